// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "contact/PolytopeGeom.hpp"

/// When a contact is taken from its last full computation and the bodies' motion since, and when a full computation leaves what that needs.
namespace yade {

/// Of body 2 against body 1 in a step, at the contact point.
struct MotionInStep {
	Vector3r translation, rotation;
};

/// One contact in one step.
class FollowedContact {
public:
	FollowedContact(const polytope::PlacedPair& pair, const polytope::ContactOptions& options, bool wasReal, PolytopeGeom& geom)
	        : pair_(pair), options_(options), geom_(geom),
	          may_(hasSurface(options.contactModel) && wasReal && options.warmStart && !geom.closure.get()),
	          flat_(pair.shape[0]->dimension() == 2)
	{
	}

	/// The contact in this step, if it is near its last full computation.
	bool take(polytope::ContactResult& result);
	/// Whether it can be at all.
	bool isKnown() const { return may_ && geom_.linear.get() && geom_.linear.get()->linear.known; }

	/// What the query is to fill for the steps after this one; null where the bodies move too fast. `turn`: one of the steps in which a contact without
	/// a derivative in closed form is tried.
	polytope::LinearContact* begin(bool turn, const MotionInStep& motion);
	/// After a query with the same memory: fills what it has not, by differences. `sameSurface`: the vertices are those of the last step.
	void end(const polytope::ContactSettings& settings, const polytope::PairMemory& memory, bool sameSurface,
	        polytope::ContactWorkspace& workspace, const polytope::ContactResult& result);

private:
	bool isSlow(int steps, const MotionInStep& motion) const;

	const polytope::PlacedPair&     pair_;
	const polytope::ContactOptions& options_;
	PolytopeGeom&                   geom_;
	bool                            may_;
	bool                            flat_; ///< polygons, which have no derivative in closed form
	bool                            byDifferences_ = false;
};

} // namespace yade
