// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "contact/SupportPieces.hpp"

/// Bodies that lie on several pieces of one rigid support, flush with each other: fixed plates, boxes, facets of a mesh, members of a clump.
///
/// A contact is computed from two bodies alone. Where body Y slides from piece B to its neighbour X, Y's overlap with X begins as a sliver,
/// and X's side face, which B covers, would act as an obstacle. Such a face is *internal*: nothing can touch it there. The contact is that of the solid
/// which the pieces make.
///
/// It is found from the overlap, as a polyhedron. A face of it that lies on a piece is internal if other pieces fill the place just outside of it, from corner to
/// corner. Then the piece goes on there, within all planes of the other pieces that do not cut the overlap; and so with the overlap as it
/// is without that face, until no face of it is internal. What is left are the faces of the solid. So three things stay obstacles: a step
/// of more than a fortieth of the depth, an edge that is free, and the edge of a gap that is wider than the largest ball in the overlap.
///
/// All of it follows from poses and shapes, not from other contacts' geometry, which other threads may be writing.
namespace yade {

/// Whether one of two bodies is a piece of a rigid support, fixed or a member of a clump, that the other one moves on. Free pieces are bodies of
/// their own: they may separate, and their joints carry the contact forces.
bool mayHaveInternalFaces(const Body& body1, const Body& body2);

/// Brings what is known of the solids of a touching pair up to date; false if that was right, as far as the overlap reaches.
bool findInternalFaces(const TouchingPair& pair, polytope::InternalPlanes& known);

} // namespace yade
