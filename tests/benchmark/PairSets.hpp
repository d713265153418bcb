// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <tests/core/PairSamples.hpp>

#include <functional>
#include <string>
#include <vector>

/// The pairs that all methods get. Seeded; made by what a user may have, not by what suits one method.
namespace polytope::benchmarks {

struct PairSet {
	std::string                name;
	bool                       touching; ///< of all pairs
	std::vector<samples::Pair> pairs;
	std::vector<samples::Pair> moved; ///< the same after a step: moved by 1e-4 of the size, turned by 1e-4
};

/// A set that is made when first asked for.
struct NamedSet {
	std::string                     name;
	bool                            touching;
	std::function<const PairSet&()> get;
};

/// Sets of `count` pairs: the five solids touching (s* = −0.005 of the inscribed radius) and apart (+0.05), hulls of 20, 50,
/// 100 and 200 faces, slivers, stacked faces, edges across edges, sizes 1:100, and cubes with redundant planes.
std::vector<NamedSet> pairSets(int count);

} // namespace polytope::benchmarks
