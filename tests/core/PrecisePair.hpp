// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "PairSamples.hpp"

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <array>
#include <vector>

/// The definitions of the contact (see ContactKernel.hpp) once more, written plainly and in 113-bit arithmetic: what the
/// kernel's answers are compared with. Shares no code with it. World axes from body 1's centre.
namespace polytope::samples {

using Quad       = boost::multiprecision::cpp_bin_float_quad;
using QuadVector = std::array<Quad, 3>;

inline QuadVector precise(const Vector3& v) { return { Quad(v[0]), Quad(v[1]), Quad(v[2]) }; }

inline Vector3 rounded(const QuadVector& v) { return { Real(v[0]), Real(v[1]), Real(v[2]) }; }

inline Quad dot(const QuadVector& a, const QuadVector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

inline QuadVector along(const QuadVector& x, const Quad& t, const QuadVector& n) { return { x[0] + t * n[0], x[1] + t * n[1], x[2] + t * n[2] }; }

inline QuadVector minus(const QuadVector& a, const QuadVector& b) { return along(a, Quad(-1), b); }

inline Quad norm(const QuadVector& v) { return sqrt(dot(v, v)); }

class PrecisePair {
public:
	struct Plane {
		QuadVector normal;
		Quad       offset;
		Quad       slack(const QuadVector& x) const { return offset - dot(normal, x); }
	};
	std::array<std::vector<Plane>, 2> planes;
	std::array<Quad, 2>               cornerRadius;
	int                               dimension;

	explicit PrecisePair(const Pair& pair)
	        : dimension(pair.dimension())
	{
		for (int body = 0; body < 2; ++body) {
			const HalfSpaces& set    = pair.shape[body]->planes();
			const QuadVector  centre = precise(body == 0 ? Vector3::Zero() : pair.centre2);
			cornerRadius[body]       = pair.shape[body]->cornerRadius();
			for (std::size_t i = 0; i < set.size(); ++i) {
				Plane plane;
				for (int k = 0; k < 3; ++k)
					plane.normal[k] = dot(precise(pair.rotation[body].row(k)), precise(set.normals[i]));
				plane.offset = Quad(set.offsets[i]) + dot(plane.normal, centre);
				planes[body].push_back(plane);
			}
		}
	}

	/// Largest a·x − d over all planes: −(radius of the ball about x) inside.
	Quad violation(const QuadVector& x) const { return std::max(violation(0, x), violation(1, x)); }
	Quad violation(int body, const QuadVector& x) const
	{
		Quad largest = -planes[body][0].slack(x);
		for (const Plane& plane : planes[body])
			largest = std::max<Quad>(largest, -plane.slack(x));
		return largest;
	}

	/// Length of e in the local norm at x: √(eᵀ H e), H = Σ a aᵀ/slack². One is the Dikin ellipsoid's surface.
	Quad localLength(const QuadVector& x, const QuadVector& e) const
	{
		Quad sum = 0;
		for (const auto& body : planes)
			for (const Plane& plane : body) {
				const Quad part = dot(plane.normal, e) / plane.slack(x);
				sum += part * part;
			}
		return sqrt(sum);
	}

	/// The analytic centre by damped Newton from x (strictly inside), to 25 digits. False if it does not get there.
	bool analyticCentre(QuadVector& x) const
	{
		for (int iteration = 0; iteration < 500; ++iteration) {
			QuadVector step;
			const Quad decrement = newtonStep(x, step);
			if (decrement < 0) return false;
			x = along(x, decrement < Quad(0.25) ? Quad(1) : Quad(1 / (1 + decrement)), step);
			if (decrement < Quad(1e-13)) return violation(x) < 0;
		}
		return false;
	}

	/// Newton step of −Σ log(slack) at x and its local length (the decrement); −1 outside.
	Quad newtonStep(const QuadVector& x, QuadVector& step) const
	{
		if (!(violation(x) < 0)) return -1;
		QuadVector                g {};
		std::array<QuadVector, 3> h {};
		for (const auto& body : planes)
			for (const Plane& plane : body) {
				const Quad inverse = 1 / plane.slack(x);
				for (int k = 0; k < dimension; ++k) {
					g[k] += inverse * plane.normal[k];
					for (int j = 0; j < dimension; ++j)
						h[k][j] += inverse * inverse * plane.normal[k] * plane.normal[j];
				}
			}
		for (int k = 0; k < 3; ++k)
			step[k] = -g[k];
		// Gauss without pivoting: the matrix is positive definite
		for (int k = 0; k < dimension; ++k)
			for (int i = k + 1; i < dimension; ++i) {
				const Quad factor = h[i][k] / h[k][k];
				for (int j = k; j < dimension; ++j)
					h[i][j] -= factor * h[k][j];
				step[i] -= factor * step[k];
			}
		for (int k = dimension - 1; k >= 0; --k) {
			for (int j = k + 1; j < dimension; ++j)
				step[k] -= h[k][j] * step[j];
			step[k] /= h[k][k];
		}
		return sqrt(-dot(g, step));
	}

	/// Gradient of a body's inner potential particle, Σ 2⟨a·x − d + r⟩ a.
	QuadVector innerGradient(int body, const QuadVector& x) const
	{
		QuadVector g {};
		for (const Plane& plane : planes[body]) {
			const Quad bracket = cornerRadius[body] - plane.slack(x);
			if (bracket > 0) g = along(g, 2 * bracket, plane.normal);
		}
		return g;
	}

	/// How far two points no farther apart than `move` in the local norm can have body 1's and 2's normals turned: with
	/// |a·δ| ≤ move × slack, the gradient moves by at most Σ 2 move slack over the planes that are active.
	Quad normalSlip(int body, const QuadVector& x, const Quad& move) const
	{
		Quad sum = 0;
		for (const Plane& plane : planes[body]) {
			const Quad slack = plane.slack(x);
			if (slack < cornerRadius[body] * (1 + 2 * move)) sum += 2 * move * slack;
		}
		const Quad length = norm(innerGradient(body, x));
		return length > 0 ? Quad(sum / length) : Quad(2);
	}

	/// Eq. 17 with equal weights; false where a gradient or the difference is zero.
	bool normal(const QuadVector& x, QuadVector& n) const
	{
		const QuadVector g0 = innerGradient(0, x), g1 = innerGradient(1, x);
		const Quad       l0 = norm(g0), l1 = norm(g1);
		if (l0 == 0 || l1 == 0) return false;
		for (int k = 0; k < 3; ++k)
			n[k] = g0[k] / l0 - g1[k] / l1;
		const Quad length = norm(n);
		if (length == 0) return false;
		for (Quad& component : n)
			component /= length;
		return true;
	}

	/// From x along n to the body's surface; `rate` is how fast it comes nearer: a plane off by δ moves the exit by δ/rate.
	struct Exit {
		Quad distance = 1e30;
		Quad rate     = 1;
	};
	Exit exit(int body, const QuadVector& x, const QuadVector& n, int sign) const
	{
		Exit nearest;
		for (const Plane& plane : planes[body]) {
			const Quad rate = sign * dot(plane.normal, n);
			if (!(rate > 0)) continue;
			const Quad distance = plane.slack(x) / rate;
			if (distance < nearest.distance) nearest = { distance, rate };
		}
		return nearest;
	}

	Quad depth(const QuadVector& x, const QuadVector& n) const { return exit(0, x, n, 1).distance + exit(1, x, n, -1).distance; }
};

} // namespace polytope::samples
