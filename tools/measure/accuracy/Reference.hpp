// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "PairSamples.hpp"

/// One pair's contact in double beside the reference: the linear program in exact rational arithmetic, everything else
/// in 150 digits. All lengths are over the pair's size (the smaller circumradius), angles in radians.
namespace polytope::samples {

struct Comparison {
	ContactResult result;
	Real          size = 0, inscribed = 0;
	bool          touches = false; ///< by the reference: s* < 0
	bool within = false; ///< |s*| is so small that `touches` may go either way: the contact tolerance, and what rounding does to s*
	Real infeasibility      = 0,
	     infeasibilityError = 0; ///< the reference's s*; |ours − it|, separated: by how much our lower bound is above it
	Real depth = 0, depthError = 0;
	Real centreError = 0; ///< in the overlap's own local norm
	Real normalError = 0;
	/// What rounding of the planes by the size, seen from the overlap, can do to centre and normal and depth.
	Real infeasibilityRounding = 0, centreRounding = 0, normalRounding = 0, depthRounding = 0;
	Real forceError  = 0;     ///< length of the difference of depth × normal
	bool compared    = false; ///< point, normal and depth are both in ours and in the reference
	bool finite      = false; ///< every number of ours
	bool bounded     = false; ///< no geometry, or a unit normal, a point within both bodies and a depth no longer than them
	bool free        = true;  ///< normal from the dual: moved apart along it by |s*|/|n_λ| the pair is free
	long nanoseconds = 0;     ///< of one query, the least of three, cold
};

Comparison compareWithReference(const Pair& pair);

/// Largest difference of s*, depth (over the size), point (over the size) and normal between two answers, the second one's lengths multiplied by `unit`.
Real deviation(const ContactResult& ours, const ContactResult& other, Real unit, Real size);

} // namespace polytope::samples
