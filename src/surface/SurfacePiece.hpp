// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "program/PairPlanes.hpp"
#include "surface/SurfaceBuffers.hpp"

/// The place where two planes i and j have the same slack, p: a piece of the surface between their cells, before it is cut to where no other
/// plane has a smaller one. Its plane is (a_i − a_j)·x = d_i − d_j, in which a point is foot + Σ u_m axis_m.
///
/// The plane of no pressure, number `planes.total`, has a = 0, d = 0: its pieces are the overlap's own faces.
namespace polytope {

template <class R, int D> struct SurfacePiece {
	int i, j;           ///< i < j; so of two bodies i is body 1's
	R   normal[D];      ///< unit, from cell j's side … of a_i − a_j: from body 1 to body 2
	R   offset;         ///< normal·x of its points
	R   axis[D - 1][D]; ///< unit, in its plane
	R   foot[D];        ///< of the frame's origin
	R   pressure;       ///< p at the foot: p = pressure + Σ rate_m u_m
	R   rate[D - 1];

	POLYTOPE_INLINE R pressureAt(const R* u) const
	{
		R sum = pressure;
		for (int m = 0; m < D - 1; ++m)
			sum += rate[m] * u[m];
		return sum;
	}
};

/// Normal and offset of a plane; those of the plane of no pressure are zero.
template <class R, int D> POLYTOPE_INLINE void planeOrNone(const PairPlanes<R, D>& planes, int i, R* a, R& d)
{
	if (i < planes.total) {
		planes.plane(i, a, d);
		return;
	}
	d = 0;
	for (int k = 0; k < D; ++k)
		a[k] = 0;
}

/// False if the piece's plane is farther than `box` from the origin, or there is none.
template <class R, int D> POLYTOPE_INLINE bool placePiece(const PairPlanes<R, D>& planes, int i, int j, R box, SurfacePiece<R, D>& piece)
{
	R a[D], b[D], d, e;
	planeOrNone<R, D>(planes, i, a, d);
	planeOrNone<R, D>(planes, j, b, e);
	R* const n = piece.normal;
	for (int k = 0; k < D; ++k)
		n[k] = a[k] - b[k];
	const R length = norm<R, D>(n), step = d - e;
	if (!(abs(step) <= length * box)) return false; // coincident normals too: their length is zero
	if (!(length > 0)) return false;
	const R inverse = 1 / length;
	for (int k = 0; k < D; ++k)
		n[k] *= inverse;
	piece.i                    = i;
	piece.j                    = j;
	piece.offset               = step * inverse;
	const Rotation<R, D> axes  = axesAround<R, D>(n);
	const bool           faces = j < planes.total;
	for (int k = 0; k < D; ++k)
		piece.foot[k] = n[k] * piece.offset;
	piece.pressure = faces ? d - dot<R, D>(a, piece.foot) : R(0);
	for (int m = 0; m < D - 1; ++m) {
		for (int k = 0; k < D; ++k)
			piece.axis[m][k] = axes.m[m][k];
		piece.rate[m] = faces ? -dot<R, D>(a, piece.axis[m]) : R(0);
	}
	return true;
}

/// Writes to the buffers' rows how the slack of each plane less the pressure changes over the piece. It is taken as the slack's difference to
/// that of plane i or j, whose normal is nearer: the differences of nearly parallel planes are exact, and where such planes meet is as
/// certain as where others do.
///
/// A plane may have the pressure all over the piece. If its normal is not between those of i and j it is nearer than one of them on that
/// one's side, where there is no cell of it then: such a plane leaves nothing of the piece.
template <class R, int D, int W>
POLYTOPE_INLINE void planesOnPiece(const PairPlanes<R, D>& planes, const SurfacePiece<R, D>& piece, const SurfaceBuffers<R, D>& buffers)
{
	using V = typename Lanes<R, W>::Type;
	R own[2][D], offset[2];
	planeOrNone<R, D>(planes, piece.i, own[0], offset[0]);
	planeOrNone<R, D>(planes, piece.j, own[1], offset[1]);
	const V half = broadcast<R, W>(R(1) / 2), d0 = broadcast<R, W>(offset[0]), d1 = broadcast<R, W>(offset[1]);
	const V level = broadcast<R, W>((dot<R, D>(own[0], own[0]) - dot<R, D>(own[1], own[1])) / 2);
	for (int k = 0; k < planes.total; k += W) {
		V a[D], toFirst = -level;
		for (int c = 0; c < D; ++c) {
			a[c] = load<R, W>(planes.normal[c] + k);
			toFirst += a[c] * broadcast<R, W>(own[0][c] - own[1][c]);
		}
		const auto first = toFirst > half - half;
		const V    d     = load<R, W>(planes.offset + k);
		V          rest  = first ? V(d - d0) : V(d - d1);
		V          rate[D - 1], beyond = half - half;
		for (int m = 0; m < D - 1; ++m)
			rate[m] = half - half;
		for (int c = 0; c < D; ++c) {
			const V step = first ? V(a[c] - broadcast<R, W>(own[0][c])) : V(a[c] - broadcast<R, W>(own[1][c]));
			rest -= step * broadcast<R, W>(piece.foot[c]);
			beyond += step * broadcast<R, W>(own[0][c] - own[1][c]);
			for (int m = 0; m < D - 1; ++m)
				rate[m] -= step * broadcast<R, W>(piece.axis[m][c]);
		}
		V most = absolute(rest);
		for (int m = 0; m < D - 1; ++m)
			most = maxOf(most, absolute(rate[m]));
		const V outside = first ? beyond : V(-beyond);
		const V aside   = outside > half - half ? V(half - half - half) : V(half - half);
		rest            = most > half - half ? rest : aside;
		store<R, W>(buffers.rest + k, rest);
		for (int m = 0; m < D - 1; ++m)
			store<R, W>(buffers.rate[m] + k, rate[m]);
	}
	const bool faces = piece.j < planes.total;
	for (int k = planes.total; k < buffers.length; ++k) {
		const bool none = faces && k == planes.total;
		buffers.rest[k] = none ? piece.pressure : R(padOffset);
		for (int m = 0; m < D - 1; ++m)
			buffers.rate[m][k] = none ? piece.rate[m] : R(0);
	}
	for (const int k : { piece.i, piece.j }) {
		buffers.rest[k] = R(padOffset);
		for (int m = 0; m < D - 1; ++m)
			buffers.rate[m][k] = 0;
	}
}

} // namespace polytope
