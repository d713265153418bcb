// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "PairSamples.hpp"

#include <boost/multiprecision/gmp.hpp>

#include <array>
#include <stdexcept>
#include <vector>

/// Phase-one LP of a pair (see SimplexLp.hpp) in exact rational arithmetic: the input's doubles are taken as exact numbers.
/// Simplex with Bland's rule from four artificial planes far outside; the optimum is proved by its certificate, so
/// the path to it does not matter.
namespace polytope::samples {

using Rational = boost::multiprecision::mpq_rational;

template <int D> class ExactLp {
public:
	Rational                    infeasibility; ///< s*
	std::array<Rational, D>     point;         ///< of the optimal basis
	std::array<Rational, D + 1> weight;        ///< λ
	std::array<int, D + 1>      basis;

	explicit ExactLp(const Pair& pair)
	{
		for (int body = 0; body < 2; ++body) {
			const HalfSpaces& set = pair.shape[body]->planes();
			for (std::size_t i = 0; i < set.size(); ++i) {
				Plane plane;
				plane.offset = Rational(set.offsets[i]);
				for (int k = 0; k < D; ++k) {
					plane.normal[k] = 0;
					for (int j = 0; j < D; ++j)
						plane.normal[k] += Rational(pair.rotation[body](k, j)) * Rational(set.normals[i][j]);
					if (body == 1) plane.offset += plane.normal[k] * Rational(pair.centre2[k]);
				}
				planes_.push_back(plane);
			}
		}
		const int corner[4][3] = { { 1, 1, 1 }, { 1, -1, -1 }, { -1, 1, -1 }, { -1, -1, 1 } };
		const int fan[3][2]    = { { 1, 0 }, { 0, 1 }, { -1, -1 } };
		for (int k = 0; k <= D; ++k) {
			Plane plane;
			for (int j = 0; j < D; ++j)
				plane.normal[j] = D == 3 ? corner[k][j] : fan[k][j % 2];
			plane.offset = Rational(1e9 * double(pair.reach()));
			basis[k]     = int(planes_.size());
			planes_.push_back(plane);
		}
		solve();
		proveOptimal();
	}

private:
	struct Plane {
		std::array<Rational, D> normal;
		Rational                offset;
	};
	std::vector<Plane> planes_;

	using Column = std::array<Rational, D + 1>;

	Column columnOf(int plane) const
	{
		Column c;
		for (int k = 0; k < D; ++k)
			c[k] = planes_[plane].normal[k];
		c[D] = 1;
		return c;
	}

	/// Solves M y = right, M's columns being the basis' (a; 1), or Mᵀ y = right.
	Column linearSolve(Column right, bool transposed) const
	{
		std::array<Column, D + 1> m;
		for (int j = 0; j <= D; ++j) {
			const Column c = columnOf(basis[j]);
			for (int i = 0; i <= D; ++i)
				(transposed ? m[j][i] : m[i][j]) = c[i];
		}
		for (int k = 0; k <= D; ++k) {
			int pivot = k;
			while (pivot <= D && m[pivot][k] == 0)
				++pivot;
			if (pivot > D) throw std::logic_error("ExactLp: singular basis");
			std::swap(m[k], m[pivot]);
			std::swap(right[k], right[pivot]);
			for (int i = 0; i <= D; ++i) {
				if (i == k || m[i][k] == 0) continue;
				const Rational factor = m[i][k] / m[k][k];
				for (int j = k; j <= D; ++j)
					m[i][j] -= factor * m[k][j];
				right[i] -= factor * right[k];
			}
		}
		for (int k = 0; k <= D; ++k)
			right[k] /= m[k][k];
		return right;
	}

	Rational violation(int plane) const
	{
		Rational v = -planes_[plane].offset - infeasibility;
		for (int k = 0; k < D; ++k)
			v += planes_[plane].normal[k] * point[k];
		return v;
	}

	void solveBasis()
	{
		Column unit, offsets;
		for (int k = 0; k <= D; ++k) {
			unit[k]    = k == D;
			offsets[k] = planes_[basis[k]].offset;
		}
		weight         = linearSolve(unit, false);
		const Column z = linearSolve(offsets, true); // (x; −s)
		for (int k = 0; k < D; ++k)
			point[k] = z[k];
		infeasibility = -z[D];
	}

	void solve()
	{
		for (int pivots = 0;; ++pivots) {
			solveBasis();
			// the most violated plane is quick, Bland's first one cannot cycle
			int      entering = -1;
			Rational worst    = 0;
			for (int i = 0; i < int(planes_.size()); ++i) {
				const Rational v = violation(i);
				if (v > worst) {
					entering = i;
					worst    = v;
					if (pivots > 60) break;
				}
			}
			if (entering < 0) return;
			const Column w       = linearSolve(columnOf(entering), false);
			int          leaving = -1;
			for (int k = 0; k <= D; ++k) {
				if (w[k] <= 0) continue;
				if (leaving >= 0) {
					const Rational here = weight[k] * w[leaving], best = weight[leaving] * w[k];
					if (here > best || (here == best && basis[k] > basis[leaving])) continue;
				}
				leaving = k;
			}
			basis[leaving] = entering;
		}
	}

	/// λ ≥ 0, Σ λ = 1, Σ λ a = 0, no plane violated, −Σ λ d = s*, no artificial plane used.
	void proveOptimal() const
	{
		Column   sum {};
		Rational dual = 0;
		bool     good = true;
		for (int k = 0; k <= D; ++k) {
			const Column c = columnOf(basis[k]);
			for (int i = 0; i <= D; ++i)
				sum[i] += weight[k] * c[i];
			dual -= weight[k] * planes_[basis[k]].offset;
			good = good && weight[k] >= 0 && (weight[k] == 0 || basis[k] < int(planes_.size()) - D - 1);
		}
		for (int i = 0; i <= D; ++i)
			good = good && sum[i] == (i == D ? 1 : 0);
		for (int i = 0; i < int(planes_.size()); ++i)
			good = good && violation(i) <= 0;
		if (!good || dual != infeasibility) throw std::logic_error("ExactLp: no certificate");
	}
};

} // namespace polytope::samples
