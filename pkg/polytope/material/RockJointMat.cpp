// SPDX-License-Identifier: GPL-2.0-or-later
#include "material/RockJointMat.hpp"

#include <core/Scene.hpp>
#include <lib/high-precision/Constants.hpp>

namespace yade {

YADE_PLUGIN((RockJointMat));

RockJointMat::Values RockJointMat::values() const
{
	return { { normalStiffness, shearStiffness, frictionAngle, cohesion, tensileStrength, residualFrictionAngle, dilationAngle,
		dilationLimit, residualCohesion, residualTensileStrength } };
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
}

void RockJointMat::postLoad(RockJointMat&)
{
	const auto require = [&](bool good, const char* name, Real value, const char* rule) {
		if (good) return;
		setValues(good_);
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
	require(dilationLimit >= 0, "dilationLimit", dilationLimit, "at least 0 [m] (infinity: no limit)");
	good_ = values();
}

} // namespace yade
