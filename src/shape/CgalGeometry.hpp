// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "numbers/Real.hpp"

#include <limits>
#include <vector>

/// The two computations of shape construction whose outcome must not depend on rounding, done by CGAL where the digits of Real are not
/// sufficient: a linear program, and on which side of a plane a point lies. No other file includes CGAL.
namespace polytope::exact {

/// lower ≤ x ≤ upper; infinite: free.
struct Bounds {
	Vector3 lower = Vector3::Constant(-std::numeric_limits<Real>::infinity());
	Vector3 upper = Vector3::Constant(std::numeric_limits<Real>::infinity());
};

struct DeepPoint {
	Vector3 point = Vector3::Zero();
	Real    depth = 0; ///< unit normals: distance to the nearest plane, negative where the planes have no common point
};

/// max t: normals[i]·x + t ≤ offsets[i], t ≤ cap, x within bounds. Exact for the numbers given, the answer rounded.
DeepPoint deepest(const std::vector<Vector3>& normals, const std::vector<Real>& offsets, const Real& cap, const Bounds& bounds);

/// Sign of (b − a)·((c − a) × (d − a)): exact for the numbers given.
int orientation(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d);

} // namespace polytope::exact
