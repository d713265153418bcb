// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "contact/SupportPieces.hpp"

/// Bodies that lie on several pieces of one rigid support, flush with each other: fixed plates, boxes, facets of a mesh, members of a clump.
///
/// A contact is computed from two bodies alone. Where body Y slides from piece B to its neighbour X, Y's overlap with X begins as a sliver,
/// and X's side face, which B covers, would act as an obstacle. Such a face is *internal*: nothing can touch it there.
///
/// A plane of X near the overlap is internal where two things hold. Y slides on another face of X, with a face, an edge or a vertex. And a piece B
/// whose face continues that one fills the place just outside of the plane, at the height of the contact point. So three things stay obstacles: a step
/// of more than a fortieth of the depth, an edge that is free, and the edge of a gap that is wider than the largest ball in the overlap.
///
/// All of it follows from poses and shapes, not from other contacts' geometry, which other threads may be writing.
namespace yade {

/// Whether one of two bodies is a piece of a rigid support, fixed or a member of a clump, that the other one moves on. Free pieces are bodies of
/// their own: they may separate, and their joints carry the contact forces.
bool mayHaveInternalFaces(const Body& body1, const Body& body2);

/// The planes of a touching pair near the overlap that are internal faces.
struct InternalFaces {
	/// \param settings those of the query that has found the contact, with the planes that bound the overlap. Where both bodies are pieces, the overlap of
	/// their solids may reach internal faces that their own does not: there further queries look for them, and have used the workspace.
	InternalFaces(const TouchingPair& pair, const polytope::PlacedPair& placed, polytope::ContactSettings settings,
	        polytope::PairMemory memory, polytope::ContactWorkspace& workspace);

	polytope::InternalPlanes planes;
	bool                     queried = false; ///< whether the workspace was used
};

} // namespace yade
