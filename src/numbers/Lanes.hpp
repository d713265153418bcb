// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "numbers/Real.hpp"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>

/// Vectors of numbers that the compiler maps to the registers of the instruction set (GCC/Clang vector
/// extensions): one source for SSE2, AVX2 and AVX-512VL, and plain scalars for arithmetics wider than double.
namespace polytope {

/// Whatever returns a vector or takes one by value has to be this: a function of its own is compiled for the plain instruction set, whose callers
/// look for a vector of four elsewhere than those that are compiled for AVX.
#define POLYTOPE_INLINE inline __attribute__((always_inline))
#define POLYTOPE_INLINE_LAMBDA __attribute__((always_inline))
/// One copy for all instruction sets: what only some pairs need, and follows indices, does not make the code of the others longer.
#define POLYTOPE_APART __attribute__((noinline))

/// Plane arrays are padded to a multiple of this with neutral planes (see padOffset), so every loop runs on whole vectors.
constexpr int padWidth = 4;

/// Offset of a neutral plane 0·x ≤ padOffset: never violated, weight 1/slack negligible against any plane of any scene.
/// (Where the precision has more than 60 digits, its weight has to be smaller than those.)
constexpr double padOffset = std::numeric_limits<Real>::digits > 150 ? 1e300 : 1e60;

template <class R, int W> struct Lanes { // W is 1 here
	using Type = R;
};
template <> struct Lanes<double, 2> {
	typedef double Type __attribute__((vector_size(16)));
};
template <> struct Lanes<double, 4> {
	typedef double Type __attribute__((vector_size(32)));
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
	else std::memcpy(p, &v, sizeof v);
}

template <class R, int W> POLYTOPE_INLINE typename Lanes<R, W>::Type broadcast(const R& x)
{
	if constexpr (W == 1) return x;
	else return x - typename Lanes<R, W>::Type {};
}

/// 0, 1, … W − 1.
template <class R, int W> POLYTOPE_INLINE typename Lanes<R, W>::Type firstIndices()
{
	if constexpr (W == 1) return 0;
	else {
		typename Lanes<R, W>::Type v;
		for (int k = 0; k < W; ++k)
			v[k] = R(k);
		return v;
	}
}

template <class R, int W, class V> POLYTOPE_INLINE R horizontalSum(const V& v)
{
	if constexpr (W == 1) return v;
	else {
		// pairwise, so the compiler may use shuffles
		if constexpr (W == 4) return (v[0] + v[2]) + (v[1] + v[3]);
		else return v[0] + v[1];
	}
}

/// Sums of N vectors' lanes: four at a time by transposing, which takes half the instructions of one after another.
template <class R, int W, int N, class V> POLYTOPE_INLINE void horizontalSums(const V (&v)[N], R (&sums)[N])
{
	int k = 0;
	if constexpr (W == 4)
		for (; k + 4 <= N; k += 4) {
			const V ab
			        = __builtin_shufflevector(v[k], v[k + 1], 0, 4, 2, 6) + __builtin_shufflevector(v[k], v[k + 1], 1, 5, 3, 7);
			const V cd = __builtin_shufflevector(v[k + 2], v[k + 3], 0, 4, 2, 6)
			        + __builtin_shufflevector(v[k + 2], v[k + 3], 1, 5, 3, 7);
			const V all = __builtin_shufflevector(ab, cd, 0, 1, 4, 5) + __builtin_shufflevector(ab, cd, 2, 3, 6, 7);
			for (int j = 0; j < 4; ++j)
				sums[k + j] = all[j];
		}
	for (; k < N; ++k)
		sums[k] = horizontalSum<R, W>(v[k]);
}

template <class R, int W, class V> POLYTOPE_INLINE V squareRoot(const V& v)
{
	using std::sqrt;
	if constexpr (W == 1) return sqrt(v);
	else {
		V root;
		for (int k = 0; k < W; ++k)
			root[k] = sqrt(v[k]);
		return root;
	}
}

template <class V> POLYTOPE_INLINE V minOf(const V& a, const V& b) { return a < b ? a : b; }
template <class V> POLYTOPE_INLINE V maxOf(const V& a, const V& b) { return a > b ? a : b; }

template <class R, int W, class V> POLYTOPE_INLINE R horizontalMin(const V& v)
{
	if constexpr (W == 1) return v;
	else if constexpr (W == 2) return minOf<R>(v[0], v[1]);
	else {
		const V pairs = minOf(v, V(__builtin_shufflevector(v, v, 2, 3, 0, 1)));
		return minOf<R>(pairs[0], pairs[1]);
	}
}

template <class R, int W, class V> POLYTOPE_INLINE R horizontalMax(const V& v) { return -horizontalMin<R, W>(V(-v)); }

/// The columns of four vectors of four.
template <class V> POLYTOPE_INLINE void transpose(const V (&row)[4], V (&column)[4])
{
	const V a = __builtin_shufflevector(row[0], row[1], 0, 4, 2, 6), b = __builtin_shufflevector(row[0], row[1], 1, 5, 3, 7),
	        c = __builtin_shufflevector(row[2], row[3], 0, 4, 2, 6), d = __builtin_shufflevector(row[2], row[3], 1, 5, 3, 7);
	column[0] = __builtin_shufflevector(a, c, 0, 1, 4, 5);
	column[1] = __builtin_shufflevector(b, d, 0, 1, 4, 5);
	column[2] = __builtin_shufflevector(a, c, 2, 3, 6, 7);
	column[3] = __builtin_shufflevector(b, d, 2, 3, 6, 7);
}

/// Four numbers each from W places, place(lane), the same of all in one vector.
template <class R, int W, class Place, class V> POLYTOPE_INLINE void gatherFours(const Place& place, V (&four)[4])
{
	if constexpr (W == 4) {
		const V row[4] = { load<R, 4>(place(0)), load<R, 4>(place(1)), load<R, 4>(place(2)), load<R, 4>(place(3)) };
		transpose(row, four);
	} else if constexpr (W == 2)
		for (int m = 0; m < 4; m += 2) {
			const V one = load<R, 2>(place(0) + m), other = load<R, 2>(place(1) + m);
			four[m]     = __builtin_shufflevector(one, other, 0, 2);
			four[m + 1] = __builtin_shufflevector(one, other, 1, 3);
		}
	else
		for (int m = 0; m < 4; ++m) {
			R lanes[W];
			for (int lane = 0; lane < W; ++lane)
				lanes[lane] = place(lane)[m];
			four[m] = load<R, W>(lanes);
		}
}

/// To W places that follow each other.
template <class R, int W, class V> POLYTOPE_INLINE void scatterFours(const V (&four)[4], R* to)
{
	if constexpr (W == 4) {
		V row[4];
		transpose(four, row);
		for (int lane = 0; lane < 4; ++lane)
			store<R, 4>(to + 4 * lane, row[lane]);
	} else if constexpr (W == 2)
		for (int m = 0; m < 4; m += 2) {
			store<R, 2>(to + m, __builtin_shufflevector(four[m], four[m + 1], 0, 2));
			store<R, 2>(to + 4 + m, __builtin_shufflevector(four[m], four[m + 1], 1, 3));
		}
	else
		for (int m = 0; m < 4; ++m) {
			R lanes[W];
			store<R, W>(lanes, four[m]);
			for (int lane = 0; lane < W; ++lane)
				to[4 * lane + m] = lanes[lane];
		}
}

template <class V> POLYTOPE_INLINE V absolute(const V& v) { return v < 0 ? -v : v; }
POLYTOPE_INLINE double               absolute(double v) { return std::abs(v); }
POLYTOPE_INLINE long double          absolute(long double v) { return std::abs(v); }

} // namespace polytope
