// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "PairPlanes.hpp"
#include "Tolerances.hpp"

#include <cmath>

/// Phase-one linear programme (Boon et al. 2012, Eq. 9): over all planes of both bodies
///
///     s* = min s   subject to   a_i·x − d_i ≤ s,
///
/// solved on its dual, max −Σ λ_i d_i subject to Σ λ_i a_i = 0, Σ λ_i = 1, λ ≥ 0, which has D + 1 rows: one
/// (D+1)×(D+1) basis serves however many planes there are. With unit normals −s* is the radius of the largest ball in
/// the overlap, x its centre. Every dual feasible basis bounds s* from below (weak duality), so a separated pair is
/// dismissed as soon as one basis says s > −tolerance, at best by last step's basis alone, without looking at the other
/// planes.
///
/// Departure from the usual revised simplex: the basis is solved afresh after each pivot. For unit normals and D = 3 that
/// is three cross products of differences of normals, as cheap as updating an inverse, and nothing accumulates. Bodies
/// have faces that are parallel but for 1e-9, and a basis of both is as ill-conditioned: then the differences are taken
/// between these, weights and point are corrected by their residuals, and what is left of rounding in each weight
/// (`noise`) is not mistaken for its sign. It does little harm: where λ_k is so uncertain, the other planes bound slack_k.
namespace polytope {

enum class LpStatus { Optimal, Separated, PivotLimit };

template <class R, int D> struct LpBasis {
	int plane[D + 1];       ///< rows of PairPlanes
	R   inverse[D + 1][D + 1]; ///< rows r_k of the inverse of the matrix with columns (a_k; 1)
	R   weight[D + 1];      ///< λ_k, sum 1
	R   noise[D + 1];       ///< rounding in λ_k, and in component k of any column in this basis: rounding × length of row k
	R   point[D];           ///< x of the basis: its planes have equal violation
	R   infeasibility = 0;  ///< s of the basis, ≤ s*
};

/// Inverse, noise, weights and point of the basis from D differences of normals: of planes order[1] … order[D] to plane
/// order[0], or (`chained`) of the last one to the last but one. Returns the largest noise; infinite if singular.
///
///     (p; t) = Σ μ_k (a_k; 1)   ⇔   Σ ν_k e_k = p − t a_0,   ν_k: sum of μ over the planes that hang on edge k
template <class R, int D>
POLYTOPE_INLINE R
solveFromDifferences(const R (&a)[D + 1][D], const R (&d)[D + 1], const int (&order)[D + 1], bool chained, R leastVolume, LpBasis<R, D>& basis)
{
	R e[D][D], c[D][D], difference[D], det;
	for (int k = 0; k < D; ++k) {
		const int from = chained && k == D - 1 ? order[D - 1] : order[0];
		difference[k]  = d[order[k + 1]] - d[from];
		for (int j = 0; j < D; ++j)
			e[k][j] = a[order[k + 1]][j] - a[from][j];
	}
	if constexpr (D == 3) {
		for (int k = 0; k < 3; ++k) {
			const R *u = e[(k + 1) % 3], *v = e[(k + 2) % 3];
			c[k][0] = u[1] * v[2] - u[2] * v[1];
			c[k][1] = u[2] * v[0] - u[0] * v[2];
			c[k][2] = u[0] * v[1] - u[1] * v[0];
		}
		det = dot<R, 3>(e[0], c[0]);
	} else {
		c[0][0] = e[1][1];
		c[0][1] = -e[1][0];
		c[1][0] = -e[0][1];
		c[1][1] = e[0][0];
		det     = dot<R, 2>(e[0], c[0]);
	}
	R lengths = 1;
	for (int k = 0; k < D; ++k)
		lengths *= dot<R, D>(e[k], e[k]);
	if (!(det * det > leastVolume * leastVolume * lengths)) return R(padOffset);
	const R reciprocal = 1 / det;
	R *     root = basis.inverse[order[0]], *before = basis.inverse[order[D - 1]];
	for (int j = 0; j < D; ++j) {
		root[j]        = 0;
		basis.point[j] = 0;
	}
	root[D] = 1;
	for (int k = 0; k < D; ++k) {
		R* row = basis.inverse[order[k + 1]];
		row[D] = 0;
		for (int j = 0; j < D; ++j) {
			row[j] = c[k][j] * reciprocal;
			row[D] -= row[j] * a[order[0]][j];
			// z = (x; −s) solves (a_k; 1)·z = d_k. Differences keep s exact when the planes agree.
			basis.point[j] += row[j] * difference[k];
		}
		R* upper = chained && k == D - 1 ? before : root;
		for (int j = 0; j <= D; ++j)
			upper[j] -= row[j];
	}
	R longest = 0;
	for (int k = 0; k <= D; ++k) {
		R length = 0;
		for (int j = 0; j <= D; ++j)
			length += std::abs(basis.inverse[k][j]);
		basis.weight[k] = basis.inverse[k][D];
		basis.noise[k]  = R(tolerance::rounding) * length;
		longest         = maxOf<R>(longest, basis.noise[k]);
	}
	return longest;
}

/// Corrects weights and point by their residuals: Σ λ_k (a_k; 1) = (0; 1) and a_k·x − s = d_k to rounding, whatever the
/// inverse lost to cancellation.
template <class R, int D> POLYTOPE_INLINE void refineBasis(const R (&a)[D + 1][D], const R (&d)[D + 1], LpBasis<R, D>& basis)
{
	R minusS = 0;
	for (int k = 0; k <= D; ++k)
		minusS += basis.weight[k] * d[k];
	for (int round = 0; round < tolerance::refinements; ++round) {
		R dual[D + 1], primal[D + 1];
		R size = 0, wrong = 0;
		for (int j = 0; j < D; ++j) {
			dual[j] = 0;
			for (int k = 0; k <= D; ++k)
				dual[j] -= basis.weight[k] * a[k][j];
			size = maxOf<R>(size, std::abs(basis.point[j]));
		}
		dual[D] = 1;
		for (int k = 0; k <= D; ++k) {
			dual[D] -= basis.weight[k];
			primal[k] = d[k] - dot<R, D>(a[k], basis.point) - minusS;
			size      = maxOf<R>(size, std::abs(d[k]));
			wrong     = maxOf<R>(wrong, std::abs(primal[k]));
		}
		for (int j = 0; j <= D; ++j)
			wrong = maxOf<R>(wrong, std::abs(dual[j]) * size);
		if (wrong <= R(tolerance::refined) * size) break;
		for (int k = 0; k <= D; ++k) {
			minusS += basis.inverse[k][D] * primal[k];
			for (int j = 0; j < D; ++j)
				basis.point[j] += basis.inverse[k][j] * primal[k];
			for (int j = 0; j <= D; ++j)
				basis.weight[k] += basis.inverse[k][j] * dual[j];
		}
	}
}

/// As solveBasis(), for a basis that has nearly parallel planes: these are paired, for differences that are small keep
/// their digits if they are taken as such. Out of line, for it is rare.
template <class R, int D>
__attribute__((noinline)) bool solveNearlyParallel(const R (&a)[D + 1][D], const R (&d)[D + 1], LpBasis<R, D>& basis)
{
	const auto apart = [&](int i, int j) {
		R sum = 0;
		for (int k = 0; k < D; ++k)
			sum += (a[i][k] - a[j][k]) * (a[i][k] - a[j][k]);
		return sum;
	};
	// the closest two first
	int order[D + 1] = { 0, 1 };
	for (int i = 0; i <= D; ++i)
		for (int j = 0; j < i; ++j)
			if (apart(i, j) < apart(order[0], order[1])) {
				order[0] = i;
				order[1] = j;
			}
	for (int k = 2, i = 0; i <= D; ++i)
		if (i != order[0] && i != order[1]) order[k++] = i;
	bool chained = false;
	if constexpr (D == 3) {
		if (apart(order[3], order[0]) < apart(order[2], order[0])) {
			const int nearer = order[3];
			order[3]         = order[2];
			order[2]         = nearer;
		}
		chained = apart(order[2], order[3]) < apart(order[0], order[3]);
	}
	if (!(solveFromDifferences<R, D>(a, d, order, chained, R(tolerance::noVolume), basis) < R(tolerance::singularBasis))) return false;
	refineBasis<R, D>(a, d, basis);
	return true;
}

/// Solves the basis of the planes (a_k, d_k), k = 0…D: inverse, weights, point, s. False if singular (normals that,
/// with the row of ones, are linearly dependent to rounding).
template <class R, int D> POLYTOPE_INLINE bool solveBasis(const R (&a)[D + 1][D], const R (&d)[D + 1], LpBasis<R, D>& basis)
{
	int order[D + 1];
	for (int k = 0; k <= D; ++k)
		order[k] = k;
	const R noise = solveFromDifferences<R, D>(a, d, order, false, R(tolerance::smallVolume), basis);
	if (!(noise <= R(tolerance::refinedBasis)) && !solveNearlyParallel<R, D>(a, d, basis)) return false;
	// from the weights, not from z: their residual Σ λ a multiplies a point of the overlap, z's one multiplies x, which may be far
	basis.infeasibility = 0;
	for (int k = 0; k <= D; ++k)
		basis.infeasibility -= basis.weight[k] * d[k];
	return true;
}

template <class R, int D> POLYTOPE_INLINE bool solveBasis(const PairPlanes<R, D>& planes, LpBasis<R, D>& basis)
{
	R a[D + 1][D], d[D + 1];
	for (int k = 0; k <= D; ++k)
		planes.plane(basis.plane[k], a[k], d[k]);
	return solveBasis<R, D>(a, d, basis);
}

template <class R, int D> POLYTOPE_INLINE bool dualFeasible(const LpBasis<R, D>& basis)
{
	for (int k = 0; k <= D; ++k)
		if (!(basis.weight[k] >= -R(tolerance::weight) - R(tolerance::noise) * basis.noise[k])) return false;
	return true;
}

/// The most violated plane at the basis' point: largest a·x − d − s. Also leaves the slacks d − a·x in planes.slack.
template <class R, int D, int W> POLYTOPE_INLINE int mostViolated(const PairPlanes<R, D>& planes, const R* x, R& smallestSlack)
{
	using V = typename Lanes<R, W>::Type;
	V X[D];
	for (int k = 0; k < D; ++k)
		X[k] = broadcast<R, W>(x[k]);
	V best = broadcast<R, W>(R(padOffset));
	for (int i = 0; i < planes.total; i += W) {
		V slack = load<R, W>(planes.offset + i);
		for (int k = 0; k < D; ++k)
			slack -= load<R, W>(planes.normal[k] + i) * X[k];
		store<R, W>(planes.slack + i, slack);
		best = minOf(best, slack);
	}
	smallestSlack = horizontalMin<R, W>(best);
	int q         = 0;
	while (q < planes.total && !(planes.slack[q] <= smallestSlack))
		++q;
	return q;
}

/// The row that leaves for entering column w: the smallest λ_k/w_k over w_k > 0. Among near-ties (Harris' test: each λ
/// may fall by its noise) the one that leaves the best conditioned basis; under Bland's rule the smallest ratio, ties by
/// plane index.
template <class R, int D> POLYTOPE_INLINE int leavingRow(const LpBasis<R, D>& basis, const R (&w)[D + 1], bool bland)
{
	R limit = R(padOffset);
	for (int k = 0; k <= D; ++k)
		if (w[k] > R(tolerance::noise) * basis.noise[k])
			limit = minOf<R>(limit, (maxOf<R>(basis.weight[k], 0) + (bland ? R(0) : R(tolerance::noise) * basis.noise[k])) / w[k]);
	int leaving = -1;
	for (int k = 0; k <= D; ++k) {
		if (!(w[k] > R(tolerance::noise) * basis.noise[k]) || maxOf<R>(basis.weight[k], 0) > limit * w[k]) continue;
		if (leaving < 0 || (bland ? basis.plane[k] < basis.plane[leaving] : w[k] * basis.noise[leaving] > w[leaving] * basis.noise[k])) leaving = k;
	}
	return leaving;
}

/// The row whose replacement leaves the best conditioned basis, whatever the weights.
template <class R, int D> POLYTOPE_INLINE int steadiestRow(const LpBasis<R, D>& basis, const R (&w)[D + 1])
{
	int best = 0;
	for (int k = 1; k <= D; ++k)
		if (w[k] * basis.noise[best] > w[best] * basis.noise[k]) best = k;
	return best;
}

/// First violated plane, for Bland's rule.
template <class R, int D> POLYTOPE_INLINE int firstViolated(const PairPlanes<R, D>& planes, R below)
{
	for (int i = 0; i < planes.total; ++i)
		if (planes.slack[i] < below) return i;
	return -1;
}

/// s of the basis less what weights below zero may pretend: a lower bound of s* for overlaps within `reach` of every plane.
template <class R, int D> POLYTOPE_INLINE R lowerBound(const LpBasis<R, D>& basis, R reach)
{
	R negative = 0;
	for (int k = 0; k <= D; ++k)
		negative -= minOf<R>(basis.weight[k], 0);
	return basis.infeasibility - negative * reach;
}

/// One step of the primal simplex, for a basis that violates no plane but has a weight below zero beyond its noise (a
/// weight that was noise while a nearly parallel plane was in the basis may turn out to be none when that has left):
/// leaves that plane along the edge of the others, where s falls, to the first plane met. Slacks as mostViolated() left
/// them. False if there is no such weight (the basis is optimal); `entering` < 0 if no plane is met.
template <class R, int D> POLYTOPE_INLINE bool primalStep(const PairPlanes<R, D>& planes, const LpBasis<R, D>& basis, int& leaving, int& entering)
{
	leaving = -1;
	for (int k = 0; k <= D; ++k)
		if (basis.weight[k] < -R(tolerance::noise) * basis.noise[k] && (leaving < 0 || basis.weight[k] < basis.weight[leaving])) leaving = k;
	if (leaving < 0) return false;
	const R* row   = basis.inverse[leaving];
	R        limit = R(padOffset);
	entering       = -1;
	for (int i = 0; i < planes.total; ++i) {
		R rate = row[D];
		for (int j = 0; j < D; ++j)
			rate += row[j] * planes.normal[j][i];
		// basic, not met, or a twin of a basic plane
		bool basic = false;
		for (int k = 0; k <= D; ++k)
			basic = basic || basis.plane[k] == i;
		if (basic || !(-rate * R(tolerance::singularBasis) > basis.noise[leaving]) || planes.offset[i] >= R(padOffset) / 2) continue;
		const R distance = maxOf<R>(planes.slack[i] + basis.infeasibility, 0) / -rate;
		if (distance < limit) {
			limit    = distance;
			entering = i;
		}
	}
	return true;
}

/// Dual simplex steps from a solved basis until no plane is violated or a bound exceeds dismissAbove, then primal ones
/// where a weight is below zero.
/// `size`: what the tolerances of lengths are relative to. `reach`: as lowerBound().
template <class R, int D, int W>
POLYTOPE_INLINE LpStatus
solveLp(const PairPlanes<R, D>& planes, LpBasis<R, D>& basis, R size, R dismissAbove, R reach, int pivotLimit, int& pivots)
{
	int  stalled = 0;
	bool bland   = false;
	for (;;) {
		if (lowerBound<R, D>(basis, reach) > dismissAbove) return LpStatus::Separated;
		R   smallest;
		int q = mostViolated<R, D, W>(planes, basis.point, smallest);
		// by how much the basis' own planes miss s is what rounding makes of the others
		R rounding = R(tolerance::violation) * size;
		for (int k = 0; k <= D; ++k)
			rounding = maxOf<R>(rounding, 2 * std::abs(planes.slack[basis.plane[k]] + basis.infeasibility));
		const R    bound = -basis.infeasibility - rounding;
		const bool met   = !(smallest < bound);
		if (!met && bland) q = firstViolated<R, D>(planes, bound);
		int leaving = -1;
		if (met && !primalStep<R, D>(planes, basis, leaving, q)) return LpStatus::Optimal;
		if (pivots >= pivotLimit || q < 0) return LpStatus::PivotLimit;

		R w[D + 1];
		for (int k = 0; k <= D && !met; ++k) {
			w[k] = basis.inverse[k][D];
			for (int j = 0; j < D; ++j)
				w[k] += basis.inverse[k][j] * planes.normal[j][q];
		}
		if (!met) leaving = leavingRow<R, D>(basis, w, bland);
		if (leaving < 0) return LpStatus::PivotLimit; // Σ w = 1, so only rounding can bring us here
		LpBasis<R, D> next  = basis;
		next.plane[leaving] = q;
		++pivots;
		if (!solveBasis<R, D>(planes, next)) {
			if (met) return LpStatus::PivotLimit;
			if (-planes.slack[q] - basis.infeasibility <= R(tolerance::twinViolation) * size) return LpStatus::Optimal;
			next                                     = basis;
			next.plane[steadiestRow<R, D>(basis, w)] = q;
			if (!solveBasis<R, D>(planes, next)) return LpStatus::PivotLimit;
		}
		if (!met) {
			stalled = next.infeasibility > basis.infeasibility ? 0 : stalled + 1;
			bland   = stalled > tolerance::stalledPivots;
		}
		basis = next;
	}
}

} // namespace polytope
