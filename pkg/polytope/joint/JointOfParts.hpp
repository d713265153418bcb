// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/Interaction.hpp>
#include <core/Scene.hpp>

namespace yade {

/// The rock joint of a contact goes on between parts of its two bodies, which have been cut: the parts get a contact with its state, over
/// the area that they have in common. Its springs are strained as those of the whole are at the same place, so that forces, moments and
/// energies of all parts add up to those of the whole as far as their areas do; slip, dilation, strength and laws are those of the whole.
/// Not for periodic scenes, nor for stiffnesses per contact.
/// \param whole with a PolytopeGeom and a RockJointPhys, as it was in the last step; its bodies need not be in the scene any more
/// \param part1,part2 in the scene, where the wholes were; the collider knows them, for a contact with one of several flush pieces depends
/// on the others
/// \returns whether the parts have such a contact
bool continueBetween(Scene& scene, const Interaction& whole, const Body& whole1, const Body& whole2, const shared_ptr<Body>& part1,
        const shared_ptr<Body>& part2);

} // namespace yade
