// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "PairSamples.hpp"

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <array>
#include <limits>
#include <vector>

/// The definitions of the contact (see ContactKernel.hpp) once more, written plainly and in 113-bit arithmetic (or another
/// `Number`): what the kernel's answers are compared with. Shares no code with it. World axes from body 1's centre.
namespace polytope::samples {

using Quad = boost::multiprecision::cpp_bin_float_quad;

template <class Number> using PreciseVector = std::array<Number, 3>;
using QuadVector                            = PreciseVector<Quad>;

template <class Number = Quad> PreciseVector<Number> precise(const Vector3& v) { return { Number(v[0]), Number(v[1]), Number(v[2]) }; }

template <class Number> Vector3 rounded(const PreciseVector<Number>& v) { return { Real(v[0]), Real(v[1]), Real(v[2]) }; }

template <class Number> Number dot(const PreciseVector<Number>& a, const PreciseVector<Number>& b)
{
	return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

template <class Number>
PreciseVector<Number> along(
        const PreciseVector<Number>& x, const typename PreciseVector<Number>::value_type& t, const PreciseVector<Number>& n)
{
	return { x[0] + t * n[0], x[1] + t * n[1], x[2] + t * n[2] };
}

template <class Number> PreciseVector<Number> minus(const PreciseVector<Number>& a, const PreciseVector<Number>& b)
{
	return along(a, Number(-1), b);
}

template <class Number> Number norm(const PreciseVector<Number>& v) { return sqrt(dot(v, v)); }

template <class Number> class PrecisePairOf {
public:
	using Vector = PreciseVector<Number>;
	struct Plane {
		Vector normal;
		Number offset;
		Number slack(const Vector& x) const { return offset - dot(normal, x); }
	};
	std::array<std::vector<Plane>, 2> planes;
	std::array<Number, 2>             cornerRadius;
	int                               dimension;

	explicit PrecisePairOf(const Pair& pair) : dimension(pair.dimension())
	{
		for (int body = 0; body < 2; ++body) {
			const HalfSpaces& set    = pair.shape[body]->planes();
			const Vector      centre = precise<Number>(body == 0 ? Vector3::Zero() : pair.centre2);
			cornerRadius[body]       = pair.shape[body]->cornerRadius();
			for (std::size_t i = 0; i < set.size(); ++i) {
				Plane plane;
				for (int k = 0; k < 3; ++k)
					plane.normal[k] = dot(precise<Number>(pair.rotation[body].row(k)), precise<Number>(set.normals[i]));
				plane.offset = Number(set.offsets[i]) + dot(plane.normal, centre);
				planes[body].push_back(plane);
			}
		}
	}

	/// Largest a·x − d over all planes: −(radius of the ball about x) inside.
	Number violation(const Vector& x) const { return std::max(violation(0, x), violation(1, x)); }
	Number violation(int body, const Vector& x) const
	{
		Number largest = -planes[body][0].slack(x);
		for (const Plane& plane : planes[body])
			largest = std::max<Number>(largest, -plane.slack(x));
		return largest;
	}

	/// Length of e in the local norm at x: √(eᵀ H e), H = Σ a aᵀ/slack². One is the Dikin ellipsoid's surface.
	Number localLength(const Vector& x, const Vector& e) const
	{
		Number sum = 0;
		for (const auto& body : planes)
			for (const Plane& plane : body) {
				const Number part = dot(plane.normal, e) / plane.slack(x);
				sum += part * part;
			}
		return sqrt(sum);
	}

	/// The analytic centre by damped Newton from x (strictly inside), to three quarters of the digits. False if it does not converge.
	bool analyticCentre(Vector& x) const
	{
		const Number close
		        = ldexp(Number(1), -3 * std::numeric_limits<Number>::digits / 8); // and twice as many digits after that step
		for (int iteration = 0; iteration < 500; ++iteration) {
			Vector       step;
			const Number decrement = newtonStep(x, step);
			if (decrement < 0) return false;
			x = along(x, decrement < Number(0.25) ? Number(1) : Number(1 / (1 + decrement)), step);
			if (decrement < close) return violation(x) < 0;
		}
		return false;
	}

	/// Newton step of −Σ log(slack) at x and its local length (the decrement); −1 outside.
	Number newtonStep(const Vector& x, Vector& step) const
	{
		if (!(violation(x) < 0)) return -1;
		Vector                g {};
		std::array<Vector, 3> h {};
		for (const auto& body : planes)
			for (const Plane& plane : body) {
				const Number inverse = 1 / plane.slack(x);
				for (int k = 0; k < dimension; ++k) {
					g[k] += inverse * plane.normal[k];
					for (int j = 0; j < dimension; ++j)
						h[k][j] += inverse * inverse * plane.normal[k] * plane.normal[j];
				}
			}
		for (int k = 0; k < 3; ++k)
			step[k] = -g[k];
		solvePositive(h, step);
		return sqrt(-dot(g, step));
	}

	/// h⁻¹ b by Gauss without pivoting: the matrix is positive definite.
	void solvePositive(std::array<Vector, 3>& h, Vector& b) const
	{
		for (int k = 0; k < dimension; ++k)
			for (int i = k + 1; i < dimension; ++i) {
				const Number factor = h[i][k] / h[k][k];
				for (int j = k; j < dimension; ++j)
					h[i][j] -= factor * h[k][j];
				b[i] -= factor * b[k];
			}
		for (int k = dimension - 1; k >= 0; --k) {
			for (int j = k + 1; j < dimension; ++j)
				b[k] -= h[k][j] * b[j];
			b[k] /= h[k][k];
		}
	}

	/// Gradient of a body's inner potential particle, Σ 2⟨a·x − d + r⟩ a.
	Vector innerGradient(int body, const Vector& x) const
	{
		Vector g {};
		for (const Plane& plane : planes[body]) {
			const Number bracket = cornerRadius[body] - plane.slack(x);
			if (bracket > 0) g = along(g, 2 * bracket, plane.normal);
		}
		return g;
	}

	/// How far two points no farther apart than `move` in the local norm can have body 1's and 2's normals turned: with
	/// |a·δ| ≤ move × slack, the gradient moves by at most Σ 2 move slack over the planes that are active.
	Number normalSlip(int body, const Vector& x, const Number& move) const
	{
		Number sum = 0;
		for (const Plane& plane : planes[body]) {
			const Number slack = plane.slack(x);
			if (slack < cornerRadius[body] * (1 + 2 * move)) sum += 2 * move * slack;
		}
		const Number length = norm(innerGradient(body, x));
		return length > 0 ? Number(sum / length) : Number(2);
	}

	/// Eq. 17 with equal weights; false where a gradient or the difference is zero.
	bool normal(const Vector& x, Vector& n) const
	{
		const Vector g0 = innerGradient(0, x), g1 = innerGradient(1, x);
		const Number l0 = norm(g0), l1 = norm(g1);
		if (l0 == 0 || l1 == 0) return false;
		for (int k = 0; k < 3; ++k)
			n[k] = g0[k] / l0 - g1[k] / l1;
		const Number length = norm(n);
		if (length == 0) return false;
		for (Number& component : n)
			component /= length;
		return true;
	}

	/// The way from x along n to the body's surface; `rate` is how fast it comes nearer: a plane off by δ moves the exit by δ/rate.
	struct Exit {
		Number distance = std::numeric_limits<Number>::max();
		Number rate     = 1;
	};
	Exit exit(int body, const Vector& x, const Vector& n, int sign) const
	{
		Exit nearest;
		for (const Plane& plane : planes[body]) {
			const Number rate = sign * dot(plane.normal, n);
			if (!(rate > 0)) continue;
			const Number distance = plane.slack(x) / rate;
			if (distance < nearest.distance) nearest = { distance, rate };
		}
		return nearest;
	}

	Number depth(const Vector& x, const Vector& n) const { return exit(0, x, n, 1).distance + exit(1, x, n, -1).distance; }
};

using PrecisePair = PrecisePairOf<Quad>;

} // namespace polytope::samples
