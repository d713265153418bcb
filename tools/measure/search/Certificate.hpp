// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "ExactLp.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

/// The exact predicate, filtered: bounds of s*, and of the remaining distance to a centre, from an answer's own certificate
/// evaluated with 11 digits of binary more than the answer has; rational arithmetic where that does not decide. The
/// planes are those of the input's doubles, as in ExactLp.hpp and PrecisePair.hpp.
namespace polytope::search {

using Extended       = long double;
using ExtendedVector = std::array<Extended, 3>;

/// Allowed error of s*: rounding of the pair's planes (tests/core/SimplexLpTest.cpp states the same).
inline Real allowedError(const samples::Pair& pair) { return 8 * tolerance::rounding * pair.reach(); }

class Certificate {
public:
	explicit Certificate(const samples::Pair& pair) : pair_(pair), dimension_(pair.dimension()), reach_(pair.reach())
	{
		for (int body = 0; body < 2; ++body) {
			begin_[body]          = int(planes_.size());
			const HalfSpaces& set = pair.shape[body]->planes();
			const Matrix3&    r   = pair.rotation[body];
			for (std::size_t i = 0; i < set.size(); ++i) {
				Plane plane;
				plane.offset = set.offsets[i];
				for (int k = 0; k < dimension_; ++k) {
					plane.normal[k] = 0;
					for (int j = 0; j < dimension_; ++j)
						plane.normal[k] += Extended(r(k, j)) * set.normals[i][j];
					if (body == 1) plane.offset += plane.normal[k] * pair.centre2[k];
				}
				planes_.push_back(plane);
			}
		}
	}

	/// Bounds of s* from a solved linear program's point and dual weights.
	void bracket(const ContactResult& solved)
	{
		const ExtendedVector x = extended(solved.point);
		upper                  = violation(x);
		Extended       weights[4], sum = 0, value = 0;
		ExtendedVector balance {};
		weightsOf(solved, weights);
		for (int k = 0; k <= dimension_; ++k) {
			const Plane&   plane  = basisPlane(solved, k);
			const Extended weight = std::max<Extended>(weights[k], 0);
			sum += weight;
			value -= weight * slack(plane, x);
			for (int j = 0; j < dimension_; ++j)
				balance[j] += weight * plane.normal[j];
		}
		// Σ λ (a·y − d) ≤ s* Σ λ at the optimal y, which is no farther than that from x
		lower = (value - norm(balance) * 4 * reach_) / sum;
		if (!(lower <= upper) || !(sum > 0)) lower = -std::numeric_limits<Extended>::infinity();
	}

	/// Finds both bounds by rational arithmetic.
	void solveExactly()
	{
		const auto s = dimension_ == 3 ? samples::ExactLp<3>(pair_).infeasibility : samples::ExactLp<2>(pair_).infeasibility;
		// the remainder of a double is representable in another one
		const Real first = Real(s);
		lower = upper = Extended(first) + Extended(Real(samples::Rational(s - samples::Rational(first))));
	}

	Extended lower = 0, upper = 0; ///< of s*

	/// Newton decrement of the analytic centre at x: to first order the distance from it in its local norm. Infinite outside.
	/// From a QR factorisation of the rows a/slack, which keeps twice the digits that the Hessian does.
	Extended centreDecrement(const Vector3& point) const
	{
		const ExtendedVector  x = extended(point);
		std::vector<Extended> rows[4], ones;
		for (const Plane& plane : planes_) {
			const Extended s = slack(plane, x);
			if (!(s > 0)) return std::numeric_limits<Extended>::infinity();
			for (int k = 0; k < dimension_; ++k)
				rows[k].push_back(plane.normal[k] / s);
			ones.push_back(1);
		}
		Extended sum = 0;
		orthonormalise(rows, dimension_);
		for (int k = 0; k < dimension_; ++k) {
			const Extended part = inner(rows[k], ones);
			sum += part * part;
		}
		return std::sqrt(sum);
	}


private:
	struct Plane {
		ExtendedVector normal {};
		Extended       offset;
	};
	const samples::Pair& pair_;
	int                  dimension_;
	Extended             reach_;
	std::vector<Plane>   planes_;
	int                  begin_[2];

	static ExtendedVector extended(const Vector3& v) { return { v[0], v[1], v[2] }; }

	Extended slack(const Plane& plane, const ExtendedVector& x) const
	{
		Extended sum = plane.offset;
		for (int k = 0; k < dimension_; ++k)
			sum -= plane.normal[k] * x[k];
		return sum;
	}

	Extended violation(const ExtendedVector& x) const
	{
		Extended largest = -std::numeric_limits<Extended>::infinity();
		for (const Plane& plane : planes_)
			largest = std::max(largest, -slack(plane, x));
		return largest;
	}

	const Plane& basisPlane(const ContactResult& result, int k) const
	{
		return planes_[std::size_t(begin_[result.basis[k] & 1] + (result.basis[k] >> 1))];
	}

	/// The weights of the answer's basis once more, by elimination with pivoting; the answer's own if it is singular.
	void weightsOf(const ContactResult& solved, Extended (&weights)[4]) const
	{
		const int n = dimension_ + 1;
		Extended  m[4][5];
		for (int k = 0; k < n; ++k) {
			const Plane& plane = basisPlane(solved, k);
			for (int i = 0; i < n; ++i)
				m[i][k] = i < dimension_ ? plane.normal[i] : Extended(1);
			m[k][n] = k == dimension_;
		}
		bool singular = false;
		for (int k = 0; k < n; ++k) {
			int pivot = k;
			for (int i = k + 1; i < n; ++i)
				if (std::abs(m[i][k]) > std::abs(m[pivot][k])) pivot = i;
			std::swap(m[k], m[pivot]);
			singular = singular || m[k][k] == 0;
			for (int i = k + 1; i < n && !singular; ++i)
				for (int j = n; j >= k; --j)
					m[i][j] -= m[i][k] / m[k][k] * m[k][j];
		}
		for (int k = n - 1; k >= 0; --k) {
			weights[k] = m[k][n];
			for (int j = k + 1; j < n; ++j)
				weights[k] -= m[k][j] * weights[j];
			weights[k] /= m[k][k];
		}
		for (int k = 0; k < n && singular; ++k)
			weights[k] = solved.weights[k];
	}

	static Extended norm(const ExtendedVector& v) { return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

	static Extended inner(const std::vector<Extended>& u, const std::vector<Extended>& v)
	{
		Extended sum = 0;
		for (std::size_t i = 0; i < u.size(); ++i)
			sum += u[i] * v[i];
		return sum;
	}

	/// Gram-Schmidt, twice.
	static void orthonormalise(std::vector<Extended>* columns, int count)
	{
		for (int k = 0; k < count; ++k) {
			std::vector<Extended>& column = columns[k];
			for (int twice = 0; twice < 2; ++twice)
				for (int j = 0; j < k; ++j) {
					const Extended part = inner(columns[j], column);
					for (std::size_t i = 0; i < column.size(); ++i)
						column[i] -= part * columns[j][i];
				}
			const Extended length = std::sqrt(inner(column, column));
			for (Extended& element : column)
				element = length > 0 ? element / length : Extended(0);
		}
	}
};

} // namespace polytope::search
