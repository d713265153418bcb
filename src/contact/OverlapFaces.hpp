// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "shape/HalfSpaces.hpp"

#include <vector>

/// The faces of the inside of a list of half-spaces: which planes bound the overlap of two bodies, and where.
namespace polytope {

struct OverlapFace {
	int                  plane; ///< in the list; −1: of the box that the inside was sought in
	std::vector<Vector3> corners;
};

/// The inside of `planes` that lies within `halfWidth` of the origin along each axis; the origin is inside. Empty where the faces are more
/// than there is room for.
std::vector<OverlapFace> overlapFaces(const std::vector<Plane>& planes, Real halfWidth);

} // namespace polytope
