// SPDX-License-Identifier: GPL-2.0-or-later
//
// A polytope on a beam of YADE's grids (GridConnection, a segment with a radius between two nodes): a family that says so and that forces act on the nodes, a
// contact that follows from it, and a law.
#include <yade-polytope/contact/ContactForce.hpp>
#include <yade-polytope/contact/MarginContact.hpp>

#include <pkg/common/Grid.hpp>

namespace yade {

/// GridConnection is derived from Sphere; it is no ball.
class BeamFamily : public ShapeFamily {
	static const GridConnection& beam(const Shape& shape) { return static_cast<const GridConnection&>(shape); }

	Real boundingRadius(const Shape& shape) const override
	{
		return beam(shape).getLength() + beam(shape).radius;
	} // about the first node
	Real                      size(const Shape& shape) const override { return beam(shape).radius; }
	std::optional<CoreOfBody> core(const Shape& shape, const Vector3r&, const Quaternionr&, const Vector3r&) const override
	{
		const State &start = *beam(shape).node1->state, &end = *beam(shape).node2->state;
		return CoreOfBody { nullptr, beam(shape).radius, start.pos, Matrix3r::Identity(), end.pos - start.pos, &start, &end };
	}
	/// The nodes carry the force: the nearer one more of it.
	void addForce(const Body& body, const Vector3r& place, const Vector3r& force, ForceContainer& forces) const override
	{
		const Body &   start = *beam(*body.shape).node1, &end = *beam(*body.shape).node2;
		const Vector3r way = end.state->pos - start.state->pos;
		const Real along   = math::min(math::max(Real((place - start.state->pos).dot(way) / way.squaredNorm()), Real(0)), Real(1));
		const Vector3r arm = place - start.state->pos - along * way;
		for (const auto& [node, part] : { std::pair(start.id, Real(1 - along)), std::pair(end.id, along) }) {
			forces.addForce(node, part * force);
			forces.addTorque(node, part * arm.cross(force));
		}
	}
};
const FamilyOf<GridConnection, BeamFamily> family;

YADE_POLYTOPE_MARGIN_PAIR(Ig2_GridConnection_Polytope_PolytopeGeom, GridConnection, Polytope);

class Law2_PolytopeGeom_FrictPhys_OnNodes : public LawFunctor {
public:
	bool go(shared_ptr<IGeom>& geometry, shared_ptr<IPhys>& physics, Interaction* c) override
	{
		auto& geom = static_cast<PolytopeGeom&>(*geometry);
		auto& phys = static_cast<FrictPhys&>(*physics);
		if (geom.penetrationDepth <= 0) return false; // apart: YADE deletes the contact
		phys.normalForce = phys.kn * geom.penetrationDepth * geom.normal;
		followShear(geom, phys);
		addContactForce(geom, phys, *c, *scene);
		return true;
	}
	FUNCTOR2D(PolytopeGeom, FrictPhys);
	YADE_CLASS_BASE_DOC(Law2_PolytopeGeom_FrictPhys_OnNodes, LawFunctor, "Spring and friction between beams of grids and polytopes.");
};
REGISTER_SERIALIZABLE(Law2_PolytopeGeom_FrictPhys_OnNodes);

YADE_PLUGIN((Ig2_GridConnection_Polytope_PolytopeGeom)(Law2_PolytopeGeom_FrictPhys_OnNodes));

} // namespace yade
