// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "numbers/Lanes.hpp"

/// Four numbers that belong together: a point and its pressure, a plane and its offset, a number for each row of the linear program.
///
/// A kernel with four lanes has them in one vector, one with two lanes in two: without AVX the compiler keeps a vector of four in memory,
/// which made a query three times as long. Types without vectors have plain numbers.
namespace polytope {

template <class R> struct Plain4 {
	R             v[4];
	R             operator[](int k) const { return v[k]; }
	Plain4        operator-() const { return { { -v[0], -v[1], -v[2], -v[3] } }; }
	Plain4&       operator+=(const Plain4& o) { return *this = *this + o; }
	Plain4&       operator-=(const Plain4& o) { return *this = *this - o; }
	Plain4&       operator*=(const Plain4& o) { return *this = *this * o; }
	friend Plain4 operator+(const Plain4& a, const Plain4& b) { return { { a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3] } }; }
	friend Plain4 operator-(const Plain4& a, const Plain4& b) { return { { a[0] - b[0], a[1] - b[1], a[2] - b[2], a[3] - b[3] } }; }
	friend Plain4 operator*(const Plain4& a, const Plain4& b) { return { { a[0] * b[0], a[1] * b[1], a[2] * b[2], a[3] * b[3] } }; }
};

struct Halves4 {
	using Half = Lanes<double, 2>::Type;
	Half low, high;

	POLYTOPE_INLINE double         operator[](int k) const { return k < 2 ? low[k] : high[k - 2]; }
	POLYTOPE_INLINE Halves4        operator-() const { return { -low, -high }; }
	POLYTOPE_INLINE Halves4&       operator+=(const Halves4& o) { return *this = *this + o; }
	POLYTOPE_INLINE Halves4&       operator-=(const Halves4& o) { return *this = *this - o; }
	POLYTOPE_INLINE Halves4&       operator*=(const Halves4& o) { return *this = *this * o; }
	friend POLYTOPE_INLINE Halves4 operator+(const Halves4& a, const Halves4& b) { return { a.low + b.low, a.high + b.high }; }
	friend POLYTOPE_INLINE Halves4 operator-(const Halves4& a, const Halves4& b) { return { a.low - b.low, a.high - b.high }; }
	friend POLYTOPE_INLINE Halves4 operator*(const Halves4& a, const Halves4& b) { return { a.low * b.low, a.high * b.high }; }
};

template <class R, int W> struct FourOf {
	using Type = Plain4<R>;
};
template <> struct FourOf<double, 4> {
	using Type = Lanes<double, 4>::Type;
};
template <> struct FourOf<double, 2> {
	using Type = Halves4;
};
template <class R, int W> using Four = typename FourOf<R, W>::Type;

template <class F> constexpr bool isHalves = std::is_same_v<F, Halves4>;
template <class F> constexpr bool isPlain  = !std::is_same_v<F, Lanes<double, 4>::Type> && !isHalves<F>;

/// Put together in registers: reading a vector back from four numbers that were just written stalls.
template <class F, class R> POLYTOPE_INLINE F four(R a, R b, R c, R d)
{
	if constexpr (isHalves<F>) return { Halves4::Half { a, b }, Halves4::Half { c, d } };
	else if constexpr (isPlain<F>) return { { a, b, c, d } };
	else return F { a, b, c, d };
}

/// The same number four times.
template <class F, class R> POLYTOPE_INLINE F repeated(const R& x)
{
	if constexpr (isHalves<F>) return { broadcast<R, 2>(x), broadcast<R, 2>(x) };
	else if constexpr (isPlain<F>) return { { x, x, x, x } };
	else return broadcast<R, 4>(x);
}

template <class F, class R> POLYTOPE_INLINE F loadFour(const R* p)
{
	if constexpr (isHalves<F>) return { load<R, 2>(p), load<R, 2>(p + 2) };
	else if constexpr (isPlain<F>) return { { p[0], p[1], p[2], p[3] } };
	else return load<R, 4>(p);
}

template <class F, class R> POLYTOPE_INLINE void storeFour(R* p, const F& v)
{
	if constexpr (isHalves<F>) {
		store<R, 2>(p, v.low);
		store<R, 2>(p + 2, v.high);
	} else if constexpr (isPlain<F>)
		for (int k = 0; k < 4; ++k)
			p[k] = v[k];
	else store<R, 4>(p, v);
}

/// Those at places a, b, c, d, in this order.
template <int a, int b, int c, int d, class F> POLYTOPE_INLINE F shuffled(const F& v)
{
	if constexpr (isHalves<F>) return { __builtin_shufflevector(v.low, v.high, a, b), __builtin_shufflevector(v.low, v.high, c, d) };
	else if constexpr (isPlain<F>) return { { v[a], v[b], v[c], v[d] } };
	else return __builtin_shufflevector(v, v, a, b, c, d);
}

/// a × b of the first three.
template <class F> POLYTOPE_INLINE F crossProduct(const F& a, const F& b)
{
	return shuffled<1, 2, 0, 3>(a) * shuffled<2, 0, 1, 3>(b) - shuffled<2, 0, 1, 3>(a) * shuffled<1, 2, 0, 3>(b);
}

template <class F> POLYTOPE_INLINE F sizes(const F& v)
{
	if constexpr (isHalves<F>) return { absolute(v.low), absolute(v.high) };
	else if constexpr (isPlain<F>) return { { absolute(v[0]), absolute(v[1]), absolute(v[2]), absolute(v[3]) } };
	else return absolute(v);
}

/// The sum of each of four.
template <class F, class R> POLYTOPE_INLINE void sumsOf(const F (&v)[4], R (&sums)[4])
{
	if constexpr (isHalves<F>)
		for (int k = 0; k < 4; k += 2) {
			const Halves4::Half a = v[k].low + v[k].high, b = v[k + 1].low + v[k + 1].high;
			store<R, 2>(sums + k, __builtin_shufflevector(a, b, 0, 2) + __builtin_shufflevector(a, b, 1, 3));
		}
	else if constexpr (isPlain<F>)
		for (int k = 0; k < 4; ++k)
			sums[k] = (v[k][0] + v[k][1]) + (v[k][2] + v[k][3]);
	else horizontalSums<R, 4>(v, sums);
}

template <class F> POLYTOPE_INLINE auto largestOf(const F& v)
{
	if constexpr (isHalves<F>) return horizontalMax<double, 2>(maxOf(v.low, v.high));
	else if constexpr (isPlain<F>) return maxOf(maxOf(v[0], v[2]), maxOf(v[1], v[3]));
	else return horizontalMax<double, 4>(v);
}

} // namespace polytope
