// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "shape/HalfSpaces.hpp"

#include <vector>

/// A joint that ends inside the rock, and what it has in common with a convex polygon in its plane.
namespace polytope {

/// Part of a plane: all of it, or a disc, less what lies beyond straight edges. A convex polygon is the disc about its corners with an edge for
/// each side; a joint that ends at others has an edge for each of them.
struct FiniteJoint {
	Plane              plane;
	Vector3            centre = Vector3::Zero();
	Real               radius = 0;      ///< of the disc; 0: there is none
	std::vector<Plane> edges;           ///< it lies where normal·x ≤ offset; these planes cross its own
	Real               persistence = 1; ///< probability that a block which it reaches into is cut

	bool bounded() const { return radius > 0 || !edges.empty(); }
};

/// Corners in order, in one plane.
using Polygon = std::vector<Vector3>;

/// Positive where the corners run counter-clockwise about the normal.
Real areaOfPolygon(const Polygon& polygon, const Vector3& normal);

/// What of a convex polygon lies where the half-space is fulfilled. Fewer than three corners: nothing.
Polygon clipped(const Polygon& polygon, const Plane& halfSpace);

/// What two convex polygons in one plane have in common; the second runs counter-clockwise about the normal.
Polygon commonPart(Polygon first, const Polygon& second, const Vector3& normal);

/// Area that a joint and a convex polygon in its plane have in common, exact to rounding. The polygon may run either way.
Real areaWithin(const FiniteJoint& joint, Polygon polygon);

/// Area of a convex polygon that none of these joints covers, all in its plane with this normal. Exact for one joint, and for polygons;
/// where several overlap, a disc counts as the regular polygon of construction::discSides sides about it.
Real uncovered(const Polygon& polygon, const Vector3& normal, const std::vector<const FiniteJoint*>& joints);

} // namespace polytope
