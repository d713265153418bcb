// SPDX-License-Identifier: GPL-2.0-or-later
//
// Rods with round ends, whose core is a segment: a family, its contacts and box; and a normal law, σ = k a (exp(u/a) − 1), straight beyond 5 a.
#include <yade-polytope/contact/MarginContact.hpp>
#include <yade-polytope/material/JointLaws.hpp>
#include <yade-polytope/shape/FamilyBound.hpp>
#include <yade-polytope/shape/ShapeFamily.hpp>

#include <pkg/common/Box.hpp>
#include <pkg/common/Facet.hpp>
#include <pkg/common/Sphere.hpp>
#include <pkg/common/Wall.hpp>

namespace yade {

class Rod : public Shape {
public:
	virtual ~Rod() = default;
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR(Rod, Shape, "Rod along its own x axis.", ((Real, length, 1, , "between the centres of its ends [m]"))((Real, radius, 0.1, , "[m]")), createIndex(););
	// clang-format on
	REGISTER_CLASS_INDEX(Rod, Shape);
};
REGISTER_SERIALIZABLE(Rod);

class RodFamily : public ShapeFamily {
	static const Rod& rod(const Shape& shape) { return static_cast<const Rod&>(shape); }

	Real                      boundingRadius(const Shape& shape) const override { return rod(shape).length / 2 + rod(shape).radius; }
	Real                      inscribedRadius(const Shape& shape) const override { return rod(shape).radius; }
	Real                      size(const Shape& shape) const override { return rod(shape).radius; }
	std::optional<CoreOfBody> core(
	        const Shape& shape, const Vector3r& position, const Quaternionr& orientation, const Vector3r&) const override
	{
		const Vector3r way = rod(shape).length * (orientation * Vector3r::UnitX());
		return CoreOfBody { nullptr, rod(shape).radius, position - way / 2, Matrix3r::Identity(), way };
	}
};
const FamilyOf<Rod, RodFamily> family;

YADE_POLYTOPE_BALL_BOUND(Bo1_Rod_Aabb, Rod);
YADE_POLYTOPE_MARGIN_PAIR(Ig2_Rod_Rod_PolytopeGeom, Rod, Rod);
YADE_POLYTOPE_MARGIN_PAIR(Ig2_Rod_Polytope_PolytopeGeom, Rod, Polytope);
YADE_POLYTOPE_MARGIN_PAIR(Ig2_Sphere_Rod_PolytopeGeom, Sphere, Rod);
YADE_POLYTOPE_MARGIN_PAIR(Ig2_Wall_Rod_PolytopeGeom, Wall, Rod);
YADE_POLYTOPE_MARGIN_PAIR(Ig2_Box_Rod_PolytopeGeom, Box, Rod);
YADE_POLYTOPE_MARGIN_PAIR(Ig2_Facet_Rod_PolytopeGeom, Facet, Rod);

namespace {

	const Real end = 5; // × a

	Real pressure(Real u, Real a, Real)
	{
		const Real x = math::min(Real(u / a), end);
		return a * math::expm1(x) + (u - a * x) * math::exp(x);
	}
	Real tangent(Real u, Real a, Real) { return math::exp(math::min(Real(u / a), end)); }
	Real energy(Real u, Real a, Real)
	{
		const Real x = math::min(Real(u / a), end), beyond = u - a * x;
		// a² (eˣ − 1 − x): its first terms where the closed form would lose digits
		const Real within = x < Real(1e-3) ? x * x / 2 * (1 + x / 3 * (1 + x / 4)) : Real(math::expm1(x) - x);
		return a * a * within + beyond * (a * math::expm1(x) + beyond / 2 * math::exp(x));
	}

	const polytope::NormalLaw exponential("ExponentialClosure", pressure, tangent, energy);

} // namespace

class ExponentialClosure : public JointClosure {
public:
	virtual ~ExponentialClosure() = default;
	polytope::ClosureLaw law(Real) const override { return polytope::ClosureLaw::own(exponential, length); }
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(ExponentialClosure, JointClosure, "Exponential closure.", ((Real, length, 1e-3, , "$a$ [m]")));
	// clang-format on
};
REGISTER_SERIALIZABLE(ExponentialClosure);

YADE_PLUGIN((
        Rod)(Bo1_Rod_Aabb)(Ig2_Rod_Rod_PolytopeGeom)(Ig2_Rod_Polytope_PolytopeGeom)(Ig2_Sphere_Rod_PolytopeGeom)(Ig2_Wall_Rod_PolytopeGeom)(Ig2_Box_Rod_PolytopeGeom)(Ig2_Facet_Rod_PolytopeGeom)(ExponentialClosure));

} // namespace yade
