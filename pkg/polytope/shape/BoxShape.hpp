// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "shape/ShapeFamily.hpp"

#include <pkg/common/Box.hpp>

#include <src/shape/ConvexShape.hpp>

/// YADE's box as half-spaces.
namespace yade {

/// Calls visit(axis, sign, offset) for its six half-spaces: −x, x, −y, y, −z, z of its own axes.
template <class Visit> void forPlanesOf(const Box& box, const Visit& visit)
{
	for (int axis = 0; axis < 3; ++axis)
		for (int sign = -1; sign <= 1; sign += 2)
			visit(axis, sign, box.extents[axis]);
}

/// In its own axes, in that order.
polytope::HalfSpaces halfSpacesOf(const Box& box);

/// Whether these are a solid's.
bool isMadeOf(const polytope::ConvexShape& solid, const Box& box);

std::unique_ptr<const ShapeFamily> familyOfBoxes();

} // namespace yade
