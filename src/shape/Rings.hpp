// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "shape/ShapeConstruction.hpp"
#include "shape/SolidMoments.hpp"

#include <cstddef>

/// Plane convex polygons as lists of their corners in turn.
namespace polytope {

/// What of a convex ring lies where `height`, a linear function of the place, is not negative. `kept` takes the corners, after those that
/// are in it. A corner is a point, or what else is linear along a side: with a sum, a difference and a multiple.
template <class Ring, class Height> void keepAbove(const Ring& ring, const Height& height, Ring& kept)
{
	for (std::size_t k = 0, count = ring.size(); k < count; ++k) {
		const auto &here = ring[k], &next = ring[k + 1 < count ? k + 1 : 0];
		const Real  atHere = height(here), atNext = height(next);
		if (atHere >= 0) kept.push_back(here);
		if ((atHere > 0 && atNext < 0) || (atHere < 0 && atNext > 0))
			kept.push_back(here + Real(atHere / (atHere - atNext)) * (next - here));
	}
}

/// Area vector of a ring in space: as long as its area is large, and in the direction from which it is counter-clockwise. `corner(k)`: its corners.
template <class Corner> Vector3 areaVector(std::size_t count, const Corner& corner)
{
	Vector3 twice = Vector3::Zero();
	for (std::size_t k = 2; k < count; ++k)
		twice += (corner(k - 1) - corner(0)).cross(corner(k) - corner(0));
	return twice / 2;
}

/// Area vector of face k of a polyhedron, outward.
inline Vector3 faceArea(const Polyhedron& hull, std::size_t k)
{
	const std::vector<int>& face = hull.faces[k];
	return areaVector(face.size(), [&](std::size_t corner) -> const Vector3& { return hull.vertices[std::size_t(face[corner])]; });
}

/// Moments of face k of a polyhedron over its area, from a place. `normal`: outward, of unit length.
inline SolidMoments faceMoments(const Polyhedron& hull, std::size_t k, const Vector3& normal, const Vector3& from)
{
	const std::vector<int>& face   = hull.faces[k];
	const auto              corner = [&](std::size_t n) -> Vector3 { return hull.vertices[std::size_t(face[n])] - from; };
	SolidMoments            sum;
	for (std::size_t n = 2; n < face.size(); ++n)
		sum.addTriangle(corner(0), corner(n - 1), corner(n), normal);
	return sum;
}

} // namespace polytope
