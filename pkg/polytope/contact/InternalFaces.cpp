// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact/InternalFaces.hpp"

#include "contact/OverlapOfSolids.hpp"

#include <src/numbers/Tolerances.hpp>

#include <algorithm>
#include <limits>

namespace yade {

namespace {

	/// Whether the covered face goes on beyond its edges with faces that are not covered, along the most of them. A neighbour that rises there
	/// stands in the way of the other body with a face that is covered itself below: of two such faces, back to back, both stay, and what presses
	/// on them cancels but for what is higher. Of a neighbour that lies on the one which covers it, no face is there below.
	bool isInLine(const OverlapOfSolids& overlap, const OverlapOfSolids::Face& covered, const SolidOfPieces& solid)
	{
		const FaceOfPiece& face  = solid.faces[covered.number];
		Real               along = 0, rising = 0;
		const auto         rises = [&](const FaceOfPiece& beside, const Vector3r& edge, const Real& length) {
                        return solid.risesAt(face, beside, edge, length, covered.middle, overlap.widthFrom(beside.plane));
		};
		overlap.forEdges(covered, [&](std::size_t number, const Vector3r& one, const Vector3r& other) {
			const FaceOfPiece& beside = solid.faces[number];
			if (beside.isCovered) return;
			const Real length = (other - one).norm();
			along += length;
			if (rises(beside, (one + other) / 2, length)) rising += length;
		});
		if (along > 0) return 2 * rising <= along;
		// where the overlap reaches it with a corner alone, from another face: as if it went on to that one
		bool isHigher = false;
		overlap.forFaces([&](const OverlapOfSolids::Face& other) {
			if (other.body != covered.body || other.number == covered.number || isHigher) return;
			const FaceOfPiece& beside = solid.faces[other.number];
			if (beside.isCovered) return;
			Vector3r way;
			if (!wayOut(beside.plane, face.plane, way)) return;
			const Vector3r edge = covered.middle + (beside.plane.offset - beside.plane.normal.dot(covered.middle)) * way;
			isHigher            = rises(beside, edge, std::numeric_limits<Real>::infinity());
		});
		return !isHigher;
	}

	/// Where the other body presses on a piece at a corner that points inwards, and is in a piece beyond the corner, too: the overlap with the
	/// latter has grown over the face between them, and yet ends at the face of the former. That it presses on the face is seen from the overlap,
	/// which is thinnest there.
	bool endsAtCorner(const OverlapOfSolids& overlap, int body, SolidOfPieces& solid)
	{
		const OverlapOfSolids::Face* thinnest = nullptr;
		Real                         least    = std::numeric_limits<Real>::infinity();
		overlap.forFaces([&](const OverlapOfSolids::Face& face) {
			if (face.body != body || solid.faces[face.number].isCovered) return;
			const Real width = overlap.widthFrom(solid.faces[face.number].plane);
			if (width >= least) return;
			least    = width;
			thinnest = &face;
		});
		if (!thinnest) return false;
		const FaceOfPiece end = solid.faces[thinnest->number];
		return end.own < 0 && solid.keepBelow(end, thinnest->middle);
	}

	/// Leaves out internal faces, from the overlap of the two pieces on, until that of the solids has none.
	OverlapOfSolids findFaces(const OverlapOfSolids& ofPieces, SolidOfPieces (&solids)[2], bool flat, const Real& reach)
	{
		OverlapOfSolids overlap = ofPieces;
		for (int k = 0; k < polytope::tolerance::piecesOnTheWay; ++k) {
			overlap.forFaces([&](const OverlapOfSolids::Face& on) {
				SolidOfPieces& solid = solids[on.body];
				FaceOfPiece&   face  = solid.faces[on.number];
				if (face.isEnd) return;
				face.isCovered = solid.isPieced() && (on.isThin || solid.covers(face, on.corners, on.middle));
			});
			bool grown = false;
			overlap.forFaces([&](const OverlapOfSolids::Face& on) {
				SolidOfPieces& solid = solids[on.body];
				FaceOfPiece&   face  = solid.faces[on.number];
				if (face.isEnd || face.isInternal || on.isThin) return;
				face.isEnd = !face.isCovered || !isInLine(overlap, on, solid);
				if (face.isEnd) return;
				solid.leaveOut(on.number, ofPieces.corners());
				grown = true;
			});
			for (int body = 0; body < 2 && !grown; ++body)
				grown = solids[body].isOpen() && endsAtCorner(overlap, body, solids[body]);
			if (!grown) break;
			overlap = OverlapOfSolids(solids, flat, reach);
		}
		ofPieces.forFaces([&](const OverlapOfSolids::Face& on) {
			SolidOfPieces& other = solids[1 - on.body];
			if (other.isOpen()) other.leaveOutCovered(solids[on.body].faces[on.number].plane, on.corners, on.middle);
		});
		return overlap;
	}

	/// Whether the overlap has grown over pieces that make no solid, as those about a corner that points inwards, which another body meets along
	/// an edge alone: from the edge into the other body, where they are not.
	bool hasGrownOut(const OverlapOfSolids& grown, const OverlapOfSolids& ofPieces, const SolidOfPieces (&solids)[2])
	{
		if (!(grown.thickness() > polytope::tolerance::grownOut * ofPieces.thickness())) return false;
		return std::any_of(
		        solids, solids + 2, [&](const SolidOfPieces& solid) { return solid.isOpen() && !solid.holds(grown.middle()); });
	}

	/// How near each end comes to the overlap, and which bound it. Returns the overlap's extent.
	Real measureEnds(const OverlapOfSolids& overlap, SolidOfPieces (&solids)[2])
	{
		Real extent = 0;
		for (const Vector3r& corner : overlap.corners()) {
			extent = math::max(extent, corner.norm());
			for (SolidOfPieces& solid : solids)
				for (FaceOfPiece& face : solid.faces)
					if (face.own < 0 && !face.isInternal)
						face.apart = math::min(face.apart, Real(face.plane.offset - face.plane.normal.dot(corner)));
		}
		overlap.forFaces([&](const OverlapOfSolids::Face& on) { solids[on.body].faces[on.number].bounds = true; });
		return extent;
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
			const polytope::Plane end = solid.inBody(face->plane);
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
		if (!(solid.centre().norm() + extent <= known.radius[body])) return false;
		const Real near = Real(polytope::tolerance::endsNear) * extent, room = Real(polytope::tolerance::endOfSupport) * extent;
		const auto same = [&](const polytope::Plane& one, const polytope::Plane& other) {
			return math::abs(one.offset - other.offset) <= room && (one.normal - other.normal).norm() * solid.reach() <= room;
		};
		std::vector<bool> isThere(std::size_t(known.ends[body]), false);
		for (const FaceOfPiece& face : solid.faces) {
			if (face.own >= 0 || face.isInternal) continue;
			const polytope::Plane end     = solid.inBody(face.plane);
			bool                  isKnown = false;
			for (int k = 0; k < known.ends[body]; ++k)
				if (same(known.end[body][k], end)) isKnown = isThere[std::size_t(k)] = true;
			if (!isKnown && (face.bounds || face.apart <= near)) return false;
		}
		// of a piece that is not found any more, or with a face that is internal now: far from the overlap it does not matter
		for (int k = 0; k < known.ends[body]; ++k) {
			if (isThere[std::size_t(k)]) continue;
			const polytope::Plane end   = solid.inWorld(known.end[body][k]);
			Real                  apart = std::numeric_limits<Real>::infinity();
			for (const Vector3r& corner : overlap.corners())
				apart = math::min(apart, Real(end.offset - end.normal.dot(corner)));
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
	const bool               grownOut = hasGrownOut(overlap, ofPieces, solids);
	polytope::InternalPlanes found;
	for (int body = 0; body < 2 && !grownOut; ++body) {
		if (!solids[body].isOpen()) continue;
		addPlanes(body, solids[body], Real(polytope::tolerance::endsKnown) * extent, found);
		found.radius[body] = (1 + Real(polytope::tolerance::endsKnown)) * (solids[body].centre().norm() + extent);
	}
	if (agree(0, solids[0], overlap, extent, known, found) && agree(1, solids[1], overlap, extent, known, found)) return false;
	known = found;
	return true;
}

} // namespace yade
