// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "bond/PolytopeBond.hpp"

namespace yade {

/// The bond goes on between parts of its two bodies, which have been cut: over the area that the parts have in common, its springs strained
/// as those of the whole are at the same place. So forces, moments and energies of all parts add up to those of the whole, as far as their
/// areas do. Not for periodic scenes.
/// \param part1,part2 in the scene, where the wholes are
/// \returns null where the parts have no common face
shared_ptr<PolytopeBond> bondOfParts(const PolytopeBond& whole, const Body& whole1, const Body& whole2, const Body& part1,
        const Body& part2, const BodyContainer& bodies);

} // namespace yade
