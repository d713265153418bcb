// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "shape/ConvexShape.hpp"

namespace polytope {

/// Signed distance from a point to a convex shape's surface (3-D; a polygon counts as its prism; or a half-space's).
struct ClosestPoint {
	Vector3 point;    ///< nearest point of the surface, body frame
	Vector3 outward;  ///< unit, from the shape towards the query point (from its face when the query point is inside or on it)
	Real    distance; ///< positive outside, negative inside [m]
};

/// Outside: the nearest point of the faces whose plane the query point is beyond (Ericson 2005, Real-Time Collision
/// Detection, section 5.1.5, with polygons for triangles). Inside: the nearest face's plane. Exact up to rounding.
POLYTOPE_API ClosestPoint closestPoint(const ConvexShape& shape, const Vector3& query);

/// The point of a segment that is nearest to a shape, or deepest in it.
struct ClosestOnSegment {
	Real         along;   ///< place on the segment, 0 to 1
	ClosestPoint nearest; ///< of that place
};

/// Where a segment is nearest to a shape, or deepest in it; for one that lies along a face, the middle of where it is nearest, to
/// tolerance::alongSegment. The distance along it is convex, so that thirds and halves find it. \param way from its start to its end
POLYTOPE_API ClosestOnSegment closestOnSegment(const ConvexShape& shape, const Vector3& start, const Vector3& way);

/// Where two segments are nearest to each other, each place 0 to 1 (Ericson, section 5.1.9); for parallel ones, in the middle of where they
/// lie beside each other. A segment of no length is a point.
POLYTOPE_API Vector2 closestOnSegments(const Vector3& start1, const Vector3& way1, const Vector3& start2, const Vector3& way2);

} // namespace polytope
