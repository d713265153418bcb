// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/State.hpp>

namespace yade {

/// A force and a moment on body 2 of a pair, and their opposites on body 1.
struct ForceOfPair {
	Vector3r force, moment; ///< moment about the point where the force acts
	Vector3r arm1, arm2;    ///< from the bodies' centres to that point
};

/// Work in half of a step, by the bodies' motion in it: the work of the whole step is that of the mean of the forces at both of its ends.
/// \param velocity of body 2's centre against body 1's, that of its period included
inline Real halfStepWork(const ForceOfPair& of, const Vector3r& velocity, const State& state1, const State& state2, Real dt)
{
	return dt / 2
	        * (of.force.dot(velocity) + (of.arm2.cross(of.force) + of.moment).dot(state2.angVel)
	                - (of.arm1.cross(of.force) + of.moment).dot(state1.angVel));
}

} // namespace yade
