// SPDX-License-Identifier: GPL-2.0-or-later
#include "bolt/PolytopeBoltCrossing.hpp"

#include <src/bond/BondSprings.hpp>

namespace yade {

POLYTOPE_CLASSES((PolytopeBoltCrossing));

namespace {

	Vector3r between(const State& state1, const Vector3r& point1, const State& state2, const Vector3r& point2)
	{
		return (state2.pos - state1.pos) + (state2.ori * point2 - state1.ori * point1);
	}

} // namespace

Real PolytopeBoltCrossing::newOpening(const BodyContainer& bodies) const
{
	return between(*bodies[id1]->state, point1, *bodies[id2]->state, point2).norm() - (stop - start);
}

Real PolytopeBoltCrossing::follow(const BodyContainer& bodies, const Real& openingNow, const Real& tensionNow, bool unlimited)
{
	const State &state1 = *bodies[id1]->state, &state2 = *bodies[id2]->state;
	const Real   work = (tension + tensionNow) / 2 * (openingNow - opening);
	opening           = openingNow;
	tension           = tensionNow;
	force             = tension * between(state1, point1, state2, point2).normalized();
	return work + (dowelStiffness > 0 ? followShear(state1, state2, unlimited) : Real(0));
}

/// Elastic, then perfectly plastic. The force acts half way between the middles, with the moment that keeps its power that of the shear.
Real PolytopeBoltCrossing::followShear(const State& state1, const State& state2, bool unlimited)
{
	const Vector3r apart = between(state1, middle1, state2, middle2), to1 = state1.ori * middle1, to2 = state2.ori * middle2;
	const auto     motion   = polytope::bondMotion(state1.ori * frame1, state2.ori * frame2, apart);
	const Vector2r shearNow = motion.displacement.tail<2>();
	Vector2r       now      = dowelStiffness * (shearNow - plasticShear);
	if (!unlimited && now.norm() > dowelStrength) {
		now *= dowelStrength / now.norm();
		plasticShear = shearNow - now / dowelStiffness;
	}
	const Real work   = (dowelForce + now).dot(shearNow - shear) / 2;
	const auto acting = polytope::bondForce(motion, Vector3r(0, now[0], now[1]), Vector3r::Zero(), 0);
	shear             = shearNow;
	dowelForce        = now;
	shearForce        = acting.force;
	dowelMoment       = acting.moment;
	dowelArm1         = to1 + apart / 2;
	dowelArm2         = to2 - apart / 2;
	return work;
}

void PolytopeBoltCrossing::apply(Scene& scene) const
{
	const State &state1 = *(*scene.bodies)[id1]->state, &state2 = *(*scene.bodies)[id2]->state;
	scene.forces.addForce(id1, force - shearForce);
	scene.forces.addForce(id2, shearForce - force);
	scene.forces.addTorque(id1, (state1.ori * point1).cross(force) - dowelArm1.cross(shearForce) - dowelMoment);
	scene.forces.addTorque(id2, dowelArm2.cross(shearForce) + dowelMoment - (state2.ori * point2).cross(force));
}

void PolytopeBoltCrossing::end(const char* reason)
{
	failure = reason;
	tension = 0;
	force = shearForce = dowelMoment = Vector3r::Zero();
	dowelForce                       = Vector2r::Zero();
}

Vector3r PolytopeBoltCrossing::placeOn(const BodyContainer& bodies, bool second, const Real& place) const
{
	const Vector3r along((place - (start + stop) / 2), 0, 0);
	const State&   state = *bodies[second ? id2 : id1]->state;
	return state.pos + state.ori * (second ? Vector3r(middle2 + frame2 * along) : Vector3r(middle1 + frame1 * along));
}

SpringsAtPoint PolytopeBoltCrossing::springsOn(const Body& body) const
{
	const State&   state  = *body.state;
	const bool     first  = body.id == id1;
	const Real     length = stop - start + opening;
	const Vector3r axis
	        = tension != 0 ? Vector3r(force / tension) : Vector3r(state.ori * ((first ? frame1 : frame2) * Vector3r::UnitX()));
	// steel under tension resists what turns it, as a string does
	const Real taut = length > 0 ? math::max(tension, Real(0)) / length : Real(0);
	return { axis, state.pos + state.ori * (first ? point1 : point2), stiffness, dowelStiffness + taut, Matrix3r::Zero() };
}

} // namespace yade
