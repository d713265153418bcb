// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>

namespace yade {

/// What is wrong with code that runs while a library is loaded, its static objects' constructors; empty if nothing is. An exception there
/// cannot be caught: it would have to pass the dynamic linker's frames, which ends the process. So a process of its own loads the library
/// first. It shares all memory until it writes, and takes milliseconds.
std::string faultOfConstructors(const std::string& path);

} // namespace yade
