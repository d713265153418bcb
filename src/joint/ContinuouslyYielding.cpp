// SPDX-License-Identifier: GPL-2.0-or-later
#include "joint/ContinuouslyYielding.hpp"

#include "joint/JointTolerances.hpp"

#include <cmath>

namespace polytope {

ContinuouslyYielding ContinuouslyYielding::between(const ContinuouslyYielding& one, const ContinuouslyYielding& other)
{
	const auto    lesser = [](Real a, Real b) { return b < a ? b : a; };
	const Values &a = one.values_, &b = other.values_;
	Values        joint;
	joint.friction          = lesser(a.friction, b.friction);
	joint.initialFriction   = lesser(a.initialFriction, b.initialFriction);
	joint.roughness         = lesser(a.roughness, b.roughness);
	joint.stiffnessExponent = lesser(a.stiffnessExponent, b.stiffnessExponent);
	joint.referenceStress   = -lesser(-a.referenceStress, -b.referenceStress);
	return ContinuouslyYielding(joint);
}

Real ContinuouslyYielding::stiffness(Real stress) const
{
	using std::pow;
	if (values_.stiffnessExponent == 0) return 1;
	const Real ratio = stress > 0 ? Real(pow(stress / values_.referenceStress, values_.stiffnessExponent)) : Real(0);
	return ratio > Real(tolerance::softestShear) ? ratio : Real(tolerance::softestShear);
}

Real ContinuouslyYielding::elasticPart(const Vector3& direction, Real stressRatio)
{
	if (direction.dot(direction_) < 0)
		atReversal_ = stressRatio < Real(tolerance::mostAtReversal) ? stressRatio : Real(tolerance::mostAtReversal);
	direction_      = direction;
	const Real part = (1 - stressRatio) / (1 - atReversal_);
	return part < 0 ? Real(0) : part < 1 ? part : Real(1);
}

void ContinuouslyYielding::wear(Real slip)
{
	using std::exp;
	bounding_ = values_.friction + (bounding_ - values_.friction) * exp(-slip / values_.roughness);
}

Real ContinuouslyYielding::dilationAngle(Real ratio) const
{
	using std::atan;
	const Real angle = atan(ratio) - values_.friction;
	return angle > 0 ? angle : Real(0);
}

} // namespace polytope
