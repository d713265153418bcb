// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "joint/ClosureLaw.hpp"
#include "timestep/TimeStepTolerances.hpp"

#include <algorithm>

/// Time step of two bodies that close a joint with a closure law (ClosureLaw.hpp).
///
/// Problem: the step is taken from the joint's stiffness as it is. Bodies that come nearer by much of what the joint can close in one step are in
/// the steep part of the law before the step is shortened, and are thrown back with an energy that they never had.
namespace polytope {

/// How far the joint may close in one step [m], at most `most`: its stiffness grows by tolerance::closingGrowth over that from which the step is
/// taken, of this closure [m] or of the joint's linear spring.
inline Real closingWay(const ClosureLaw& law, const Real& closure, const Real& most)
{
	const Real stiffest = tolerance::closingGrowth * std::max(Real(1), law.tangent(closure));
	Real       within = 0, beyond = most;
	if (!(law.tangent(closure + most) > stiffest)) return most;
	for (int k = 0; k < tolerance::closingHalvings; ++k) {
		const Real middle                                            = (within + beyond) / 2;
		(law.tangent(closure + middle) > stiffest ? beyond : within) = middle;
	}
	return beyond;
}

/// Time in which bodies that close by this speed [m/s] come nearer by the way [m], or, if they touch later than so many steps of that, half of the
/// time until they touch [s] over the steps: then the step is found anew in between.
inline Real closingStep(const Real& way, const Real& speed, const Real& untilTouch, const Real& steps)
{
	return std::max(Real(way / speed), Real(untilTouch / (2 * steps)));
}

} // namespace polytope
