// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "contact/ContactTypes.hpp"
#include "contact/PlacedPair.hpp"

#include <string>

/// What contactQuery() needs of its arguments. It does not look itself: with others its answer means nothing, and planes beyond a body's own in
/// ContactSettings::internal are read. For code under development, and for input from outside; not for each query of a loop.
namespace polytope {

/// A sentence that names the option that is out of range, or nothing.
POLYTOPE_API std::string faultOf(const ContactOptions& options);

/// A sentence that names the first argument of a query that is not as it must be, or nothing: options as above, weights, and internal
/// planes that the bodies have; both shapes of one dimension, not both half-spaces; of a half-space a unit normal (to
/// tolerance::orthogonal); rotations that are rotations (tolerance::orthogonal), in 2-D about z; a finite position. The memory may be any.
POLYTOPE_API std::string faultOf(const PlacedPair& pair, const ContactSettings& settings);

} // namespace polytope
