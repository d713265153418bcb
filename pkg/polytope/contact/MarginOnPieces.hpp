// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "contact/SupportPieces.hpp"

#include <src/contact/SpreadContact.hpp>

#include <vector>

/// A body with a margin on several pieces of one rigid support: fixed polytopes, YADE's boxes and walls, facets of a mesh, members of a
/// clump; pieces without margins of their own.
///
/// Each pair knows the way to its own piece alone: beside a seam that leads to the edge of the next piece, which is no edge of the support,
/// and a face that lies on four pieces has four springs. So, where pieces meet, each contact is that of the body with all of them: their
/// nearest point and normal, and closure and line of action of the face that goes on over flush pieces (src/contact/SpreadContact.hpp).
/// Each has a share of it: the part of the body's section, half as deep as it overlaps, that lies in its piece, of what lies in all; and it
/// acts as far from the common line of action as the middle of its part lies from that of all. Then together they have the force and the
/// moment of one contact, and shares change without a jump. Where a contact begins its part is zero.
///
/// It follows from poses and shapes alone. Lengths in m, from the origin of the moving body's core, world axes.
namespace yade {

/// Where a support is touched.
struct SupportPlace {
	Vector3r outward; ///< unit, from the support to the body
	Vector3r point;   ///< of the support, the nearest
	Real     depth;   ///< by which the body overlaps it there
};

class MarginOnPieces {
public:
	/// \param mover body of the pair (0, 1) that moves on the other one; `core`: its own, no half-space. The pair's point is the core's origin.
	MarginOnPieces(const TouchingPair& pair, int mover, const CoreOfBody& core);

	/// Whether no other piece is near.
	bool alone() const { return pieces_.size() < 2; }

	/// Replaces the place where its own piece is touched by that of all pieces.
	void toNearest(SupportPlace& place) const;

	/// The face that is touched, on this piece (first; it may be empty) and on those that continue it; none: this piece has no face there.
	std::vector<polytope::FaceCorners> faces(const SupportPlace& place) const;

	struct Share {
		Real     part;  ///< of the stiffness [-]
		Vector3r aside; ///< from the common line of action to this piece's
	};
	Share share(const SupportPlace& place) const;

private:
	struct Piece {
		Solid                 solid;
		std::vector<Vector3r> corners; ///< none: a half-space
	};

	bool                        add(const Body& body, const Vector3r& centre, const Vector3r& ofMover);
	std::optional<SupportPlace> placeOn(const Piece& piece) const;
	std::optional<SupportPlace> placeOnFace(const Vector3r& point, Real room) const;
	Vector3r                    lowest(const Vector3r& outward) const;
	Real                        flushRoom() const;

	std::vector<Piece>    pieces_; ///< its own first
	std::vector<Vector3r> core_;
	Real                  margin_, reach_, thin_;
};

} // namespace yade
