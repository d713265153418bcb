// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact/InternalFaces.hpp"

#include "contact/FacetPrism.hpp"

#include <src/contact/OverlapFaces.hpp>
#include <src/numbers/Tolerances.hpp>

#include <algorithm>
#include <limits>

namespace yade {

namespace {

	const Real noEnd = std::numeric_limits<Real>::infinity();

	/// A face of a piece, from the point in the overlap.
	struct FaceOfPiece {
		polytope::Plane plane;
		int             own;                ///< its number among the planes of the piece that touches; −1: of another piece
		bool            isCovered  = false; ///< by other pieces, where the overlap reaches it
		bool            isInternal = false; ///< and goes on there
		bool            isEnd      = false; ///< it does not
		bool            bounds     = false; ///< the overlap
		Real            apart      = noEnd; ///< least slack in the overlap
	};

	Vector3r middleOf(const std::vector<Vector3r>& corners)
	{
		Vector3r sum = Vector3r::Zero();
		for (const Vector3r& corner : corners)
			sum += corner;
		return sum / Real(corners.size());
	}

	/// One of the two bodies, and what other pieces its solid has.
	class SolidOfPieces {
	public:
		SolidOfPieces(const TouchingPair& pair, int which)
		        : centre(pair.centre[which] + movedBy(pair, which) - pair.point), rotation(pair.rotation[which]),
		          rounding_(roundingOf(pair)), step_(flushStep(pair)), ball_(pair.ball)
		{
			polytope::addPlanesOf({ *pair.convex[which], centre, rotation }, own_);
			for (std::size_t k = 0; k < own_.size(); ++k)
				faces.push_back({ own_[k], int(k) });
			reach_ = centre.norm() + pair.convex[which]->boundingRadius();
			if (!isPiece(bodyOf(pair, which)) || own_.size() < 2) return;
			const int  other     = 1 - which;
			const bool isAlone   = !isPiece(bodyOf(pair, other));
			const bool bothFixed = isFixed(bodyOf(pair, which), *pair.scene) && isFixed(bodyOf(pair, other), *pair.scene);
			// the overlap with a single body reaches no farther than that
			const Real near = isAlone ? Real(2 * pair.convex[other]->boundingRadius()) : noEnd;
			forOtherPieces(pair, other, [&](const Body& piece, const Vector3r& at) {
				const Vector3r place   = at + movedBy(pair, which);
				const bool     isFacet = dynamic_cast<const Facet*>(piece.shape.get());
				const Real     radius  = familyOf(*piece.shape).boundingRadius(*piece.shape);
				Piece          one { {}, place, radius > 0 ? radius : noEnd }; // a wall has none
				// the other body, as it lies by the piece
				const Vector3r met = place + pair.centre[other] - pair.point - at;
				if (isFacet) setGround(piece, place, bodyOf(pair, other), met, *pair.scene, one.solid);
				else setBody(one.solid, piece, place, met, near);
				if (one.solid.planes.empty()) return;
				// of two fixed bodies, what is fixed may as well be of the other one's solid: it is where that is in their overlap
				if (bothFixed && contains(one.solid.planes, Vector3r::Zero())) return;
				reach_ = math::max(reach_, Real(place.norm() + one.radius));
				// prisms: the ground behind a facet goes on for ever, and so does a polygon
				if (isFacet || pair.convex[which]->dimension() == 2) one.radius = noEnd;
				pieces_.push_back(std::move(one));
			});
		}

		bool isPieced() const { return !pieces_.empty(); }
		/// Not less than the distance of any of its points.
		Real reach() const { return reach_; }
		bool isOpen() const { return isOpen_; }

		/// Whether a point is in it.
		bool holds(const Vector3r& point) const { return holds(point, true); }

		/// Whether a face of the overlap is no wider than rounding: nothing can be said of it, and nothing presses on it.
		bool isThin(const std::vector<Vector3r>& corners) const
		{
			const Vector3r middle = middleOf(corners);
			Vector3r       area   = Vector3r::Zero();
			Real           length = 0;
			for (std::size_t k = 0; k < corners.size(); ++k) {
				const Vector3r arm = corners[k] - middle;
				area += arm.cross(corners[(k + 1) % corners.size()] - middle) / 2;
				length = math::max(length, arm.norm());
			}
			return area.norm() <= 4 * rounding_ * length;
		}

		/// Whether other pieces fill the place outside of a face that the overlap has here, from corner to corner.
		bool covers(const FaceOfPiece& face, const std::vector<Vector3r>& corners) const
		{
			const Vector3r  middle = middleOf(corners);
			const Vector3r& out    = face.plane.normal;
			const Real      inside = Real(polytope::tolerance::flushOfDepth), near = inside / 2 * roomBeside(face, middle);
			return isBeside(face, middle, out, near)
			        && std::all_of(corners.begin(), corners.end(), [&](const Vector3r& corner) {
				           return isBeside(face, corner + inside * (middle - corner), out, near);
			           });
		}

		/// Whether one of them rises above the face `beside`, at a point on the edge with it of a covered face with such a middle. It is looked for along
		/// that face, and so at one height above it.
		bool risesAt(const FaceOfPiece& face, const FaceOfPiece& beside, const Vector3r& edge, const Vector3r& middle) const
		{
			const Vector3r &n = face.plane.normal, &up = beside.plane.normal;
			const Vector3r  along  = n - n.dot(up) * up; // along·n = |along|²
			const Real      square = along.squaredNorm();
			if (!(square > Real(polytope::tolerance::parallel))) return false;
			const Vector3r step = Real(polytope::tolerance::flushOfDepth) * (middle - edge);
			for (const double way : polytope::tolerance::closeBy) {
				const Vector3r out = edge + math::max(Real(Real(way) * ball_), Real(2 * rounding_)) / square * along;
				if (goesThrough(out + step, out - step)) return true;
			}
			return false;
		}

		/// Internal faces stay if a piece below them rises above the face `end` of another piece, by which the grown overlap has such a middle: at a corner that
		/// points inwards. Returns whether there are some.
		bool keepBelow(const FaceOfPiece& end, const Vector3r& middle)
		{
			bool some = false;
			for (FaceOfPiece& face : faces) {
				if (!face.isInternal) continue;
				const Vector3r &n = face.plane.normal, &up = end.plane.normal;
				const Vector3r  along  = n - n.dot(up) * up;
				const Real      square = along.squaredNorm();
				if (!(square > Real(polytope::tolerance::parallel))) continue;
				const Vector3r edge = middle + (face.plane.offset - n.dot(middle)) / square * along;
				const Real     far  = math::max(Real(Real(polytope::tolerance::flushOfDepth) * ball_), Real(2 * rounding_));
				const Vector3r below = edge - far / square * along;
				if (!goesThrough(below - far * up, below + far * up)) continue;
				face.isInternal = false;
				face.isEnd = some = true;
			}
			return some;
		}

		/// The overlap goes on beyond this face, within the faces of the other pieces that do not cut `overlap`, the one of the two pieces.
		void leaveOut(std::size_t which, const std::vector<polytope::OverlapFace>& overlap)
		{
			if (!isOpen_) addFacesOfOthers(overlap);
			const polytope::Plane plane = faces[which].plane;
			for (FaceOfPiece& face : faces)
				face.isInternal = face.isInternal || (!face.isEnd && isSame(face.plane, plane));
		}

		std::vector<FaceOfPiece> faces; ///< first the own
		const Vector3r           centre;
		const Matrix3r           rotation;

	private:
		struct Piece {
			Solid    solid;
			Vector3r centre;
			Real     radius;

			bool holds(const Vector3r& point, const Real& room) const
			{
				const Real far = radius + room;
				return (point - centre).squaredNorm() <= far * far && contains(solid.planes, point, room);
			}
		};

		static Vector3r movedBy(const TouchingPair& pair, int which)
		{
			return which == 1 ? pair.nearer : Vector3r(Vector3r::Zero());
		}

		/// Whether a piece has both points, the second one by more than rounding.
		bool goesThrough(const Vector3r& one, const Vector3r& other) const
		{
			return (contains(own_, one, rounding_) && contains(own_, other, -rounding_))
			        || std::any_of(pieces_.begin(), pieces_.end(),
			                [&](const Piece& piece) { return piece.holds(one, rounding_) && piece.holds(other, -rounding_); });
		}

		bool holds(const Vector3r& point, bool orOwn) const
		{
			if (pieces_[last_].holds(point, rounding_)) return true;
			for (std::size_t k = 0; k < pieces_.size(); ++k)
				if (pieces_[k].holds(point, rounding_)) {
					last_ = k;
					return true;
				}
			return orOwn && contains(own_, point, rounding_);
		}

		/// How far from the middle of an oblique face one may go along its normal until one is beyond another face of the solid.
		Real roomBeside(const FaceOfPiece& face, const Vector3r& middle) const
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

		/// `out`: the way to one beyond the face; `near`: a point no farther than that is looked at.
		bool isBeside(const FaceOfPiece& face, const Vector3r& point, const Vector3r& out, const Real& near) const
		{
			for (const double& way : polytope::tolerance::closeBy) {
				const Real far = &way == polytope::tolerance::closeBy ? math::min(Real(Real(way) * ball_), near)
				                                                      : Real(Real(way) * ball_);
				if (holds(point + math::max(far, Real(2 * rounding_)) * out, face.own < 0)) return true;
			}
			return false;
		}

		bool isSame(const polytope::Plane& one, const polytope::Plane& other) const
		{
			return math::abs(one.offset - other.offset) <= step_ && (one.normal - other.normal).norm() * extent_ <= step_;
		}

		void addFacesOfOthers(const std::vector<polytope::OverlapFace>& overlap)
		{
			isOpen_ = true;
			for (const polytope::OverlapFace& face : overlap)
				for (const Vector3r& corner : face.corners)
					extent_ = math::max(extent_, corner.norm());
			for (const Piece& piece : pieces_)
				for (std::size_t k = 0; k < piece.solid.faces; ++k) {
					const polytope::Plane& plane = piece.solid.planes[k];
					const bool             cuts  = std::any_of(overlap.begin(), overlap.end(), [&](const auto& face) {
                                                return std::any_of(face.corners.begin(), face.corners.end(),
						                     [&](const Vector3r& at) { return plane.normal.dot(at) > plane.offset + step_; });
                                        });
					const bool             isOwn = std::any_of(
                                                own_.begin(), own_.end(), [&](const polytope::Plane& own) { return isSame(own, plane); });
					if (!cuts && !isOwn) faces.push_back({ plane, -1 });
				}
		}

		Planes              own_;
		std::vector<Piece>  pieces_;
		mutable std::size_t last_ = 0; ///< the piece that a point was in
		Real                rounding_, step_, ball_, reach_, extent_ = 0;
		bool                isOpen_ = false; ///< it goes on beyond a face of the piece
	};

	/// The overlap of two solids as far as their faces are known.
	class OverlapOfSolids {
	public:
		OverlapOfSolids(const SolidOfPieces (&solids)[2], bool flat, const Real& reach)
		{
			for (int body = 0; body < 2; ++body)
				for (std::size_t k = 0; k < solids[body].faces.size(); ++k) {
					const FaceOfPiece& face = solids[body].faces[k];
					if (face.isInternal) continue;
					planes_.push_back(face.plane);
					named_.push_back({ body, k });
				}
			for (int side = flat ? -1 : 2; side < 2; side += 2) // a polygon's depth does not matter
				planes_.push_back({ Vector3r(0, 0, side), reach });
			faces_ = polytope::overlapFaces(planes_, 2 * reach);
		}

		const std::vector<polytope::OverlapFace>& faces() const { return faces_; }

		/// Calls visit(body, number of the face, its corners).
		template <class Visit> void forFaces(const Visit& visit) const
		{
			for (const polytope::OverlapFace& face : faces_)
				if (const Name* const name = nameOf(face)) visit(name->body, name->face, face.corners);
		}
		/// Calls visit(number of the face beside it, its two ends) for the edges of a face of the body with faces of the same body.
		template <class Visit> void forEdges(int body, const std::vector<Vector3r>& corners, const Visit& visit) const
		{
			for (const polytope::OverlapFace& face : faces_) {
				const Name* const name = nameOf(face);
				if (!name || name->body != body || &face.corners == &corners) continue;
				for (std::size_t k = 0; k < corners.size(); ++k) {
					const Vector3r &one = corners[k], &other = corners[(k + 1) % corners.size()];
					const auto      has = [&](const Vector3r& corner) { // faces that meet have the same corners
                                                return std::find(face.corners.begin(), face.corners.end(), corner) != face.corners.end();
					};
					if (has(one) && has(other)) visit(name->face, one, other);
				}
			}
		}
		template <class Visit> void forCorners(const Visit& visit) const
		{
			for (const polytope::OverlapFace& face : faces_)
				for (const Vector3r& corner : face.corners)
					visit(corner);
		}

	private:
		struct Name {
			int         body;
			std::size_t face;
		};
		/// Null for faces of neither body.
		const Name* nameOf(const polytope::OverlapFace& face) const
		{
			return face.plane >= 0 && std::size_t(face.plane) < named_.size() ? &named_[std::size_t(face.plane)] : nullptr;
		}

		std::vector<polytope::Plane>       planes_;
		std::vector<Name>                  named_;
		std::vector<polytope::OverlapFace> faces_;
	};

	/// Whether the covered face goes on beyond its edges with faces that are not covered, along the most of them. A neighbour that rises there stands in
	/// the way of the other body with a face that is covered itself below: of two such faces, back to back, both stay, and what presses on them
	/// cancels but for what is higher. Of a neighbour that lies on the one which covers it, no face is there below.
	bool isInLine(const OverlapOfSolids& overlap, int body, const SolidOfPieces& solid, const FaceOfPiece& face,
	        const std::vector<Vector3r>& corners)
	{
		const Vector3r middle = middleOf(corners);
		Real           along = 0, rising = 0;
		overlap.forEdges(body, corners, [&](std::size_t beside, const Vector3r& one, const Vector3r& other) {
			if (solid.faces[beside].isCovered) return;
			const Real length = (other - one).norm();
			along += length;
			if (solid.risesAt(face, solid.faces[beside], (one + other) / 2, middle)) rising += length;
		});
		if (along > 0) return 2 * rising <= along;
		// where the overlap reaches it with a corner alone, from another face: as if it went on to that one
		bool rises = false;
		overlap.forFaces([&](int of, std::size_t which, const std::vector<Vector3r>&) {
			const FaceOfPiece& beside = solid.faces[of == body ? which : 0];
			if (of != body || &beside == &face || beside.isCovered) return;
			const Vector3r& up     = beside.plane.normal;
			const Vector3r  along  = up - up.dot(face.plane.normal) * face.plane.normal;
			const Real      square = along.squaredNorm();
			if (!(square > Real(polytope::tolerance::parallel))) return;
			const Vector3r edge = middle + (beside.plane.offset - up.dot(middle)) / square * along;
			rises               = rises || solid.risesAt(face, beside, edge, middle);
		});
		return !rises;
	}

	/// Where the other body presses on a piece at a corner that points inwards, and is in a piece beyond the corner, too: the overlap with the latter has grown over
	/// the face between them, and yet ends at the face of the former. That it presses on the face is seen from the overlap, which is thinnest there.
	bool endsAtCorner(const OverlapOfSolids& overlap, int body, SolidOfPieces& solid)
	{
		const FaceOfPiece* thinnest = nullptr;
		Vector3r           middle;
		Real               least = noEnd;
		overlap.forFaces([&](int of, std::size_t which, const std::vector<Vector3r>& corners) {
			if (of != body || solid.faces[which].isCovered) return;
			const polytope::Plane& plane = solid.faces[which].plane;
			Real                   width = 0;
			overlap.forCorners(
			        [&](const Vector3r& corner) { width = math::max(width, Real(plane.offset - plane.normal.dot(corner))); });
			if (width >= least) return;
			least    = width;
			thinnest = &solid.faces[which];
			middle   = middleOf(corners);
		});
		return thinnest && thinnest->own < 0 && solid.keepBelow(*thinnest, middle);
	}

	/// Leaves out internal faces, from the overlap of the two pieces on, until that of the solids has none.
	OverlapOfSolids findFaces(const OverlapOfSolids& ofPieces, SolidOfPieces (&solids)[2], bool flat, const Real& reach)
	{
		OverlapOfSolids overlap = ofPieces;
		for (int k = 0; k < polytope::tolerance::piecesOnTheWay; ++k) {
			overlap.forFaces([&](int body, std::size_t which, const std::vector<Vector3r>& corners) {
				FaceOfPiece& face = solids[body].faces[which];
				if (!face.isEnd)
					face.isCovered = solids[body].isPieced()
					        && (solids[body].isThin(corners) || solids[body].covers(face, corners));
			});
			bool grown = false;
			overlap.forFaces([&](int body, std::size_t which, const std::vector<Vector3r>& corners) {
				SolidOfPieces& solid = solids[body];
				FaceOfPiece&   face  = solid.faces[which];
				if (face.isEnd || face.isInternal || solid.isThin(corners)) return;
				face.isEnd = !face.isCovered || !isInLine(overlap, body, solid, face, corners);
				if (face.isEnd) return;
				solid.leaveOut(which, ofPieces.faces());
				grown = true;
			});
			for (int body = 0; body < 2 && !grown; ++body)
				grown = solids[body].isOpen() && endsAtCorner(overlap, body, solids[body]);
			if (!grown) break;
			overlap = OverlapOfSolids(solids, flat, reach);
		}
		return overlap;
	}

	/// Not less than the radius of the largest ball in the overlap: three times the volume over the surface, which is that of a ball's circumscribed polyhedra.
	Real thicknessOf(const OverlapOfSolids& overlap)
	{
		Real volume = 0, surface = 0;
		for (const polytope::OverlapFace& face : overlap.faces()) {
			const Vector3r& first = face.corners.front();
			Vector3r        area  = Vector3r::Zero();
			for (std::size_t k = 2; k < face.corners.size(); ++k)
				area += (face.corners[k - 1] - first).cross(face.corners[k] - first) / 2;
			volume += area.dot(first) / 3;
			surface += area.norm();
		}
		return surface > 0 ? Real(3 * volume / surface) : Real(0);
	}

	/// Whether the overlap has grown over pieces that make no solid, as those about a corner that points inwards, which another body meets along an edge
	/// alone: from the edge into the other body, where they are not.
	bool hasGrownOut(const OverlapOfSolids& grown, const Real& thicknessOfPieces, const SolidOfPieces (&solids)[2])
	{
		if (!(thicknessOf(grown) > polytope::tolerance::grownOut * thicknessOfPieces)) return false;
		Vector3r sum   = Vector3r::Zero();
		Real     count = 0;
		grown.forCorners([&](const Vector3r& corner) {
			sum += corner;
			count += 1;
		});
		return std::any_of(
		        solids, solids + 2, [&](const SolidOfPieces& solid) { return solid.isOpen() && !solid.holds(sum / count); });
	}

	/// How near each end comes to the overlap, and which bound it. Returns the overlap's extent.
	Real measureEnds(const OverlapOfSolids& overlap, SolidOfPieces (&solids)[2])
	{
		Real extent = 0;
		overlap.forCorners([&](const Vector3r& corner) {
			extent = math::max(extent, corner.norm());
			for (SolidOfPieces& solid : solids)
				for (FaceOfPiece& face : solid.faces)
					if (face.own < 0 && !face.isInternal)
						face.apart = math::min(face.apart, Real(face.plane.offset - face.plane.normal.dot(corner)));
		});
		overlap.forFaces(
		        [&](int body, std::size_t which, const std::vector<Vector3r>&) { solids[body].faces[which].bounds = true; });
		return extent;
	}

	/// The plane in the body's axes, from its centre.
	polytope::Plane inBody(const polytope::Plane& plane, const SolidOfPieces& solid)
	{
		return { solid.rotation.transpose() * plane.normal, plane.offset - plane.normal.dot(solid.centre) };
	}

	/// The solid's internal faces, and its ends no farther from the overlap than that: those that bound it first.
	void addPlanes(int body, const SolidOfPieces& solid, const Real& farthest, polytope::InternalPlanes& planes)
	{
		std::vector<const FaceOfPiece*> ends;
		for (const FaceOfPiece& face : solid.faces) {
			if (face.own >= 0 && face.isInternal && planes.count[body] < polytope::InternalPlanes::most)
				planes.add(body, face.own);
			if (face.own < 0 && !face.isInternal && (face.bounds || face.apart <= farthest)) ends.push_back(&face);
		}
		if (planes.count[body] == 0) return;
		std::stable_sort(ends.begin(), ends.end(), [](const FaceOfPiece* one, const FaceOfPiece* other) {
			return one->bounds != other->bounds ? one->bounds : one->apart < other->apart;
		});
		for (const FaceOfPiece* face : ends) {
			const polytope::Plane end = inBody(face->plane, solid);
			const auto            same
			        = [&](const polytope::Plane& known) { return known.normal == end.normal && known.offset == end.offset; };
			const polytope::Plane* const first = planes.end[body];
			if (planes.ends[body] == polytope::InternalPlanes::mostEnds) return;
			if (std::none_of(first, first + planes.ends[body], same)) planes.addEnd(body, end);
		}
	}

	/// Whether planes known before are those of this solid as far as they are near the overlap.
	bool agree(int body, const SolidOfPieces& solid, const OverlapOfSolids& overlap, const Real& extent,
	        const polytope::InternalPlanes& known, const polytope::InternalPlanes& found)
	{
		const int* const first = known.plane[body];
		if (known.count[body] != found.count[body] || !std::equal(first, first + known.count[body], found.plane[body]))
			return false;
		if (known.count[body] == 0) return true;
		if (!(solid.centre.norm() + extent <= known.radius[body])) return false;
		const Real near = Real(polytope::tolerance::endsNear) * extent, room = Real(polytope::tolerance::endOfSupport) * extent;
		const auto same = [&](const polytope::Plane& one, const polytope::Plane& other) {
			return math::abs(one.offset - other.offset) <= room && (one.normal - other.normal).norm() * solid.reach() <= room;
		};
		std::vector<bool> isThere(std::size_t(known.ends[body]), false);
		for (const FaceOfPiece& face : solid.faces) {
			if (face.own >= 0 || face.isInternal) continue;
			const polytope::Plane end     = inBody(face.plane, solid);
			bool                  isKnown = false;
			for (int k = 0; k < known.ends[body]; ++k)
				if (same(known.end[body][k], end)) isKnown = isThere[std::size_t(k)] = true;
			if (!isKnown && (face.bounds || face.apart <= near)) return false;
		}
		// of a piece that is not found any more, or with a face that is internal now: far from the overlap it does not matter
		for (int k = 0; k < known.ends[body]; ++k) {
			if (isThere[std::size_t(k)]) continue;
			const Vector3r normal = solid.rotation * known.end[body][k].normal;
			Real           apart  = noEnd;
			overlap.forCorners([&](const Vector3r& corner) {
				apart = math::min(apart, Real(known.end[body][k].offset - normal.dot(corner - solid.centre)));
			});
			if (!(apart > near)) return false;
		}
		return true;
	}

} // namespace

bool mayHaveInternalFaces(const Body& body1, const Body& body2) { return (isPiece(body1) || isPiece(body2)) && !inOneClump(body1, body2); }

bool findInternalFaces(const TouchingPair& pair, polytope::InternalPlanes& known)
{
	SolidOfPieces solids[] = { { pair, 0 }, { pair, 1 } };
	if (!solids[0].isPieced() && !solids[1].isPieced()) {
		const bool some = !known.none();
		known           = {};
		return some;
	}
	const bool               flat  = pair.convex[0]->dimension() == 2;
	const Real               reach = math::min(solids[0].reach(), solids[1].reach());
	const OverlapOfSolids    ofPieces(solids, flat, reach);
	const OverlapOfSolids    overlap  = findFaces(ofPieces, solids, flat, reach);
	const Real               extent   = measureEnds(overlap, solids);
	const bool               grownOut = hasGrownOut(overlap, thicknessOf(ofPieces), solids);
	polytope::InternalPlanes found;
	for (int body = 0; body < 2 && !grownOut; ++body) {
		if (!solids[body].isOpen()) continue;
		addPlanes(body, solids[body], Real(polytope::tolerance::endsKnown) * extent, found);
		found.radius[body] = (1 + Real(polytope::tolerance::endsKnown)) * (solids[body].centre.norm() + extent);
	}
	if (agree(0, solids[0], overlap, extent, known, found) && agree(1, solids[1], overlap, extent, known, found)) return false;
	known = found;
	return true;
}

} // namespace yade
