// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "contact/StartBasis.hpp"
#include "program/SimplexLp.hpp"

/// The linear program of a pair (SimplexLp.hpp) from its start basis, and the result that is reported.
namespace polytope {

/// Undecided where rounding leaves no optimum certain. `pivots`: steps to other bases than the start's.
template <class R, int D, int W>
POLYTOPE_INLINE LpStatus solvePhaseOne(
        StartBasis start, const PairPlanes<R, D>& planes, const ProgramLimits<R>& limits, R size, LpBasis<R, D>& basis, int& pivots)
{
	const int limit = maxOf<int>(tolerance::pivotsAtLeast, tolerance::pivotsPerPlane * planes.total);
	if (start != StartBasis::Unsolved && start != StartBasis::None) {
		const LpStatus lp = solveLp<R, D, W>(planes, basis, size, limits.dismissAbove, limits.reach, limit, pivots);
		if (lp != LpStatus::Undecided) return lp;
	}
	return solveWide<R, D>(planes, basis, size, limit, pivots) ? LpStatus::Optimal : LpStatus::Undecided;
}

/// The value reported for s* of a pair that a basis separates: a lower bound wherever s* is attained, rounding of the weights
/// included, above `least`.
template <class R, int D> POLYTOPE_INLINE R separatedBound(const LpBasis<R, D>& basis, R reach, const PlacedPair& in, R least)
{
	R noise = 0;
	for (int k = 0; k < D; ++k)
		reach += abs((*in.centre2)[k]);
	for (int k = 0; k <= D; ++k)
		noise += basis.noise[k];
	return maxOf<R>(lowerBound<R, D>(basis, reach) - noise * reach, least);
}

/// n_λ = Σ over body 1 of λ_k a_k in the planes' frame.
template <class R, int D> POLYTOPE_INLINE void dualDirection(const PairPlanes<R, D>& planes, const LpBasis<R, D>& basis, R* dual)
{
	R share[D + 1];
	for (int k = 0; k <= D; ++k)
		share[k] = basis.plane[k] < planes.first ? basis.weight[k] : R(0);
	for (int j = 0; j < D; ++j) {
		dual[j] = share[0] * basis.normal[j][0];
		for (int k = 1; k <= D; ++k)
			dual[j] += share[k] * basis.normal[j][k];
	}
}

/// The start basis alone separates the bodies.
template <class R, int D>
POLYTOPE_INLINE void publishSeparation(
        const PlacedPair& in, const ProgramLimits<R>& limits, const LpBasis<R, D>& basis, PairMemory& memory, ContactResult& out)
{
	out.status        = ContactStatus::Separated;
	out.infeasibility = separatedBound<R, D>(basis, limits.reach, in, -limits.tolerance);
	out.dismissed     = true;
	rememberWeights<D>(basis.weight, memory);
}

/// The result before the contact point is computed, with the dual direction, and the memory for the next step.
template <class R, int D> POLYTOPE_INLINE void publishProgram(const PairQuery<R, D>& q, LpStatus lp)
{
	const LpBasis<R, D>& basis = q.basis;
	rememberBasis<R, D>(q.planes, basis, q.memory, q.out);
	const bool separated = lp == LpStatus::Separated;
	q.out.infeasibility  = separated ? separatedBound<R, D>(basis, q.limits.reach, q.in, -q.limits.tolerance) : basis.infeasibility;
	q.out.status         = lp == LpStatus::Undecided ? ContactStatus::LpNotConverged : ContactStatus::Separated;
	dualDirection<R, D>(q.planes, basis, q.dual);
	q.out.dualDirection = worldDirection<R, D>(q.frame, q.dual);
}

} // namespace polytope
