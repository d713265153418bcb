// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "numbers/Lanes.hpp"
#include "numbers/Tolerances.hpp"

/// One basis of the phase-one linear program (see SimplexLp.hpp): D + 1 planes, their weights λ with Σ λ_k a_k = 0 and
/// Σ λ_k = 1, and the point x and value s with a_k·x − d_k = s.
namespace polytope {

template <class R, int D> struct LpBasis {
	int plane[D + 1];      ///< rows of PairPlanes
	R   normal[D][4];      ///< [j][k]: component j of a_k
	R   inverse[D + 1][4]; ///< [j][k]: component j of row k of the inverse of the matrix with columns (a_k; 1)
	R   weight[4];         ///< λ_k, sum 1
	R   noise[4];          ///< rounding in λ_k, and in component k of any column in this basis: rounding × length of row k
	R   point[D];          ///< x of the basis: its planes have equal violation
	R   infeasibility = 0; ///< s of the basis, ≤ s*
};

/// Analytic centre of the optimal basis' planes alone, a good initial guess of that of all planes: there λ_k slack_k is the same for all
/// k, and Σ λ_k slack_k = −s at any point. A plane of negligible weight does not bound the guess. `deep`: −s.
template <class R, int D> POLYTOPE_INLINE void simplexCentre(const LpBasis<R, D>& basis, R deep, const R* x, R* centre)
{
	for (int j = 0; j < D; ++j)
		centre[j] = x[j];
	for (int k = 0; k <= D; ++k) {
		const R share = maxOf<R>(basis.weight[k], R(tolerance::leastShare)) * (D + 1);
		const R back  = deep * (1 - 1 / share); // a_k·(centre − x)
		for (int j = 0; j < D; ++j)
			centre[j] += basis.inverse[j][k] * back;
	}
}

template <class R, int D> POLYTOPE_INLINE bool dualFeasible(const LpBasis<R, D>& basis)
{
	for (int k = 0; k <= D; ++k)
		if (!(basis.weight[k] >= -R(tolerance::weight) - R(tolerance::noise) * basis.noise[k])) return false;
	return true;
}

/// s of the basis less the largest error that negative weights (rounding) can cause: a lower bound of s*
/// for overlaps within `reach` of every plane.
template <class R, int D> POLYTOPE_INLINE R lowerBound(const LpBasis<R, D>& basis, R reach)
{
	R negative = 0;
	for (int k = 0; k <= D; ++k)
		negative -= minOf<R>(basis.weight[k], 0);
	return basis.infeasibility - negative * reach;
}

} // namespace polytope
