// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "host/PartsOfBodies.hpp"

#include <src/timestep/ApproachLimit.hpp>
#include <src/timestep/StableTimeStep.hpp>

#include <limits>
#include <vector>

/// Limits of the time step of the present scene: its contacts (here), potential contacts (PotentialContacts.hpp), motion.
/// The scene is not changed.
namespace yade {

class Law2_PolytopeGeom_RockJointPhys_MohrCoulomb;

/// Shortest time step of all bodies for one reason [s], and the body; infinite and none where nothing limits.
struct TimeStepLimit {
	Real       step = std::numeric_limits<Real>::infinity();
	Body::id_t body = Body::ID_NONE;

	/// Takes a step if it is shorter; of equal steps that of the lower id, whatever the order. Steps that are not a number, or not above 0,
	/// are left out.
	void take(Real other, Body::id_t id)
	{
		if (!(other > 0 && other < std::numeric_limits<Real>::infinity())) return;
		if (other < step || (other == step && id < body)) {
			step = other;
			body = id;
		}
	}
};

/// Mobility (inverse mass and inertia) of the body, as YADE's integrator uses it.
polytope::Mobility mobilityOf(const Body& body);

/// The law whose dampers act on rock joints; null if the scene has none.
const Law2_PolytopeGeom_RockJointPhys_MohrCoulomb* dampingLaw(const Scene& scene);

/// τ of src/timestep/StableTimeStep.hpp from the springs and dampers of all present contacts.
struct ContactLimit : TimeStepLimit {
	bool rocking = false; ///< rocking of contacts makes up more than half of the limiting body's ω²
};

/// \param below limits longer than this need not be found
ContactLimit contactLimit(const Scene& scene, Real below = std::numeric_limits<Real>::infinity());

/// Limit of each body's contacts, by id [s]; infinite for those without contacts.
std::vector<Real> contactSteps(const Scene& scene);

/// What a body, or a clump with its members, occupies and how it moves; its radius is that of the smallest inscribed ball.
polytope::MovingBox movingBoxOf(const Body& body, const Scene& scene);

/// Time in which two bodies that may meet move against each other by `fraction` of the smaller one's inscribed radius, gravity included
/// (src/timestep/ApproachLimit.hpp). Where no other limit is known, in periodic cells and in a scene divided among processes, which each
/// know a part of it: in which each body alone moves by that much of its own, or of the smallest one's where its motion is prescribed.
/// \param below longer limits need not be found; infinite: none is known
/// \param steps until the limits are computed anew
TimeStepLimit motionLimit(const Scene& scene, Real fraction, Real below, Real steps);

/// Time in which a joint with a closure law stiffens by so much that the step from its present stiffness is too long (src/timestep/ClosingStep.hpp),
/// of bodies that close it, or will before the limits are computed anew. In periodic cells and in a scene divided among processes of contacts that
/// there are; not of spheres and facets.
/// \param below longer limits need not be found
/// \param steps until the limits are computed anew
TimeStepLimit closingLimit(Scene& scene, Real below, Real steps);

} // namespace yade
