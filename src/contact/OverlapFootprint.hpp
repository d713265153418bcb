// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "shape/HalfSpaces.hpp"

#include <vector>

/// What is seen along a direction of the inside of a list of half-spaces: the area over which two bodies press on each other.
namespace polytope {

struct OverlapFootprint {
	Real    area;   ///< [m²]; 2-D: length [m]
	Matrix3 second; ///< ∫ r rᵀ dA, r from the origin and normal to the direction [m⁴]; 2-D: [m³]
};

/// `direction`: a unit vector; the inside lies within `halfWidth` of the origin, along each axis.
OverlapFootprint overlapFootprint(const std::vector<Plane>& planes, const Vector3& direction, Real halfWidth, int dimension);

} // namespace polytope
