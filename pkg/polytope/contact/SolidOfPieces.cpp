// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact/SolidOfPieces.hpp"

#include "contact/FacetPrism.hpp"

#include <src/numbers/Tolerances.hpp>

#include <algorithm>

namespace yade {

namespace {

	const Real noEnd = std::numeric_limits<Real>::infinity();

} // namespace

bool wayOut(const polytope::Plane& plane, const polytope::Plane& within, Vector3r& way)
{
	way               = plane.normal - plane.normal.dot(within.normal) * within.normal; // way·normal = |way|²
	const Real square = way.squaredNorm();
	if (!(square > Real(polytope::tolerance::parallel))) return false;
	way /= square;
	return true;
}

bool SolidOfPieces::Piece::holds(const Vector3r& point, const Real& room) const
{
	const Real far = radius + room;
	return (point - centre).squaredNorm() <= far * far && contains(solid.planes, point, room);
}

SolidOfPieces::SolidOfPieces(const TouchingPair& pair, int which)
        : rotation_(pair.rotation[which]), rounding_(roundingOf(pair)), step_(flushStep(pair)), ball_(pair.ball)
{
	const Vector3r moved = which == 1 ? pair.nearer : Vector3r(Vector3r::Zero());
	centre_              = pair.centre[which] + moved - pair.point;
	reach_               = centre_.norm() + pair.convex[which]->boundingRadius();
	polytope::addPlanesOf({ *pair.convex[which], centre_, rotation_ }, own_);
	for (std::size_t k = 0; k < own_.size(); ++k)
		faces.push_back({ own_[k], int(k) });
	if (isPiece(bodyOf(pair, which)) && own_.size() > 1) addPieces(pair, which, moved);
}

void SolidOfPieces::addPieces(const TouchingPair& pair, int which, const Vector3r& moved)
{
	const int   other     = 1 - which;
	const Body& met       = bodyOf(pair, other);
	const bool  isAlone   = !isPiece(met);
	const bool  bothFixed = isFixed(bodyOf(pair, which), *pair.scene) && isFixed(met, *pair.scene);
	// the overlap with a single body reaches no farther than that
	const Real near = isAlone ? Real(2 * pair.convex[other]->boundingRadius()) : noEnd;
	forOtherPieces(pair, other, [&](const Body& piece, const Vector3r& at) {
		const Vector3r place   = at + moved;
		const bool     isFacet = dynamic_cast<const Facet*>(piece.shape.get());
		const Real     radius  = familyOf(*piece.shape).boundingRadius(*piece.shape);
		Piece          one { {}, place, radius > 0 ? radius : noEnd }; // a wall has none
		// the other body, as it lies by the piece
		const Vector3r beside = place + pair.centre[other] - pair.point - at;
		if (isFacet) setGround(piece, place, met, beside, *pair.scene, one.solid);
		else setBody(one.solid, piece, place, beside, near);
		if (one.solid.planes.empty()) return;
		// of two fixed bodies, what is fixed may as well be of the other one's solid: it is where that is in their overlap
		if (bothFixed && contains(one.solid.planes, Vector3r::Zero())) return;
		reach_ = math::max(reach_, Real(place.norm() + one.radius));
		// prisms: the ground behind a facet goes on for ever, and so does a polygon
		if (isFacet || pair.convex[which]->dimension() == 2) one.radius = noEnd;
		pieces_.push_back(std::move(one));
	});
}

bool SolidOfPieces::covers(const FaceOfPiece& face, const std::vector<Vector3r>& corners, const Vector3r& middle) const
{
	const Real inside = Real(polytope::tolerance::flushOfDepth), near = inside / 2 * roomBeside(face, middle);
	return isBeside(face, middle, near) && std::all_of(corners.begin(), corners.end(), [&](const Vector3r& corner) {
		return isBeside(face, corner + inside * (middle - corner), near);
	});
}

bool SolidOfPieces::risesAt(const FaceOfPiece& face, const FaceOfPiece& beside, const Vector3r& edge, const Real& length,
        const Vector3r& middle, const Real& depth) const
{
	Vector3r along;
	if (!wayOut(face.plane, beside.plane, along)) return false;
	const Real     flush = Real(polytope::tolerance::flushOfDepth);
	const Vector3r in = middle - edge, up = flush * ball_ * math::max(Real(1), Real(flush * in.norm() / length)) * in.normalized();
	const auto     isHigher = [&](double way, const Vector3r& height) {
                const Vector3r out = edge + offFace(Real(way) * ball_) * along;
                return goesThrough(out + height, out - height, false);
	};
	const double *const first = std::begin(polytope::tolerance::closeBy), *const farthest = std::end(polytope::tolerance::closeBy) - 1;
	const bool isStep = std::any_of(first, farthest, [&](double way) { return isHigher(way, up); });
	if (!isStep) return isHigher(*farthest, up);
	const Vector3r height = math::max(Real(1), Real(depth / (2 * ball_))) * up;
	return std::any_of(first, farthest + 1, [&](double way) { return isHigher(way, height); });
}

void SolidOfPieces::leaveOut(std::size_t which, const std::vector<Vector3r>& overlap)
{
	if (!isOpen_) addFacesOfOthers(overlap);
	const polytope::Plane plane = faces[which].plane;
	for (FaceOfPiece& face : faces)
		face.isInternal = face.isInternal || (!face.isEnd && isSame(face.plane, plane, extent_));
}

void SolidOfPieces::leaveOutCovered(const polytope::Plane& plane, const std::vector<Vector3r>& corners, const Vector3r& middle)
{
	for (FaceOfPiece& face : faces)
		if (face.own < 0 && !face.isInternal && isSame(face.plane, plane, extent_)) face.isInternal = covers(face, corners, middle);
}

bool SolidOfPieces::keepBelow(const FaceOfPiece& end, const Vector3r& middle)
{
	const Real far  = offFace(Real(polytope::tolerance::flushOfDepth) * ball_);
	bool       some = false;
	for (FaceOfPiece& face : faces) {
		Vector3r along;
		if (!face.isInternal || !wayOut(face.plane, end.plane, along)) continue;
		const Vector3r edge  = middle + (face.plane.offset - face.plane.normal.dot(middle)) * along;
		const Vector3r below = edge - far * along, up = far * end.plane.normal;
		if (!goesThrough(below - up, below + up, true)) continue;
		face.isInternal = false;
		face.isEnd = some = true;
	}
	return some;
}

/// A point as far outside of a face is not on it.
Real SolidOfPieces::offFace(const Real& far) const { return math::max(far, Real(Real(polytope::tolerance::offFace) * rounding_)); }

bool SolidOfPieces::holds(const Vector3r& point, bool orOwn) const
{
	if (pieces_[last_].holds(point, rounding_)) return true;
	for (std::size_t k = 0; k < pieces_.size(); ++k)
		if (pieces_[k].holds(point, rounding_)) {
			last_ = k;
			return true;
		}
	return orOwn && contains(own_, point, rounding_);
}

/// Whether a piece has both points, the second one by more than rounding.
bool SolidOfPieces::goesThrough(const Vector3r& one, const Vector3r& other, bool orOwn) const
{
	return (orOwn && contains(own_, one, rounding_) && contains(own_, other, -rounding_))
	        || std::any_of(pieces_.begin(), pieces_.end(),
	                [&](const Piece& piece) { return piece.holds(one, rounding_) && piece.holds(other, -rounding_); });
}

/// How far from the middle of an oblique face one may go along its normal until one is beyond another face of the solid.
Real SolidOfPieces::roomBeside(const FaceOfPiece& face, const Vector3r& middle) const
{
	Real room = noEnd;
	for (const FaceOfPiece& other : faces) {
		const Real rate = other.plane.normal.dot(face.plane.normal);
		if (other.isInternal || &other == &face || !(rate > Real(polytope::tolerance::parallel))) continue;
		const Real slack = other.plane.offset - other.plane.normal.dot(middle);
		if (slack > 0) room = math::min(room, Real(slack / rate));
	}
	return room;
}

/// Whether the place outside of a point on the face is filled; `near`: a point no farther out than that is looked at.
bool SolidOfPieces::isBeside(const FaceOfPiece& face, const Vector3r& point, const Real& near) const
{
	for (const double& way : polytope::tolerance::closeBy) {
		Real far = Real(way) * ball_;
		if (&way == polytope::tolerance::closeBy) far = math::min(far, near);
		if (holds(point + offFace(far) * face.plane.normal, face.own < 0)) return true;
	}
	return false;
}

void SolidOfPieces::addFacesOfOthers(const std::vector<Vector3r>& overlap)
{
	isOpen_ = true;
	for (const Vector3r& corner : overlap)
		extent_ = math::max(extent_, corner.norm());
	const auto cuts = [&](const polytope::Plane& plane) {
		return std::any_of(overlap.begin(), overlap.end(),
		        [&](const Vector3r& corner) { return plane.normal.dot(corner) > plane.offset + step_; });
	};
	const auto isOwn = [&](const polytope::Plane& plane) {
		return std::any_of(own_.begin(), own_.end(), [&](const polytope::Plane& own) { return isSame(own, plane, extent_); });
	};
	for (const Piece& piece : pieces_)
		for (std::size_t k = 0; k < piece.solid.faces; ++k) {
			const polytope::Plane& plane = piece.solid.planes[k];
			if (!cuts(plane) && !isOwn(plane)) faces.push_back({ plane, -1 });
		}
}

} // namespace yade
