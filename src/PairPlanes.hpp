// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "ConvexShape.hpp"
#include "Lanes.hpp"

/// All planes of both bodies in one frame: a_i·x ≤ d_i, body 1's first, each body's padded to whole lanes with neutral
/// planes. D is the number of space dimensions (2 or 3), W the lane width.
namespace polytope {

/// Rotation of D dimensions, row-major plain numbers: the kernel's own, since kernel code is compiled for several
/// instruction sets and must not emit Eigen's functions.
template <class R, int D> struct Rotation {
	R m[D][D == 3 ? 4 : D]; ///< rows of whole lanes
};

template <class R, int D> POLYTOPE_INLINE R dot(const R* a, const R* b)
{
	R sum = a[0] * b[0];
	for (int k = 1; k < D; ++k)
		sum += a[k] * b[k];
	return sum;
}

/// rows(T)·v
template <class R, int D> POLYTOPE_INLINE void rotate(const Rotation<R, D>& t, const R* v, R* out)
{
	for (int k = 0; k < D; ++k)
		out[k] = dot<R, D>(t.m[k], v);
}

/// Tᵀ·v
template <class R, int D> POLYTOPE_INLINE void rotateBack(const Rotation<R, D>& t, const R* v, R* out)
{
	for (int k = 0; k < D; ++k) {
		R sum = t.m[0][k] * v[0];
		for (int j = 1; j < D; ++j)
			sum += t.m[j][k] * v[j];
		out[k] = sum;
	}
}

template <class R, int D> struct PairPlanes {
	R*  normal[D]; ///< component arrays of the unit normals
	R*  offset;
	R*  slack; ///< scratch: d − a·x at the current point
	R*  rate;  ///< scratch: a·direction
	int first; ///< padded number of planes of body 1; body 2's follow
	int total; ///< padded number of planes of both

	int begin(int body) const { return body == 0 ? 0 : first; }
	int end(int body) const { return body == 0 ? first : total; }

	POLYTOPE_INLINE void plane(int i, R* a, R& d) const
	{
		for (int k = 0; k < D; ++k)
			a[k] = normal[k][i];
		d = offset[i];
	}
};

/// Planes of `shape` into pair rows from `begin` on: a ← Tᵀ·a, d ← (d − a·centre) − a·origin with the body's own a, in whose axes
/// `centre` (of the smaller body) and from there `origin` (of the rows' frame) are given: so a normal's rounding acts over the
/// overlap only. `own`: T, from the rows' frame to the body's axes.
template <class R, int D, int W>
POLYTOPE_INLINE void placePlanes(
        const ConvexShape& shape, const Rotation<R, D>& own, const R* centre, const R* origin, PairPlanes<R, D>& out, int begin, int end)
{
	using V = typename Lanes<R, W>::Type;
	V T[D][D], C[D], O[D];
	for (int j = 0; j < D; ++j) {
		C[j] = broadcast<R, W>(centre[j]);
		O[j] = broadcast<R, W>(origin[j]);
		for (int k = 0; k < D; ++k)
			T[j][k] = broadcast<R, W>(own.m[k][j]);
	}
	const R* source[D];
	for (int k = 0; k < D; ++k)
		source[k] = shape.normalArray(k);
	const R* offsets = shape.offsetArray();
	for (int i = 0; begin + i < end; i += W) {
		V a[D];
		V d = load<R, W>(offsets + i);
		for (int k = 0; k < D; ++k) {
			a[k] = load<R, W>(source[k] + i);
			d -= a[k] * C[k];
		}
		for (int k = 0; k < D; ++k)
			d -= a[k] * O[k];
		store<R, W>(out.offset + begin + i, d);
		for (int j = 0; j < D; ++j) {
			V moved = T[j][0] * a[0];
			for (int k = 1; k < D; ++k)
				moved += T[j][k] * a[k];
			store<R, W>(out.normal[j] + begin + i, moved);
		}
	}
}

/// Turns in place, about the frame's origin: a ← T·a.
template <class R, int D, int W> POLYTOPE_INLINE void turnPlanes(const Rotation<R, D>& t, PairPlanes<R, D>& planes)
{
	using V = typename Lanes<R, W>::Type;
	V T[D][D];
	for (int j = 0; j < D; ++j)
		for (int k = 0; k < D; ++k)
			T[j][k] = broadcast<R, W>(t.m[j][k]);
	for (int i = 0; i < planes.total; i += W) {
		V a[D];
		for (int k = 0; k < D; ++k)
			a[k] = load<R, W>(planes.normal[k] + i);
		for (int j = 0; j < D; ++j) {
			V moved = T[j][0] * a[0];
			for (int k = 1; k < D; ++k)
				moved += T[j][k] * a[k];
			store<R, W>(planes.normal[j] + i, moved);
		}
	}
}

/// The axes (t1, t2, n) or (t, n) as rows, from the unit vector n; n along an axis gives a signed permutation exactly.
/// (Duff et al. 2017, "Building an orthonormal basis, revisited", J. Comput. Graph. Tech. 6(1).)
template <class R, int D> POLYTOPE_INLINE Rotation<R, D> axesAround(const R* n)
{
	if constexpr (D == 2) return { { { n[1], -n[0] }, { n[0], n[1] } } };
	else {
		const R sign = n[2] < 0 ? R(-1) : R(1);
		const R a    = R(-1) / (sign + n[2]);
		const R b    = n[0] * n[1] * a;
		return { { { 1 + sign * n[0] * n[0] * a, sign * b, -sign * n[0] }, { b, sign + n[1] * n[1] * a, -n[1] },
			{ n[0], n[1], n[2] } } };
	}
}

} // namespace polytope
