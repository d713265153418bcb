// SPDX-License-Identifier: GPL-2.0-or-later
#include "shape/ClosestPoint.hpp"

#include <algorithm>
#include <limits>

namespace polytope {

namespace {

	Vector3 onSegment(const Vector3& a, const Vector3& b, const Vector3& query)
	{
		const Vector3 edge   = b - a;
		const Real    length = edge.squaredNorm();
		const Real    t      = length > 0 ? (query - a).dot(edge) / length : Real(0);
		return a + std::min(std::max(t, Real(0)), Real(1)) * edge;
	}

	Vector3 onFace(const Polyhedron& shape, const std::vector<int>& face, const Vector3& normal, const Vector3& query)
	{
		const Vector3 foot   = query - normal.dot(query - shape.vertices[face.front()]) * normal;
		Real          best   = std::numeric_limits<Real>::infinity();
		Vector3       answer = foot;
		bool          inside = true;
		for (std::size_t k = 0; k < face.size(); ++k) {
			const Vector3& a = shape.vertices[face[k]];
			const Vector3& b = shape.vertices[face[(k + 1) % face.size()]];
			if ((b - a).cross(foot - a).dot(normal) >= 0) continue;
			inside                  = false;
			const Vector3 candidate = onSegment(a, b, query);
			const Real    distance  = (candidate - query).squaredNorm();
			if (distance < best) {
				best   = distance;
				answer = candidate;
			}
		}
		return inside ? foot : answer;
	}

} // namespace

ClosestPoint closestPoint(const ConvexShape& shape, const Vector3& query)
{
	const Polyhedron& hull = shape.polyhedron();
	ClosestPoint      outside, inside;
	outside.distance = std::numeric_limits<Real>::infinity();
	inside.distance  = -std::numeric_limits<Real>::infinity();
	outside.point = outside.outward = inside.point = inside.outward = Vector3::Zero();
	for (std::size_t f = 0; f < hull.faces.size(); ++f) {
		const int plane = hull.planeOfFace[f];
		// the caps of a polygon's prism have no plane of their own
		const Vector3 normal
		        = plane >= 0 ? shape.planes().normals[plane] : Vector3(0, 0, hull.vertices[hull.faces[f].front()].z() > 0 ? 1 : -1);
		const Real beyond = normal.dot(query - hull.vertices[hull.faces[f].front()]);
		if (beyond > inside.distance) inside = { query - beyond * normal, normal, beyond };
		if (!(beyond > 0)) continue;
		const Vector3 point    = onFace(hull, hull.faces[f], normal, query);
		const Real    distance = (query - point).norm();
		if (distance < outside.distance) outside = { point, distance > 0 ? Vector3((query - point) / distance) : normal, distance };
	}
	return inside.distance > 0 ? outside : inside;
}

} // namespace polytope
