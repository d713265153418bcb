// SPDX-License-Identifier: GPL-2.0-or-later
//
// A polyhedron rounded by a ball (sphero-polyhedron): the shape, and its contacts with its like, with Polytope and with Wall. Apart from its planes the surface
// is a distance away: the depth is what the radii exceed the planes' distance by. For stiffnesses per contact: the area is not computed.
#include <yade-polytope/contact/PolytopeGeom.hpp>

#include <polytope/contact/PairDistance.hpp>

#include <pkg/common/Wall.hpp>

namespace yade {

class RoundedPolytope : public Polytope {
public:
	virtual ~RoundedPolytope() = default;
	std::optional<Real> margin() const override { return radius; }
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR(RoundedPolytope, Polytope, "Sum of a polyhedron (the planes) and a ball.", ((Real, radius, 0, , "of the ball [m]")), createIndex(););
	// clang-format on
	REGISTER_CLASS_INDEX(RoundedPolytope, Polytope);
};
REGISTER_SERIALIZABLE(RoundedPolytope);

/// The contact of two bodies with margins, whatever their classes.
class Ig2_RoundedPolytope_RoundedPolytope_PolytopeGeom : public PolytopeGeomFunctor {
public:
	bool go(const shared_ptr<Shape>& shape1, const shared_ptr<Shape>& shape2, const State& state1, const State& state2,
	        const Vector3r& shift2, const bool& force, const shared_ptr<Interaction>& c) override
	{
		const auto &one = static_cast<const Polytope&>(*shape1), &other = static_cast<const Polytope&>(*shape2);
		const Real  margin1 = one.margin().value_or(0), margins = margin1 + other.margin().value_or(0);
		return rounded(*one.convex(), margin1, { state1.pos, state1.ori.toRotationMatrix() }, *other.convex(), margins, state1,
		        state2, shift2, force, c);
	}
	bool goReverse(const shared_ptr<Shape>& shape1, const shared_ptr<Shape>& shape2, const State& state1, const State& state2,
	        const Vector3r& shift2, const bool& force, const shared_ptr<Interaction>& c) override
	{
		c->swapOrder();
		return go(shape2, shape1, state2, state1, -shift2, force, c);
	}
	FUNCTOR2D(RoundedPolytope, RoundedPolytope);
	DEFINE_FUNCTOR_ORDER_2D(RoundedPolytope, RoundedPolytope);
	YADE_CLASS_BASE_DOC(Ig2_RoundedPolytope_RoundedPolytope_PolytopeGeom, PolytopeGeomFunctor, "Contact of two rounded polyhedra.");

protected:
	/// Of planes with a margin each; `margin1`: the first body's of both `margins`.
	bool rounded(const polytope::ConvexShape& convex1, Real margin1, const Body1Frame& frame1, const polytope::ConvexShape& convex2,
	        Real margins, const State& state1, const State& state2, const Vector3r& shift2, const bool& force,
	        const shared_ptr<Interaction>& c)
	{
		static thread_local polytope::ContactWorkspace workspace;
		const Vector3r                                 centre2   = state2.pos + shift2 - frame1.origin;
		const Matrix3r                                 rotation2 = state2.ori.toRotationMatrix();
		const auto                gap = polytope::pairDistance(convex1, frame1.rotation, convex2, rotation2, centre2);
		polytope::PairMemory      memory;
		polytope::ContactResult   result;
		polytope::ContactSettings settings = this->settings(StiffnessRule::PerContact);
		if (gap.distance >= margins && !c->isReal() && !force) return false;
		// the planes' contact; apart, moved together until they touch: its point is where the surfaces face each other
		const Real size = math::min(convex1.boundingRadius(), convex2.boundingRadius());
		contactQuery(convex1, frame1.rotation, convex2, rotation2,
		        centre2 - (gap.distance > 0 ? gap.distance + 1e-6 * size : 0) * gap.normal, settings, memory, workspace, result);
		if (!result.inContact) return failed(c);
		if (gap.distance > 0) {
			result.normal = gap.normal;
			result.depth  = margins - gap.distance;
			result.point
			        += (gap.point[0] - result.point).dot(gap.normal) * gap.normal + (margin1 - result.depth / 2) * gap.normal;
		} else result.depth += margins;
		result.inContact     = result.depth > 0;
		result.status        = result.inContact ? result.status : polytope::ContactStatus::Separated;
		result.infeasibility = -result.depth / 2;
		result.energy        = result.inContact ? result.depth * result.depth / 2 : Real(0);
		return apply(result, frame1.origin, state1, state2, shift2, force, c);
	}
};
REGISTER_SERIALIZABLE(Ig2_RoundedPolytope_RoundedPolytope_PolytopeGeom);

class Ig2_Polytope_RoundedPolytope_PolytopeGeom : public Ig2_RoundedPolytope_RoundedPolytope_PolytopeGeom {
public:
	FUNCTOR2D(Polytope, RoundedPolytope);
	DEFINE_FUNCTOR_ORDER_2D(Polytope, RoundedPolytope);
	YADE_CLASS_BASE_DOC(
	        Ig2_Polytope_RoundedPolytope_PolytopeGeom, Ig2_RoundedPolytope_RoundedPolytope_PolytopeGeom, "Contact with sharp ones.");
};
REGISTER_SERIALIZABLE(Ig2_Polytope_RoundedPolytope_PolytopeGeom);

class Ig2_Wall_RoundedPolytope_PolytopeGeom : public Ig2_RoundedPolytope_RoundedPolytope_PolytopeGeom {
public:
	bool go(const shared_ptr<Shape>& shape1, const shared_ptr<Shape>& shape2, const State& state1, const State& state2,
	        const Vector3r& shift2, const bool& force, const shared_ptr<Interaction>& c) override
	{
		const auto& wall  = static_cast<const Wall&>(*shape1);
		const auto& other = static_cast<const Polytope&>(*shape2);
		const Real  side  = wall.sense != 0 ? Real(wall.sense) : (state2.pos + shift2 - state1.pos)[wall.axis];
		Body1Frame  foot { state2.pos + shift2, Matrix3r::Identity() }; // the wall's point nearest to the body's centre
		foot.origin[wall.axis] = state1.pos[wall.axis];
		const auto plane       = polytope::ConvexShape::halfSpace((side < 0 ? -1 : 1) * Vector3r::Unit(wall.axis), 3);
		return rounded(*plane, 0, foot, *other.convex(), other.margin().value_or(0), state1, state2, shift2, force, c);
	}
	FUNCTOR2D(Wall, RoundedPolytope);
	DEFINE_FUNCTOR_ORDER_2D(Wall, RoundedPolytope);
	YADE_CLASS_BASE_DOC(Ig2_Wall_RoundedPolytope_PolytopeGeom, Ig2_RoundedPolytope_RoundedPolytope_PolytopeGeom, "Contact with walls.");
};
REGISTER_SERIALIZABLE(Ig2_Wall_RoundedPolytope_PolytopeGeom);

YADE_PLUGIN((
        RoundedPolytope)(Ig2_RoundedPolytope_RoundedPolytope_PolytopeGeom)(Ig2_Polytope_RoundedPolytope_PolytopeGeom)(Ig2_Wall_RoundedPolytope_PolytopeGeom));

} // namespace yade
