// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "contact/ContactNormal.hpp"
#include "contact/ContactPointRules.hpp"
#include "contact/PenetrationDepth.hpp"

/// Normal and depth at the contact point, by all planes or without those of internal faces.
namespace polytope {

/// Replaces the offsets of internal faces by ones that no body reaches, and restores them; `offset`: buffer for the original values.
template <class R, int D> POLYTOPE_INLINE void takeOut(PairPlanes<R, D>& planes, const InternalPlanes& internal, R* offset)
{
	for (int body = 0, next = 0; body < 2; ++body)
		for (int k = 0; k < internal.count[body]; ++k) {
			R& one         = planes.offset[planes.begin(body) + internal.plane[body][k]];
			offset[next++] = one;
			one            = R(padOffset);
		}
}

template <class R, int D> POLYTOPE_INLINE void putBack(PairPlanes<R, D>& planes, const InternalPlanes& internal, const R* offset)
{
	for (int body = 0, next = 0; body < 2; ++body)
		for (int k = 0; k < internal.count[body]; ++k)
			planes.offset[planes.begin(body) + internal.plane[body][k]] = offset[next++];
}

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

/// Depth along n through the contact point, whose slacks are in the planes (an overlap thinner than the planes' rounding may have its
/// point outside).
template <class R, int D, int W> POLYTOPE_INLINE R chord(const PairPlanes<R, D>& planes, const R* n)
{
	return maxOf<R>(0, exitDistance<R, D, W>(planes, 0, n, 1) + exitDistance<R, D, W>(planes, 1, n, -1));
}

/// From x to the analytic centre of the overlap without the planes that were taken out, which the piece has together with its neighbours. Frame, planes, x and
/// dual turn where they must. False if Newton does not converge, or if there is no centre: between two bodies that both are pieces the overlap may go on for ever.
template <class R, int D, int W>
POLYTOPE_INLINE bool centreOfPieces(const PairInput& in, const ContactSettings& settings, PairPlanes<R, D>& planes, ContactFrame<R, D>& f,
        R* x, R* dual, R* centre, ContactResult& out)
{
	for (int k = 0; k < D; ++k)
		centre[k] = x[k];
	const CentreStatus found = newtonCentre<R, D, W>(planes, f, centre, R(settings.newtonTolerance), x, dual, out);
	if (found != CentreStatus::Converged && found != CentreStatus::RoundingLimited) return false;
	R square = 0;
	for (int k = 0; k < D; ++k)
		square += (centre[k] - x[k]) * (centre[k] - x[k]);
	const R reach = 2 * maxOf<R>(in.shape[0]->boundingRadius(), in.shape[1]->boundingRadius());
	return square <= reach * reach;
}

/// Where internal faces are left out, an edge or a vertex is as deep on a seam as on one piece, so it has the depth at the centre of the overlap without these
/// faces (`whole`): at the piece's own point, beside the seam, it would be less. A face, which is much wider than deep, has the depth at the piece's own
/// point: together the pieces resist its rocking. h: Hessian of the barrier at that centre, across n about 8/width² in sum.
template <class R, int D> POLYTOPE_INLINE R depthOnPieces(R depth, R whole, const R (&h)[D][D], const R* n)
{
	R across = 0;
	for (int k = 0; k < D; ++k) {
		across += h[k][k] * (1 - n[k] * n[k]);
		for (int j = 0; j < k; ++j)
			across -= 2 * h[k][j] * n[k] * n[j];
	}
	const R thick = whole * sqrt(maxOf<R>(0, across / 8)) / R(tolerance::faceContact), fourth = thick * thick * thick * thick;
	return fourth < R(padOffset) ? depth + (whole - depth) * fourth / (1 + fourth) : whole;
}

/// A touching pair, at x. Internal faces are left out where what is left bounds the contact.
template <class R, int D, int W>
POLYTOPE_INLINE ContactStatus normalInOverlap(const PairInput& in, const ContactSettings& settings, PairPlanes<R, D>& planes,
        ContactFrame<R, D>& f, R* x, R* dual, R* n, ContactResult& out)
{
	R& depth = out.depth;
	if (settings.internal) {
		R offset[2 * BoundingPlanes::most];
		takeOut<R, D>(planes, *settings.internal, offset);
		R          centre[D], g[D], h[D][D];
		const bool found
		        = settings.depthRule != DepthRule::Mean && centreOfPieces<R, D, W>(in, settings, planes, f, x, dual, centre, out);
		const ContactStatus status = contactNormal<R, D, W>(in, settings, planes, f, x, dual, n);
		depth                      = chord<R, D, W>(planes, n);
		const bool common          = found && barrierDerivatives<R, D, W>(planes, centre, g, h);
		if (common) depth = depthOnPieces<R, D>(depth, chord<R, D, W>(planes, n), h, n);
		out.common = worldPoint<R, D>(in, f, toBody<R, D>(f, f.home, common ? centre : x));
		putBack<R, D>(planes, *settings.internal, offset);
		if (depth < internalDepth<R, D>(in, f, *settings.internal, n)) return status;
	}
	const ContactStatus status = contactNormal<R, D, W>(in, settings, planes, f, x, dual, n);
	depth                      = chord<R, D, W>(planes, n);
	return status;
}

/// A pair across a gap, at x in the overlap of both bodies grown by `grown`: the depth is minus the distance
/// between the surfaces along n. `apart`: s*.
template <class R, int D, int W>
POLYTOPE_INLINE void normalAcrossGap(const PairInput& in, const ContactSettings& settings, const PairPlanes<R, D>& planes,
        const ContactFrame<R, D>& f, R grown, R apart, const R* x, const R* dual, R* n, R& depth)
{
	contactNormal<R, D, W>(in, settings, planes, f, x, dual, n);
	// where the normal does not separate the bodies the chord has no meaning; they are at least s*/|n_λ| apart
	const R least = maxOf<R>(apart, 0) / maxOf<R>(norm<R, D>(dual), R(tolerance::direction));
	depth         = minOf<R>(exitOfGrown<R, D>(planes, 0, n, 1, grown) + exitOfGrown<R, D>(planes, 1, n, -1, grown), -least);
}

} // namespace polytope
