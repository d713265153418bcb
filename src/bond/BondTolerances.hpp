// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "numbers/Tolerances.hpp"

/// Thresholds of bonds: meaning, scale, reason.
namespace polytope::tolerance {

/// × the smaller of two faces' areas: what they have in common counts as an area that a bond can be made of. Less is what rounding leaves of
/// neighbours that share an edge only.
constexpr Real leastBondArea = 1e-6;

/// Relative difference of an area's second moments, and of its product, below which it has no principal axes of its own (square, regular polygon).
constexpr Real isotropicArea = 1e-9;

/// × the smaller circumradius: default of the largest gap across which a bond is made. What rounding of poses and planes leaves between faces
/// that are meant to touch.
constexpr Real touchingFaces = 1e-6;

/// × the smaller inscribed radius: deeper in each other, two bodies have no common face. Overlaps of DEM are a hundredth at the most.
constexpr Real deepestOfFaces = 0.1;

/// Largest angle between two faces [rad] that a joint takes for faces lying on each other, and the default of polytope.bond(): half a
/// degree, what rounding and settling leave between faces meant to touch, at ordinary stiffness.
constexpr Real facingOfJoints = 0.01;

} // namespace polytope::tolerance
