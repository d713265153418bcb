// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "numbers/Four.hpp"
#include "program/LpBasis.hpp"
#include "program/PairPlanes.hpp"

#include <cmath>

/// Solves a basis: inverse, weights, point and s from its planes.
///
/// Departure from the usual revised simplex: the basis is solved afresh after each pivot. For unit normals and D = 3 that
/// is three cross products of differences of normals, as cheap as updating an inverse, and rounding does not accumulate. Bodies
/// have faces that are parallel but for 1e-9, and a basis of both is as ill-conditioned: then the differences are taken
/// between these, weights and point are corrected by their residuals, and what is left of rounding in each weight
/// (`noise`) is not mistaken for its sign. An uncertain λ_k does little harm: the other planes bound slack_k there.
namespace polytope {

/// Cofactors c of the matrix whose rows are e: c_k·e_k = det, which it returns, and c_k·e_j = 0 for j ≠ k.
template <class R, int D> POLYTOPE_INLINE R cofactors(const R (&e)[D][D], R (&c)[D][D])
{
	if constexpr (D == 3) {
		for (int k = 0; k < 3; ++k) {
			const R *u = e[(k + 1) % 3], *v = e[(k + 2) % 3];
			c[k][0] = u[1] * v[2] - u[2] * v[1];
			c[k][1] = u[2] * v[0] - u[0] * v[2];
			c[k][2] = u[0] * v[1] - u[1] * v[0];
		}
	} else {
		c[0][0] = e[1][1];
		c[0][1] = -e[1][0];
		c[1][0] = -e[0][1];
		c[1][1] = e[0][0];
	}
	return dot<R, D>(e[0], c[0]);
}

/// Inverse, noise, weights and point of the basis from D differences of normals: those of planes order[1] … order[D] to plane
/// order[0], or (`chained`) of the last one to the last but one. Returns the largest noise; infinite where the volume the
/// differences span is, over their lengths, no more than `leastVolume`.
///
///     (p; t) = Σ μ_k (a_k; 1)   ⇔   Σ ν_k e_k = p − t a_0,   ν_k: sum of μ over the planes that are reached through edge k
template <class R, int D>
POLYTOPE_INLINE R solveFromDifferences(
        const R (&a)[D + 1][D], const R (&d)[D + 1], const int (&order)[D + 1], bool chained, R leastVolume, LpBasis<R, D>& basis)
{
	R e[D][D], c[D][D], difference[D];
	for (int k = 0; k < D; ++k) {
		const int from = chained && k == D - 1 ? order[D - 1] : order[0];
		difference[k]  = d[order[k + 1]] - d[from];
		for (int j = 0; j < D; ++j)
			e[k][j] = a[order[k + 1]][j] - a[from][j];
	}
	const R det     = cofactors<R, D>(e, c);
	R       lengths = 1;
	for (int k = 0; k < D; ++k)
		lengths *= dot<R, D>(e[k], e[k]);
	if (!(det * det > leastVolume * leastVolume * lengths)) return R(padOffset);
	const R   reciprocal = 1 / det;
	const int root = order[0], before = order[D - 1];
	for (int j = 0; j < D; ++j) {
		basis.inverse[j][root] = 0;
		basis.point[j]         = 0;
	}
	basis.inverse[D][root] = 1;
	for (int k = 0; k < D; ++k) {
		const int own         = order[k + 1];
		basis.inverse[D][own] = 0;
		for (int j = 0; j < D; ++j) {
			const R component     = c[k][j] * reciprocal;
			basis.inverse[j][own] = component;
			basis.inverse[D][own] -= component * a[root][j];
			// z = (x; −s) solves (a_k; 1)·z = d_k. Differences keep s exact when the planes agree.
			basis.point[j] += component * difference[k];
		}
		const int upper = chained && k == D - 1 ? before : root;
		for (int j = 0; j <= D; ++j)
			basis.inverse[j][upper] -= basis.inverse[j][own];
	}
	R longest = 0;
	for (int k = 0; k <= D; ++k) {
		R length = 0;
		for (int j = 0; j <= D; ++j)
			length += absolute(basis.inverse[j][k]);
		basis.weight[k] = basis.inverse[D][k];
		basis.noise[k]  = R(tolerance::rounding) * length;
		longest         = maxOf<R>(longest, basis.noise[k]);
	}
	return longest;
}

/// Corrects weights and point by their residuals: Σ λ_k (a_k; 1) = (0; 1) and a_k·x − s = d_k to rounding, whatever the
/// inverse lost to cancellation. False if it lost so much that they remain.
template <class R, int D> POLYTOPE_INLINE bool refineBasis(const R (&a)[D + 1][D], const R (&d)[D + 1], LpBasis<R, D>& basis)
{
	R minusS = 0;
	for (int k = 0; k <= D; ++k)
		minusS += basis.weight[k] * d[k];
	for (int round = 0;; ++round) {
		R dual[D + 1], primal[D + 1];
		R size = 0, wrong = 0;
		for (int j = 0; j < D; ++j) {
			dual[j] = 0;
			for (int k = 0; k <= D; ++k)
				dual[j] -= basis.weight[k] * a[k][j];
			size = maxOf<R>(size, abs(basis.point[j]));
		}
		dual[D] = 1;
		for (int k = 0; k <= D; ++k) {
			dual[D] -= basis.weight[k];
			primal[k] = d[k] - dot<R, D>(a[k], basis.point) - minusS;
			size      = maxOf<R>(size, abs(d[k]));
			wrong     = maxOf<R>(wrong, abs(primal[k]));
		}
		for (int j = 0; j <= D; ++j)
			wrong = maxOf<R>(wrong, abs(dual[j]) * size);
		if (wrong <= R(tolerance::refined) * size) return true;
		if (round == tolerance::refinements) return wrong <= R(tolerance::refinedLast) * size;
		for (int k = 0; k <= D; ++k) {
			minusS += basis.inverse[D][k] * primal[k];
			for (int j = 0; j < D; ++j)
				basis.point[j] += basis.inverse[j][k] * primal[k];
			for (int j = 0; j <= D; ++j)
				basis.weight[k] += basis.inverse[j][k] * dual[j];
		}
	}
}

/// The order in which solveFromDifferences() takes planes some of which are nearly parallel: these are paired, for
/// differences that are small keep their digits if they are taken as such.
template <int D> struct DifferenceOrder {
	int  planes[D + 1] = { 0, 1 };
	bool chained       = false;
};

template <class R, int D> DifferenceOrder<D> differenceOrder(const R (&a)[D + 1][D])
{
	const auto apart = [&](int i, int j) {
		R sum = 0;
		for (int k = 0; k < D; ++k)
			sum += (a[i][k] - a[j][k]) * (a[i][k] - a[j][k]);
		return sum;
	};
	DifferenceOrder<D> result;
	int(&order)[D + 1] = result.planes;
	// the closest two first
	for (int i = 0; i <= D; ++i)
		for (int j = 0; j < i; ++j)
			if (apart(i, j) < apart(order[0], order[1])) {
				order[0] = i;
				order[1] = j;
			}
	for (int k = 2, i = 0; i <= D; ++i)
		if (i != order[0] && i != order[1]) order[k++] = i;
	if constexpr (D == 3) {
		if (apart(order[3], order[0]) < apart(order[2], order[0])) {
			const int nearer = order[3];
			order[3]         = order[2];
			order[2]         = nearer;
		}
		result.chained = apart(order[2], order[3]) < apart(order[0], order[3]);
	}
	return result;
}

/// Does what solveBasis() does, for a basis that has nearly parallel planes. Not inlined, since it is rare.
template <class R, int D>
__attribute__((noinline)) bool solveNearlyParallel(const R (&a)[D + 1][D], const R (&d)[D + 1], LpBasis<R, D>& basis)
{
	const DifferenceOrder<D> order = differenceOrder<R, D>(a);
	if (!(solveFromDifferences<R, D>(a, d, order.planes, order.chained, R(tolerance::noVolume), basis) < R(tolerance::singularBasis)))
		return false;
	return refineBasis<R, D>(a, d, basis);
}

/// solveFromDifferences() in 3-D with the planes in order, all rows at once: number k is row k's. a[j]: component j of the four
/// normals. Also s.
template <class R, class V> POLYTOPE_INLINE R solveRows(const V (&a)[3], const V& d, LpBasis<R, 3>& basis)
{
	V e[3], c[3], row[4]; // the first number, the root's, is zero until its row is the others' rest
	for (int j = 0; j < 3; ++j)
		e[j] = a[j] - repeated<V>(a[j][0]);
	const V difference = d - repeated<V>(d[0]);
	for (int j = 0; j < 3; ++j) {
		const V &u = e[(j + 1) % 3], &v = e[(j + 2) % 3];
		c[j] = shuffled<0, 2, 3, 1>(u) * shuffled<0, 3, 1, 2>(v) - shuffled<0, 2, 3, 1>(v) * shuffled<0, 3, 1, 2>(u);
	}
	const V volume = e[0] * c[0] + e[1] * c[1] + e[2] * c[2];
	const V length = e[0] * e[0] + e[1] * e[1] + e[2] * e[2];
	const R det    = volume[1];
	if (!(det * det > R(tolerance::smallVolume) * R(tolerance::smallVolume) * (length[1] * length[2] * length[3]))) return R(padOffset);
	const V reciprocal = repeated<V>(1 / det);
	row[3]             = repeated<V>(R(0));
	for (int j = 0; j < 3; ++j) {
		row[j] = c[j] * reciprocal;
		row[3] -= row[j] * repeated<V>(a[j][0]);
	}
	const V products[4] = { row[0] * difference, row[1] * difference, row[2] * difference, row[3] * difference };
	R       sums[4], rest[4];
	sumsOf(products, sums);
	sumsOf(row, rest);
	V longest = repeated<V>(R(0));
	for (int j = 0; j < 4; ++j) {
		row[j] += four<V>(R(j == 3) - rest[j], R(0), R(0), R(0));
		longest += sizes(row[j]);
		storeFour(basis.inverse[j], row[j]);
	}
	for (int j = 0; j < 3; ++j)
		basis.point[j] = sums[j];
	// from the weights, which sum to one
	basis.infeasibility = -(d[0] + sums[3]);
	longest *= repeated<V>(R(tolerance::rounding));
	storeFour(basis.weight, row[3]);
	storeFour(basis.noise, longest);
	return largestOf(longest);
}

/// s from the weights, not from z: their residual Σ λ a multiplies a point of the overlap, z's one multiplies x, which may be far.
template <class R, int D> POLYTOPE_INLINE void setValue(const R (&d)[D + 1], LpBasis<R, D>& basis)
{
	basis.infeasibility = 0;
	for (int k = 0; k <= D; ++k)
		basis.infeasibility -= basis.weight[k] * d[k];
}

/// Solves the basis of D + 1 planes, plane(k, a, d) being the k-th: inverse, weights, point, s. False if singular (normals
/// that, with the row of ones, are linearly dependent to rounding).
template <class R, int D, int W, class Plane> POLYTOPE_INLINE bool solveBasis(const Plane& plane, LpBasis<R, D>& basis)
{
	R a[D + 1][D], d[D + 1];
	for (int k = 0; k <= D; ++k)
		plane(k, a[k], d[k]);
	if constexpr (D == 3) {
		using V            = Four<R, W>;
		const V normals[3] = { four<V>(a[0][0], a[1][0], a[2][0], a[3][0]), four<V>(a[0][1], a[1][1], a[2][1], a[3][1]),
			four<V>(a[0][2], a[1][2], a[2][2], a[3][2]) };
		for (int j = 0; j < 3; ++j)
			storeFour(basis.normal[j], normals[j]);
		if (solveRows<R>(normals, four<V>(d[0], d[1], d[2], d[3]), basis) <= R(tolerance::refinedBasis)) return true;
		if (!solveNearlyParallel<R, D>(a, d, basis)) return false;
	} else {
		for (int k = 0; k <= D; ++k)
			for (int j = 0; j < D; ++j)
				basis.normal[j][k] = a[k][j];
		const int order[3] = { 0, 1, 2 };
		const R   noise    = solveFromDifferences<R, D>(a, d, order, false, R(tolerance::smallVolume), basis);
		if (!(noise <= R(tolerance::refinedBasis)) && !solveNearlyParallel<R, D>(a, d, basis)) return false;
	}
	setValue<R, D>(d, basis);
	return true;
}

template <class R, int D, int W> POLYTOPE_INLINE bool solveBasis(const PairPlanes<R, D>& planes, LpBasis<R, D>& basis)
{
	return solveBasis<R, D, W>([&](int k, R* a, R& d) POLYTOPE_INLINE_LAMBDA { planes.plane(basis.plane[k], a, d); }, basis);
}

/// refineBasis() for a basis of little noise, which solveBasis() leaves as it is. Also s. Not inlined, since it is rare.
template <class R, int D> __attribute__((noinline)) bool refineBasis(const PairPlanes<R, D>& planes, LpBasis<R, D>& basis)
{
	R a[D + 1][D], d[D + 1];
	for (int k = 0; k <= D; ++k)
		planes.plane(basis.plane[k], a[k], d[k]);
	if (!refineBasis<R, D>(a, d, basis)) return false;
	setValue<R, D>(d, basis);
	return true;
}

template <class R, int D> POLYTOPE_INLINE void readNormals(const PairPlanes<R, D>& planes, LpBasis<R, D>& basis)
{
	for (int k = 0; k <= D; ++k)
		for (int j = 0; j < D; ++j)
			basis.normal[j][k] = planes.normal[j][basis.plane[k]];
}

/// The solved basis in the planes' frame; `turn` and `origin` transform from the frame it was solved in.
/// Turned with it while its s is below `thin`; solved afresh where the overlap is so thin that rounding in the first frame
/// would matter.
template <class R, int D, int W>
POLYTOPE_INLINE bool moveBasis(const PairPlanes<R, D>& planes, const Rotation<R, D>& turn, const R* origin, R thin, LpBasis<R, D>& basis)
{
	if (!(basis.infeasibility < thin)) return solveBasis<R, D, W>(planes, basis);
	R moved[D];
	for (int j = 0; j < D; ++j)
		moved[j] = basis.point[j] - origin[j];
	rotate<R, D>(turn, moved, basis.point);
	readNormals<R, D>(planes, basis);
	basis.infeasibility = 0;
	for (int k = 0; k <= D; ++k) {
		R row[D], turned[D];
		for (int j = 0; j < D; ++j)
			row[j] = basis.inverse[j][k];
		rotate<R, D>(turn, row, turned);
		for (int j = 0; j < D; ++j)
			basis.inverse[j][k] = turned[j];
		basis.infeasibility -= basis.weight[k] * planes.offset[basis.plane[k]];
	}
	return true;
}

} // namespace polytope
