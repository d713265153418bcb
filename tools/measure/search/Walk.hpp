// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "Families.hpp"

#include <array>
#include <map>
#include <string>
#include <vector>

/// One trial: shapes of a family, moved past each other; every pose queried in all ways and compared with its certificate.
namespace polytope::search {

/// Defects.
enum class Defect : int {
	Miss,          ///< overlap deeper than the contact tolerance, no contact reported
	FalseContact,  ///< contact reported without such an overlap
	Infeasibility, ///< s* off by more than rounding
	Centre,        ///< contact reported, but the point is not the analytic centre, and the status does not tell
	NotConverged,  ///< a query without an answer, or one whose contact point Newton's method did not find
	NotFinite,     ///< a value that is not finite, a normal that is not unit, a depth that is not positive
	NoEnergy,      ///< spring: a contact without energy
	Shape,         ///< a body that was refused, or failed in construction
};
constexpr int defectCount = int(Defect::Shape) + 1;
const char*   defectName(Defect defect);

struct Finding {
	int         family;
	long        trial;
	int         pose;
	Defect      defect;
	std::string text;
};

/// Sums of any number of trials; the order does not matter.
struct Tally {
	long                                 pairs = 0, overlaps = 0, gaps = 0, queries = 0, exact = 0, undecided = 0;
	std::array<long, contactStatusCount> paper {}, spring {};
	std::array<long, defectCount>        defects {};
	Real                                 worstInfeasibility = 0; ///< largest error of s* over rounding × reach
	int                                  mostPivots = 0, mostIterations = 0;

	void add(const Tally& other);
};

constexpr int posesPerTrial = 200;

/// Trial number `trial` of a family: posesPerTrial pairs.
void walk(int family, long trial, unsigned long seed, Tally& tally, std::vector<Finding>& findings);

} // namespace polytope::search
