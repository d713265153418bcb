// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "contact/PairSurface.hpp"
#include "contact/PhaseOne.hpp"
#include "contact/PlacePlanes.hpp"
#include "program/BasisSolver.hpp"

/// The contact surface of a body on one of several flush pieces: that of the solid which they make, and the part of it on this piece. Where both
/// bodies are pieces, it is that of both solids, and the part which is on both pieces. The solid is taken to be the piece without the faces that its
/// neighbours cover, within the planes that these have near. Where the pieces are no such solid, as about a corner that points
/// inwards, it differs from them beside the piece alone: the pressure on the piece, and so its part of the force, are right all the same.
namespace polytope {

constexpr int inWholeLanes(int count) { return (count + padWidth - 1) / padWidth * padWidth; }

/// The planes of both solids, in the rows of both pieces and behind them: of each solid those of the piece but the internal ones, and the ends of the other
/// pieces. Last come D + 1 planes of a simplex that the overlap lies in, for the program to begin with. `size`: about the frame's origin, of the overlap.
template <class R, int D> class SolidsPlanes {
public:
	POLYTOPE_APART void begin(const PairQuery<R, D>& q, const InternalPlanes& internal, R size)
	{
		const PairPlanes<R, D>& own    = q.planes;
		const int               ends[] = { inWholeLanes(internal.ends[0]), inWholeLanes(internal.ends[1]) };
		planes_.first                  = own.first + ends[0];
		simplex_                       = own.total + ends[0] + ends[1];
		planes_.total                  = simplex_ + inWholeLanes(D + 1);
		R* const row                   = q.workspace.rowsOfSolids(D + 3, planes_.total);
		for (int k = 0; k < D; ++k)
			planes_.normal[k] = row + k * planes_.total;
		planes_.offset = row + D * planes_.total;
		planes_.slack  = row + (D + 1) * planes_.total;
		planes_.rate   = row + (D + 2) * planes_.total;
		for (int body = 0; body < 2; ++body) {
			int to = planes_.begin(body);
			for (int i = own.begin(body); i < own.end(body); ++i)
				copy(own, i, to++);
			for (int k = 0; k < internal.count[body]; ++k)
				leaveOut(planes_.begin(body) + internal.plane[body][k]);
			for (int k = 0; k < ends[body]; ++k)
				if (k < internal.ends[body]) place(q.frame, body, internal.end[body][k], to++);
				else leaveOut(to++);
		}
		for (int k = 0; k < inWholeLanes(D + 1); ++k)
			leaveOut(simplex_ + k);
		placeSimplex(R(tolerance::simplexAround) * size);
	}

	const PairPlanes<R, D>& planes() const { return planes_; }

	/// The optimum of the program; false where there is none to find a surface from.
	template <int W> POLYTOPE_APART bool solve(const PairQuery<R, D>& q, R size, LpBasis<R, D>& optimum) const
	{
		for (int k = 0; k <= D; ++k)
			optimum.plane[k] = simplex_ + k;
		if (!solveBasis<R, D, W>(planes_, optimum)) return false;
		ProgramLimits<R> all = q.limits;
		all.dismissAbove     = R(padOffset);
		int pivots           = 0;
		return solvePhaseOne<R, D, W>(StartBasis::Aimed, planes_, all, size, optimum, pivots) == LpStatus::Optimal
		        && optimum.infeasibility < -q.limits.tolerance;
	}

private:
	POLYTOPE_INLINE void copy(const PairPlanes<R, D>& own, int i, int to)
	{
		for (int k = 0; k < D; ++k)
			planes_.normal[k][to] = own.normal[k][i];
		planes_.offset[to] = own.offset[i];
	}
	POLYTOPE_INLINE void leaveOut(int i)
	{
		for (int k = 0; k < D; ++k)
			planes_.normal[k][i] = 0;
		planes_.offset[i] = R(padOffset);
	}
	POLYTOPE_INLINE void place(const ContactFrame<R, D>& f, int body, const Plane& plane, int i)
	{
		R own[D], a[D], d;
		for (int k = 0; k < D; ++k)
			own[k] = R(plane.normal[k]);
		framePlane<R, D>(f, body, own, R(plane.offset), a, d);
		for (int k = 0; k < D; ++k)
			planes_.normal[k][i] = a[k];
		planes_.offset[i] = d;
	}
	/// Regular in space: (1, 1, 1), (1, −1, −1), (−1, 1, −1), (−1, −1, 1) over √3; in the plane with a right angle.
	POLYTOPE_INLINE void placeSimplex(R distance)
	{
		using std::sqrt;
		for (int k = 0; k <= D; ++k) {
			const R component = 1 / sqrt(R(D));
			if constexpr (D == 3) {
				planes_.normal[0][simplex_ + k] = k < 2 ? component : -component;
				planes_.normal[1][simplex_ + k] = k % 2 == 0 ? component : -component;
				planes_.normal[2][simplex_ + k] = k == 0 || k == 3 ? component : -component;
			} else {
				planes_.normal[0][simplex_ + k] = k == 0 ? R(-1) : k == 1 ? R(0) : component;
				planes_.normal[1][simplex_ + k] = k == 0 ? R(0) : k == 1 ? R(-1) : component;
			}
			planes_.offset[simplex_ + k] = distance;
		}
	}

	PairPlanes<R, D> planes_;
	int              simplex_ = 0; ///< row of the first of its planes
};

/// Length within which the overlap of the solids lies, about the centre of one of the bodies.
template <class R> POLYTOPE_INLINE R sizeOfOverlap(const PlacedPair& in, const InternalPlanes& internal)
{
	R size = R(padOffset);
	for (int body = 0; body < 2; ++body)
		size = minOf<R>(size, R(internal.count[body] > 0 ? internal.radius[body] : in.shape[body]->boundingRadius()));
	return size;
}

/// What lies on the pieces is kept within `clips`: the planes left out. False if they have no room.
template <class R, int D>
POLYTOPE_APART bool clipsOfPieces(const InternalPlanes& internal, const PairPlanes<R, D>& planes, SurfaceClips<R, D>& clips)
{
	clips.count = 0;
	for (int body = 0; body < 2; ++body)
		for (int k = 0; k < internal.count[body]; ++k)
			clips.add(planes, planes.begin(body) + internal.plane[body][k]);
	return !clips.full();
}

/// Whether the surface of the solids was found, with a force that has an area across it.
template <class R, int D> POLYTOPE_APART bool isFoundOnPieces(const ProgramLimits<R>& limits, const PairSurface<R, D>& surface)
{
	return surface.status == SurfaceStatus::Found && surface.deepest > limits.tolerance
	        && dot<R, D>(surface.sums.areaVector, surface.sums.force) > 0;
}

} // namespace polytope
