// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "PairSamples.hpp"

#include <limits>
#include <string>
#include <vector>

/// The axes along which a pair is varied from easy to extreme. Each is a list of values and of kinds of pairs,
/// and makes a pair of any value and kind at random.
namespace polytope::samples {

struct PairAxis {
	using Maker = Pair (*)(Real value, const std::string& kind, std::mt19937_64& random);

	std::string              name;
	std::vector<Real>        values;
	std::vector<std::string> kinds;
	/// Throws std::invalid_argument where shape construction refuses the body.
	Maker make;
	/// For axes on which making the pair rounds it (coordinates, units): the pair before that, null elsewhere.
	Maker intended = nullptr;
	/// The intended pair's lengths are to be multiplied by the value.
	bool scaled = false;
	/// Reference solutions with many planes are expensive: above this value fewer samples, and none in a quick run.
	Real costlyAbove = std::numeric_limits<Real>::infinity();
};

const std::vector<PairAxis>& pairAxes();

} // namespace polytope::samples
