// SPDX-License-Identifier: GPL-2.0-or-later
#include "bond/PolytopeBond.hpp"

#include <src/bond/TensionFibres.hpp>

namespace yade {

POLYTOPE_CLASSES((PolytopeBond));

bool PolytopeBond::hasItsBodies(const BodyContainer& bodies) const { return body1_.isStill(id1, bodies) && body2_.isStill(id2, bodies); }

void PolytopeBond::adoptBodies(const BodyContainer& bodies, bool anew)
{
	body1_.adopt(id1, bodies, anew);
	body2_.adopt(id2, bodies, anew);
}

void PolytopeBond::join(Body::id_t first, Body::id_t second, const polytope::CommonFace& face)
{
	id1           = first;
	id2           = second;
	area          = face.area;
	secondMoments = face.second;
	corners.clear();
	for (const polytope::Vector2& x : face.corners)
		corners.push_back(Vector3r(0, x[0], x[1]));
}

void PolytopeBond::attach(int which, const State& state, const Vector3r& shift, const Vector3r& where, const Quaternionr& axes)
{
	(which == 1 ? point1 : point2) = state.ori.conjugate() * (where - state.pos - shift);
	(which == 1 ? frame1 : frame2) = (state.ori.conjugate() * axes).normalized();
}

polytope::BondMotion PolytopeBond::follow(const State& state1, const State& state2, const Vector3r& shift)
{
	const Vector3r             to1 = state1.ori * point1, to2 = state2.ori * point2;
	const Vector3r             between = (state2.pos - state1.pos + shift) + (to2 - to1);
	const polytope::BondMotion motion  = polytope::bondMotion(state1.ori * frame1, state2.ori * frame2, between);
	const polytope::BondForce  now
	        = yields() ? yieldingForce(motion) : polytope::bondForce(motion, linearStiffness(), angularStiffness());
	force  = now.force;
	moment = now.moment;
	energy = now.energy;
	arm1   = to1 + between / 2;
	arm2   = to2 - between / 2;
	point  = state1.pos + arm1;
	setStresses(motion.displacement, motion.rotation);
	if (yields()) {
		normalStress = -force.dot(motion.mean * Vector3r::UnitX()) / area;
		edgeStress   = math::min(edgeStress, tensileStrength);
	}
	return motion;
}

void PolytopeBond::beginToYield() { lastingOpenings.assign(polytope::fibreCount(corners.size()), 0); }

Real PolytopeBond::meanLastingOpening() const
{
	Real sum = 0;
	if (yields())
		polytope::forFibres(corners, [&](const Vector3r&, Real part, std::size_t index) { sum += part * lastingOpenings[index]; });
	return sum / area;
}

/// Force and moment of a bond that yields: those of the springs, except for the normal stresses, which are those of fibres. (Bending and
/// normal stiffness of a joint are the same.)
polytope::BondForce PolytopeBond::yieldingForce(const polytope::BondMotion& motion)
{
	const Vector3r &         d = motion.displacement, turn = motion.rotation;
	const polytope::FibreSum fibres
	        = polytope::fibreForces(corners, d[0], turn[1], turn[2], normalStiffness, tensileStrength, lastingOpenings);
	Vector3r   force = linearStiffness().cwiseProduct(d), moment = angularStiffness().cwiseProduct(turn);
	const Real elastic = (force.tail<2>().dot(d.tail<2>()) + moment[0] * turn[0]) / 2;
	force[0]           = fibres.force;
	moment[1]          = fibres.moment1;
	moment[2]          = fibres.moment2;
	plasticWork_       = fibres.work;
	return polytope::bondForce(motion, force, moment, elastic + fibres.energy);
}

/// Sets the stresses that belong to a displacement and rotation (src/bond/BondSprings.hpp).
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
