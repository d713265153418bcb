// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/Body.hpp>
#include <core/Clump.hpp>
#include <core/Scene.hpp>

/// Which bodies move, what moves with what (bodies by themselves, and the parts of clumps), and whether other processes move some.
namespace yade {

/// The body itself, or the clump that it is a part of.
inline const Body& moverOf(const Body& body, const Scene& scene)
{
	return body.isClumpMember() && scene.bodies->exists(body.clumpId) ? *(*scene.bodies)[body.clumpId] : body;
}

/// Whether both are parts of one clump.
inline bool inOneClump(const Body& one, const Body& other) { return one.isClumpMember() && one.clumpId == other.clumpId; }

/// Whether it does not move: a body that is not dynamic, or a part of a clump that is not.
inline bool isFixed(const Body& body, const Scene& scene) { return !moverOf(body, scene).isDynamic(); }

/// Whether two bodies move as one, or not at all: they never touch.
inline bool rigidTogether(const Body& one, const Body& other, const Scene& scene)
{
	return inOneClump(one, other) || (isFixed(one, scene) && isFixed(other, scene));
}

/// Fixed, or a part of a clump: it may be a piece of a larger solid.
inline bool isPiece(const Body& body) { return body.isClumpMember() || !body.isDynamic(); }

/// Whether forces move the body; members of clumps are moved by their clump.
inline bool isMovedByForces(const Body& body) { return body.state && body.isDynamic() && !body.isClumpMember(); }

/// Whether YADE's NewtonIntegrator turns the body about its own axes: with a rotation blocked, moments of inertia are those about the world's axes.
inline bool turnsAboutOwnAxes(const Body& body)
{
	return body.isAspherical() && (body.state->blockedDOFs & State::DOF_RXRYRZ) == State::DOF_NONE;
}

/// Whether the scene is a part of one that several processes compute.
inline bool isDivided(const Scene& scene)
{
	for (const auto& body : *scene.bodies)
		if (body && body->getIsSubdomain()) return true;
	return false;
}

/// The body itself, or the members of a clump.
template <class Visit> void forParts(const Body& body, const Scene& scene, const Visit& visit)
{
	if (!body.isClump()) return visit(body);
	for (const auto& member : static_cast<const Clump&>(*body.shape).members)
		if (scene.bodies->exists(member.first)) visit(*(*scene.bodies)[member.first]);
}

} // namespace yade
