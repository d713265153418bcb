// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "numbers/Real.hpp"

#include <array>
#include <vector>

namespace polytope {

using Triangle  = std::array<int, 3>;
using Triangles = std::vector<Triangle>;

/// Convex hull of points that span space: triangles of indices, counter-clockwise seen from outside, each beginning with its
/// smallest index, in ascending order. Repeated points appear under the first one's index, points inside not at all; coplanar
/// facets come as several triangles.
///
/// Quickhull (Barber, Dobkin & Huhdanpaa 1996, "The quickhull algorithm for convex hulls", ACM Trans. Math. Softw. 22:469-483).
/// Departure: there are no thick facets. On which side of a plane a point lies is decided exactly, by an error bound in Real and
/// in exact arithmetic where that does not decide, so the surface is closed and convex whatever the points.
Triangles hullTriangles(const std::vector<Vector3>& points);

} // namespace polytope
