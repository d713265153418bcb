// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/Interaction.hpp>
#include <core/Scene.hpp>

#include <src/contact/ContactQuery.hpp>

#include "contact/FollowedContact.hpp"
#include "contact/PolytopeGeom.hpp"

/// When the internal faces of a pair (InternalFaces.hpp) are searched for anew: for new contacts, for all where bodies were added or erased, for
/// the others every few steps, and before that where what is known of the pieces may not hold.
namespace yade {

/// Whether it is this pair's turn, which comes every so many steps: that of all is not in the same step.
bool isTurn(const Interaction& contact, const Scene& scene, int every);

/// Whether a script has put one of the two bodies elsewhere since the last step.
bool wasPutElsewhere(const polytope::PairMemory& memory, const polytope::PlacedPair& pair);

/// Whether the overlap may have come to faces that the last search has not looked at: it has grown or shrunk, or moves on. `last` and `now`: its corners
/// in the last step and in this one, none where they are not kept.
bool mayHaveMetMore(const Interaction& contact, Scene& scene, const PolytopeGeom& geom, const polytope::ContactResult& result,
        const MotionInStep& motion, const polytope::KeptVertices& last, const polytope::KeptVertices& now);

/// What tells that the overlap grows or shrinks, as geom.sizeAtSearch is [m³].
inline Real sizeOfOverlap(const polytope::ContactResult& result) { return -result.infeasibility * result.area; }

} // namespace yade
