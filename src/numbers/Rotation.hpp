// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "numbers/Four.hpp"

#include <cmath>

/// Vectors and rotations of D dimensions (2 or 3) as plain numbers.
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

template <class R, int D> POLYTOPE_INLINE R norm(const R* v)
{
	using std::sqrt;
	return sqrt(dot<R, D>(v, v));
}

/// left·right, `left` a function of row and column. In 3-D a row at a time.
template <class R, int D, int W, class Left> POLYTOPE_INLINE Rotation<R, D> product(const Left& left, const Rotation<R, D>& right)
{
	Rotation<R, D> out;
	if constexpr (D == 3) {
		using V = Four<R, W>;
		V row[3];
		for (int i = 0; i < 3; ++i)
			row[i] = four<V>(right.m[i][0], right.m[i][1], right.m[i][2], R(0));
		for (int j = 0; j < 3; ++j) {
			V sum = row[0] * repeated<V>(R(left(j, 0)));
			sum += row[1] * repeated<V>(R(left(j, 1)));
			sum += row[2] * repeated<V>(R(left(j, 2)));
			storeFour(out.m[j], sum);
		}
	} else
		for (int j = 0; j < D; ++j)
			for (int k = 0; k < D; ++k)
				out.m[j][k] = left(j, 0) * right.m[0][k] + left(j, 1) * right.m[1][k];
	return out;
}

template <class R, int D> POLYTOPE_INLINE Rotation<R, D> transposed(const Rotation<R, D>& t)
{
	Rotation<R, D> out;
	for (int j = 0; j < D; ++j)
		for (int k = 0; k < D; ++k)
			out.m[j][k] = t.m[k][j];
	return out;
}

/// v ← T·v
template <class R, int D> POLYTOPE_INLINE void turnVector(const Rotation<R, D>& turn, R* v)
{
	R old[D];
	for (int k = 0; k < D; ++k)
		old[k] = v[k];
	rotate<R, D>(turn, old, v);
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
