// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/Body.hpp>
#include <core/Interaction.hpp>
#include <core/Scene.hpp>

namespace yade {

/// Calls visit(partner, shift) for the bodies that `body` may touch, as the collider has them in its list of pairs, without one of them.
/// `shift`: from where the partner is to where it is in the period of `body`. Poses and shapes of others may be read while contacts are
/// computed; what other pairs remember may not.
template <class Visit> void forPartners(const Body& body, Body::id_t without, Scene& scene, const Visit& visit)
{
	for (const auto& [id, contact] : body.intrs) {
		if (id == without || !contact) continue;
		const shared_ptr<Body>& partner = Body::byId(id, &scene);
		if (!partner || !partner->shape || !partner->maskOk(body.groupMask)) continue;
		Vector3r shift = Vector3r::Zero();
		if (scene.isPeriodic) {
			shift = scene.cell->intrShiftPos(contact->cellDist);
			if (contact->getId2() != id) shift = -shift;
		}
		visit(*partner, shift);
	}
}

} // namespace yade
