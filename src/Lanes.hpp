// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "Real.hpp"

#include <cstdint>
#include <cstring>
#include <limits>

/// Vectors of numbers that the compiler maps to whatever registers the instruction set offers (GCC/Clang vector
/// extensions): one source for SSE2, AVX2 and AVX-512, and plain scalars for arithmetics wider than double.
namespace polytope {

#define POLYTOPE_INLINE inline __attribute__((always_inline))

/// Plane arrays are padded to a multiple of this with neutral planes (see padOffset), so every loop runs on whole vectors.
constexpr int padWidth = 8;

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
template <> struct Lanes<double, 8> {
	typedef double  Type __attribute__((vector_size(64)));
	typedef int64_t Mask __attribute__((vector_size(64)));
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
		if constexpr (W == 8) return ((v[0] + v[4]) + (v[2] + v[6])) + ((v[1] + v[5]) + (v[3] + v[7]));
		else if constexpr (W == 4)
			return (v[0] + v[2]) + (v[1] + v[3]);
		else
			return v[0] + v[1];
	}
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
