// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "program/WideLp.hpp"

#include <cmath>

/// Phase-one linear program (Boon et al. 2012, Eq. 9): over all planes of both bodies
///
///     s* = min s   subject to   a_i·x − d_i ≤ s,
///
/// solved on its dual, max −Σ λ_i d_i subject to Σ λ_i a_i = 0, Σ λ_i = 1, λ ≥ 0, which has D + 1 rows: one
/// (D+1)×(D+1) basis is enough for any number of planes. With unit normals −s* is the radius of the largest ball in
/// the overlap, x its centre. Every dual feasible basis bounds s* from below (weak duality), so a separated pair is
/// dismissed as soon as one basis says s > −tolerance, at best by the last step's basis alone, without evaluating the other
/// planes.
namespace polytope {

enum class LpStatus { Optimal, Separated, Undecided };

/// The most violated plane at the basis' point: largest a·x − d − s. Also leaves the slacks d − a·x in planes.slack.
template <class R, int D, int W> POLYTOPE_INLINE int mostViolated(const PairPlanes<R, D>& planes, const R* x, R& smallestSlack)
{
	using V = typename Lanes<R, W>::Type;
	V X[D];
	for (int k = 0; k < D; ++k)
		X[k] = broadcast<R, W>(x[k]);
	// the indices are carried along as numbers: finding the smallest afterwards costs a branch that is always mispredicted
	V best = broadcast<R, W>(R(padOffset)), where = broadcast<R, W>(0), index = firstIndices<R, W>();
	for (int i = 0; i < planes.total; i += W) {
		V slack = load<R, W>(planes.offset + i);
		for (int k = 0; k < D; ++k)
			slack -= load<R, W>(planes.normal[k] + i) * X[k];
		store<R, W>(planes.slack + i, slack);
		where = slack < best ? index : where;
		best  = minOf(best, slack);
		index += R(W);
	}
	smallestSlack = horizontalMin<R, W>(best);
	const V least = broadcast<R, W>(smallestSlack), none = broadcast<R, W>(R(planes.total));
	return int(horizontalMin<R, W>(V(best <= least ? where : none)));
}

/// The row that leaves for entering column w: the smallest λ_k/w_k over w_k > 0. Among near-ties (Harris' test: each λ
/// may fall by its noise) the one that leaves the best conditioned basis; under Bland's rule the smallest ratio, ties by
/// plane index.
template <class R, int D> POLYTOPE_INLINE int leavingRow(const LpBasis<R, D>& basis, const R (&w)[D + 1], bool bland)
{
	// conditional selections instead of branches, whose outcome is unpredictable
	R limit = R(padOffset);
	for (int k = 0; k <= D; ++k) {
		const R allowed = bland ? R(0) : R(tolerance::noise) * basis.noise[k];
		const R ratio   = (maxOf<R>(basis.weight[k], 0) + allowed) / w[k];
		limit           = w[k] > R(tolerance::noise) * basis.noise[k] ? minOf<R>(limit, ratio) : limit;
	}
	int leaving = -1;
	R   best    = 0;
	for (int k = 0; k <= D; ++k) {
		const bool may  = (w[k] > R(tolerance::noise) * basis.noise[k]) & (maxOf<R>(basis.weight[k], 0) <= limit * w[k]);
		const R    rank = bland ? R(-basis.plane[k]) : w[k] / basis.noise[k];
		const bool take = may & ((leaving < 0) | (rank > best));
		leaving         = take ? k : leaving;
		best            = take ? rank : best;
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

/// Column w of the entering plane q in the basis: Σ_k w_k (a_k; 1) = (a_q; 1).
template <class R, int D>
POLYTOPE_INLINE void enteringColumn(const PairPlanes<R, D>& planes, const LpBasis<R, D>& basis, int q, R (&w)[D + 1])
{
	for (int k = 0; k <= D; ++k) {
		w[k] = basis.inverse[D][k];
		for (int j = 0; j < D; ++j)
			w[k] += basis.inverse[j][k] * planes.normal[j][q];
	}
}

/// s = −Σ λ_k slack_k, from the slacks at the basis' own point: −Σ λ_k d_k is off by the weights' residual times a point of the overlap.
template <class R, int D> POLYTOPE_INLINE R infeasibilityAtPoint(const PairPlanes<R, D>& planes, const LpBasis<R, D>& basis)
{
	R s = 0;
	for (int k = 0; k <= D; ++k)
		s -= basis.weight[k] * planes.slack[basis.plane[k]];
	return s;
}

/// Dual simplex steps from a solved basis until no plane is violated or a bound exceeds dismissAbove. At the optimum the
/// basis certifies itself: the largest violation at its point bounds s* from above, lowerBound() from below. Undecided
/// where rounding leaves a gap between these two after the basis is refined, where a basis is singular to rounding, or at the pivot limit.
/// `size`: what the tolerances of lengths are relative to. `reach`: as lowerBound().
template <class R, int D, int W>
POLYTOPE_INLINE LpStatus solveLp(
        const PairPlanes<R, D>& planes, LpBasis<R, D>& basis, R size, R dismissAbove, R reach, int pivotLimit, int& pivots)
{
	int            stalled = 0;
	bool           bland   = false;
	bool           refined = false; // this basis
	LpBasis<R, D>  spare;
	LpBasis<R, D>* now  = &basis;
	LpBasis<R, D>* next = &spare;
	const auto     end  = [&](LpStatus status) {
                if (now != &basis) basis = *now;
                return status;
	};
	for (;;) {
		const R below = lowerBound<R, D>(*now, reach);
		if (below > dismissAbove) return end(LpStatus::Separated);
		R   smallest;
		int q = mostViolated<R, D, W>(planes, now->point, smallest);
		// the deviation of the basis' own planes from s is taken as the rounding of the others
		R rounding = R(tolerance::violation) * size;
		for (int k = 0; k <= D; ++k)
			rounding = maxOf<R>(rounding, 2 * abs(planes.slack[now->plane[k]] + now->infeasibility));
		const R bound = -now->infeasibility - rounding;
		if (!(smallest < bound)) {
			now->infeasibility = infeasibilityAtPoint<R, D>(planes, *now);
			if (-smallest - lowerBound<R, D>(*now, reach) <= R(tolerance::certain) * (size + reach / 2))
				return end(LpStatus::Optimal);
			if (refined || !refineBasis<R, D>(planes, *now)) return end(LpStatus::Undecided);
			refined = true;
			continue;
		}
		if (bland) q = firstViolated<R, D>(planes, bound);
		if (pivots >= pivotLimit || q < 0) return end(LpStatus::Undecided);

		R w[D + 1];
		enteringColumn<R, D>(planes, *now, q, w);
		const int leaving = leavingRow<R, D>(*now, w, bland);
		if (leaving < 0) return end(LpStatus::Undecided); // Σ w = 1, so only rounding can bring us here
		for (int k = 0; k <= D; ++k)
			next->plane[k] = now->plane[k];
		next->plane[leaving] = q;
		++pivots;
		refined = false;
		if (!solveBasis<R, D, W>(planes, *next)) {
			next->plane[leaving]                     = now->plane[leaving];
			next->plane[steadiestRow<R, D>(*now, w)] = q;
			if (!solveBasis<R, D, W>(planes, *next)) return end(LpStatus::Undecided);
		}
		stalled                  = next->infeasibility > now->infeasibility ? 0 : stalled + 1;
		bland                    = stalled > tolerance::stalledPivots;
		LpBasis<R, D>* const old = now;
		now                      = next;
		next                     = old;
	}
}

} // namespace polytope
