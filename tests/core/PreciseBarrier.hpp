// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "PrecisePair.hpp"

#include <array>

/// The barrier's value (BarrierValue.hpp) once more in 113-bit arithmetic (or another `Number`), by damped Newton on the function itself: shares
/// no code and no iteration with the kernel.
namespace polytope::samples {

template <class Number> class PreciseBarrierOf {
public:
	using Vector = PreciseVector<Number>;
	PrecisePairOf<Number> pair;
	Number                mu;
	Vector                x {};
	Number                s = 0;

	PreciseBarrierOf(const Pair& source, Real barrier)
	        : pair(source), mu(Number(barrier) * Number(source.inscribedRadius())), centre2_(precise<Number>(source.centre2))
	{
	}

	/// Body 2 moved: translated by `move`, turned about the axis through its centre by the angle.
	PreciseBarrierOf moved(const Vector& move, const Vector& axis, const Number& angle) const
	{
		PreciseBarrierOf other = *this;
		other.centre2_         = along(centre2_, 1, move);
		const Number c = cos(angle), sine = sin(angle);
		for (auto& plane : other.pair.planes[1]) {
			const Vector a   = plane.normal;
			const Number own = plane.offset - dot(a, centre2_), parallel = dot(axis, a) * (1 - c);
			const Vector cross
			        = { axis[1] * a[2] - axis[2] * a[1], axis[2] * a[0] - axis[0] * a[2], axis[0] * a[1] - axis[1] * a[0] };
			for (int k = 0; k < 3; ++k)
				plane.normal[k] = c * a[k] + sine * cross[k] + parallel * axis[k];
			plane.offset = own + dot(plane.normal, other.centre2_);
		}
		return other;
	}

	/// Φ; leaves the minimiser in x and s, from where they are (lifted until inside). NaN if Newton does not converge.
	Number value()
	{
		s            = std::max<Number>(s, pair.violation(x) + mu / 4);
		Number reach = 0;
		for (const auto& body : pair.planes)
			for (const auto& plane : body)
				reach = std::max<Number>(reach, abs(plane.offset));
		for (int iteration = 0; iteration < 300; ++iteration) {
			const int                            n = pair.dimension + 1;
			std::array<Number, 4>                step {};
			std::array<std::array<Number, 4>, 4> h {};
			step[n - 1] = -1;
			for (const auto& body : pair.planes)
				for (const auto& plane : body) {
					const Number          inverse = 1 / (s + plane.slack(x));
					const Number          weight  = mu * mu * inverse * inverse;
					std::array<Number, 4> z;
					for (int k = 0; k < n - 1; ++k)
						z[k] = -plane.normal[k];
					z[n - 1] = 1;
					for (int k = 0; k < n; ++k) {
						step[k] += weight * z[k];
						for (int j = 0; j < n; ++j)
							h[k][j] += 2 * weight * inverse * z[k] * z[j];
					}
				}
			Number gradient = 0;
			for (int k = 0; k < n; ++k)
				gradient = std::max<Number>(gradient, abs(step[k]));
			if (iteration > 0 && gradient < 512 * std::numeric_limits<Number>::epsilon() * (1 + reach / mu)) return objective();
			// Gauss; the last unknown, s, first: the matrix is graded
			for (int k = n - 1; k >= 0; --k)
				for (int i = k - 1; i >= 0; --i) {
					const Number factor = h[i][k] / h[k][k];
					for (int j = k; j >= 0; --j)
						h[i][j] -= factor * h[k][j];
					step[i] -= factor * step[k];
				}
			for (int k = 0; k < n; ++k) {
				for (int j = 0; j < k; ++j)
					step[k] -= h[k][j] * step[j];
				step[k] /= h[k][k];
			}
			const Vector from  = x;
			const Number level = s, before = objective();
			Number       t = 1;
			for (int halving = 0; halving < 200; ++halving, t /= 2) {
				for (int k = 0; k < n - 1; ++k)
					x[k] = from[k] + t * step[k];
				s = level + t * step[n - 1];
				// near the minimum differences of the objective are rounding
				if (pair.violation(x) < s && (gradient < Number(1e-10) || objective() < before)) break;
			}
		}
		return std::numeric_limits<Number>::quiet_NaN();
	}

	/// λ_i = μ²/σ_i² at (x, s).
	std::vector<Number> weights(int body) const
	{
		std::vector<Number> all;
		for (const auto& plane : pair.planes[body]) {
			const Number u = mu / (s + plane.slack(x));
			all.push_back(u * u);
		}
		return all;
	}

private:
	Vector centre2_;

	Number objective() const
	{
		Number sum = 0;
		for (const auto& body : pair.planes)
			for (const auto& plane : body)
				sum += 1 / (s + plane.slack(x));
		return s + mu * mu * sum - 2 * sqrt(Number(2)) * mu;
	}
};

using PreciseBarrier = PreciseBarrierOf<Quad>;

} // namespace polytope::samples
