// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "SupportPieces.hpp"

namespace yade {

/// What a contact with a stiffness per contact has of it when the body lies on several pieces of one rigid support (fixed bodies, or members of one
/// clump).
struct SupportShare {
	Real share = 1; ///< by the areas in which the contact's plane cuts the body and each piece
	/// Where an edge or a vertex is made of the pieces, the depth below it, which they have in common; else 0: as the contact has it.
	Real depth = 0;
};

SupportShare shareOfSupport(const TouchingPair& pair, const polytope::InternalPlanes& internal);

} // namespace yade
