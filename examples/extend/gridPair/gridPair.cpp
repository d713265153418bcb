// SPDX-License-Identifier: GPL-2.0-or-later
//
// A polytope on a beam of YADE's grids (GridConnection, a segment with a radius): a geometry of its own with the place along the segment, a family for the
// segment's size, and a law whose force acts on the two nodes.
#include <yade-polytope/contact/PolytopeGeom.hpp>
#include <yade-polytope/shape/ShapeFamily.hpp>

#include <polytope/shape/ClosestPoint.hpp>

#include <core/Scene.hpp>
#include <pkg/common/Grid.hpp>
#include <pkg/dem/FrictPhys.hpp>

namespace yade {

/// GridConnection is derived from Sphere; it is no ball.
class SegmentFamily : public ShapeFamily {
	Real boundingRadius(const Shape& shape) const override
	{
		const auto& beam = static_cast<const GridConnection&>(shape);
		return beam.getLength() + beam.radius; // its position is that of the first node
	}
	Real size(const Shape& shape) const override { return static_cast<const GridConnection&>(shape).radius; }
};
const FamilyOf<GridConnection, SegmentFamily> family;

class PolytopeGridGeom : public PolytopeGeom {
public:
	virtual ~PolytopeGridGeom() = default;
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR(PolytopeGridGeom, PolytopeGeom, "Contact of a beam and a polytope.", ((Real, along, 0, , "Place on the beam, 0 to 1")), createIndex(););
	// clang-format on
	REGISTER_CLASS_INDEX(PolytopeGridGeom, PolytopeGeom);
};
REGISTER_SERIALIZABLE(PolytopeGridGeom);

class Ig2_GridConnection_Polytope_PolytopeGridGeom : public PolytopeGeomFunctor {
public:
	bool go(const shared_ptr<Shape>& shape1, const shared_ptr<Shape>& shape2, const State&, const State& state2, const Vector3r& shift2,
	        const bool& force, const shared_ptr<Interaction>& c) override
	{
		const auto&    beam  = static_cast<const GridConnection&>(*shape1);
		const auto&    solid = *static_cast<const Polytope&>(*shape2).convex();
		const State &  a = *beam.node1->state, &b = *beam.node2->state;
		const Vector3r start = state2.ori.conjugate() * Vector3r(a.pos - state2.pos - shift2),
		               way   = state2.ori.conjugate() * Vector3r(b.pos - a.pos);
		const auto at        = [&](Real part) { return polytope::closestPoint(solid, start + part * way); };
		const Real along     = middleOfNearest([&](Real part) { return at(part).distance; }, 1e-9 * solid.boundingRadius());
		const auto near      = at(along);
		polytope::ContactResult result;
		result.depth       = beam.radius - near.distance;
		result.inContact   = result.depth > 0;
		result.hasGeometry = true;
		result.status      = result.inContact ? polytope::ContactStatus::Contact : polytope::ContactStatus::Separated;
		if (!result.inContact && !c->isReal() && !force) return apply(result, a.pos, a, state2, shift2, force, c);
		result.normal = state2.ori * Vector3r(-near.outward);
		result.point  = (beam.radius - result.depth / 2) * result.normal;
		if (!c->geom) c->geom = shared_ptr<PolytopeGridGeom>(new PolytopeGridGeom);
		static_cast<PolytopeGridGeom&>(*c->geom).along = along;
		State foot; // of the beam, where it is touched
		foot.pos = a.pos + along * (b.pos - a.pos);
		foot.vel = a.vel + along * (b.vel - a.vel);
		return apply(result, foot.pos, foot, state2, shift2, force, c);
	}
	bool goReverse(const shared_ptr<Shape>& shape1, const shared_ptr<Shape>& shape2, const State& state1, const State& state2,
	        const Vector3r& shift2, const bool& force, const shared_ptr<Interaction>& c) override
	{
		c->swapOrder();
		return go(shape2, shape1, state2, state1, -shift2, force, c);
	}
	FUNCTOR2D(GridConnection, Polytope);
	DEFINE_FUNCTOR_ORDER_2D(GridConnection, Polytope);
	YADE_CLASS_BASE_DOC(Ig2_GridConnection_Polytope_PolytopeGridGeom, PolytopeGeomFunctor, "Contact of beams of grids with polytopes.");

private:
	/// Where along the segment a convex function is least: the middle of where it is less than `rest` above that, as on a face along which the beam lies.
	template <class Distance> static Real middleOfNearest(const Distance& distance, Real rest)
	{
		Real low = 0, high = 1;
		for (int k = 0; k < 60; ++k) {
			const Real third = (high - low) / 3;
			(distance(low + third) > distance(high - third) ? low : high)
			        = distance(low + third) > distance(high - third) ? low + third : high - third;
		}
		const Real least = (low + high) / 2, most = distance(least) + rest;
		const auto end = [&](Real outside) {
			Real inside = least;
			for (int k = 0; k < 50; ++k) {
				const Real middle                             = (inside + outside) / 2;
				(distance(middle) <= most ? inside : outside) = middle;
			}
			return inside;
		};
		return (end(0) + end(1)) / 2;
	}
};
REGISTER_SERIALIZABLE(Ig2_GridConnection_Polytope_PolytopeGridGeom);

class Law2_PolytopeGridGeom_FrictPhys_CundallStrack : public LawFunctor {
public:
	bool go(shared_ptr<IGeom>& geometry, shared_ptr<IPhys>& physics, Interaction* c) override
	{
		auto& geom = static_cast<PolytopeGridGeom&>(*geometry);
		auto& phys = static_cast<FrictPhys&>(*physics);
		if (geom.penetrationDepth <= 0) return false;
		const auto &body1 = Body::byId(c->getId1(), scene), &body2 = Body::byId(c->getId2(), scene);
		phys.normalForce = phys.kn * geom.penetrationDepth * geom.normal;
		geom.rotate(phys.shearForce);
		phys.shearForce -= phys.ks * geom.shearIncrement();
		const Real most = phys.normalForce.norm() * phys.tangensOfFrictionAngle, shear = phys.shearForce.norm();
		if (shear > most) phys.shearForce *= most / shear;
		const Vector3r force = phys.normalForce + phys.shearForce; // on the polytope
		const Vector3r shift = scene->isPeriodic ? scene->cell->intrShiftPos(c->cellDist) : Vector3r(Vector3r::Zero());
		const auto&    beam  = static_cast<const GridConnection&>(*body1->shape);
		scene->forces.addForce(body2->id, force);
		scene->forces.addTorque(body2->id, (geom.contactPoint - body2->state->pos - shift).cross(force));
		scene->forces.addForce(beam.node1->id, -(1 - geom.along) * force);
		scene->forces.addForce(beam.node2->id, -geom.along * force);
		return true;
	}
	FUNCTOR2D(PolytopeGridGeom, FrictPhys);
	YADE_CLASS_BASE_DOC(
	        Law2_PolytopeGridGeom_FrictPhys_CundallStrack, LawFunctor, "Spring and friction between beams of grids and polytopes.");
};
REGISTER_SERIALIZABLE(Law2_PolytopeGridGeom_FrictPhys_CundallStrack);

YADE_PLUGIN((PolytopeGridGeom)(Ig2_GridConnection_Polytope_PolytopeGridGeom)(Law2_PolytopeGridGeom_FrictPhys_CundallStrack));

} // namespace yade
