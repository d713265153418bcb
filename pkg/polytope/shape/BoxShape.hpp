// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "shape/ShapeFamily.hpp"

#include <pkg/common/Box.hpp>

#include <src/shape/ConvexShape.hpp>

/// YADE's box as half-spaces.
namespace yade {

/// In its own axes.
inline polytope::HalfSpaces halfSpacesOf(const Box& box) { return polytope::cuboid(box.extents); }

/// Whether these are a solid's.
bool isMadeOf(const polytope::ConvexShape& solid, const Box& box);

std::unique_ptr<const ShapeFamily> familyOfBoxes();

} // namespace yade
