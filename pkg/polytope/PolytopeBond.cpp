// SPDX-License-Identifier: GPL-2.0-or-later
#include "PolytopeBond.hpp"

namespace yade {

YADE_PLUGIN((PolytopeBond));

namespace {

	bool isStill(const boost::weak_ptr<Body>& own, Body::id_t id, const BodyContainer& bodies)
	{
		if (!bodies.exists(id)) return false;
		return own.empty() || (!own.owner_before(bodies[id]) && !bodies[id].owner_before(own));
	}

	void adopt(boost::weak_ptr<Body>& own, Body::id_t id, const BodyContainer& bodies, bool anew)
	{
		if ((anew || own.empty()) && bodies.exists(id)) own = bodies[id];
	}

} // namespace

bool PolytopeBond::hasItsBodies(const BodyContainer& bodies) const { return isStill(body1_, id1, bodies) && isStill(body2_, id2, bodies); }

void PolytopeBond::adoptBodies(const BodyContainer& bodies, bool anew)
{
	adopt(body1_, id1, bodies, anew);
	adopt(body2_, id2, bodies, anew);
}

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
	if (shearStress > cohesion - normalStress * math::tan(frictionAngle)) return "shear"; // in tension above c/tan φ without any shear
	return nullptr;
}

} // namespace yade
