// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "surface/MeetingPlanes.hpp"
#include "surface/PieceQueue.hpp"
#include "surface/SurfaceSums.hpp"
#include "surface/TwinPlanes.hpp"

/// The surface on which two bodies that overlap press on each other, and the energy whose gradient that is.
///
/// The linear program of a pair has the feasible set {(x, s): a_i·x + s ≤ d_i for all planes of both bodies}. Cut off at s ≥ 0 it is bounded, and
/// with the slacks σ_i = d_i − a_i·x and p = min σ_i its volume and the first moment along s are
///
///     V = ∫ p dx,     W = ∫ ½ p² dx     over the overlap.
///
/// The overlap consists of cells, in each of which one plane is the nearest. Moving body 2 changes V by Σ over its planes of a_j·(velocity) over the
/// cell, and by the divergence theorem that is an integral over the surface between the cells of body 1 and those of body 2, where both have
/// the same least slack: −∂V/∂(centre 2) = ∫ p n dS, −∂W/∂(centre 2) = ∫ ½ p² n dS, moments likewise. The surface consists of convex pieces (i of
/// body 1, j of body 2). Both bodies have the same force to rounding, since it is one sum.
///
/// The pieces are found from one to the next: where at an edge plane k is as near as i and j, the surface goes on between two of the three.
/// It begins at the optimum's basis, whose planes all have a cell. The overlap's own faces (between a cell and s = 0) are walked too, for
/// the surface may have parts apart from each other, one body passing through the other; each has an edge on the overlap's surface. And the
/// faces close the space of body 1's cells, so that the sum of area vectors tells if a piece is missing.
///
/// Nothing here throws or allocates.
namespace polytope {

enum class SurfaceParts : int {
	Facing = 0, ///< force and moment of bodies whose surface is connected (NearPlanes.hpp), begun on it
	Contact,    ///< of any
	Cells,      ///< also overlap, volume and level
};

enum class SurfaceStatus : int {
	Found = 0,
	None,   ///< no surface: one body is wholly within the other, or they coincide; the force is zero
	Open,   ///< a part is missing (SurfaceSums::open), which rounding explains in no pair seen
	NoRoom, ///< more pieces than tolerance::piecesPerPlane
};

/// A piece of a larger solid, and what there is on it.
template <class R, int D> struct SurfaceOnPiece {
	SurfaceClips<R, D> clips;
	R                  pressure      = 0;  ///< ∫ p dS over the part of the surface that lies on the piece [m³]
	R                  centre[D]     = {}; ///< ∫ p x dS over it [m⁴]
	R                  areaVector[D] = {}; ///< ∫ n dS over it [m²]

	POLYTOPE_INLINE void reset()
	{
		pressure = 0;
		for (int k = 0; k < D; ++k)
			centre[k] = areaVector[k] = 0;
	}
	/// What lies on the piece of a polygon of the surface, of which so much is between the bodies.
	template <class Cut>
	POLYTOPE_APART void add(const SurfacePiece<R, D>& piece, const Cut& cut, const SurfaceBuffers<R, D>& buffers, R share = R(1))
	{
		const ClippedPiece<R, D> clipped(piece, cut, clips, buffers);
		if (clipped.count() == 0) return;
		const PieceIntegrals<R, D> of = integrate<R>(piece, clipped);
		if (!(of.area > 0)) return;
		pressure += share * of.p;
		for (int k = 0; k < D; ++k) {
			centre[k] += share * of.pMoment[k];
			areaVector[k] += share * of.area * piece.normal[k];
		}
	}
	POLYTOPE_INLINE void average(const SurfaceOnPiece& other)
	{
		pressure = (pressure + other.pressure) / 2;
		for (int k = 0; k < D; ++k) {
			centre[k]     = (centre[k] + other.centre[k]) / 2;
			areaVector[k] = (areaVector[k] + other.areaVector[k]) / 2;
		}
	}
};

template <class R, int D, int W> class SurfaceWalk {
public:
	/// `on`: a piece of a larger solid, or null.
	POLYTOPE_INLINE SurfaceWalk(PairPlanes<R, D>& planes, const SurfaceBuffers<R, D>& buffers, R size, R deepest, SurfaceParts parts,
	        int order, SurfaceOnPiece<R, D>* on)
	        : planes_(planes), buffers_(buffers), reach_(R(tolerance::pieceBox) * size), deepest_(deepest),
	          all_(parts == SurfaceParts::Cells), faces_(parts != SurfaceParts::Facing), twins_(planes, buffers, size, order),
	          queue_(buffers), cones_(buffers.cell), on_(on)
	{
	}

	/// `basis`: planes that are nearest somewhere. True if planes of both bodies coincide, so that the sums depend on the order.
	///
	/// Where a part is missing the walk begins again: a piece may have been cut by a plane that has been left out since, for another that
	/// coincides with it; or, the third time, from all faces, for rounding may leave no piece of the basis.
	POLYTOPE_INLINE bool run(const int* basis, int count, SurfaceStatus& status, SurfaceSums<R, D>& sums)
	{
		status = SurfaceStatus::Open;
		for (int attempt = 0; attempt < 3 && status == SurfaceStatus::Open; ++attempt) {
			faces_ = faces_ || attempt > 0;
			begin(basis, count, attempt == 2, sums);
			for (int piece = 0; piece < queue_.count(); ++piece)
				look(piece, sums);
			close(status, sums);
		}
		twins_.restore();
		return twins_.shared();
	}

private:
	POLYTOPE_INLINE void reset(SurfaceSums<R, D>& sums)
	{
		sums      = SurfaceSums<R, D>();
		faceArea_ = 0;
		if (on_) on_->reset();
		for (int k = 0; k < D; ++k)
			face_[0][k] = face_[1][k] = 0;
		if (all_) cones_.clear(planes_.total);
	}

	POLYTOPE_INLINE void begin(const int* basis, int count, bool everywhere, SurfaceSums<R, D>& sums)
	{
		reset(sums);
		queue_.clear();
		for (int k = 0; k < count; ++k)
			buffers_.meeting[k] = basis[k];
		meet(buffers_.meeting, count, true);
		for (int k = 0; k < planes_.total && everywhere; ++k) {
			int one = k;
			if (planes_.offset[k] < R(padOffset) / 2) meet(&one, 1, true);
		}
	}

	bool ofFirst(int k) const { return k < planes_.first; }

	/// Planes stand for themselves here.
	POLYTOPE_INLINE void add(int i, int j, int a = -1, int b = -1, int c = -1)
	{
		const int low = i < j ? i : j, high = i < j ? j : i;
		if (low == high) return;
		if (!all_ && high < planes_.total && ofFirst(low) == ofFirst(high)) return;
		queue_.add(low, high, a, b, c);
	}

	/// Adds all pairs of planes that meet, and each of these with the plane of no pressure, if that meets them, too.
	POLYTOPE_INLINE void meet(int* edge, int count, bool noPressure)
	{
		for (int a = 0; a < count; ++a)
			edge[a] = twins_.of(edge[a]);
		for (int a = 0; a < count; ++a) {
			for (int b = 0; b < a; ++b)
				add(edge[a], edge[b]);
			if (noPressure && faces_) add(edge[a], planes_.total);
		}
	}

	POLYTOPE_INLINE void look(int number, SurfaceSums<R, D>& sums)
	{
		SurfacePiece<R, D> piece;
		// of a plane that coincides with another the number is in the queue if it was found to only afterwards
		const int i = queue_.first(number), j = queue_.second(number);
		if (left(i) || left(j)) return;
		if (!placePiece<R, D>(planes_, i, j, reach_, piece)) return;
		planesOnPiece<R, D, W>(planes_, piece, buffers_);
		const SurfaceCut<R, D, W> cut(buffers_, reach_, deepest_, queue_.known(number));
		if (cut.count() == 0) return;
		const PieceIntegrals<R, D> of = integrate<R>(piece, cut);
		sum(piece, cut, of, sums);
		for (int t = 0; t < cut.count(); ++t)
			goOn(piece, cut, t);
	}

	bool left(int k) const { return k < planes_.total && planes_.offset[k] >= R(padOffset) / 2; }

	/// Goes on beyond edge t.
	POLYTOPE_INLINE void goOn(const SurfacePiece<R, D>& piece, const SurfaceCut<R, D, W>& cut, int t)
	{
		const int tag = cut.tag(t), met = cut.meeting(t, buffers_.meeting + 3, buffers_.room - 3);
		if (met > tolerance::fewMeeting && cut.isPoint(t)) return; // the other edges of that vertex lead to the pieces about it
		// at the ends of an edge the same planes meet on its other side
		const int before = cut.tag(t > 0 ? t - 1 : cut.count() - 1), after = cut.tag(t + 1 < cut.count() ? t + 1 : 0);
		if (met > 0) meetAll(piece, cut, t, met);
		else if (tag == planes_.total) {
			if (!faces_) return;
			add(piece.i, tag, piece.j, before, after);
			add(piece.j, tag, piece.i, before, after);
		} else if (tag >= 0) {
			const int third = twins_.of(tag);
			add(piece.i, third, piece.j, before, after);
			if (third != piece.i) add(piece.j, third, piece.i, before, after);
		}
	}

	/// Adds pairs of the planes that meet in edge t: the piece's two, the edge's own, and `met` more, which are in `meeting` from its third number on. All
	/// pairs of a few, for where planes meet but for rounding there may be tiny pieces; of more those that have a piece.
	POLYTOPE_INLINE void meetAll(const SurfacePiece<R, D>& piece, const SurfaceCut<R, D, W>& cut, int t, int met)
	{
		int* const edge   = buffers_.meeting;
		const int  own[3] = { piece.i, piece.j, cut.tag(t) };
		int        count  = 0;
		bool       none   = false;
		for (int k = 0; k < met + 3; ++k) {
			const int plane = k < 3 ? own[k] : edge[k];
			if (plane == planes_.total) none = true;
			else if (plane >= 0) edge[count++] = plane;
		}
		if (count <= tolerance::fewMeeting) return meet(edge, count, none);
		for (int k = 0; k < count; ++k)
			edge[k] = twins_.of(edge[k]);
		if (none && faces_) edge[count++] = planes_.total;
		R across[D - 1];
		cut.across(t, across);
		const MeetingPlanes<R, D> meeting(planes_, piece, across, edge, count);
		meeting.neighbours(!all_, [&](int one, int other) POLYTOPE_INLINE_LAMBDA { add(one, other); });
	}

	template <class Cut>
	POLYTOPE_INLINE void sum(const SurfacePiece<R, D>& piece, const Cut& cut, const PieceIntegrals<R, D>& of, SurfaceSums<R, D>& sums)
	{
		if (!(of.area > 0)) return;
		const bool face = piece.j == planes_.total;
		if (face) {
			R* const vector = ofFirst(piece.i) ? face_[0] : face_[1];
			faceArea_ += of.area;
			for (int k = 0; k < D; ++k)
				vector[k] += of.area * piece.normal[k];
		} else if (ofFirst(piece.i) != ofFirst(piece.j)) {
			sums.add(piece, of);
			if (on_) on_->add(piece, cut, buffers_);
		}
		if (!all_) return;
		cones_.add(piece.i, piece, of, sums);
		if (!face) cones_.add(piece.j, piece, of, sums);
	}

	POLYTOPE_INLINE void close(SurfaceStatus& status, SurfaceSums<R, D>& sums) const
	{
		R first[D], second[D];
		for (int k = 0; k < D; ++k) {
			first[k]  = sums.areaVector[k] - face_[0][k];
			second[k] = sums.areaVector[k] + face_[1][k];
		}
		// without faces nothing says whether a part is missing: then planes that coincide, which may hide one, are reason enough to begin again with them
		if (faces_) sums.open = faceArea_ > 0 ? (norm<R, D>(first) + norm<R, D>(second)) / (sums.area + faceArea_) : R(padOffset);
		else sums.open = sums.pieces > 0 && !twins_.any() ? R(0) : R(padOffset);
		const R allowed = R(tolerance::openSurface) + R(tolerance::openThin / tolerance::pieceBox) * reach_ / deepest_;
		if (queue_.full()) status = SurfaceStatus::NoRoom;
		else if (!(sums.open <= allowed)) status = SurfaceStatus::Open;
		else status = sums.pieces == 0 ? SurfaceStatus::None : SurfaceStatus::Found;
	}

	PairPlanes<R, D>&           planes_;
	const SurfaceBuffers<R, D>& buffers_;
	R                           reach_, deepest_;
	bool                        all_, faces_;
	TwinPlanes<R, D, W>         twins_;
	PieceQueue<R, D>            queue_;
	CellCones<R, D>             cones_;
	SurfaceOnPiece<R, D>*       on_;
	R                           face_[2][D] = {}; ///< area vectors of the overlap's faces of each body
	R                           faceArea_   = 0;
};

/// The contact surface of a pair that overlaps. `basis`: planes of the linear program's optimal basis, in any number; `deepest`: −s*;
/// `size`: the smaller body's circumradius. The planes' frame has its origin within √2 sizes of the smaller body's centre; it has most
/// digits at its origin, which is best at the optimum. Offsets of the planes are changed meanwhile. Where planes of both bodies coincide
/// the force is the mean of the energy's derivatives to both sides. `on`: a piece of a larger solid, or null.
template <class R, int D, int W>
POLYTOPE_INLINE SurfaceStatus contactSurface(PairPlanes<R, D>& planes, const int* basis, int count, R size, R deepest, SurfaceParts parts,
        const SurfaceBuffers<R, D>& buffers, SurfaceSums<R, D>& sums, SurfaceOnPiece<R, D>* on = nullptr)
{
	SurfaceStatus status[2] = { SurfaceStatus::Found, SurfaceStatus::Found };
	bool          shared    = true;
	for (int order = 0; order < 2 && shared; ++order) {
		SurfaceWalk<R, D, W> walk(planes, buffers, size, deepest, parts, order, on);
		SurfaceSums<R, D>    own;
		SurfaceOnPiece<R, D> before;
		if (on) before = *on;
		shared = walk.run(basis, count, status[order], own);
		if (order == 0) sums = own;
		else {
			sums.average(own);
			if (on) on->average(before);
		}
	}
	const auto worse = status[0] > status[1] ? status[0] : status[1];
	// of a surface that is there in one order alone the mean is as good
	return worse == SurfaceStatus::None && sums.pieces > 0 ? SurfaceStatus::Found : worse;
}

} // namespace polytope
