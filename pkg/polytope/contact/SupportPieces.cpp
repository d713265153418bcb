// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact/SupportPieces.hpp"

#include <src/numbers/Tolerances.hpp>

#include <limits>

namespace yade {

int supportOf(const TouchingPair& pair)
{
	const Body &first = bodyOf(pair, 0), &second = bodyOf(pair, 1);
	const bool  fixed = isFixed(first, *pair.scene);
	if (fixed != isFixed(second, *pair.scene)) return fixed ? 0 : 1;
	return first.id < second.id ? 0 : 1;
}

void setBody(Solid& solid, const Body& body, const Vector3r& centre, const Vector3r& other, Real near)
{
	solid.clear();
	if (body.shape) familyOf(*body.shape).addSupport(*body.shape, { centre, body.state->ori.toRotationMatrix(), other, near }, solid);
}

bool contains(const Planes& planes, const Vector3r& point, const Real& room)
{
	for (const polytope::Plane& plane : planes)
		if (!(plane.normal.dot(point) <= plane.offset + room)) return false;
	return !planes.empty();
}

const polytope::Plane* faceAt(const Solid& solid, const Vector3r& outward, const Vector3r& point, Real step)
{
	for (std::size_t k = 0; k < solid.faces; ++k) {
		const polytope::Plane& plane = solid.planes[k];
		if (plane.normal.dot(outward) > 1 - Real(polytope::tolerance::parallel)
		        && math::abs(plane.offset - plane.normal.dot(point)) <= step)
			return &plane;
	}
	return nullptr;
}

Real roundingOf(const TouchingPair& pair)
{
	Real larger = 0;
	for (const polytope::ConvexShape* const convex : pair.convex)
		if (math::isfinite(convex->boundingRadius())) larger = math::max(larger, convex->boundingRadius());
	return Real(polytope::tolerance::flush) * larger;
}

Real flushStep(const TouchingPair& pair) { return math::max(Real(polytope::tolerance::flushOfDepth) * pair.ball, roundingOf(pair)); }

Real imagesApart(const Scene& scene)
{
	if (!scene.isPeriodic) return std::numeric_limits<Real>::infinity();
	return Real(polytope::tolerance::flush) * scene.cell->getSize().norm();
}

} // namespace yade
