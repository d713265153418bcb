// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact/SphereOnPieces.hpp"

#include "contact/PieceTolerances.hpp"
#include "host/Partners.hpp"
#include "host/PartsOfBodies.hpp"
#include "shape/ShapeOfBody.hpp"

#include <lib/high-precision/Constants.hpp>

#include <src/contact/SectionArea.hpp>
#include <src/numbers/Tolerances.hpp>
#include <src/shape/ClosestPoint.hpp>

namespace yade {

namespace {

	/// Whether a point, from the same origin, lies in a solid or as near as `reach` to each of its half-spaces.
	bool reaches(const polytope::ConvexShape& solid, const Vector3r& centre, const Quaternionr& orientation, const Vector3r& point,
	        const Real& reach)
	{
		const Vector3r              own    = orientation.conjugate() * Vector3r(point - centre);
		const polytope::HalfSpaces& planes = solid.planes();
		for (size_t i = 0; i < planes.size(); ++i)
			if (planes.normals[i].dot(own) - planes.offsets[i] > reach) return false;
		return true;
	}

	/// Calls visit(solid, its centre from the sphere's, orientation) for the other polytopes that reach as near as `reach` to a point.
	template <class Visit>
	void forPiecesAt(const Body& sphere, const Real& radius, const Body& piece, Scene& scene, const Vector3r& point, const Real& reach,
	        const Visit& visit)
	{
		forPartners(sphere, piece.id, scene, [&](const Body& other, const Vector3r& shift) {
			const polytope::ConvexShape* const solid = convexShapeOf(other);
			if (!solid || inOneClump(other, sphere)) return; // which never touch
			const Vector3r centre = other.state->pos + shift - sphere.state->pos;
			if (centre.norm() > radius + solid->boundingRadius()) return;
			if (reaches(*solid, centre, other.state->ori, point, reach)) visit(*solid, centre, other.state->ori);
		});
	}

	/// Half-spaces of a disc's rim: around the origin, normal to `normal`.
	void addRim(const Vector3r& normal, const Real& radius, std::vector<polytope::Plane>& planes)
	{
		const Vector3r u = normal.unitOrthogonal(), v = normal.cross(u);
		for (int k = 0; k < pieces::discSides; ++k) {
			const Real angle = 2 * Mathr::PI * k / pieces::discSides;
			planes.push_back({ math::cos(angle) * u + math::sin(angle) * v, radius });
		}
	}

} // namespace

NearestOfSphere nearestOfSphere(const polytope::ConvexShape& solid, const Vector3r& centre, const Quaternionr& orientation)
{
	const polytope::ClosestPoint nearest = polytope::closestPoint(solid, orientation.conjugate() * Vector3r(-centre));
	return { centre + orientation * nearest.point, orientation * nearest.outward, nearest.distance };
}

Real discRadiusSquared(const Real& radius, const Real& depth)
{
	const Real cap = math::max(Real(0), math::min(Real(depth / 2), radius));
	return cap * (2 * radius - cap);
}

Real energyOfSpherePerArea(const Real& radius, const Real& depth)
{
	const Real part = math::min(Real(depth / radius), Real(2));
	return (Real(1) / 3 - part / 16) / (1 - part / 4);
}

Real shareOfSphere(
        const Body& sphere, const Real& radius, const Body& piece, const Vector3r& centre, Scene& scene, NearestOfSphere& nearest)
{
	if (sphere.intrs.size() < 2) return 1;
	const auto& own  = *static_cast<const Polytope&>(*piece.shape).convex();
	const Real  room = math::max(radius - nearest.distance, Real(polytope::tolerance::flush) * math::min(radius, own.boundingRadius()));
	// each time a piece that is nearer: the end is that of a way over the pieces towards the sphere's centre
	for (bool nearer = true; nearer;) {
		nearer                        = false;
		const NearestOfSphere present = nearest;
		forPiecesAt(sphere, radius, piece, scene, present.point, room,
		        [&](const polytope::ConvexShape& solid, const Vector3r& at, const Quaternionr& orientation) {
			        const NearestOfSphere other = nearestOfSphere(solid, at, orientation);
			        if (!(other.distance < nearest.distance)) return;
			        nearest = other;
			        nearer  = true;
		        });
	}

	const Real     depth = radius - nearest.distance, disc = math::sqrt(discRadiusSquared(radius, depth));
	const Vector3r point = nearest.point - depth / 2 * nearest.outward;
	static thread_local std::vector<polytope::Plane> planes;
	planes.clear();
	const auto areaOf = [&](const polytope::ConvexShape& solid, const Vector3r& at, const Quaternionr& orientation) {
		planes.resize(pieces::discSides, { Vector3r::Zero(), 0 });
		polytope::addPlanesOf({ solid, at - point, orientation.toRotationMatrix() }, planes);
		return polytope::sectionArea(planes, nearest.outward, 2 * disc, 3);
	};
	Real here = -1, all = 0;
	forPiecesAt(sphere, radius, piece, scene, point, disc,
	        [&](const polytope::ConvexShape& solid, const Vector3r& at, const Quaternionr& orientation) {
		        if (here < 0) {
			        addRim(nearest.outward, disc, planes);
			        here = all = areaOf(own, centre, piece.state->ori);
		        }
		        all += areaOf(solid, at, orientation);
	        });
	if (!(all > 0)) return 1;
	return math::max(here / all, Real(polytope::tolerance::leastShareOfSupport));
}

} // namespace yade
