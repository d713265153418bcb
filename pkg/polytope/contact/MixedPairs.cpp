// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact/MixedPairs.hpp"

#include "contact/Ig2_Polytope_Polytope_PolytopeGeom.hpp"
#include "contact/SphereOnPieces.hpp"
#include "contact/StandIns.hpp"
#include "contact/StiffnessShare.hpp"
#include "host/ExactClass.hpp"
#include "shape/WallShape.hpp"

#include <core/Scene.hpp>
#include <lib/high-precision/Constants.hpp>

#include <src/shape/ShapeOrNull.hpp>

namespace yade {

POLYTOPE_CLASSES(
        (Ig2_Wall_Polytope_PolytopeGeom)(Ig2_Box_Polytope_PolytopeGeom)(Ig2_Facet_Polytope_PolytopeGeom)(Ig2_Sphere_Polytope_PolytopeGeom));

namespace {

	/// The two shapes as those of a functor's classes.
	template <class Other> struct Shapes {
		const Other*    other;
		const Polytope* polytope;

		Shapes(const shared_ptr<Shape>& shape1, const shared_ptr<Shape>& shape2)
		        : other(asClass<Other>(shape1.get())), polytope(asClass<Polytope>(shape2.get()))
		{
		}
		bool areOfTheseClasses() const { return other && polytope; }
	};

} // namespace

bool Ig2_Wall_Polytope_PolytopeGeom::go(const shared_ptr<Shape>& shape1, const shared_ptr<Shape>& shape2, const State& state1,
        const State& state2, const Vector3r& shift2, const bool& force, const shared_ptr<Interaction>& c)
{
	const Shapes<Wall> shapes(shape1, shape2);
	if (!shapes.areOfTheseClasses()) return isOfOthers(*c);
	if (!shapes.polytope->convex()) return false;
	const Wall& wall   = *shapes.other;
	const auto& convex = shapes.polytope->convex();
	if (wall.axis >= convex->dimension()) return failed(c); // parallel to a polygon's plane: it has no edge there
	StandIn& standIn = geometry(c).standIn.make();
	if (!standIn.partner) {
		const Vector3r outward = outwardOf(wall, state2.pos + shift2 - state1.pos);
		standIn.partner = polytope::shapeOrNull([&] { return polytope::ConvexShape::halfSpace(outward, convex->dimension()); });
	}
	if (!standIn.partner) return failed(c);
	const Body1Frame foot { footOn(wall, state1.pos, state2.pos + shift2), Matrix3r::Identity() };
	return query(*standIn.partner, foot, *convex, state1, state2, shift2, force, c);
}

bool Ig2_Box_Polytope_PolytopeGeom::go(const shared_ptr<Shape>& shape1, const shared_ptr<Shape>& shape2, const State& state1,
        const State& state2, const Vector3r& shift2, const bool& force, const shared_ptr<Interaction>& c)
{
	const Shapes<Box> shapes(shape1, shape2);
	if (!shapes.areOfTheseClasses()) return isOfOthers(*c);
	if (!shapes.polytope->convex()) return false;
	const auto& convex  = shapes.polytope->convex();
	StandIn&    standIn = geometry(c).standIn.make();
	standForBox(*shapes.other, convex->cornerRadius(), standIn);
	if (!standIn.partner) return failed(c);
	return query(*standIn.partner, { state1.pos, state1.ori.toRotationMatrix() }, *convex, state1, state2, shift2, force, c);
}

bool Ig2_Facet_Polytope_PolytopeGeom::go(const shared_ptr<Shape>& shape1, const shared_ptr<Shape>& shape2, const State& state1,
        const State& state2, const Vector3r& shift2, const bool& force, const shared_ptr<Interaction>& c)
{
	const Shapes<Facet> shapes(shape1, shape2);
	if (!shapes.areOfTheseClasses()) return isOfOthers(*c);
	if (!shapes.polytope->convex()) return false;
	const auto& convex  = shapes.polytope->convex();
	StandIn&    standIn = geometry(c).standIn.make();
	standForFacet(*Body::byId(c->getId1(), scene), *Body::byId(c->getId2(), scene), shift2, *scene, !c->isReal(),
	        2 * convex->boundingRadius(), convex->cornerRadius(), standIn);
	if (!standIn.partner) return failed(c);
	return query(*standIn.partner, { state1.pos, state1.ori.toRotationMatrix() }, *convex, state1, state2, shift2, force, c);
}

bool Ig2_Sphere_Polytope_PolytopeGeom::go(const shared_ptr<Shape>& shape1, const shared_ptr<Shape>& shape2, const State& state1,
        const State& state2, const Vector3r& shift2, const bool& force, const shared_ptr<Interaction>& c)
{
	const Shapes<Sphere> shapes(shape1, shape2);
	if (!shapes.areOfTheseClasses()) return isOfOthers(*c);
	if (!shapes.polytope->convex()) return false;
	const Real     radius  = shapes.other->radius;
	const auto&    convex  = shapes.polytope->convex();
	const Vector3r centre2 = state2.pos + shift2 - state1.pos;
	const bool     wasReal = c->isReal();
	if (!wasReal && !force && centre2.norm() > radius + convex->boundingRadius()) return false;

	NearestOfSphere         nearest = nearestOfSphere(*convex, centre2, state2.ori);
	polytope::ContactResult result;
	result.inContact     = radius - nearest.distance > ofScene().tolerance * radius;
	result.hasGeometry   = true;
	result.status        = result.inContact ? polytope::ContactStatus::Contact : polytope::ContactStatus::Separated;
	const Real share     = result.inContact
	            ? shareOfSphere(*Body::byId(c->getId1(), scene), radius, *Body::byId(c->getId2(), scene), centre2, *scene, nearest)
	            : Real(1);
	const Real depth     = radius - nearest.distance;
	result.depth         = depth;
	result.infeasibility = -depth / 2; // the diameter of the largest ball between a sphere and a plane is the depth
	result.normal        = -nearest.outward;
	result.point         = (radius - depth / 2) * result.normal;
	result.area          = share * Mathr::PI * discRadiusSquared(radius, depth);
	if (result.inContact) {
		PolytopeGeom& geom = geometry(c);
		if (!wasReal) geom.stiffnessRule = std::int8_t(stiffnessRuleOfNew(*scene, *c));
		const bool perArea = geom.stiffnessRule == int(StiffnessRule::PerArea);
		result.energy      = depth * depth * (perArea ? energyOfSpherePerArea(radius, depth) : Real(0.5));
		giveShare(share, geom, *c, result);
	}
	return apply(result, state1.pos, state1, state2, shift2, force, c);
}

} // namespace yade
