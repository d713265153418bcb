// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "shape/HalfSpaces.hpp"

#include <vector>

/// What a plane cuts out of the inside of a list of half-spaces (3-D), or a line (2-D): area (length) and second moment.
namespace polytope {

/// The plane passes through the origin, `normal` to it is a unit vector; what lies beyond `halfWidth` from the origin does not count.
Real sectionArea(const std::vector<Plane>& planes, const Vector3& normal, Real halfWidth, int dimension);

/// ∫ r rᵀ dA over the same section, r from the origin.
Matrix3 sectionSecondMoment(const std::vector<Plane>& planes, const Vector3& normal, Real halfWidth, int dimension);

} // namespace polytope
