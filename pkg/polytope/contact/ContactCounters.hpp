// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <src/contact/ContactTypes.hpp>

/// How queries of a loop have ended: one thread adds to its own, stats() sums them up.
namespace yade {

/// Counters of one thread, on cache lines of its own.
struct alignas(64) ContactCounters {
	long pairs = 0, contacts = 0, dismissed = 0, simplexPivots = 0, newtonIterations = 0, ipoptSolves = 0, ipoptIterations = 0,
	     surfacesKept = 0, linear = 0;
	long statuses[polytope::contactStatusCount] = {};
	long lpNanoseconds = 0, centreNanoseconds = 0, timedPairs = 0;
};

} // namespace yade
