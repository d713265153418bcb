// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "program/BasisSolver.hpp"

#include <algorithm>

/// The linear program of SimplexLp.hpp where the digits of Real do not decide it: bases of planes that are parallel but for
/// the last digits have weights that are mostly rounding. The planes as they stand are taken for exact numbers and the
/// simplex is run on them with twice the digits; differences of nearly parallel normals are exact in it. Much
/// slower, and rare.
namespace polytope {

/// A wider arithmetic, the widest available, and its rounding.
template <class R> struct Wider {
	using Type                       = R;
	static constexpr double rounding = tolerance::rounding;
};
#ifdef __SIZEOF_FLOAT128__
template <> struct Wider<double> {
	using Type                       = __float128;
	static constexpr double rounding = tolerance::powerOfTwo(-112);
};
template <> struct Wider<long double> : Wider<double> { };
#else
template <> struct Wider<double> {
	using Type                       = long double;
	static constexpr double rounding = std::numeric_limits<long double>::epsilon();
};
#endif

/// The simplex in `Q`. Starts from far planes, a simplex by themselves, numbered from planes.total on: their basis is dual
/// feasible and well conditioned.
template <class R, int D> class WideLp {
public:
	using Q = typename Wider<R>::Type;

	/// Volume of differences of normals, over their lengths, that is rounding.
	static constexpr double noVolume = std::max(tolerance::wideVolume, 4 * Wider<R>::rounding);
	/// × size: by how much a plane may be violated at the optimum.
	static constexpr double violation = std::max(tolerance::wideRest * tolerance::rounding, 8 * Wider<R>::rounding);

	WideLp(const PairPlanes<R, D>& planes, R size) : planes_(planes), size_(size)
	{
		R largest = size;
		for (int i = 0; i < planes.total; ++i)
			if (abs(planes.offset[i]) < R(padOffset) / 2) largest = maxOf<R>(largest, abs(planes.offset[i]));
		far_ = Q(largest) * 64;
	}

	/// False if it does not reach the optimum: never seen.
	bool solve(int pivotLimit, int& pivots)
	{
		for (int k = 0; k <= D; ++k)
			basis_.plane[k] = planes_.total + k;
		if (!solveBasis(basis_)) return false;
		int stalled = 0;
		for (int steps = 0; steps < pivotLimit; ++steps) {
			const bool bland    = stalled > tolerance::stalledPivots;
			const int  entering = violated(bland);
			if (entering < 0) return complete();
			++pivots;
			if (!exchange(entering, bland, stalled)) return false;
		}
		return false;
	}

	void copyTo(LpBasis<R, D>& out) const
	{
		for (int k = 0; k <= D; ++k) {
			out.plane[k]  = basis_.plane[k];
			out.weight[k] = R(basis_.weight[k]);
			out.noise[k]  = R(basis_.noise[k]);
			for (int j = 0; j <= D; ++j)
				out.inverse[j][k] = R(basis_.inverse[j][k]);
		}
		for (int j = 0; j < D; ++j)
			out.point[j] = R(basis_.point[j]);
		out.infeasibility = R(basis_.infeasibility);
		readNormals<R, D>(planes_, out);
	}

private:
	const PairPlanes<R, D>& planes_;
	R                       size_;
	Q                       far_;
	LpBasis<Q, D>           basis_;

	void plane(int i, Q* a, Q& d) const
	{
		if (i < planes_.total) {
			for (int k = 0; k < D; ++k)
				a[k] = Q(planes_.normal[k][i]);
			d = Q(planes_.offset[i]);
			return;
		}
		// sums of the normals are zero; that they are not unit does not matter
		const int corner[4][3] = { { 1, 1, 1 }, { 1, -1, -1 }, { -1, 1, -1 }, { -1, -1, 1 } };
		const int fan[3][2]    = { { 1, 0 }, { 0, 1 }, { -1, -1 } };
		for (int k = 0; k < D; ++k)
			a[k] = D == 3 ? corner[i - planes_.total][k] : fan[i - planes_.total][k % 2];
		d = far_;
	}

	bool solveBasis(LpBasis<Q, D>& basis) const
	{
		Q a[D + 1][D], d[D + 1];
		for (int k = 0; k <= D; ++k)
			plane(basis.plane[k], a[k], d[k]);
		const DifferenceOrder<D> order = differenceOrder<Q, D>(a);
		// the volume of differences has their own digits, and twice as many are available
		const Q noise = solveFromDifferences<Q, D>(a, d, order.planes, order.chained, Q(noVolume), basis);
		if (!(noise < Q(padOffset))) return false;
		basis.infeasibility = 0;
		for (int k = 0; k <= D; ++k)
			basis.infeasibility -= basis.weight[k] * d[k];
		return true;
	}

	/// The plane most violated (Bland's rule: the first one), −1 if there is none.
	int violated(bool bland) const
	{
		int worst = -1;
		Q   most  = -Q(violation) * Q(size_);
		for (int i = 0; i < planes_.total; ++i) {
			if (planes_.offset[i] >= R(padOffset) / 2 || basic(i)) continue;
			Q a[D], slack;
			plane(i, a, slack);
			slack += basis_.infeasibility;
			for (int k = 0; k < D; ++k)
				slack -= a[k] * basis_.point[k];
			if (!(slack < most)) continue;
			worst = i;
			most  = slack;
			if (bland) break;
		}
		return worst;
	}

	bool basic(int i) const
	{
		for (int k = 0; k <= D; ++k)
			if (basis_.plane[k] == i) return true;
		return false;
	}

	/// Smallest ratio λ_k/w_k; where that leaves a singular basis, the next one.
	bool exchange(int entering, bool bland, int& stalled)
	{
		Q a[D], d, w[D + 1], least = 0;
		plane(entering, a, d);
		for (int k = 0; k <= D; ++k) {
			w[k] = basis_.inverse[D][k];
			for (int j = 0; j < D; ++j)
				w[k] += basis_.inverse[j][k] * a[j];
		}
		bool tried[D + 1] = {};
		for (int attempt = 0; attempt <= D; ++attempt) {
			int leaving = -1;
			for (int k = 0; k <= D; ++k) {
				if (tried[k] || !(w[k] > 0)) continue;
				const Q    ratio = maxOf<Q>(basis_.weight[k], Q(0)) / w[k];
				const bool tie   = leaving >= 0 && ratio == least;
				if (leaving < 0 || ratio < least
				        || (tie && (bland ? basis_.plane[k] < basis_.plane[leaving] : w[k] > w[leaving]))) {
					leaving = k;
					least   = ratio;
				}
			}
			if (leaving < 0) return false;
			tried[leaving]      = true;
			LpBasis<Q, D> next  = basis_;
			next.plane[leaving] = entering;
			if (!solveBasis(next)) continue;
			stalled = next.infeasibility > basis_.infeasibility ? 0 : stalled + 1;
			basis_  = next;
			return true;
		}
		return false;
	}

	/// Whether the optimal basis has no far plane; one of weight zero is exchanged for any other plane that fits.
	bool complete()
	{
		for (int k = 0; k <= D; ++k) {
			if (basis_.plane[k] < planes_.total) continue;
			if (basis_.weight[k] > Q(tolerance::rounding)) return false;
			bool exchanged = false;
			for (int i = 0; i < planes_.total && !exchanged; ++i) {
				if (planes_.offset[i] >= R(padOffset) / 2 || basic(i)) continue;
				LpBasis<Q, D> next = basis_;
				next.plane[k]      = i;
				exchanged          = solveBasis(next);
				for (int j = 0; j <= D; ++j)
					exchanged = exchanged && next.weight[j] > -Q(tolerance::weight);
				if (exchanged) basis_ = next;
			}
			if (!exchanged) return false;
		}
		return true;
	}
};

/// Finds the optimum as solveLp() does.
template <class R, int D>
__attribute__((noinline)) bool solveWide(const PairPlanes<R, D>& planes, LpBasis<R, D>& basis, R size, int pivotLimit, int& pivots)
{
	WideLp<R, D> wide(planes, size);
	if (!wide.solve(pivotLimit, pivots)) return false;
	wide.copyTo(basis);
	return true;
}

} // namespace polytope
