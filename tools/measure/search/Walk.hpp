// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "Families.hpp"

#include <array>
#include <map>
#include <string>
#include <vector>

/// One trial: shapes of a family, moved past each other; every pose queried in all ways and compared with exact arithmetic.
namespace polytope::search {

/// Defects.
enum class Defect : int {
	Miss,          ///< overlap deeper than the contact tolerance, no contact reported
	FalseContact,  ///< contact reported without such an overlap
	Infeasibility, ///< s* off by more than rounding
	Centre,        ///< contact reported, but the point is not the analytic centre, and the status does not tell
	NotConverged,  ///< a query without an answer, or one whose contact point Newton's method did not find
	NotFinite,     ///< a value that is not finite, a normal that is not unit, a depth that is not positive
	NoEnergy,      ///< foundation, spring: a contact without energy
	Energy,        ///< foundation, spring: the energy (volume), the force or the moment off by more than rounding
	Force,
	Moment,
	Shape, ///< a body that was refused, or failed in construction
};
constexpr int defectCount = int(Defect::Shape) + 1;
const char*   defectName(Defect defect);

constexpr ContactModel models[]   = { ContactModel::Boon2012, ContactModel::Foundation, ContactModel::Spring };
constexpr int          modelCount = 3;
const char*            modelName(ContactModel model);

struct Finding {
	int         family;
	long        trial;
	int         pose;
	Defect      defect;
	std::string text;
};

/// Sums of any number of trials; the order does not matter.
struct Tally {
	long pairs = 0, overlaps = 0, gaps = 0, queries = 0, exact = 0, undecided = 0;
	long compared = 0; ///< overlaps whose energy, force and moment were compared with the exact ones
	long unlike   = 0; ///< of these: where one answer was unlike another
	long ridges   = 0; ///< of these: ExactSurface::hasRidge()
	std::array<std::array<long, contactStatusCount>, modelCount> statuses {};
	std::array<long, defectCount>                                defects {};
	Real                                                         worstInfeasibility = 0; ///< largest error of s* over rounding × reach
	Real worstEnergy = 0, worstForce = 0, worstMoment = 0;                               ///< largest errors over what is allowed
	int  mostPivots = 0, mostIterations = 0;

	void add(const Tally& other);
};

constexpr int posesPerTrial = 200;

/// Of so many overlaps, one has its contact surface compared with the exact one, drawn with the trial's random numbers; besides all whose answers differ.
constexpr int overlapsPerExact = 1000;

/// Trial number `trial` of a family: posesPerTrial pairs.
void walk(int family, long trial, unsigned long seed, Tally& tally, std::vector<Finding>& findings);

} // namespace polytope::search
