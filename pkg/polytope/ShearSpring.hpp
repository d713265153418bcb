// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <lib/base/Math.hpp>

/// The shear spring of a joint whose stiffness changes with the contact's area.
///
/// A joint is a bed of springs, k = k' A [N/m]. When the area shrinks, the force of the springs that leave it is lost: the
/// displacement f/k of the others is unchanged. Springs that a growing area adds are unstrained: the force is unchanged. Either way the bed
/// loses energy and never gains any (Elata & Berryman 1996, Mechanics of Materials 24:229-240, for contacts of spheres), and its
/// displacement never grows by itself. Forces are those on body 2 [N].
namespace yade {

struct ShearSpring {
	Vector3r force;     ///< at the end of the last step, turned to this one's normal
	Real     stiffness; ///< at the end of the last step

	/// The force before this step's motion, with the present stiffness.
	Vector3r forceWith(Real present) const { return present < stiffness ? Vector3r(present / stiffness * force) : force; }

	/// Part of the spring's energy and of the work done on it that is lost in a step from a trial force to the final one [J].
	///
	/// With u = f/k at both ends: friction dissipates the mean force times the slip; the remaining loss of ½ k u² is ½ (k₀ − k₁) u₀·u₁
	/// where the stiffness falls, ½ f₀² (1/k₀ − 1/k₁) where it rises.
	Real loss(Real present, const Vector3r& trial, const Vector3r& now) const
	{
		if (!(stiffness > 0 && present > 0)) return 0;
		const Real friction = (force + now).dot(trial - now) / (2 * present);
		const Real leaving  = (stiffness - present) / 2 * (force / stiffness).dot(now / present);
		const Real joining  = force.squaredNorm() / 2 * (1 / stiffness - 1 / present);
		return friction + (present < stiffness ? leaving : joining);
	}
};

} // namespace yade
