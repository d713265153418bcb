// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "contact/BoundingPlanes.hpp"
#include "contact/ContactPointRules.hpp"
#include "contact/PairSurface.hpp"
#include "contact/PhaseOne.hpp"
#include "contact/WarmStart.hpp"
#include "program/BasisSolver.hpp"

#include <algorithm>

/// The contact surface of a body on one of several flush pieces: that of the solid which they make, without the faces between them, and the
/// part of it on this piece. Where both bodies are pieces, it is that of both solids, and the part which is on both pieces. The solid is taken to
/// be the piece with each such face moved out to where the solid ends beyond it. Where the pieces are no such solid, as about a corner that points
/// inwards, it differs from them beside the piece alone: the pressure on the piece, and so its part of the force, are right all the same.
namespace polytope {

/// Planes of internal faces, moved to where the solid ends beyond them until they are restored.
template <class R, int D> class ExtendedPieces {
public:
	POLYTOPE_INLINE explicit ExtendedPieces(PairPlanes<R, D>& planes) : planes_(planes) { }
	ExtendedPieces(const ExtendedPieces&)            = delete;
	ExtendedPieces& operator=(const ExtendedPieces&) = delete;

	POLYTOPE_APART void extend(const InternalPlanes& internal)
	{
		for (int body = 0; body < 2; ++body)
			for (int k = 0; k < internal.count[body]; ++k) {
				const int i     = planes_.begin(body) + internal.plane[body][k];
				place_[count_]  = i;
				offset_[count_] = planes_.offset[i];
				++count_;
				planes_.offset[i]
				        = minOf<R>(planes_.offset[i] + R(internal.beyond[body][k]), R(padOffset)); // that no body reaches
			}
	}
	POLYTOPE_INLINE void restore()
	{
		while (count_ > 0) {
			--count_;
			planes_.offset[place_[count_]] = offset_[count_];
		}
	}

private:
	PairPlanes<R, D>& planes_;
	int               count_ = 0, place_[2 * BoundingPlanes::most];
	R                 offset_[2 * BoundingPlanes::most];
};

/// The planes that bound the overlap, with their slacks at its analytic centre. What is in the frame turns with it.
template <class R, int D, int W> POLYTOPE_APART void boundingPlanesOf(PairQuery<R, D> q)
{
	BoundingPlanes&      bounding = *q.settings.bounding;
	ExtendedPieces<R, D> extended(q.planes);
	if (q.settings.internal && q.settings.boundingOfSolids) extended.extend(*q.settings.internal);
	R centre[D];
	for (int k = 0; k < D; ++k)
		centre[k] = q.x[k];
	newtonCentre<R, D, W>(q, centre, R(q.settings.newtonTolerance));
	boundingPlanes<R, D, W>(q.planes, centre, bounding);
	bounding.point = worldPoint<R, D>(q.in, q.frame, toBody<R, D>(q.frame, q.frame.home, centre));
	extended.restore();
}

/// Length that bounds the overlap of the extended pieces: it lies within each of them enlarged about its centre until it reaches as far as the
/// solid, for planes that are moved out by no more than that factor bound no more.
template <class R> POLYTOPE_INLINE R sizeOfOverlap(const PlacedPair& in, const InternalPlanes& internal)
{
	R size = R(padOffset);
	for (int piece = 0; piece < 2; ++piece) {
		R larger = 1;
		for (int k = 0; k < internal.count[piece]; ++k) {
			const R own = in.shape[piece]->offsetArray()[internal.plane[piece][k]];
			larger      = maxOf<R>(larger, own > 0 ? R(1 + R(internal.beyond[piece][k]) / own) : R(padOffset));
		}
		size = minOf<R>(size, larger * in.shape[piece]->boundingRadius());
	}
	return size;
}

/// Whether the body is bounded, and its solid too.
inline bool isSolidBounded(const PlacedPair& in, const InternalPlanes& internal, int body)
{
	const Real* const beyond = internal.beyond[body];
	return in.shape[body]->inscribedRadius() < Real(padOffset)
	        && std::all_of(beyond, beyond + internal.count[body], [](const Real& way) { return way < Real(padOffset); });
}

/// The optimum of the program of the extended pieces, from the planes that touch the ball of one of them: of one whose solid is bounded. `size`: that
/// of a body in which the overlap lies. False where it has no optimum to find a surface from.
template <class R, int D, int W> POLYTOPE_APART bool programOnPieces(PairQuery<R, D> q, R size, LpBasis<R, D>& optimum)
{
	const InternalPlanes& internal = *q.settings.internal;
	const int             ball     = internal.count[0] > 0 && isSolidBounded(q.in, internal, 1) ? 1 : 0;
	if (!isSolidBounded(q.in, internal, ball)) return false;
	PairMemory start;
	for (int k = 0; k <= D; ++k)
		start.basis[k] = planeCode(ball, q.in.shape[ball]->inscribedBasis()[k]);
	recallBasis<R, D>(q.planes, start, optimum);
	if (!solveBasis<R, D>(q.planes, optimum)) return false;
	ProgramLimits<R> all = q.limits;
	all.dismissAbove     = R(padOffset);
	int pivots           = 0;
	return solvePhaseOne<R, D, W>(StartBasis::Aimed, q.planes, all, size, optimum, pivots) == LpStatus::Optimal
	        && optimum.infeasibility < -q.limits.tolerance;
}

/// The extended pieces in place of the pieces. What lies on the pieces is kept within `clips`; false if they have no room.
template <class R, int D>
POLYTOPE_APART bool beginOnPieces(
        const InternalPlanes& internal, const PairPlanes<R, D>& planes, ExtendedPieces<R, D>& extended, SurfaceClips<R, D>& clips)
{
	clips.count = 0;
	for (int body = 0; body < 2; ++body)
		for (int k = 0; k < internal.count[body]; ++k)
			clips.add(planes, planes.begin(body) + internal.plane[body][k]);
	if (clips.full()) return false;
	extended.extend(internal);
	return true;
}

/// Whether the surface of the extended pieces was found, with a force that has an area across it.
template <class R, int D> POLYTOPE_APART bool isFoundOnPieces(const ProgramLimits<R>& limits, const PairSurface<R, D>& surface)
{
	return surface.status == SurfaceStatus::Found && surface.deepest > limits.tolerance
	        && dot<R, D>(surface.sums.areaVector, surface.sums.force) > 0;
}

} // namespace polytope
