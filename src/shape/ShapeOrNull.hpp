// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "shape/ConvexShape.hpp"

namespace polytope {

/// What `make` returns, or null where it throws: std::invalid_argument where construction refuses what is no solid, std::runtime_error where it
/// finds no inscribed ball, std::bad_alloc, or whatever CGAL throws. For construction in YADE's parallel loop, where an exception would end
/// the process.
template <class Make> std::shared_ptr<const ConvexShape> shapeOrNull(const Make& make) noexcept
{
	try {
		return make();
	} catch (...) {
		return nullptr;
	}
}

} // namespace polytope
