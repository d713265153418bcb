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

polytope::BondMotion PolytopeBond::follow(const State& state1, const State& state2, const Vector3r& shift)
{
	const Vector3r             to1 = state1.ori * point1, to2 = state2.ori * point2;
	const Vector3r             between = (state2.pos - state1.pos + shift) + (to2 - to1);
	const polytope::BondMotion motion  = polytope::bondMotion(state1.ori * frame1, state2.ori * frame2, between);
	const polytope::BondForce  now     = polytope::bondForce(motion, linearStiffness(), angularStiffness());
	force                              = now.force;
	moment                             = now.moment;
	energy                             = now.energy;
	arm1                               = to1 + between / 2;
	arm2                               = to2 - between / 2;
	point                              = state1.pos + arm1;
	setStresses(motion.displacement, motion.rotation);
	return motion;
}

/// Of a displacement and rotation (src/bond/BondSprings.hpp).
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
