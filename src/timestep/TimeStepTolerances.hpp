// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "numbers/Real.hpp"

/// Thresholds of the time step, as Tolerances.hpp has those of the contact path: meaning, scale, reason.
namespace polytope::tolerance {

/// × inscribed radius: depth at which a potential contact of a body on a whole face is evaluated. Its rocking stiffness over
/// its normal one is the same at any depth that is small against the body.
constexpr double potentialDepth = 1e-3;

/// × a sphere's radius: as large as a wall, a box or a facet is taken to be in a potential contact with it, for YADE's contacts of spheres with
/// these have a size that is a setting of theirs. Where stiffness goes by the radii (2 E₁R₁ E₂R₂/(E₁R₁ + E₂R₂)), it is within a
/// thousandth of that with an infinite one.
constexpr double potentialPartner = 1e3;

/// Sizes for which a potential contact's stiffness is asked are rounded up to powers of this, so that thousands of bodies of a kind, or of
/// a range of sizes, take a few hundred evaluations. The step is shorter by half of it at most (stiffness per area or by radii), 1 %.
constexpr double potentialSizes = 1.02;

/// Updates of the time step between two evaluations of the potential contacts: these change with the bodies, whose number each update
/// checks, and where a script changes stiffnesses or masses.
constexpr unsigned potentialUpdates = 10;

/// Part of a body's ω² from which on the rocking of its contacts is named as what limits the time step.
constexpr double rockingShare = 0.5;

/// Time step of a scene in which nothing can move, as a part of the period after which an engine is called again. What the engine puts into
/// the scene then falls for a time that is shorter or longer by up to this part, until the next call.
constexpr double periodStep = 0.01;

/// Growth of a closing joint's stiffness in one step. A hyperbola closes by a tenth of its maximum closure in a step then from its beginning, and by
/// a tenth of what is left later. Undamped collisions keep their energy to some per cent then, and to a sixth where they just reach the end of the law.
constexpr double closingGrowth = 1.23;

/// Halvings by which the way is found in which that happens: to a millionth.
constexpr int closingHalvings = 20;

/// At most so many places of two bodies are looked at in the time until the step is found anew, in which they move against each other by the smaller
/// one's inscribed radius from place to place if that is enough.
constexpr int closingPlaces = 16;

/// × the time to a place: before it, for how fast they close there.
constexpr double closingDifference = 1e-4;

} // namespace polytope::tolerance
