// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "PairSamples.hpp"

#include <functional>
#include <vector>

/// The kinds of pairs that are searched. A family makes a few shapes (expensive) and then any number of poses of them (cheap).
namespace polytope::search {

using Random = std::mt19937_64;

/// A new pose of the scene's shapes.
using Poses = std::function<samples::Pair(Random&)>;

struct Family {
	const char* name;
	Poses (*scene)(Random&);
};

const std::vector<Family>& families();

/// Moves body 2 along a unit direction until s* = target, as samples::moveTo(), but by Newton's method on the convex
/// piecewise linear function s* of the way: some five linear programs instead of sixty.
void approach(samples::Pair& pair, const Vector3& direction, Real target);

/// A random s* to test: overlaps and gaps from rounding to half the inscribed radius, many about the border of contact.
Real someInfeasibility(const samples::Pair& pair, Random& random);

} // namespace polytope::search
