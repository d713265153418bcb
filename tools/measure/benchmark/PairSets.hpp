// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <tests/core/PairSamples.hpp>

#include <functional>
#include <string>
#include <vector>

/// The pairs that all methods get. Seeded; chosen by what users may have, not to favour one method.
namespace polytope::benchmarks {

struct PairSet {
	std::string name;
	bool        touching; ///< of all pairs
	/// The pairs, then the same after each of some steps of DEM: moved by 1e-4 of the size, turned by 1e-4, in any direction.
	/// Alternating between two poses is not enough: where many bases are optimal, one is found that is optimal for both.
	std::vector<std::vector<samples::Pair>> steps;

	const std::vector<samples::Pair>& pairs() const { return steps.front(); }

	/// The step of a walk to the last one and back, over and over.
	const std::vector<samples::Pair>& walk(std::size_t at) const
	{
		const std::size_t last = steps.size() - 1, k = at % (2 * last);
		return steps[k < last ? k : 2 * last - k];
	}
};

/// A set that is made when first asked for.
struct NamedSet {
	std::string                     name;
	bool                            touching;
	bool                            flat; ///< polygons: ours alone
	std::function<const PairSet&()> get;
};

/// Sets of `count` pairs: the five solids touching (s* = −0.005 of the inscribed radius) and apart (+0.05), hulls of 20, 50,
/// 100 and 200 faces, slivers, stacked faces, edges across edges, sizes 1:100, cubes with redundant planes, squares
/// in two dimensions,
/// and the contacts in the file `heap` (may be null), written by heap.py.
std::vector<NamedSet> pairSets(int count, const char* heap);

} // namespace polytope::benchmarks
