// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <deque>
#include <string>
#include <vector>

/// Libraries of others with classes derived from the plug-in's (docs/extending.md).
///
/// Problem: YADE would load such a library, too, if it lay in its own folder; but in the order of the file system, and what is not found
/// ends the process. Nobody would compare what it was compiled for. So the plug-in loads it: after its own classes, and only where the text
/// that yade_polytope_add_extension() compiles into the library (cmake/yadePolytopeExtension.cpp.in) says that it fits. That is read from
/// the file, before any of the library's code runs.
namespace yade {

struct Extension {
	std::string              path;
	std::string              name;
	std::vector<std::string> classes;
};

/// The extensions that are loaded.
const std::deque<Extension>& extensions();

/// Loads one and makes its classes known to YADE and Python; nothing where it is loaded already. Throws std::runtime_error with the reason
/// where it does not fit: then none of its classes is known.
const Extension& loadExtension(const std::string& path);

} // namespace yade
