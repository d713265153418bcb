// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "numbers/Real.hpp"

#include <array>
#include <limits>
#include <vector>

/// The two questions of shape construction that must not be decided by rounding, asked of CGAL: a linear program in
/// exact arithmetic and a convex hull with exact predicates. No other file includes CGAL.
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

using Triangle  = std::array<int, 3>;
using Triangles = std::vector<Triangle>;

/// Convex hull of points that span space: triangles of indices, counter-clockwise seen from outside. Repeated points
/// appear under the first one's index, points inside not at all; coplanar facets come as several triangles.
Triangles hullTriangles(const std::vector<Vector3>& points);

} // namespace polytope::exact
