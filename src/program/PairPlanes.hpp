// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "numbers/Rotation.hpp"

/// All planes of both bodies in one frame: a_i·x ≤ d_i, body 1's first, each body's padded to whole lanes with neutral
/// planes. D is the number of space dimensions (2 or 3), W the lane width.
namespace polytope {

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

/// Slacks d − a·x of planes i … i + W − 1, and their normals a. X holds x in all lanes.
template <class R, int D, int W, class V> POLYTOPE_INLINE V slacksOf(const PairPlanes<R, D>& planes, int i, const V (&X)[D], V (&a)[D])
{
	V slack = load<R, W>(planes.offset + i);
	for (int k = 0; k < D; ++k) {
		a[k] = load<R, W>(planes.normal[k] + i);
		slack -= a[k] * X[k];
	}
	return slack;
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

} // namespace polytope
