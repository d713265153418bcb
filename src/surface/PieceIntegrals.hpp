// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "surface/SurfaceClips.hpp"

/// Integrals over a piece of the surface of the pressure p, which is linear on it.
namespace polytope {

template <class R, int D> struct PieceIntegrals {
	R area            = 0;  ///< ∫ dS [m²; 2-D: m]
	R p               = 0;  ///< ∫ p dS
	R square          = 0;  ///< ∫ p² dS
	R pMoment[D]      = {}; ///< ∫ p x dS
	R squareMoment[D] = {};
	R any[D]          = {}; ///< a point of the piece, the first vertex
	R pressureThere   = 0;
};

/// Integrals over a polygon, as a fan of triangles from its first vertex: with the values f, g, h of linear functions at a triangle's corners,
///
///     ∫ f g = A/12 (Σf Σg + Σfg),     ∫ f g h = A/60 (Σf Σg Σh + Σf Σgh + Σg Σfh + Σh Σfg + 2 Σfgh).
template <class R, class Cut> POLYTOPE_INLINE PieceIntegrals<R, 3> integrate(const SurfacePiece<R, 3>& piece, const Cut& cut)
{
	PieceIntegrals<R, 3> out;
	R                    origin[2], from[2], along[2] = {}, alongSquare[2] = {};
	cut.vertex(0, origin);
	cut.vertex(1, from);
	const R p0 = maxOf<R>(0, piece.pressureAt(origin));
	R       p1 = maxOf<R>(0, piece.pressureAt(from));
	for (int m = 0; m < 2; ++m)
		from[m] -= origin[m];
	for (int t = 2; t < cut.count(); ++t) {
		R to[2];
		cut.vertex(t, to);
		const R p2 = maxOf<R>(0, piece.pressureAt(to));
		for (int m = 0; m < 2; ++m)
			to[m] -= origin[m];
		const R area = (from[0] * to[1] - from[1] * to[0]) / 2;
		const R sum = p0 + p1 + p2, squares = p0 * p0 + p1 * p1 + p2 * p2, second = sum * sum + squares;
		out.area += area;
		out.p += area * sum;
		out.square += area * second;
		for (int m = 0; m < 2; ++m) { // u is zero at the first vertex
			const R sumU = from[m] + to[m], mixed = p1 * from[m] + p2 * to[m];
			along[m] += area * (sum * sumU + mixed);
			alongSquare[m] += area * (second * sumU + 2 * sum * mixed + 2 * (p1 * p1 * from[m] + p2 * p2 * to[m]));
		}
		p1      = p2;
		from[0] = to[0];
		from[1] = to[1];
	}
	out.p /= 3;
	out.square /= 12;
	out.pressureThere = p0;
	for (int k = 0; k < 3; ++k) {
		out.any[k]     = piece.foot[k] + origin[0] * piece.axis[0][k] + origin[1] * piece.axis[1][k];
		out.pMoment[k] = out.p * out.any[k] + (along[0] * piece.axis[0][k] + along[1] * piece.axis[1][k]) / 12;
		out.squareMoment[k]
		        = out.square * out.any[k] + (alongSquare[0] * piece.axis[0][k] + alongSquare[1] * piece.axis[1][k]) / 60;
	}
	return out;
}

template <class R, class Cut> POLYTOPE_INLINE PieceIntegrals<R, 2> integrate(const SurfacePiece<R, 2>& piece, const Cut& cut)
{
	PieceIntegrals<R, 2> out;
	R                    first[1], last[1];
	cut.vertex(0, first);
	cut.vertex(1, last);
	const R length = last[0] - first[0], p0 = maxOf<R>(0, piece.pressureAt(first)), p1 = maxOf<R>(0, piece.pressureAt(last));
	out.area          = length;
	out.p             = length * (p0 + p1) / 2;
	out.square        = length * (p0 * p0 + p0 * p1 + p1 * p1) / 3;
	out.pressureThere = p0;
	const R along = length * length * (p0 + 2 * p1) / 6, alongSquare = length * length * (p0 * p0 + 2 * p0 * p1 + 3 * p1 * p1) / 12;
	for (int k = 0; k < 2; ++k) {
		out.any[k]          = piece.foot[k] + first[0] * piece.axis[0][k];
		out.pMoment[k]      = out.p * out.any[k] + along * piece.axis[0][k];
		out.squareMoment[k] = out.square * out.any[k] + alongSquare * piece.axis[0][k];
	}
	return out;
}

} // namespace polytope
