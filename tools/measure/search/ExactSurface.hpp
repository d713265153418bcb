// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "ContactLoad.hpp"
#include "PairSamples.hpp"

/// Force, moment and energy of the contacts with a surface from 113-digit arithmetic, and how far rounding may be from them.
namespace polytope::search {

/// Relative change of a pair's contact by one rounding of its planes' places: of the reach, over the radius of the overlap's largest ball. The linear program's
/// feasible set, of D + 1 dimensions, grows or shrinks by no more than that along each of them.
inline Real roundingOf(const samples::Pair& pair, const Real& deepest) { return tolerance::rounding * pair.reach() / deepest; }

/// Overlaps are compared where that is no more than this: of a thinner one rounding leaves too few digits.
constexpr Real coarsestRounding = 1e-5;

/// Allowed errors in roundings of the planes. Planes are placed within 8 of them (allowedError()), which is 4 × 8 of the foundation's energy, the volume. The
/// spring's is the square of a ratio of two such integrals, of which the other changes by 5: 2 × (4 + 5) × 8. A force is the gradient of the energy.
constexpr Real allowedUnits(ContactModel model) { return model == ContactModel::Foundation ? 32 : 144; }

/// A load, and what it changes by when the pair's planes are off by one rounding of the pair's reach.
struct LoadWithUnits {
	samples::ContactLoad load;
	Real                 energyUnit, forceUnit, momentUnit;

	/// Without planes of both bodies that nearly coincide: bodies that are moved against each other by δ change the energy by no more than planes that are off
	/// by δ do, so that the scale of a force is the energy over `deepest`.
	LoadWithUnits(const samples::ContactLoad& load_, const samples::Pair& pair, const Real& deepest)
	        : load(load_), energyUnit(load.energy * roundingOf(pair, deepest)), forceUnit(energyUnit / deepest),
	          momentUnit(forceUnit * pair.size())
	{
	}
};

/// The exact loads of a pair that overlaps by `deepest` at `origin`: moments are about that point. Where planes of both bodies coincide the energy has a ridge,
/// and the load is the mean of those to its two sides. Where they nearly do, rounding says where the ridge is, and moves the force by more than it does the
/// energy: by how much is found from planes that are off by random errors.
class ExactSurface {
public:
	ExactSurface(const samples::Pair& pair, const Vector3& origin, const Real& deepest);

	/// Takes planes with other errors into account.
	void drawErrors(std::mt19937_64& random);

	const LoadWithUnits& of(ContactModel model) const { return model == ContactModel::Spring ? spring_ : foundation_; }

	/// Whether the errors that were drawn move a force by more than ten times what they do without a ridge.
	bool hasRidge() const { return ridge_; }

private:
	const samples::Pair& pair_;
	Vector3              origin_;
	Real                 deepest_;
	LoadWithUnits        foundation_, spring_;
	bool                 ridge_ = false;
};

} // namespace polytope::search
