// SPDX-License-Identifier: GPL-2.0-or-later
#include "material/RockJointMat.hpp"

#include <core/Scene.hpp>
#include <lib/high-precision/Constants.hpp>

namespace yade {

YADE_PLUGIN((RockJointMat));

RockJointMat::Values RockJointMat::values() const
{
	return { { normalStiffness, shearStiffness, frictionAngle, cohesion, tensileStrength, residualFrictionAngle, dilationAngle,
		dilationLimit, residualCohesion, residualTensileStrength, reduction } };
}

void RockJointMat::setValues(const Values& v)
{
	normalStiffness         = v[0];
	shearStiffness          = v[1];
	frictionAngle           = v[2];
	cohesion                = v[3];
	tensileStrength         = v[4];
	residualFrictionAngle   = v[5];
	dilationAngle           = v[6];
	dilationLimit           = v[7];
	residualCohesion        = v[8];
	residualTensileStrength = v[9];
	reduction               = v[10];
}

void RockJointMat::postLoad(RockJointMat&)
{
	const auto require = [&](bool good, const char* name, Real value, const char* rule) {
		if (good) return;
		setValues(good_);
		closure        = goodClosure_;
		this->strength = goodStrength_;
		std::ostringstream message;
		message << name << ": must be " << rule << ", got " << value;
		throw std::invalid_argument(message.str());
	};
	const char* const angleRule = "an angle in radians, at least 0 and below pi/2 (use radians(degrees))";
	const auto        positive  = [](Real v) { return v > 0 && math::isfinite(v); };
	const auto        strength  = [](Real v) { return v >= 0 && math::isfinite(v); };
	// in wider precisions, too, Python's pi/2 is a double, and below the true one
	const auto angle = [](Real v) { return v >= 0 && v < double(Mathr::HALF_PI); };
	require(positive(normalStiffness), "normalStiffness", normalStiffness, "positive and finite [Pa/m, or N/m for each contact]");
	require(positive(shearStiffness), "shearStiffness", shearStiffness, "positive and finite [Pa/m, or N/m for each contact]");
	require(angle(frictionAngle), "frictionAngle", frictionAngle, angleRule);
	require(strength(cohesion), "cohesion", cohesion, "at least 0 and finite [Pa]");
	require(strength(residualCohesion), "residualCohesion", residualCohesion, "at least 0 and finite [Pa]");
	require(strength(residualTensileStrength), "residualTensileStrength", residualTensileStrength, "at least 0 and finite [Pa]");
	require(strength(tensileStrength), "tensileStrength", tensileStrength, "at least 0 and finite [Pa]");
	require(angle(residualFrictionAngle) || residualFrictionAngle == -1, "residualFrictionAngle", residualFrictionAngle,
	        "-1 (the same as frictionAngle) or an angle in radians, at least 0 and below pi/2");
	require(angle(dilationAngle), "dilationAngle", dilationAngle, angleRule);
	require(positive(reduction), "reduction", reduction, "positive and finite (what tan φ of the shear law is divided by)");
	require(dilationLimit >= 0, "dilationLimit", dilationLimit, "at least 0 [m] (infinity: no limit)");
	try {
		refuseForLaws();
	} catch (...) {
		setValues(good_);
		closure        = goodClosure_;
		this->strength = goodStrength_;
		throw;
	}
	good_         = values();
	goodClosure_  = closure;
	goodStrength_ = this->strength;
}

void RockJointMat::refuseForLaws() const
{
	const auto refuse = [](const char* name, const std::string& message) { throw std::invalid_argument(name + (": " + message)); };
	if (closure && tensileStrength > 0)
		refuse("tensileStrength", "a joint with a closure of its own has none, for its spring is linear in tension; leave it at 0");
	if (!strength) {
		if (reduction != 1) refuse("reduction", "belongs to a shear law; give the material one with strength=…, or leave it at 1");
		return;
	}
	const std::pair<const char*, bool> ofMohrCoulomb[] = { { "cohesion", cohesion != 0 }, { "residualCohesion", residualCohesion != 0 },
		{ "tensileStrength", tensileStrength != 0 }, { "residualTensileStrength", residualTensileStrength != 0 },
		{ "residualFrictionAngle", residualFrictionAngle != -1 }, { "dilationAngle", dilationAngle != 0 },
		{ "dilationLimit", dilationLimit < std::numeric_limits<Real>::infinity() } };
	for (const auto& [name, given] : ofMohrCoulomb)
		if (given)
			refuse(name,
			        "belongs to Mohr-Coulomb; leave it at its default beside strength=" + strength->getClassName() + "(…)");
	const auto* yielding = dynamic_cast<const ContinuouslyYieldingStrength*>(strength.get());
	if (yielding && yielding->initialFrictionAngle < frictionAngle)
		refuse("frictionAngle", "must not be above initialFrictionAngle of the ContinuouslyYieldingStrength");
}

} // namespace yade
