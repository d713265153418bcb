// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "shape/ConvexShape.hpp"

namespace polytope {

/// Signed distance from a point to a convex shape's surface (3-D; a polygon counts as its prism).
struct ClosestPoint {
	Vector3 point;    ///< nearest point of the surface, body frame
	Vector3 outward;  ///< unit, from the shape towards the query point (from its face when the query point is inside or on it)
	Real    distance; ///< positive outside, negative inside [m]
};

/// Outside: the nearest point of the faces whose plane the query point is beyond (Ericson 2005, Real-Time Collision
/// Detection, section 5.1.5, with polygons for triangles). Inside: the nearest face's plane. Exact up to rounding.
POLYTOPE_API ClosestPoint closestPoint(const ConvexShape& shape, const Vector3& query);

} // namespace polytope
