// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact/CoreFeatures.hpp"

#include "shape/DistanceTolerances.hpp"

#include <limits>

namespace polytope {

Real parallelism(const Real& slopeSquared, Real& change)
{
	const Real most = Real(tolerance::parallelFeatures) * Real(tolerance::parallelFeatures), rest = 1 - slopeSquared / most;
	change = 0;
	if (!(rest > 0)) return 0;
	change = -2 * rest / most;
	return rest * rest;
}

CoreFeatures::CoreFeatures(const CoreInPlace& core, const Vector3& outward)
{
	if (core.shape) {
		takeFace(core, outward);
		takeEdge(core, outward);
	} else {
		ends = { core.origin, core.origin + core.way };
		weighEdge(outward);
	}
}

void CoreFeatures::takeFace(const CoreInPlace& core, const Vector3& outward)
{
	const Polyhedron& hull   = core.shape->polyhedron();
	const auto&       planes = core.shape->planes();
	const Vector3     own    = core.rotation.transpose() * outward;
	std::size_t       best   = 0;
	Real              most   = -1;
	for (std::size_t f = 0; f < hull.faces.size(); ++f) {
		if (hull.planeOfFace[f] < 0) continue;
		const Real cosine = planes.normals[hull.planeOfFace[f]].dot(own);
		if (cosine > most) {
			most = cosine;
			best = f;
		}
	}
	const bool halfSpace = hull.faces.empty();
	const int  plane     = halfSpace ? 0 : hull.planeOfFace[best];
	faceNormal           = core.rotation * planes.normals[plane];
	onFace               = core.origin + planes.offsets[plane] * faceNormal;
	if (core.pieces) faces = *core.pieces;
	else if (!halfSpace) {
		faces.emplace_back();
		for (int v : hull.faces[best])
			faces.back().push_back(core.origin + core.rotation * hull.vertices[v]);
	}
	const Real cosine = faceNormal.dot(outward);
	if (!(cosine > 0)) return;
	const Vector3 axis = faceNormal.cross(outward);
	Real          change;
	face.value = parallelism(axis.squaredNorm(), change);
	face.turn  = -2 * change * cosine * axis; // the square of the sine is 1 − cosine²
}

void CoreFeatures::takeEdge(const CoreInPlace& core, const Vector3& outward)
{
	const Polyhedron& hull    = core.shape->polyhedron();
	const Vector3     own     = core.rotation.transpose() * outward;
	Real              most    = -std::numeric_limits<Real>::infinity();
	int               best[2] = { -1, -1 };
	for (const auto& loop : hull.faces)
		for (std::size_t k = 0; k < loop.size(); ++k) {
			const int  one = loop[k], other = loop[(k + 1) % loop.size()];
			const Real height = own.dot(hull.vertices[one] + hull.vertices[other]);
			if (one > other || !(height > most)) continue; // each edge has two faces
			most    = height;
			best[0] = one;
			best[1] = other;
		}
	if (best[0] < 0) return;
	for (int k = 0; k < 2; ++k)
		ends[k] = core.origin + core.rotation * hull.vertices[best[k]];
	weighEdge(outward);
}

void CoreFeatures::weighEdge(const Vector3& outward)
{
	const Vector3 way    = ends[1] - ends[0];
	const Real    length = way.norm();
	if (!(length > 0)) return;
	const Vector3 along = way / length;
	const Real    sine  = along.dot(outward);
	Real          change;
	edge.value = parallelism(sine * sine, change);
	edge.turn  = 2 * change * sine * along.cross(outward);
}

} // namespace polytope
