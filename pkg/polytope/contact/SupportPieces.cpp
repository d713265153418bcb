// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact/SupportPieces.hpp"

#include <pkg/common/Box.hpp>
#include <pkg/common/Facet.hpp>
#include <pkg/common/Wall.hpp>

#include "shape/Polytope.hpp"

namespace yade {

namespace {

	void addPlane(Planes& planes, const Vector3r& normal, Real offset) { planes.push_back({ normal, offset }); }

} // namespace

void setBody(Solid& solid, const Body& body, const Vector3r& centre, const Vector3r& other, Real near)
{
	solid.clear();
	const Matrix3r rotation = body.state->ori.toRotationMatrix();
	const Shape*   shape    = body.shape.get();
	if (const auto* polytope = dynamic_cast<const Polytope*>(shape)) {
		const auto& convex = polytope->convex();
		if (convex && centre.norm() < convex->boundingRadius() + near)
			polytope::addPlanesOf({ *convex, centre, rotation }, solid.planes);
	} else if (const auto* box = dynamic_cast<const Box*>(shape)) {
		if (!(centre.norm() < box->extents.norm() + near)) return;
		for (int k = 0; k < 3; ++k)
			for (int sign = -1; sign <= 1; sign += 2) {
				const Vector3r normal = sign * rotation.col(k);
				addPlane(solid.planes, normal, box->extents[k] + normal.dot(centre));
			}
	} else if (const auto* facet = dynamic_cast<const Facet*>(shape)) {
		// as deep as necessary, on the side away from the other body
		Vector3r corner[3];
		for (int k = 0; k < 3; ++k)
			corner[k] = centre + rotation * facet->vertices[k];
		Vector3r normal = (corner[1] - corner[0]).cross(corner[2] - corner[0]).normalized();
		if (normal.dot(other - corner[0]) < 0) normal = -normal;
		addPlane(solid.planes, normal, normal.dot(corner[0]));
		solid.faces = 1;
		for (int k = 0; k < 3; ++k) {
			Vector3r out = (corner[(k + 1) % 3] - corner[k]).cross(normal).normalized();
			if (out.dot(corner[(k + 2) % 3] - corner[k]) > 0) out = -out;
			addPlane(solid.planes, out, out.dot(corner[k]));
		}
		return;
	} else if (const auto* wall = dynamic_cast<const Wall*>(shape)) {
		const Real     side   = wall->sense != 0 ? Real(wall->sense) : other[wall->axis] - centre[wall->axis];
		const Vector3r normal = (side < 0 ? -1 : 1) * Vector3r::Unit(wall->axis);
		addPlane(solid.planes, normal, normal.dot(centre));
	}
	solid.faces = solid.planes.size();
}

bool contains(const Planes& planes, const Vector3r& point)
{
	for (const polytope::Plane& plane : planes)
		if (!(plane.normal.dot(point) <= plane.offset)) return false;
	return !planes.empty();
}

Real flushStep(const TouchingPair& pair)
{
	const Real larger = math::max(pair.convex[0]->boundingRadius(), pair.convex[1]->boundingRadius());
	return math::max(pair.ball, Real(polytope::tolerance::flush) * larger);
}

} // namespace yade
