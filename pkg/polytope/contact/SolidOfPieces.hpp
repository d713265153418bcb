// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "contact/SupportPieces.hpp"

#include <limits>
#include <vector>

/// The solid that a body makes with the other pieces of its rigid support: what it fills near a contact, and its faces as far as they are known.
namespace yade {

/// A face of a piece, from the point in the overlap.
struct FaceOfPiece {
	polytope::Plane plane;
	int             own;                ///< its number among the planes of the piece that touches; −1: of another piece
	bool            isCovered  = false; ///< by other pieces, where the overlap reaches it
	bool            isInternal = false; ///< and goes on there
	bool            isEnd      = false; ///< it does not
	bool            bounds     = false; ///< the overlap
	Real            apart      = std::numeric_limits<Real>::infinity(); ///< least slack in the overlap
};

/// The way out of a half-space along the plane `within`, until one is out of it by one; false: they are parallel.
bool wayOut(const polytope::Plane& plane, const polytope::Plane& within, Vector3r& way);

/// One of the two bodies of a contact with the pieces of its solid.
class SolidOfPieces {
public:
	SolidOfPieces(const TouchingPair& pair, int which);

	bool isPieced() const { return !pieces_.empty(); }
	/// Whether it goes on beyond a face of the piece that touches.
	bool isOpen() const { return isOpen_; }
	/// Not less than the distance of any of its points.
	Real reach() const { return reach_; }

	/// Whether a point is in it.
	bool holds(const Vector3r& point) const { return holds(point, true); }

	/// Whether other pieces fill the place outside of a face, which the overlap has between these corners, from corner to corner.
	bool covers(const FaceOfPiece& face, const std::vector<Vector3r>& corners, const Vector3r& middle) const;

	/// Whether one of them rises above the face `beside`, at the middle `edge` of the edge with it of a covered face with such a middle. It is looked
	/// for along that face, and so at one height above it. That is a part of the ball's radius, not of the face's height: whether a hollow edge counts is
	/// a matter of its angle, and does not change as a body sinks in. What is as high at the edge itself is a step: of it, a part of half the overlap's `depth`
	/// below the face `beside`, which is that radius where the body lies flat, while the ball shrinks to nothing as a body leaves the piece or comes onto
	/// it. It is more at the ends of a long face, whose edges there are short; `length`: of the edge, without end where there is a corner alone.
	bool risesAt(const FaceOfPiece& face, const FaceOfPiece& beside, const Vector3r& edge, const Real& length, const Vector3r& middle,
	        const Real& depth) const;

	/// Whether two planes are no farther from each other than a step that counts as none, up to `extent` from the overlap's point.
	bool isSame(const polytope::Plane& one, const polytope::Plane& other, const Real& extent) const
	{
		return math::abs(one.offset - other.offset) <= step_ && (one.normal - other.normal).norm() * extent <= step_;
	}

	/// The overlap goes on beyond this face, within the faces of the other pieces that do not cut the overlap of the two
	/// pieces, which has such corners.
	void leaveOut(std::size_t which, const std::vector<Vector3r>& overlap);

	/// Leaves out faces of other pieces in a plane of the other body, which bounds the overlap of the two pieces there from corner to corner: they are
	/// no ends where the solid fills the place beyond. So it is between rows of fixed blocks, each of which has blocks of both rows in its solid.
	void leaveOutCovered(const polytope::Plane& plane, const std::vector<Vector3r>& corners, const Vector3r& middle);

	/// Internal faces stay if a piece below them rises above the face `end` of another piece, by which the grown overlap has such a middle: at a
	/// corner that points inwards. Returns whether there are some.
	bool keepBelow(const FaceOfPiece& end, const Vector3r& middle);

	/// The plane in the body's axes, from its centre.
	polytope::Plane inBody(const polytope::Plane& plane) const
	{
		return { rotation_.transpose() * plane.normal, plane.offset - plane.normal.dot(centre_) };
	}
	/// And back.
	polytope::Plane inWorld(const polytope::Plane& plane) const
	{
		const Vector3r normal = rotation_ * plane.normal;
		return { normal, plane.offset + normal.dot(centre_) };
	}
	const Vector3r& centre() const { return centre_; }
	/// What rounding of poses leaves between pieces.
	const Real& rounding() const { return rounding_; }

	std::vector<FaceOfPiece> faces; ///< first the own

private:
	struct Piece {
		Solid    solid;
		Vector3r centre;
		Real     radius;

		bool holds(const Vector3r& point, const Real& room) const;
	};

	void addPieces(const TouchingPair& pair, int which, const Vector3r& moved);
	void addFacesOfOthers(const std::vector<Vector3r>& overlap);
	bool holds(const Vector3r& point, bool orOwn) const;
	bool goesThrough(const Vector3r& one, const Vector3r& other, bool orOwn) const;
	Real roomBeside(const FaceOfPiece& face, const Vector3r& middle) const;
	bool isBeside(const FaceOfPiece& face, const Vector3r& point, const Real& near) const;
	Real offFace(const Real& far) const;

	Vector3r            centre_;
	Matrix3r            rotation_;
	Planes              own_;
	std::vector<Piece>  pieces_;
	mutable std::size_t last_ = 0; ///< the piece that a point was in
	Real                rounding_, step_, ball_, reach_, extent_ = 0;
	bool                isOpen_ = false;
};

} // namespace yade
