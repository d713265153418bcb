// SPDX-License-Identifier: GPL-2.0-or-later
//
// A family without bounds: the half-space below its own xy plane, which its orientation inclines; and a rounded polytope that meets it. A normal law that softens, σ = k a ln(1 + q u/a),
// whose tangent at zero is q.
#include <yade-polytope/contact/MarginContact.hpp>
#include <yade-polytope/material/JointLaws.hpp>
#include <yade-polytope/shape/ShapeFamily.hpp>

#include <core/Aabb.hpp>
#include <pkg/common/Sphere.hpp>

namespace yade {

class Plane : public Shape {
public:
	virtual ~Plane() = default;
	YADE_CLASS_BASE_DOC_ATTRS_CTOR(Plane, Shape, "Half-space below its own xy plane.", , createIndex(););
	REGISTER_CLASS_INDEX(Plane, Shape);
};
REGISTER_SERIALIZABLE(Plane);

class PlaneFamily : public ShapeFamily {
	void extend(const Shape&, const State&, Vector3r& low, Vector3r& high) const override
	{
		high = Vector3r::Constant(std::numeric_limits<Real>::infinity());
		low  = -high;
	}
	std::optional<CoreOfBody> core(
	        const Shape&, const Vector3r& position, const Quaternionr& orientation, const Vector3r& other) const override
	{
		const Vector3r normal = orientation * Vector3r::UnitZ();
		// below the other body: so that numbers are as small as the pair
		return CoreOfBody { halfSpace_, 0, other - normal.dot(other - position) * normal, orientation.toRotationMatrix() };
	}
	std::shared_ptr<const polytope::ConvexShape> halfSpace_ = polytope::ConvexShape::halfSpace(Vector3r::UnitZ(), 3);
};
const FamilyOf<Plane, PlaneFamily> family;

class Bo1_Plane_Aabb : public BoundFunctor {
public:
	void go(const shared_ptr<Shape>&, shared_ptr<Bound>& bound, const Se3r&, const Body*) override
	{
		if (!bound) bound = shared_ptr<Bound>(new Aabb);
		bound->max = Vector3r::Constant(std::numeric_limits<Real>::infinity());
		bound->min = -bound->max;
	}
	FUNCTOR1D(Plane);
	YADE_CLASS_BASE_DOC(Bo1_Plane_Aabb, BoundFunctor, "Box without bounds.");
};
REGISTER_SERIALIZABLE(Bo1_Plane_Aabb);

class RoundedBlock : public Polytope {
public:
	virtual ~RoundedBlock() = default;
	std::optional<Real> margin() const override { return radius; }
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR(RoundedBlock, Polytope, "Rounded polyhedron.", ((Real, radius, 0, , "[m]")), createIndex(););
	// clang-format on
	REGISTER_CLASS_INDEX(RoundedBlock, Polytope);
};
REGISTER_SERIALIZABLE(RoundedBlock);

YADE_POLYTOPE_MARGIN_PAIR(Ig2_Plane_RoundedBlock_PolytopeGeom, Plane, RoundedBlock);
YADE_POLYTOPE_MARGIN_PAIR(Ig2_Plane_Polytope_PolytopeGeom, Plane, Polytope);
YADE_POLYTOPE_MARGIN_PAIR(Ig2_Plane_Sphere_PolytopeGeom, Plane, Sphere);

namespace {

	Real pressure(Real u, Real a, Real q) { return a * math::log1p(q * u / a); }
	Real tangent(Real u, Real a, Real q) { return q / (1 + q * u / a); }
	Real energy(Real u, Real a, Real q)
	{
		const Real x = q * u / a;
		// (1 + x) ln(1 + x) − x: its first terms where the closed form would lose digits
		return a * a / q * (x < Real(1e-3) ? x * x / 2 * (1 - x / 3 * (1 - x / 2)) : Real((1 + x) * math::log1p(x) - x));
	}

	const polytope::NormalLaw softening("SofteningClosure", pressure, tangent, energy);

} // namespace

class SofteningClosure : public JointClosure {
public:
	virtual ~SofteningClosure() = default;
	polytope::ClosureLaw law(Real) const override { return polytope::ClosureLaw::own(softening, length, initialTangent); }
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(SofteningClosure, JointClosure, "Softening closure.", ((Real, length, 1e-3, , "$a$ [m]"))((Real, initialTangent, 1, , "$q$ [-]")));
	// clang-format on
};
REGISTER_SERIALIZABLE(SofteningClosure);

/// It forgets to say its law.
class SilentClosure : public JointClosure {
public:
	virtual ~SilentClosure() = default;
	YADE_CLASS_BASE_DOC(SilentClosure, JointClosure, "Without a law.");
};
REGISTER_SERIALIZABLE(SilentClosure);

YADE_PLUGIN((
        Plane)(Bo1_Plane_Aabb)(RoundedBlock)(Ig2_Plane_RoundedBlock_PolytopeGeom)(Ig2_Plane_Polytope_PolytopeGeom)(Ig2_Plane_Sphere_PolytopeGeom)(SofteningClosure)(SilentClosure));

} // namespace yade
