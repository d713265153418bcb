// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "shape/HalfSpaces.hpp"

#include <vector>

/// Area in which a plane cuts what lies within a list of half-spaces (3-D) or the length in which a line does (2-D).
namespace polytope {

/// The plane passes through the origin, `normal` to it is a unit vector; what lies beyond `halfWidth` from the origin does not count.
Real sectionArea(const std::vector<Plane>& planes, const Vector3& normal, Real halfWidth, int dimension);

} // namespace polytope
