// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "Real.hpp"

#include <cstdint>
#include <cstring>
#include <limits>

/// Vectors of numbers that the compiler maps to whatever registers the instruction set offers (GCC/Clang vector
/// extensions): one source for SSE2, AVX2 and AVX-512VL, and plain scalars for arithmetics wider than double.
namespace polytope {

#define POLYTOPE_INLINE inline __attribute__((always_inline))

/// Plane arrays are padded to a multiple of this with neutral planes (see padOffset), so every loop runs on whole vectors.
constexpr int padWidth = 4;

/// Offset of a neutral plane 0·x ≤ padOffset: never violated, weight 1/slack negligible against any plane of any scene.
constexpr double padOffset = 1e60;

template <class R, int W> struct Lanes { // W is 1 here
	using Type = R;
	using Mask = bool;
};
template <> struct Lanes<double, 2> {
	typedef double  Type __attribute__((vector_size(16)));
	typedef int64_t Mask __attribute__((vector_size(16)));
};
template <> struct Lanes<double, 4> {
	typedef double  Type __attribute__((vector_size(32)));
	typedef int64_t Mask __attribute__((vector_size(32)));
};
template <class R, int W> POLYTOPE_INLINE typename Lanes<R, W>::Type load(const R* p)
{
	if constexpr (W == 1) return *p;
	else {
		typename Lanes<R, W>::Type v;
		std::memcpy(&v, p, sizeof v);
		return v;
	}
}

template <class R, int W> POLYTOPE_INLINE void store(R* p, const typename Lanes<R, W>::Type& v)
{
	if constexpr (W == 1) *p = v;
	else
		std::memcpy(p, &v, sizeof v);
}

template <class R, int W> POLYTOPE_INLINE typename Lanes<R, W>::Type broadcast(const R& x)
{
	if constexpr (W == 1) return x;
	else
		return x - typename Lanes<R, W>::Type {};
}

template <class R, int W, class V> POLYTOPE_INLINE R horizontalSum(const V& v)
{
	if constexpr (W == 1) return v;
	else {
		// pairwise, so the compiler may use shuffles
		if constexpr (W == 4) return (v[0] + v[2]) + (v[1] + v[3]);
		else
			return v[0] + v[1];
	}
}

/// Sums of N vectors' lanes: four at a time by transposing, which takes half the instructions of one after another.
template <class R, int W, int N, class V> POLYTOPE_INLINE void horizontalSums(const V (&v)[N], R (&sums)[N])
{
	int k = 0;
	if constexpr (W == 4)
		for (; k + 4 <= N; k += 4) {
			const V ab = __builtin_shufflevector(v[k], v[k + 1], 0, 4, 2, 6) + __builtin_shufflevector(v[k], v[k + 1], 1, 5, 3, 7);
			const V cd = __builtin_shufflevector(v[k + 2], v[k + 3], 0, 4, 2, 6) + __builtin_shufflevector(v[k + 2], v[k + 3], 1, 5, 3, 7);
			const V all = __builtin_shufflevector(ab, cd, 0, 1, 4, 5) + __builtin_shufflevector(ab, cd, 2, 3, 6, 7);
			for (int j = 0; j < 4; ++j)
				sums[k + j] = all[j];
		}
	for (; k < N; ++k)
		sums[k] = horizontalSum<R, W>(v[k]);
}

template <class V> POLYTOPE_INLINE V minOf(const V& a, const V& b) { return a < b ? a : b; }
template <class V> POLYTOPE_INLINE V maxOf(const V& a, const V& b) { return a > b ? a : b; }

template <class R, int W, class V> POLYTOPE_INLINE R horizontalMin(const V& v)
{
	if constexpr (W == 1) return v;
	else {
		R m = v[0];
		for (int k = 1; k < W; ++k)
			m = minOf<R>(m, v[k]);
		return m;
	}
}

} // namespace polytope
