// SPDX-License-Identifier: GPL-2.0-or-later
#include "cutting/FiniteJoint.hpp"

#include "shape/Rings.hpp"

#include "shape/CheckedNumbers.hpp"
#include "shape/ConstructionTolerances.hpp"

#include <algorithm>

namespace polytope {
namespace {

	/// Area of the sector of a circle between two rays from its centre, less than half a turn apart.
	Real sector(const Vector3& from, const Vector3& to, const Vector3& normal, const Real& radius)
	{
		using std::atan2;
		return radius * radius / 2 * atan2(normal.dot(from.cross(to)), from.dot(to));
	}

	/// What the edge from a to b, seen from the circle's centre, adds to the area that circle and polygon share.
	Real shareOfEdge(const Vector3& a, const Vector3& b, const Vector3& normal, const Real& radius, bool& crossed)
	{
		const Vector3 along  = b - a;
		const Real    square = along.squaredNorm(), half = a.dot(along), outside = a.squaredNorm() - radius * radius;
		const Real    root = half * half - square * outside;
		if (root <= 0 || square == 0) return sector(a, b, normal, radius);
		const Real reach = sqrt(root);
		const Real first = std::max(Real(0), Real((-half - reach) / square)),
		           last  = std::min(Real(1), Real((-half + reach) / square));
		if (first >= last) return sector(a, b, normal, radius);
		crossed          = true;
		const Vector3 in = a + first * along, out = a + last * along;
		Real          area = normal.dot(in.cross(out)) / 2;
		if (first > 0) area += sector(a, in, normal, radius);
		if (last < 1) area += sector(out, b, normal, radius);
		return area;
	}

	/// A disc with its edges, as a polygon.
	Polygon outline(const FiniteJoint& joint, const Real& reach)
	{
		using std::cos;
		using std::sin;
		const Vector3 first = joint.plane.normal.unitOrthogonal(), second = joint.plane.normal.cross(first);
		const int     sides  = construction::discSides;
		const Real    turn   = 2 * Real(EIGEN_PI) / sides;
		const Real    corner = (joint.radius > 0 ? joint.radius : reach) / cos(Real(turn / 2));
		Polygon       polygon;
		for (int k = 0; k < sides; ++k) {
			const Real angle = k * turn, across = corner * cos(angle), up = corner * sin(angle);
			polygon.push_back(joint.centre + across * first + up * second);
		}
		for (const Plane& edge : joint.edges)
			polygon = clipped(polygon, edge);
		return polygon;
	}

	/// The side of a polygon's edge from a to b on which its inside is.
	Plane insideOf(const Vector3& a, const Vector3& b, const Vector3& normal)
	{
		const Vector3 outward = (b - a).cross(normal);
		return { outward, outward.dot(a) };
	}

	/// Convex pieces that are left of convex ones where another one is taken out.
	std::vector<Polygon> without(const std::vector<Polygon>& pieces, const Polygon& taken, const Vector3& normal)
	{
		if (taken.size() < 3) return pieces;
		std::vector<Polygon> left;
		for (Polygon piece : pieces)
			for (std::size_t k = 0; k < taken.size() && piece.size() >= 3; ++k) {
				const Plane inside = insideOf(taken[k], taken[(k + 1) % taken.size()], normal);
				Polygon     beyond = clipped(piece, { -inside.normal, -inside.offset });
				if (beyond.size() >= 3) left.push_back(std::move(beyond));
				piece = clipped(piece, inside);
			}
		return left;
	}

} // namespace

Real areaOfPolygon(const Polygon& polygon, const Vector3& normal)
{
	return normal.dot(areaVector(polygon.size(), [&](std::size_t k) -> const Vector3& { return polygon[k]; }));
}

Polygon clipped(const Polygon& polygon, const Plane& halfSpace)
{
	Polygon part;
	keepAbove(polygon, [&](const Vector3& x) { return Real(halfSpace.offset - halfSpace.normal.dot(x)); }, part);
	if (part.size() < 3) part.clear();
	return part;
}

Polygon commonPart(Polygon first, const Polygon& second, const Vector3& normal)
{
	for (std::size_t k = 0; k < second.size() && !first.empty(); ++k)
		first = clipped(first, insideOf(second[k], second[(k + 1) % second.size()], normal));
	return first;
}

Real areaWithin(const FiniteJoint& joint, Polygon polygon)
{
	for (const Plane& edge : joint.edges)
		polygon = clipped(polygon, edge);
	const Vector3& normal = joint.plane.normal;
	const Real     whole = magnitude(areaOfPolygon(polygon, normal)), square = joint.radius * joint.radius;
	if (joint.radius <= 0) return whole;
	// sums about the disc's centre have the rounding of the disc's area: not where the answer is zero, or all of a small polygon
	bool inside = true;
	for (Vector3& corner : polygon) {
		corner -= joint.centre;
		inside = inside && corner.squaredNorm() <= square;
	}
	if (inside) return whole;
	Real area    = 0;
	bool crossed = false;
	for (std::size_t k = 0; k < polygon.size(); ++k)
		area += shareOfEdge(polygon[k], polygon[(k + 1) % polygon.size()], normal, joint.radius, crossed);
	return crossed || magnitude(area) > square ? magnitude(area) : Real(0);
}

Real uncovered(const Polygon& polygon, const Vector3& normal, const std::vector<const FiniteJoint*>& joints)
{
	const Real whole = magnitude(areaOfPolygon(polygon, normal));
	if (joints.size() == 1) return std::max(Real(0), Real(whole - areaWithin(*joints.front(), polygon)));
	std::vector<Polygon> left { polygon };
	for (const FiniteJoint* joint : joints) {
		Real reach = 0;
		for (const Vector3& corner : polygon)
			reach = std::max(reach, Real((corner - joint->centre).norm()));
		left = without(left, outline(*joint, reach), joint->plane.normal);
	}
	Real area = 0;
	for (const Polygon& piece : left)
		area += magnitude(areaOfPolygon(piece, normal));
	return area;
}

} // namespace polytope
