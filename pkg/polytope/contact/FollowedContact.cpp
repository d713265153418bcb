// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact/FollowedContact.hpp"

#include <src/contact/LinearByDifferences.hpp>

namespace yade {

bool FollowedContact::take(polytope::ContactResult& result)
{
	auto* const             known = geom_.linear.get();
	polytope::OutlineMotion moved;
	if (!may_ || !known || !known->linear.follow(pair_, options_, geom_.point1, geom_.point2, result, moved)) return false;
	result.infeasibility = geom_.infeasibility;
	geom_.outline.move(moved);
	return true;
}

bool FollowedContact::isSlow(int steps, const MotionInStep& motion) const
{
	const Real width = flat_ ? Real(geom_.contactArea / pair_.thickness()) : math::sqrt(geom_.contactArea);
	return polytope::LinearContact::isSlow(steps, -geom_.infeasibility, width, geom_.normal, motion.translation, motion.rotation);
}

polytope::LinearContact* FollowedContact::begin(bool turn, const MotionInStep& motion)
{
	if (!may_ || (flat_ && !turn) || !isSlow(polytope::tolerance::linearSteps, motion)) {
		geom_.linear.clear();
		return nullptr;
	}
	byDifferences_ = turn && !options_.energy && isSlow(polytope::tolerance::linearStepsByDifferences, motion);
	// one that is there and unknown: the last query had no derivative in closed form
	const bool inVain = geom_.linear.get() && !geom_.linear.get()->linear.known;
	return inVain && !turn ? nullptr : &geom_.linear.make().linear;
}

void FollowedContact::end(const polytope::ContactSettings& settings, const polytope::PairMemory& memory, bool sameSurface,
        polytope::ContactWorkspace& workspace, const polytope::ContactResult& result)
{
	polytope::LinearContact* const linear = settings.linear;
	if (!linear || linear->known) return;
	if (byDifferences_) {
		polytope::linearByDifferences(pair_, settings, memory, workspace, result, *linear);
		if (linear->known) geom_.outline.keep();
	}
	if (!linear->known && !sameSurface) geom_.linear.clear(); // there may be one in the next step
}

} // namespace yade
