// SPDX-License-Identifier: GPL-2.0-or-later
#include "PolytopeBond.hpp"

namespace yade {

YADE_PLUGIN((PolytopeBond));

void PolytopeBond::setStresses(const Vector3r& displacement, const Vector3r& rotation)
{
	Real bending = -std::numeric_limits<Real>::infinity(), farthest = 0;
	for (const Vector3r& r : corners) {
		bending  = math::max(bending, Real(rotation[1] * r[2] - rotation[2] * r[1]));
		farthest = math::max(farthest, r.squaredNorm());
	}
	const Real twist = math::abs(rotation[0]) * math::sqrt(farthest);
	normalStress     = normalStiffness * displacement[0];
	edgeStress       = normalStress + bendingShare * bendingStiffness * bending;
	shearStress      = shearStiffness * displacement.tail<2>().norm() + bendingShare * twistingStiffness * twist;
}

const char* PolytopeBond::exceeded() const
{
	if (edgeStress > tensileStrength) return "tension";
	if (shearStress > math::max(cohesion - normalStress * math::tan(frictionAngle), Real(0))) return "shear";
	return nullptr;
}

} // namespace yade
