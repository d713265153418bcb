// SPDX-License-Identifier: GPL-2.0-or-later
#include "material/JointLaws.hpp"

#include <lib/high-precision/Constants.hpp>

namespace yade {

POLYTOPE_CLASSES((JointClosure)(HyperbolicClosure)(PowerClosure)(JointStrength)(BartonBandisStrength)(ContinuouslyYieldingStrength));

namespace {

	bool positive(Real value) { return value > 0 && math::isfinite(value); }

} // namespace

polytope::ClosureLaw JointClosure::law(Real) const { return {}; }

std::string JointClosure::fault(Real stiffness) const
{
	const polytope::ClosureLaw given = law(stiffness);
	if (given.isLinear())
		return "a " + getClassName()
		        + " has no normal law; take a class whose law() gives one, HyperbolicClosure for example, or None for a linear "
		          "spring";
	return given.fault();
}

polytope::ClosureLaw HyperbolicClosure::law(Real) const { return polytope::ClosureLaw::hyperbola(maximumClosure); }

polytope::ClosureLaw PowerClosure::law(Real stiffness) const { return polytope::ClosureLaw::power(exponent, referenceStress / stiffness); }

void HyperbolicClosure::postLoad(HyperbolicClosure&)
{
	checked_.check(std::tie(maximumClosure),
	        [&] { requireValue(positive(maximumClosure), "maximumClosure", maximumClosure, "positive and finite [m]"); });
}

void PowerClosure::postLoad(PowerClosure&)
{
	checked_.check(std::tie(exponent, referenceStress), [&] {
		requireValue(exponent >= 0 && exponent < 1, "exponent", exponent, "from 0 (linear) to below 1");
		requireValue(positive(referenceStress), "referenceStress", referenceStress, "positive and finite [Pa]");
	});
}

void BartonBandisStrength::postLoad(BartonBandisStrength&)
{
	checked_.check(std::tie(JRC, JCS, sampleLength, jointLength), [&] {
		requireValue(JRC >= 0 && JRC <= 30, "JRC", JRC, "from 0 (smooth) to 30; of rock joints up to 20");
		requireValue(positive(JCS), "JCS", JCS, "positive and finite [Pa]");
		requireValue(positive(sampleLength), "sampleLength", sampleLength, "positive and finite [m]");
		requireValue(positive(jointLength), "jointLength", jointLength, "positive and finite [m]");
	});
}

polytope::BartonBandis BartonBandisStrength::law(Real residualFriction) const
{
	polytope::BartonBandis::Values values;
	values.roughness        = JRC;
	values.wallStrength     = JCS;
	values.residualFriction = residualFriction;
	values.sampleLength     = sampleLength;
	values.jointLength      = jointLength;
	return polytope::BartonBandis(values);
}

void ContinuouslyYieldingStrength::postLoad(ContinuouslyYieldingStrength&)
{
	checked_.check(std::tie(initialFrictionAngle, roughness, stiffnessExponent, referenceStress), [&] {
		requireValue(initialFrictionAngle >= 0 && initialFrictionAngle < double(Mathr::HALF_PI), "initialFrictionAngle",
		        initialFrictionAngle, "an angle in radians, at least 0 and below pi/2 (use radians(degrees))");
		requireValue(positive(roughness), "roughness", roughness, "positive and finite [m]");
		requireValue(stiffnessExponent >= 0 && stiffnessExponent <= 1, "stiffnessExponent", stiffnessExponent, "from 0 to 1");
		requireValue(positive(referenceStress), "referenceStress", referenceStress, "positive and finite [Pa]");
	});
}

polytope::ContinuouslyYielding ContinuouslyYieldingStrength::law(Real friction) const
{
	polytope::ContinuouslyYielding::Values values;
	values.friction          = friction;
	values.initialFriction   = math::max(initialFrictionAngle, friction);
	values.roughness         = roughness;
	values.stiffnessExponent = stiffnessExponent;
	values.referenceStress   = referenceStress;
	return polytope::ContinuouslyYielding(values);
}

} // namespace yade
