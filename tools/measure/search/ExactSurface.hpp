// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "ContactLoad.hpp"
#include "PairSamples.hpp"

/// Force, moment and energy of the contacts with a surface from 113-digit arithmetic, and how far rounding may be from them.
namespace polytope::search {

/// The exact load of one model, and what it changes by when each plane of the pair is off by one rounding of the pair's reach.
struct ExactLoad {
	samples::ContactLoad load; ///< about the point that was asked for
	Real                 energyUnit, forceUnit, momentUnit;
};

struct ExactSurface {
	ExactLoad foundation, spring;
	bool      ridge; ///< rounding decides more than a thousandth of a force: planes of both bodies coincide or nearly so
};

/// Relative change of the pair by one rounding of its planes' places: of the reach, over the radius of the overlap's largest ball. A set that all planes
/// leave room for grows or shrinks by that, so that its volume in the program's space of D + 1 dimensions changes by D + 1 times as much.
inline Real roundingOf(const samples::Pair& pair, const Real& deepest) { return tolerance::rounding * pair.reach() / deepest; }

/// Allowed errors in these units. Planes are placed within 8 roundings (allowedError()): 4 × 8 of the foundation's energy, the volume. The spring's is the
/// square of a ratio of two such integrals, of which the other changes by 5: 2 × (4 + 5) × 8. A force is the gradient of the energy.
constexpr Real allowedUnits(ContactModel model) { return model == ContactModel::Foundation ? 32 : 144; }

/// Overlaps are compared where a rounding of the planes is no more than this part of the overlap's thickness.
constexpr Real coarsestRounding = 1e-5;

/// Of a pair that overlaps by `deepest` at `origin`, for moments about `origin`. `random` draws the errors of planes from which the units are found.
ExactSurface exactSurface(const samples::Pair& pair, const Vector3& origin, const Real& deepest, std::mt19937_64& random);

} // namespace polytope::search
