// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "PrecisePair.hpp"

#include <array>

/// The barrier's value (BarrierValue.hpp) once more in 113-bit arithmetic, by damped Newton on the function itself: shares
/// no code and no iteration with the kernel.
namespace polytope::samples {

class PreciseBarrier {
public:
	PrecisePair pair;
	Quad        mu;
	QuadVector  x {};
	Quad        s = 0;

	PreciseBarrier(const Pair& source, Real barrier)
	        : pair(source)
	        , mu(Quad(barrier) * Quad(source.inscribedRadius()))
	        , centre2_(precise(source.centre2))
	{
	}

	/// Body 2 moved: translated by `move`, turned about the axis through its centre by the angle.
	PreciseBarrier moved(const QuadVector& move, const QuadVector& axis, const Quad& angle) const
	{
		PreciseBarrier other = *this;
		other.centre2_       = along(centre2_, 1, move);
		const Quad c = cos(angle), sine = sin(angle);
		for (auto& plane : other.pair.planes[1]) {
			const QuadVector a     = plane.normal;
			const Quad       own   = plane.offset - dot(a, centre2_), parallel = dot(axis, a) * (1 - c);
			const QuadVector cross = { axis[1] * a[2] - axis[2] * a[1], axis[2] * a[0] - axis[0] * a[2], axis[0] * a[1] - axis[1] * a[0] };
			for (int k = 0; k < 3; ++k)
				plane.normal[k] = c * a[k] + sine * cross[k] + parallel * axis[k];
			plane.offset = own + dot(plane.normal, other.centre2_);
		}
		return other;
	}

	/// Φ; leaves the minimiser in x and s, from where they are (lifted until inside). NaN if Newton does not get there.
	Quad value()
	{
		s = std::max<Quad>(s, pair.violation(x) + mu / 4);
		Quad reach = 0;
		for (const auto& body : pair.planes)
			for (const auto& plane : body)
				reach = std::max<Quad>(reach, abs(plane.offset));
		for (int iteration = 0; iteration < 300; ++iteration) {
			const int                          n = pair.dimension + 1;
			std::array<Quad, 4>                step {};
			std::array<std::array<Quad, 4>, 4> h {};
			step[n - 1] = -1;
			for (const auto& body : pair.planes)
				for (const auto& plane : body) {
					const Quad          inverse = 1 / (s + plane.slack(x));
					const Quad          weight  = mu * mu * inverse * inverse;
					std::array<Quad, 4> z;
					for (int k = 0; k < n - 1; ++k)
						z[k] = -plane.normal[k];
					z[n - 1] = 1;
					for (int k = 0; k < n; ++k) {
						step[k] += weight * z[k];
						for (int j = 0; j < n; ++j)
							h[k][j] += 2 * weight * inverse * z[k] * z[j];
					}
				}
			Quad gradient = 0;
			for (int k = 0; k < n; ++k)
				gradient = std::max<Quad>(gradient, abs(step[k]));
			if (iteration > 0 && gradient < Quad(1e-31) * (1 + reach / mu)) return objective();
			// Gauss; the last unknown, s, first: the matrix is graded
			for (int k = n - 1; k >= 0; --k)
				for (int i = k - 1; i >= 0; --i) {
					const Quad factor = h[i][k] / h[k][k];
					for (int j = k; j >= 0; --j)
						h[i][j] -= factor * h[k][j];
					step[i] -= factor * step[k];
				}
			for (int k = 0; k < n; ++k) {
				for (int j = 0; j < k; ++j)
					step[k] -= h[k][j] * step[j];
				step[k] /= h[k][k];
			}
			const QuadVector from = x;
			const Quad       level = s, before = objective();
			Quad             t = 1;
			for (int halving = 0; halving < 200; ++halving, t /= 2) {
				for (int k = 0; k < n - 1; ++k)
					x[k] = from[k] + t * step[k];
				s = level + t * step[n - 1];
				// near the minimum the objective cannot tell any more
				if (pair.violation(x) < s && (gradient < Quad(1e-10) || objective() < before)) break;
			}
		}
		return std::numeric_limits<Quad>::quiet_NaN();
	}

	/// λ_i = μ²/σ_i² at (x, s).
	std::vector<Quad> weights(int body) const
	{
		std::vector<Quad> all;
		for (const auto& plane : pair.planes[body]) {
			const Quad u = mu / (s + plane.slack(x));
			all.push_back(u * u);
		}
		return all;
	}

private:
	QuadVector centre2_;

	Quad objective() const
	{
		Quad sum = 0;
		for (const auto& body : pair.planes)
			for (const auto& plane : body)
				sum += 1 / (s + plane.slack(x));
		return s + mu * mu * sum - 2 * sqrt(Quad(2)) * mu;
	}
};

} // namespace polytope::samples
