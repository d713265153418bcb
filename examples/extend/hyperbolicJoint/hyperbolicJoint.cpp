// SPDX-License-Identifier: GPL-2.0-or-later
//
// Joints that close along a hyperbola (Bandis, Lumsden & Barton 1983): σ = k u/(1 − u/V), k the material's normalStiffness. The normal law alone: shear,
// strength, dampers, energies and time step are those of rock joints. (RockJointMat has this law as HyperbolicClosure, too: the test compares both.)
#include <yade-polytope/material/JointLaws.hpp>

#include <cmath>

namespace yade {

namespace {

	/// Part of V from which on the law is straight, so that no force is infinite.
	const Real end = 0.99;

	/// σ/k [m], its slope, and its integral, for closures u above 0.
	Real pressure(Real u, Real v, Real)
	{
		const Real x = math::min(Real(u / v), end);
		return v * x / (1 - x) + (u - x * v) / ((1 - x) * (1 - x));
	}
	Real tangent(Real u, Real v, Real)
	{
		const Real x = math::min(Real(u / v), end);
		return 1 / ((1 - x) * (1 - x));
	}
	Real energy(Real u, Real v, Real)
	{
		const Real x = math::min(Real(u / v), end), beyond = u - x * v;
		return v * v * (-x - math::log1p(-x)) + beyond * (v * x / (1 - x) + beyond / 2 / ((1 - x) * (1 - x)));
	}

	const polytope::NormalLaw hyperbola("OwnHyperbola", pressure, tangent, energy);

} // namespace

class OwnHyperbola : public JointClosure {
public:
	virtual ~OwnHyperbola() = default;
	polytope::ClosureLaw law(Real) const override { return polytope::ClosureLaw::own(hyperbola, maximumClosure); }
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(OwnHyperbola, JointClosure, "Hyperbolic closure.", ((Real, maximumClosure, 1e-3, , "$V$ [m]")));
	// clang-format on
};
REGISTER_SERIALIZABLE(OwnHyperbola);

YADE_PLUGIN((OwnHyperbola));

} // namespace yade
