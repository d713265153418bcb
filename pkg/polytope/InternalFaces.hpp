// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/Body.hpp>
#include <core/Scene.hpp>

#include <src/contact/ContactQuery.hpp>

/// Bodies that lie on several pieces of one rigid support, flush with each other: fixed plates, boxes, facets of a mesh, members of a clump.
///
/// A contact is computed from two bodies alone. Where body Y slides from piece B to its neighbour X, Y's overlap with X begins as a
/// sliver, and X's side face, which B covers, would act as an obstacle. Such a face is *internal*: nothing can touch it there. A plane of X
/// near the overlap is internal if Y slides on another face of X, with a face, an edge or a vertex, and another piece B, whose face continues that one,
/// fills the place just outside of the plane, at the height of the contact point; so a step higher than the overlap is deep, an edge that is
/// free, and a gap wider than the largest ball in the overlap are not affected.
///
/// All of it follows from poses and shapes, not from other contacts' geometry, which other threads may be writing.
namespace yade {

/// One contact as both bodies stand: half-spaces of `convex` in axes `rotation` about `centre`, body 2 moved by its period.
struct TouchingPair {
	const Interaction*           contact;
	Scene*                       scene;
	const polytope::ConvexShape* convex[2];
	Vector3r                     centre[2];
	Matrix3r                     rotation[2];
	Vector3r                     point;  ///< contact point
	Vector3r                     normal; ///< from body 1 to body 2
	Real                         ball;   ///< radius of the largest ball in the overlap

	TouchingPair at(const Vector3r& otherPoint, const Vector3r& otherNormal) const
	{
		TouchingPair pair = *this;
		pair.point        = otherPoint;
		pair.normal       = otherNormal;
		return pair;
	}
};

/// Whether one of two bodies is a piece of a rigid support, fixed or a member of a clump, that the other one moves on. Free pieces are bodies of
/// their own: they may separate, and their joints carry the contact forces.
bool mayHaveInternalFaces(const Body& body1, const Body& body2, Scene& scene);

/// Of the planes near the overlap those that are internal faces.
polytope::InternalPlanes internalPlanes(const TouchingPair& pair, const polytope::BoundingPlanes& bounding);

/// For a stiffness per contact: part of the stiffness that this piece has when the body lies on several pieces of one rigid
/// support (fixed bodies, or members of one clump), by the areas in which the contact's plane cuts the body and each piece. 1 where there
/// is one piece.
Real shareOfSupport(const TouchingPair& pair, const polytope::InternalPlanes& internal);

} // namespace yade
