// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "program/SimplexLp.hpp"

#include <cmath>
#include <vector>

/// Largest ball (disc in 2-D) within one body's planes a_i·x ≤ d_i: the linear program of SimplexLp.hpp for one body,
/// min s : a_i·x − d_i ≤ s, whose −s is the radius and x the centre.
namespace polytope {

template <int D> class InscribedBall {
public:
	/// `arrays`: D component arrays of unit normals, then the offsets, each of `padded` numbers (see ConvexShape). The simplex starts
	/// from D + 1 artificial planes at a distance `reach` from the origin, which must hold the ball.
	InscribedBall(const Real* arrays, int padded, int count, const Real& reach)
	        : padded_(padded), reach_(reach), limit_(1000 + 100 * count),
	          rows_(std::size_t(D + 3) * std::size_t(padded + padWidth), Real(0))
	{
		const int total = padded + padWidth;
		for (int k = 0; k < D; ++k)
			planes_.normal[k] = rows_.data() + k * total;
		planes_.offset = rows_.data() + D * total;
		planes_.slack  = rows_.data() + (D + 1) * total;
		planes_.rate   = rows_.data() + (D + 2) * total;
		planes_.first  = padded;
		planes_.total  = total;
		for (int i = 0; i < total; ++i) {
			for (int k = 0; k < D; ++k)
				planes_.normal[k][i] = i < padded ? arrays[k * padded + i] : Real(0);
			planes_.offset[i] = i < padded ? arrays[D * padded + i] : Real(padOffset);
		}
		addArtificial();
	}
	InscribedBall(const InscribedBall&) = delete; // planes_ points into rows_

	/// Whether the optimum was found and holds no artificial plane.
	bool solve()
	{
		int pivots = 0;
		solveBasis<Real, D, 1>(planes_, basis_);
		if (solveLp<Real, D, 1>(planes_, basis_, reach_, Real(padOffset), reach_, limit_, pivots) != LpStatus::Optimal)
			return false;
		for (int k = 0; k <= D; ++k)
			if (basis_.plane[k] >= padded_) return false;
		return true;
	}

	/// Solves with twice the digits, where solve() has failed.
	bool solveWithMoreDigits()
	{
		int pivots    = 0;
		planes_.total = padded_; // solveWide() has artificial planes of its own
		return solveWide<Real, D>(planes_, basis_, reach_, limit_, pivots);
	}

	/// Solves the basis afresh, since refinement does not keep its inverse. False if it is singular or not dual feasible.
	bool solveAgain() { return solveBasis<Real, D, 1>(planes_, basis_) && dualFeasible<Real, D>(basis_); }

	const LpBasis<Real, D>& basis() const { return basis_; }

private:
	int                 padded_;
	Real                reach_;
	int                 limit_;
	std::vector<Real>   rows_;
	PairPlanes<Real, D> planes_;
	LpBasis<Real, D>    basis_;

	/// A regular simplex (tetrahedron, triangle): Σ a = 0, so λ = 1/(D+1) is feasible.
	void addArtificial()
	{
		const Real corner[4][3] = { { 1, 1, 1 }, { 1, -1, -1 }, { -1, 1, -1 }, { -1, -1, 1 } };
		const Real half = Real(1) / 2, root3 = sqrt(Real(3)) / 2;
		const Real fan[3][2] = { { 0, 1 }, { -root3, -half }, { root3, -half } };
		for (int c = 0; c <= D; ++c) {
			for (int k = 0; k < D; ++k)
				planes_.normal[k][padded_ + c] = D == 3 ? corner[c][k] / sqrt(Real(3)) : fan[c][k];
			planes_.offset[padded_ + c] = reach_;
			basis_.plane[c]             = padded_ + c;
		}
	}
};

/// Plane arrays as InscribedBall and the contact path read them: components of the normals, then offsets, padded with
/// neutral planes to whole lanes. Returns the padded number of planes.
inline int fillPlaneArrays(const std::vector<Vector3>& normals, const std::vector<Real>& offsets, int dimension, std::vector<Real>& arrays)
{
	const int count = int(normals.size()), padded = (count + padWidth - 1) / padWidth * padWidth;
	arrays.assign(std::size_t(dimension + 1) * std::size_t(padded), Real(0));
	for (int i = 0; i < padded; ++i) {
		for (int k = 0; k < dimension && i < count; ++k)
			arrays[std::size_t(k * padded + i)] = normals[std::size_t(i)][k];
		arrays[std::size_t(dimension * padded + i)] = i < count ? offsets[std::size_t(i)] : Real(padOffset);
	}
	return padded;
}

} // namespace polytope
