// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "numbers/Tolerances.hpp"
#include "program/PairPlanes.hpp"

/// Contact normal from weights of the linear program (Eq. 9) on which both bodies agree.
///
/// Weights λ_i of the linear program's dual have Σ λ_i a_i = 0 over the planes of both bodies, so
///
///     n = Σ over body 1 of λ_i a_i = −Σ over body 2 of λ_i a_i
///
/// is one direction for both: where an edge or a vertex lies on a face, the face's body has one plane there and n is its normal.
/// The weights of an optimal basis jump from one type of contact to the next. These do not: at an interior point x of the
/// overlap (the analytic centre) with slacks σ_i = d_i − a_i·x, they are the balanced weights nearest to w_i = σ_i⁻³,
///
///     min over λ of Σ (λ_i − w_i)² / w_i   subject to   Σ λ_i a_i = 0,      so  λ_i = w_i (1 + a_i·c),
///     M c = −Σ w_i a_i,      M = Σ w_i a_i a_iᵀ:
///
/// one pass over the planes and one linear system of D unknowns, positive definite since the normals span space. λ is a smooth
/// function of x, x one of the poses; the only length that enters is the overlap's own, so n does not change when everything is scaled.
///
/// Why the third power. As the power grows the weights tend to those of a basis. With the first, w_i = 1/σ_i, the analytic centre's
/// own conditions give c = 0; there a plane beside the contact, ℓ away from an overlap of thickness δ, would turn n by δ/ℓ. With
/// power p it does by (δ/2ℓ)^p. On the other hand two faces that are tilted by θ balance through planes beside them alone, of weights
/// ℓ^−p (where the overlap is a wedge, ℓ ≈ δ/θ): of 1 + a·c there is left about (δ/ℓ)^p/θ² ≥ (δ/ℓ)^(p−2). With the fourth power
/// rounding took all of it in overlaps of 1e-8 of a body's size; with the third a thousandth at 1e-13.
namespace polytope {

/// Of one body's planes, weights in units of (unit length)³.
template <class R, int D> struct WeightSums {
	R first[D];     ///< Σ w_i a_i
	R second[D][D]; ///< Σ w_i a_i a_iᵀ, lower triangle; its trace is Σ w_i
};

/// At x; leaves slacks in planes.slack. A slack of which rounding leaves no digit counts as one rounding, outside as inside. `unit`: the length in which slacks are measured, so that no power overflows.
template <class R, int D, int W>
POLYTOPE_INLINE void weightSums(const PairPlanes<R, D>& planes, int body, const R* x, R unit, WeightSums<R, D>& sums)
{
	using V             = typename Lanes<R, W>::Type;
	constexpr int count = D + D * (D + 1) / 2;
	V             X[D], sum[count];
	for (int k = 0; k < D; ++k)
		X[k] = broadcast<R, W>(x[k]);
	for (V& s : sum)
		s = broadcast<R, W>(0);
	const V least = broadcast<R, W>(R(tolerance::leastSlack) * unit);
	for (int i = planes.begin(body); i < planes.end(body); i += W) {
		V       a[D];
		const V slack = slacksOf<R, D, W>(planes, i, X, a);
		store<R, W>(planes.slack + i, slack);
		const V inverse = unit / maxOf(maxOf(slack, V(-slack)), least); // x may be outside by rounding
		const V weight  = inverse * inverse * inverse;
		for (int k = 0, next = D; k < D; ++k) {
			const V wa = weight * a[k];
			sum[k] += wa;
			for (int j = 0; j <= k; ++j, ++next)
				sum[next] += wa * a[j];
		}
	}
	R total[count];
	horizontalSums<R, W>(sum, total);
	for (int k = 0, next = D; k < D; ++k) {
		sums.first[k] = total[k];
		for (int j = 0; j <= k; ++j, ++next)
			sums.second[k][j] = total[next];
	}
}

/// c of M c = −Σ w_i a_i. LDLᵀ from the last axis (the contact normal, where M is large) to the first; a pivot that is all
/// rounding is raised to that value.
template <class R, int D> POLYTOPE_INLINE void balance(const WeightSums<R, D> (&sums)[2], R* c)
{
	R lower[D][D], pivot[D];
	for (int k = D - 1; k >= 0; --k) {
		const R whole = sums[0].second[k][k] + sums[1].second[k][k];
		R       rest  = whole;
		c[k]          = -(sums[0].first[k] + sums[1].first[k]);
		for (int j = D - 1; j > k; --j) {
			R sum = sums[0].second[j][k] + sums[1].second[j][k];
			for (int i = D - 1; i > j; --i)
				sum -= lower[k][i] * lower[j][i] * pivot[i];
			lower[k][j] = sum / pivot[j];
			rest -= lower[k][j] * sum;
			c[k] -= lower[k][j] * c[j];
		}
		pivot[k] = maxOf<R>(rest, R(tolerance::noise * tolerance::rounding) * whole);
	}
	for (int k = 0; k < D; ++k) {
		c[k] /= pivot[k];
		for (int j = 0; j < k; ++j)
			c[k] -= lower[j][k] * c[j];
	}
}

/// n at x (not of unit length), as the sum over the body whose weights are smaller (for a thin plate inside a block: the block), where
/// nothing cancels. Returns that body's Σ w_i, which n is to be compared with: where bodies share their centre n vanishes.
template <class R, int D, int W> POLYTOPE_INLINE R dualWeightsNormal(const PairPlanes<R, D>& planes, const R* x, R unit, R* n)
{
	WeightSums<R, D> sums[2];
	R                c[D], weight[2] = { 0, 0 };
	for (int body = 0; body < 2; ++body) {
		weightSums<R, D, W>(planes, body, x, unit, sums[body]);
		for (int k = 0; k < D; ++k)
			weight[body] += sums[body].second[k][k];
	}
	balance<R, D>(sums, c);
	const bool              second = weight[1] < weight[0];
	const WeightSums<R, D>& own    = sums[second];
	for (int k = 0; k < D; ++k) {
		n[k] = own.first[k];
		for (int j = 0; j < D; ++j)
			n[k] += (j <= k ? own.second[k][j] : own.second[j][k]) * c[j];
		if (second) n[k] = -n[k];
	}
	return weight[second];
}

} // namespace polytope
