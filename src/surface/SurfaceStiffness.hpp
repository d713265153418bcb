// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "surface/FeasiblePieces.hpp"
#include "surface/SurfaceSums.hpp"

#include <cmath>

/// How the integrals over a contact surface change as body 2 moves against body 1: by u at the frame's origin and θ about it.
///
/// The surface is where both bodies have the same least slack, p. On its piece between plane i of body 1 and plane j of body 2 it moves along its normal
/// by −a_j·(u + θ × x)/|a_i − a_j|, and by the divergence theorem the integral of p n over the moved surface differs from that over this one by the
/// integral over the space between of body 1's slack's gradient, −a_i: at the surface's edge there is no pressure. So with r(a) = (a, x × a)
///
///     d(∫ p n dS, ∫ x × p n dS)/d(u, θ)         = Σ over the pieces of 1/|a_i − a_j| ∫ r(a_i) r(a_j)ᵀ dS,
///     d(∫ ½ p² n dS, ∫ x × ½ p² n dS)/d(u, θ)   = the same with p in the integral.
namespace polytope {

template <class R> struct SurfaceStiffness {
	R force[6][6];  ///< of SurfaceSums::force and moment [m²] to [m⁴]
	R deeper[6][6]; ///< of SurfaceSums::deeper and deeperTurn [m³] to [m⁵]
	R farthest;     ///< square of the distance from the frame's origin to the surface's farthest corner
	R pressure;     ///< ∫ p dS over all pieces
	R leftOut;      ///< over those that are left out

	POLYTOPE_INLINE void clear()
	{
		farthest = pressure = leftOut = 0;
		for (int i = 0; i < 6; ++i)
			for (int j = 0; j < 6; ++j)
				force[i][j] = deeper[i][j] = 0;
	}

	/// Adds a piece between a plane of body 1 and one of body 2, of which so much is between the bodies.
	///
	/// Faces of both bodies that are nearly in line meet in a piece that runs away as they move: its derivative says nothing of what it will be. It is left
	/// out, for the pressure on it is of the order of depth over size.
	POLYTOPE_INLINE void add(const FeasibleBuffers<R>& set, const FeasiblePiece& piece, R share)
	{
		Moments        plain, weighted;
		const R* const first = set.point + 4 * piece.first;
		reach(first);
		for (int t = 0; t < piece.triangles; ++t) {
			const R *const v = set.point + 4 * piece.ends[2 * t], *const w = set.point + 4 * piece.ends[2 * t + 1];
			reach(v);
			reach(w);
			addTriangle(first, v, w, plain, weighted);
		}
		const R *const one = set.plane + 4 * piece.i, *const other = set.plane + 4 * piece.j;
		R between[3];
		for (int k = 0; k < 3; ++k)
			between[k] = one[k] - other[k];
		const R apart = norm<R, 3>(between), scale = share / apart;
		pressure += share * weighted.all;
		if (apart < R(tolerance::inLine)) {
			leftOut += share * weighted.all;
			return;
		}
		plain.add(one, other, scale, force);
		weighted.add(one, other, scale, deeper);
	}

private:
	/// ∫ dS, ∫ x dS, ∫ x xᵀ dS, with a weight.
	struct Moments {
		R all = 0, first[3] = {}, second[3][3] = {};

		POLYTOPE_INLINE void add(R weight, const R* x)
		{
			all += weight;
			for (int k = 0; k < 3; ++k) {
				const R once = weight * x[k];
				first[k] += once;
				for (int m = 0; m < 3; ++m)
					second[k][m] += once * x[m];
			}
		}

		/// Adds scale × ∫ r(a) r(b)ᵀ.
		POLYTOPE_INLINE void add(const R* a, const R* b, R scale, R (&sum)[6][6]) const
		{
			// x × a as a matrix times x
			const R left[3][3]  = { { 0, a[2], -a[1] }, { -a[2], 0, a[0] }, { a[1], -a[0], 0 } },
			        right[3][3] = { { 0, b[2], -b[1] }, { -b[2], 0, b[0] }, { b[1], -b[0], 0 } };
			R across[3][3]; // ∫ (x × a) xᵀ
			for (int k = 0; k < 3; ++k)
				for (int m = 0; m < 3; ++m)
					across[k][m] = left[k][0] * second[0][m] + left[k][1] * second[1][m] + left[k][2] * second[2][m];
			for (int k = 0; k < 3; ++k)
				for (int m = 0; m < 3; ++m) {
					sum[k][m] += scale * all * a[k] * b[m];
					sum[k][3 + m] += scale * a[k] * dot<R, 3>(right[m], first);
					sum[3 + k][m] += scale * dot<R, 3>(left[k], first) * b[m];
					sum[3 + k][3 + m] += scale * dot<R, 3>(across[k], right[m]);
				}
		}
	};

	POLYTOPE_INLINE void reach(const R* x) { farthest = maxOf<R>(farthest, dot<R, 3>(x, x)); }

	/// By the rule of four points, which is exact up to the third degree (Strang and Fix 1973).
	POLYTOPE_INLINE void addTriangle(const R* o, const R* v, const R* w, Moments& plain, Moments& weighted)
	{
		R from[3], to[3], twice[3] = {};
		for (int k = 0; k < 3; ++k) {
			from[k] = v[k] - o[k];
			to[k]   = w[k] - o[k];
		}
		addCross<R, 3>(from, to, twice);
		const R area = norm<R, 3>(twice) / 2;
		// shares of the three corners, and of the area
		const R fifth = R(1) / 5, third = R(1) / 3, part = R(25) / 48;
		const R rule[4][4] = { { 3 * fifth, fifth, fifth, part }, { fifth, 3 * fifth, fifth, part },
			{ fifth, fifth, 3 * fifth, part }, { third, third, third, R(-9) / 16 } };
		for (const R(&point)[4] : rule) {
			R x[4];
			for (int k = 0; k < 4; ++k)
				x[k] = point[0] * o[k] + point[1] * v[k] + point[2] * w[k];
			plain.add(point[3] * area, x);
			weighted.add(point[3] * area * x[3], x);
		}
	}
};

} // namespace polytope
