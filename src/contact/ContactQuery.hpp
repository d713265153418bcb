// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "contact/ContactTypes.hpp"
#include "contact/PlacedPair.hpp"

/// One contact, start to end: both bodies' planes → LP → analytic centre → normal → depth (→ section). The only entry of
/// the plug-in into the numerical core. Nothing throws, prints or (after a thread's first pair of a size, Ipopt aside) allocates.
namespace polytope {

/// One pair. What it needs of its arguments is not checked here: Preconditions.hpp does. Any value of the memory is safe: what does not fit
/// the pair is not used.
POLYTOPE_API void contactQuery(
        const PlacedPair& pair, const ContactSettings& settings, PairMemory& memory, ContactWorkspace& workspace, ContactResult& result);

/// Name of the instruction set the query runs with on this machine.
POLYTOPE_API const char* instructionSet();

} // namespace polytope
