// SPDX-License-Identifier: GPL-2.0-or-later
#include "material/JointLaws.hpp"

#include <lib/high-precision/Constants.hpp>

#include <sstream>

namespace yade {

YADE_PLUGIN((JointClosure)(HyperbolicClosure)(PowerClosure)(JointStrength)(BartonBandisStrength)(ContinuouslyYieldingStrength));

namespace {

	[[noreturn]] void refuse(const char* name, Real value, const char* rule)
	{
		std::ostringstream message;
		message << name << ": must be " << rule << ", got " << value;
		throw std::invalid_argument(message.str());
	}

	bool positive(Real value) { return value > 0 && math::isfinite(value); }

} // namespace

polytope::ClosureLaw JointClosure::law(Real) const { return {}; }

polytope::ClosureLaw HyperbolicClosure::law(Real) const { return polytope::ClosureLaw::hyperbola(maximumClosure); }

polytope::ClosureLaw PowerClosure::law(Real stiffness) const { return polytope::ClosureLaw::power(exponent, referenceStress / stiffness); }

void HyperbolicClosure::postLoad(HyperbolicClosure&)
{
	if (!positive(maximumClosure)) {
		const Real bad = maximumClosure;
		maximumClosure = good_;
		refuse("maximumClosure", bad, "positive and finite [m]");
	}
	good_ = maximumClosure;
}

void PowerClosure::postLoad(PowerClosure&)
{
	const auto require = [&](bool good, const char* name, Real value, const char* rule) {
		if (good) return;
		exponent        = good_[0];
		referenceStress = good_[1];
		refuse(name, value, rule);
	};
	require(exponent >= 0 && exponent < 1, "exponent", exponent, "from 0 (linear) to below 1");
	require(positive(referenceStress), "referenceStress", referenceStress, "positive and finite [Pa]");
	good_ = { { exponent, referenceStress } };
}

void BartonBandisStrength::postLoad(BartonBandisStrength&)
{
	const auto require = [&](bool good, const char* name, Real value, const char* rule) {
		if (good) return;
		JRC          = good_[0];
		JCS          = good_[1];
		sampleLength = good_[2];
		jointLength  = good_[3];
		refuse(name, value, rule);
	};
	require(JRC >= 0 && JRC <= 30, "JRC", JRC, "from 0 (smooth) to 30; of rock joints up to 20");
	require(positive(JCS), "JCS", JCS, "positive and finite [Pa]");
	require(positive(sampleLength), "sampleLength", sampleLength, "positive and finite [m]");
	require(positive(jointLength), "jointLength", jointLength, "positive and finite [m]");
	good_ = { { JRC, JCS, sampleLength, jointLength } };
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
	const auto require = [&](bool good, const char* name, Real value, const char* rule) {
		if (good) return;
		initialFrictionAngle = good_[0];
		roughness            = good_[1];
		stiffnessExponent    = good_[2];
		referenceStress      = good_[3];
		refuse(name, value, rule);
	};
	require(initialFrictionAngle >= 0 && initialFrictionAngle < double(Mathr::HALF_PI), "initialFrictionAngle", initialFrictionAngle,
	        "an angle in radians, at least 0 and below pi/2 (use radians(degrees))");
	require(positive(roughness), "roughness", roughness, "positive and finite [m]");
	require(stiffnessExponent >= 0 && stiffnessExponent <= 1, "stiffnessExponent", stiffnessExponent, "from 0 to 1");
	require(positive(referenceStress), "referenceStress", referenceStress, "positive and finite [Pa]");
	good_ = { { initialFrictionAngle, roughness, stiffnessExponent, referenceStress } };
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
