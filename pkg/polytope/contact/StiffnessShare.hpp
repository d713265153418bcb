// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "contact/PolytopeGeom.hpp"

namespace yade {

/// The rule for the stiffness of a contact that begins: its physics are made after its geometry.
StiffnessRule stiffnessRuleOfNew(const Scene& scene, const Interaction& contact);

/// Gives a touching contact its share of a stiffness, where a body lies on several pieces: PolytopeGeom::share, which rock joints read in their law.
///
/// YADE's own physics have their stiffness once for all, from when the contact begins. They are made after the geometry, so the first step
/// takes the share off the depth, and from then on it is in the stiffnesses (and dampers) of the physics, which change as the share does.
/// `result` is what the geometry gets.
void giveShare(const Real& share, PolytopeGeom& geom, Interaction& contact, polytope::ContactResult& result);

} // namespace yade
