// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "contact/BoundingPlanes.hpp"
#include "contact/ContactPointRules.hpp"
#include "contact/PairSurface.hpp"
#include "contact/PhaseOne.hpp"
#include "contact/StartBasis.hpp"

/// The contact surface of a body on one of several flush pieces: that of the solid which they make, without the faces between them, and the part of it on
/// this piece. The solid is the piece extended beyond each such face up to the plane through which the solid ends there; a solid that is not convex is so
/// where it ends alone.
namespace polytope {

/// While it lives, planes of internal faces are where the solid ends beyond them.
template <class R, int D> class ExtendedPieces {
public:
	POLYTOPE_INLINE ExtendedPieces(const ContactFrame<R, D>& f, const InternalPlanes& internal, PairPlanes<R, D>& planes)
	        : planes_(planes)
	{
		for (int body = 0; body < 2; ++body)
			for (int k = 0; k < internal.count[body]; ++k) {
				const int    i   = planes.begin(body) + internal.plane[body][k];
				const Plane& end = internal.end[body][k];
				R            own[D];
				for (int m = 0; m < D; ++m)
					own[m] = end.normal[m];
				place_[count_] = i;
				planes.plane(i, normal_[count_], offset_[count_]);
				++count_;
				if (norm<R, D>(own) > 0) {
					R a[D];
					framePlane<R, D>(f, body, own, R(end.offset), a, planes.offset[i]);
					for (int m = 0; m < D; ++m)
						planes.normal[m][i] = a[m];
				} else planes.offset[i] = R(padOffset); // that no body reaches
			}
	}
	ExtendedPieces(const ExtendedPieces&)            = delete;
	ExtendedPieces& operator=(const ExtendedPieces&) = delete;
	POLYTOPE_INLINE ~ExtendedPieces()
	{
		for (int k = 0; k < count_; ++k) {
			planes_.offset[place_[k]] = offset_[k];
			for (int m = 0; m < D; ++m)
				planes_.normal[m][place_[k]] = normal_[k][m];
		}
	}

private:
	PairPlanes<R, D>& planes_;
	int               count_ = 0, place_[2 * BoundingPlanes::most];
	R                 normal_[2 * BoundingPlanes::most][D], offset_[2 * BoundingPlanes::most];
};

/// Largest depth, along n, of a contact of two flush faces, which is the contact that remains where internal faces are left out: thin beside the body that
/// lies on the pieces, and within the thickness of a piece. Twice that, since beside the seam the piece's own part of the overlap is less deep.
template <class R, int D>
POLYTOPE_APART R internalDepth(const PairInput& in, const ContactFrame<R, D>& f, const InternalPlanes& internal, const R* n)
{
	R least = R(padOffset);
	for (int piece = 0; piece < 2; ++piece) {
		if (internal.count[piece] == 0) continue;
		R own[3] = { 0, 0, 0 };
		rotate<R, D>(f.own[piece], n, own);
		least = minOf<R>(least, in.shape[piece]->widthAlong(Vector3(own[0], own[1], own[2])));
		least = minOf<R>(least, R(tolerance::thinContact) * in.shape[1 - piece]->inscribedRadius());
	}
	return 2 * least;
}

/// The planes that bound the overlap, with their slacks at its analytic centre. x and dual turn with the frame.
template <class R, int D, int W>
POLYTOPE_APART void boundingPlanesOf(const PairInput& in, const ContactSettings& settings, PairPlanes<R, D>& planes, ContactFrame<R, D>& f,
        R* x, R* dual, ContactResult& out)
{
	R centre[D];
	for (int k = 0; k < D; ++k)
		centre[k] = x[k];
	newtonCentre<R, D, W>(planes, f, centre, R(settings.newtonTolerance), x, dual, out);
	boundingPlanes<R, D, W>(planes, centre, *settings.bounding);
	settings.bounding->point = worldPoint<R, D>(in, f, toBody<R, D>(f, f.home, centre));
}

/// Length that bounds the overlap with the extended piece: it lies within the other body, and within the piece and as far as the solid goes on beyond it.
template <class R> POLYTOPE_INLINE R sizeOfOverlap(const PairInput& in, const InternalPlanes& internal)
{
	R size = R(padOffset);
	for (int piece = 0; piece < 2; ++piece) {
		if (internal.count[piece] == 0) continue;
		R beyond = 0;
		for (int k = 0; k < internal.count[piece]; ++k) {
			const Plane& end = internal.end[piece][k];
			beyond           = maxOf<R>(beyond, end.normal.isZero() ? R(padOffset) : R(abs(end.offset)));
		}
		size = minOf<R>(size, minOf<R>(in.shape[1 - piece]->boundingRadius(), in.shape[piece]->boundingRadius() + beyond));
	}
	return size;
}

/// The surface of the extended piece, and the part of it on the piece itself. False where there is none, or where the overlap is not one
/// of a body that slides on these pieces.
template <class R, int D, int W>
POLYTOPE_APART bool surfaceOnPieces(const PairInput& in, const ContactSettings& settings, const ProgramLimits<R>& limits,
        PairPlanes<R, D>& planes, const ContactFrame<R, D>& f, bool energy, PairMemory& memory, ContactWorkspace& workspace,
        PairSurface<R, D>& surface)
{
	const InternalPlanes& internal = *settings.internal;
	surface.on->clips.count        = 0;
	for (int body = 0; body < 2; ++body)
		for (int k = 0; k < internal.count[body]; ++k)
			surface.on->clips.add(planes, planes.begin(body) + internal.plane[body][k]);
	const R                    size = maxOf<R>(f.size, sizeOfOverlap<R>(in, internal));
	const ExtendedPieces<R, D> extended(f, internal, planes);
	// the program of the solid, from the ball of the body that has no internal face
	PairMemory    start;
	LpBasis<R, D> basis;
	R             dual[D];
	int           pivots = 0;
	const int     ball   = internal.count[0] > 0 ? 1 : 0;
	bool          found  = in.shape[ball]->inscribedRadius() < R(padOffset) && !surface.on->clips.full();
	if (found) {
		for (int k = 0; k <= D; ++k)
			start.basis[k] = 2 * in.shape[ball]->inscribedBasis()[k] + ball;
		found = startFrom<R, D>(in, f, start.basis, basis, dual);
	}
	if (found) {
		recallBasis<R, D>(planes, start, basis);
		ProgramLimits<R> all = limits;
		all.dismissAbove     = R(padOffset);
		found                = solvePhaseOne<R, D, W>(StartBasis::Aimed, planes, all, size, basis, pivots) == LpStatus::Optimal;
		found                = found && basis.infeasibility < -limits.tolerance;
	}
	if (found) findSurface<R, D, W>(planes, basis, size, energy, settings.warmStart ? &memory.surface : nullptr, workspace, surface);
	if (!found || surface.status != SurfaceStatus::Found) return false;
	const R length = norm<R, D>(surface.sums.force);
	if (!(length > 0)) return false;
	R n[D];
	for (int k = 0; k < D; ++k)
		n[k] = surface.sums.force[k] / length;
	const R area = dot<R, D>(surface.sums.areaVector, n);
	return area > 0 && 2 * length < area * internalDepth<R, D>(in, f, internal, n);
}

} // namespace polytope
