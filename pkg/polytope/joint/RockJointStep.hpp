// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/Scene.hpp>

#include "contact/PolytopeGeom.hpp"
#include "host/PeriodOfPair.hpp"
#include "joint/RockJointLaw.hpp"
#include "joint/RockJointPhys.hpp"
#include "joint/StiffnessSums.hpp"

/// What the law of rock joints knows of one contact in one step: motion, the state before, and the work done.
namespace yade {

/// Carries a tangent vector along with the contact: Eq. 18 and the twist, without their second-order change of length.
inline void turnWithContact(const ScGeom& geom, Vector3r& tangent)
{
	const Real before = tangent.squaredNorm();
	if (before == 0) return;
	geom.rotate(tangent);
	tangent -= geom.normal.dot(tangent) * geom.normal;
	const Real after = tangent.squaredNorm();
	if (after > 0) tangent *= math::sqrt(before / after);
}

/// Largest t ≤ 1 with |force + t·added| ≤ limit; 0 where force itself is beyond it.
inline Real fractionWithin(Real limit, const Vector3r& force, const Vector3r& added)
{
	if (!(limit > 0)) return 0;
	if ((force + added).squaredNorm() <= limit * limit) return 1;
	const Real a = added.squaredNorm(), b = force.dot(added), c = limit * limit - force.squaredNorm();
	if (!(a > 0 && c > 0)) return 0;
	const Real root = math::sqrt(b * b + a * c);
	return b > 0 ? c / (b + root) : (root - b) / a;
}

/// Motion of both bodies at the contact in this step.
struct Law2_PolytopeGeom_RockJointPhys_MohrCoulomb::Pair {
	const Interaction&  contact;
	const PolytopeGeom& geom;
	Scene*              scene;
	const Body*         body1;
	const Body*         body2;
	const State&        state1;
	const State&        state2;
	Vector3r            centre2;    ///< of body 2, in the period of body 1
	Vector3r            arm1, arm2; ///< from the centres to the contact point

	Pair(const Interaction& contact_, const PolytopeGeom& geom_, Scene* scene_)
	        : contact(contact_), geom(geom_), scene(scene_), body1(Body::byId(contact.getId1(), scene).get()),
	          body2(Body::byId(contact.getId2(), scene).get()), state1(*body1->state), state2(*body2->state),
	          centre2(placeByCells(*scene, contact.cellDist, state2.pos))
	{
		arm1 = geom.contactPoint - state1.pos;
		arm2 = geom.contactPoint - centre2;
	}
	/// Velocity of body 2's centre relative to body 1's.
	Vector3r centreVelocity() const { return velocityByCells(*scene, contact.cellDist, state2.vel - state1.vel); }
	/// Velocity of body 2 against body 1 at the contact point.
	Vector3r velocity() const { return centreVelocity() + state2.angVel.cross(arm2) - state1.angVel.cross(arm1); }
	Vector3r spin() const { return state2.angVel - state1.angVel; }
	/// Shift from where body 2 is to where it is in the period of body 1.
	Vector3r shift2() const { return centre2 - state2.pos; }
};

/// One of the two bodies of a contact, as a damper has it.
struct Law2_PolytopeGeom_RockJointPhys_MohrCoulomb::DampedBody {
	const Body& mover;
	bool        moves;
	Across      otherIs;  ///< what the other body is for this one
	Real        part = 1; ///< s
	/// Part of the body's motion that its damper may take in a step; all dampers together take less than twice the motion, beyond which it grows.
	Real     limit = 1;
	Vector3r arm; ///< from the mover's centre to the contact point
	/// Velocity over `limit` that an impulse of one at the contact point gives it there, and a moment of one about any axis: not below.
	std::array<Real, 2> mostMotion { { 0, 0 } };

	DampedBody(const Pair& pair, const RockJointPhys& phys, const StiffnessSums& sums, const Body& body, const Body& other,
	        const Vector3r& shift);
};

/// Both, for all dampers of a contact in one step.
struct Law2_PolytopeGeom_RockJointPhys_MohrCoulomb::DampedPair {
	DampedBody body[2];
	Real       inverse = 0; ///< 1/(s₁ m₁) + 1/(s₂ m₂) [1/kg]
	Real       dt;

	DampedPair(const Pair& pair, const RockJointPhys& phys, const StiffnessSums& sums);

	/// The damper of this fraction of the critical one: for a spring and motion along a direction or, with `gyrationSquared`, for a moment
	/// about an axis.
	Real damper(Real fraction, Real stiffness, const Vector3r& direction, Real gyrationSquared = -1) const;
};

/// State at the end of the last step, before this one changes it; the shear bed's is in RockJointShear.hpp.
struct Law2_PolytopeGeom_RockJointPhys_MohrCoulomb::Last {
	Vector3r force, normalViscous, shearViscous, rockingMoment;
	Real     elasticNormal, dilation;
	bool     wasBond;     ///< the forces were those of a bond of PolytopeBonds, which has failed
	bool     actedAsBond; ///< they were those of the joint's own bond (RockJointBond.cpp)

	Last(const RockJointPhys& phys, const Vector3r& normal)
	        : force(phys.normalForce + phys.shearForce), normalViscous(phys.normalViscous), shearViscous(phys.shearViscous),
	          rockingMoment(phys.rockingMoment), elasticNormal((phys.normalForce - normalViscous).dot(normal)), dilation(phys.dilation),
	          wasBond(phys.followsBond), actedAsBond(phys.bond)
	{
	}
};

/// What a step did with energy beyond storing it [J]; book() adds the work of the dampers' forces.
struct Law2_PolytopeGeom_RockJointPhys_MohrCoulomb::StepWork {
	Real plastic = 0, normalDamping = 0, shearDamping = 0;
	Real stored    = 0;     ///< energy of the springs afterwards
	bool fractured = false; ///< what is missing then is the energy of fracture
};

} // namespace yade
