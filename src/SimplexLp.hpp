// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "PairPlanes.hpp"
#include "Tolerances.hpp"

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
/// is three cross products of differences of normals (exact for nearly parallel planes), as cheap as updating an inverse,
/// and nothing accumulates.
namespace polytope {

enum class LpStatus { Optimal, Separated, PivotLimit };

template <class R, int D> struct LpBasis {
	int plane[D + 1];       ///< rows of PairPlanes
	R   inverse[D + 1][D + 1]; ///< rows r_k of the inverse of the matrix with columns (a_k; 1)
	R   weight[D + 1];      ///< λ_k, sum 1
	R   point[D];           ///< x of the basis: its planes have equal violation
	R   infeasibility = 0;  ///< s of the basis, ≤ s*
};

/// Solves the basis of the planes (a_k, d_k), k = 0…D: inverse, weights, point, s. False if singular (normals that,
/// with the row of ones, are linearly dependent to rounding).
template <class R, int D> POLYTOPE_INLINE bool solveBasis(const R (&a)[D + 1][D], const R (&d)[D + 1], LpBasis<R, D>& basis)
{
	// (p; t) = Σ μ_k (a_k; 1)  ⇔  Σ_{k≥1} μ_k (a_k − a_0) = p − t a_0,  μ_0 = t − Σ_{k≥1} μ_k
	R e[D][D], c[D][D];
	for (int k = 0; k < D; ++k)
		for (int j = 0; j < D; ++j)
			e[k][j] = a[k + 1][j] - a[0][j];
	R det;
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
	// scale-free singularity test: det against the product of the lengths that enter it
	R scale = 0;
	for (int j = 0; j < D; ++j)
		scale += e[0][j] * e[0][j];
	R area = 0;
	for (int j = 0; j < D; ++j)
		area += c[0][j] * c[0][j];
	const R square = scale * area;
	if (!(det * det > R(tolerance::singularBasis) * R(tolerance::singularBasis) * square)) return false;
	const R reciprocal = 1 / det;
	for (int j = 0; j < D; ++j)
		basis.inverse[0][j] = 0;
	basis.inverse[0][D] = 1;
	for (int k = 0; k < D; ++k) {
		R last = 0;
		for (int j = 0; j < D; ++j) {
			const R r               = c[k][j] * reciprocal;
			basis.inverse[k + 1][j] = r;
			basis.inverse[0][j] -= r;
			last -= r * a[0][j];
		}
		basis.inverse[k + 1][D] = last;
		basis.inverse[0][D] -= last;
	}
	// z = (x; −s) solves (a_k; 1)·z = d_k. Taking the differences to plane 0 keeps s exact when the planes agree.
	for (int j = 0; j < D; ++j)
		basis.point[j] = 0;
	for (int k = 0; k < D; ++k)
		for (int j = 0; j < D; ++j)
			basis.point[j] += basis.inverse[k + 1][j] * (d[k + 1] - d[0]);
	R s = 0;
	for (int k = 0; k <= D; ++k) {
		basis.weight[k] = basis.inverse[k][D];
		s -= basis.weight[k] * d[k];
	}
	basis.infeasibility = s;
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
		if (!(basis.weight[k] >= -R(tolerance::weight))) return false;
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
/// may fall to −δ) the largest pivot, for stability; under Bland's rule the exact smallest ratio, ties by plane index.
template <class R, int D> POLYTOPE_INLINE int leavingRow(const LpBasis<R, D>& basis, const R (&w)[D + 1], bool bland)
{
	const R slackened = bland ? R(0) : R(tolerance::weight);
	R       limit     = R(padOffset);
	for (int k = 0; k <= D; ++k)
		if (w[k] > R(tolerance::pivot)) limit = minOf<R>(limit, (maxOf<R>(basis.weight[k], 0) + slackened) / w[k]);
	int leaving = -1;
	for (int k = 0; k <= D; ++k) {
		if (!(w[k] > R(tolerance::pivot)) || maxOf<R>(basis.weight[k], 0) > limit * w[k]) continue;
		if (leaving < 0 || (bland ? basis.plane[k] < basis.plane[leaving] : w[k] > w[leaving])) leaving = k;
	}
	return leaving;
}

/// First violated plane, for Bland's rule.
template <class R, int D> POLYTOPE_INLINE int firstViolated(const PairPlanes<R, D>& planes, R below)
{
	for (int i = 0; i < planes.total; ++i)
		if (planes.slack[i] < below) return i;
	return -1;
}

template <class R, int D> POLYTOPE_INLINE bool inBasis(const LpBasis<R, D>& basis, int plane)
{
	for (int k = 0; k <= D; ++k)
		if (basis.plane[k] == plane) return true;
	return false;
}

/// Simplex steps from a dual feasible, solved basis to the optimum, or until s > dismissAbove.
/// `violation`: how far (length) a plane may be violated at the optimum.
template <class R, int D, int W>
POLYTOPE_INLINE LpStatus solveLp(const PairPlanes<R, D>& planes, LpBasis<R, D>& basis, R violation, R dismissAbove, int pivotLimit, int& pivots)
{
	int  stalled = 0;
	bool bland   = false;
	for (;;) {
		if (basis.infeasibility > dismissAbove) return LpStatus::Separated;
		R         smallest;
		int       q     = mostViolated<R, D, W>(planes, basis.point, smallest);
		const R   bound = -basis.infeasibility - violation;
		if (!(smallest < bound)) return LpStatus::Optimal;
		if (pivots >= pivotLimit) return LpStatus::PivotLimit;
		if (bland) q = firstViolated<R, D>(planes, bound);
		// a basic plane can be "violated" only by the rounding of the basis' point: nothing left to gain
		if (inBasis<R, D>(basis, q)) return LpStatus::Optimal;

		R w[D + 1];
		for (int k = 0; k <= D; ++k) {
			w[k] = basis.inverse[k][D];
			for (int j = 0; j < D; ++j)
				w[k] += basis.inverse[k][j] * planes.normal[j][q];
		}
		const int leaving = leavingRow<R, D>(basis, w, bland);
		if (leaving < 0) return LpStatus::PivotLimit; // Σ w = 1, so only rounding can bring us here
		LpBasis<R, D> next = basis;
		next.plane[leaving] = q;
		++pivots;
		if (!solveBasis<R, D>(planes, next)) return LpStatus::PivotLimit;
		if (next.infeasibility > basis.infeasibility) stalled = 0;
		else if (++stalled > tolerance::stalledPivots)
			bland = true;
		if (stalled == 0) bland = false;
		basis = next;
	}
}

} // namespace polytope
