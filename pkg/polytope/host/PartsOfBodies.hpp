// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/Body.hpp>
#include <core/Clump.hpp>
#include <core/Scene.hpp>

/// Bodies that move by themselves, and the parts of clumps.
namespace yade {

/// Whether forces move the body; members of clumps are moved by their clump.
inline bool isMovedByForces(const Body& body) { return body.state && body.isDynamic() && !body.isClumpMember(); }

/// The body itself, or the members of a clump.
template <class Visit> void forParts(const Body& body, const Scene& scene, const Visit& visit)
{
	if (!body.isClump()) return visit(body);
	for (const auto& member : static_cast<const Clump&>(*body.shape).members)
		if (scene.bodies->exists(member.first)) visit(*(*scene.bodies)[member.first]);
}

} // namespace yade
