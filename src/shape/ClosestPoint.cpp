// SPDX-License-Identifier: GPL-2.0-or-later
#include "shape/ClosestPoint.hpp"

#include "shape/DistanceTolerances.hpp"

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
	if (hull.faces.empty()) { // a half-space
		const Vector3& normal = shape.planes().normals.front();
		const Real     beyond = normal.dot(query) - shape.planes().offsets.front();
		return { query - beyond * normal, normal, beyond };
	}
	ClosestPoint outside, inside;
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

ClosestOnSegment closestOnSegment(const ConvexShape& shape, const Vector3& start, const Vector3& way)
{
	const auto at       = [&](Real along) { return closestPoint(shape, Vector3(start + along * way)); };
	const auto distance = [&](Real along) { return at(along).distance; };
	if (way == Vector3::Zero()) return { 0, at(0) };
	Real low = 0, high = 1;
	for (int k = 0; k < tolerance::segmentSteps; ++k) {
		const Real third = (high - low) / 3;
		if (distance(low + third) > distance(high - third)) low += third;
		else high -= third;
	}
	const Real least = (low + high) / 2, most = distance(least) + Real(tolerance::alongSegment) * way.norm();
	const auto end = [&](Real outside) { // of where it is as near
		if (distance(outside) <= most) return outside;
		Real inside = least;
		for (int k = 0; k < tolerance::segmentSteps; ++k) {
			const Real middle                             = (inside + outside) / 2;
			(distance(middle) <= most ? inside : outside) = middle;
		}
		return inside;
	};
	const Real along = (end(0) + end(1)) / 2;
	return { along, at(along) };
}

Vector2 closestOnSegments(const Vector3& start1, const Vector3& way1, const Vector3& start2, const Vector3& way2)
{
	const auto    within = [](Real place) { return std::min(std::max(place, Real(0)), Real(1)); };
	const Vector3 from   = start1 - start2;
	const Real    a = way1.squaredNorm(), e = way2.squaredNorm(), b = way1.dot(way2), c = way1.dot(from), f = way2.dot(from);
	if (!(a > 0)) return { 0, e > 0 ? within(f / e) : Real(0) };
	if (!(e > 0)) return { within(-c / a), 0 };
	const Real cross = a * e - b * b;
	if (cross <= Real(tolerance::parallelSegments) * a * e) { // in units of segment 1: from where to where the other one lies beside it
		const Real one = -c / a, other = one + b / a;
		const Real first = within((within(std::min(one, other)) + within(std::max(one, other))) / 2);
		return { first, within((b * first + f) / e) };
	}
	Real first = within((b * f - c * e) / cross), second = (b * first + f) / e;
	if (second < 0 || second > 1) {
		second = within(second);
		first  = within((b * second - c) / a);
	}
	return { first, second };
}

} // namespace polytope
