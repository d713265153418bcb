// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "numbers/Tolerances.hpp"
#include "program/PairPlanes.hpp"

#include <cmath>

/// Analytic centre (Boon et al. 2012, Eq. 10): argmax Σ log(d_i − a_i·x) over all planes of both bodies, redundant ones
/// kept. Newton on D unknowns for φ(x) = −Σ log(d_i − a_i·x); gradient Σ a_i/slack_i, Hessian Σ a_i a_iᵀ/slack_i².
///
/// No logarithm is evaluated. A full step from a point of decrement < 1 stays inside (Dikin's ellipsoid). Above `fullStep` the step length is
/// the zero of the directional derivative Σ ρ_i/(1 − t ρ_i), ρ_i = a_i·Δ/slack_i. A start close to a face's corner then crosses the whole face
/// in one step, where a damped step would double its distance.
///
/// The frame must have its last axis along the contact normal and its origin near the overlap. A thin overlap then makes the Hessian graded
/// (one axis large) instead of ill-conditioned, and Cholesky handles that without loss. An overlap that is thin across two axes (parallel edges
/// that just overlap, blocks of a wall that meet at a corner) needs the other axes along its own, too. Where digits cancel in the Cholesky
/// factorisation, `Skewed` is returned and the caller turns to stiffAxes().
namespace polytope {

enum class CentreStatus { Converged, RoundingLimited, Skewed, NotConverged };

template <class R, int D> struct BarrierStep {
	R    direction[D];
	R    decrement; ///< √(Δᵀ H Δ), the step's length in the local norm
	bool skewed;    ///< not computed: the Hessian's digits cancel in these axes
};

/// Gradient and Hessian at x; slacks are left in planes.slack. False if x is not strictly inside.
template <class R, int D, int W>
POLYTOPE_INLINE bool barrierDerivatives(const PairPlanes<R, D>& planes, const R* x, R (&gradient)[D], R (&hessian)[D][D])
{
	using V             = typename Lanes<R, W>::Type;
	constexpr int count = D + D * (D + 1) / 2;
	V             X[D], sum[count]; // gradient, then the Hessian's lower triangle by rows
	for (int k = 0; k < D; ++k)
		X[k] = broadcast<R, W>(x[k]);
	for (V& s : sum)
		s = broadcast<R, W>(0);
	V smallest = broadcast<R, W>(R(padOffset));
	for (int i = 0; i < planes.total; i += W) {
		V       a[D];
		const V slack = slacksOf<R, D, W>(planes, i, X, a);
		smallest      = minOf(smallest, slack);
		store<R, W>(planes.slack + i, slack);
		const V inverse = R(1) / slack;
		for (int k = 0, next = D; k < D; ++k) {
			a[k] *= inverse;
			sum[k] += a[k];
			for (int j = 0; j <= k; ++j, ++next)
				sum[next] += a[k] * a[j];
		}
	}
	R total[count];
	horizontalSums<R, W>(sum, total);
	for (int k = 0, next = D; k < D; ++k) {
		gradient[k] = total[k];
		for (int j = 0; j <= k; ++j, ++next)
			hessian[k][j] = total[next];
	}
	return horizontalMin<R, W>(smallest) > 0;
}

/// Newton direction: by cofactors or, where their digits would cancel, by Cholesky, eliminating the last axis (the contact
/// normal, the large one) first.
/// Returns false if the Hessian is skewed, or not positive definite to rounding.
template <class R, int D> POLYTOPE_INLINE bool newtonStep(const R (&g)[D], const R (&h)[D][D], BarrierStep<R, D>& step)
{
	using std::sqrt;
	const R kept = R(tolerance::cancellation);
	step.skewed  = false;
	if constexpr (D == 3) {
		const R zz  = h[2][2];
		const R xx_ = h[1][1] * zz - h[2][1] * h[2][1];
		const R xy_ = h[2][0] * h[2][1] - h[1][0] * zz;
		const R xz_ = h[1][0] * h[2][1] - h[2][0] * h[1][1];
		const R det = h[0][0] * xx_ + h[1][0] * xy_ + h[2][0] * xz_;
		if (det > R(tolerance::wellScaled) * (h[0][0] * h[1][1] * zz)) {
			// by cofactors: one division, where an elimination needs three in sequence
			const R yy_       = h[0][0] * zz - h[2][0] * h[2][0];
			const R yz_       = h[1][0] * h[2][0] - h[0][0] * h[2][1];
			const R zz_       = h[0][0] * h[1][1] - h[1][0] * h[1][0];
			const R scale     = R(-1) / det;
			step.direction[0] = (xx_ * g[0] + xy_ * g[1] + xz_ * g[2]) * scale;
			step.direction[1] = (xy_ * g[0] + yy_ * g[1] + yz_ * g[2]) * scale;
			step.direction[2] = (xz_ * g[0] + yz_ * g[1] + zz_ * g[2]) * scale;
			step.decrement    = sqrt(-dot<R, D>(step.direction, g));
		} else {
			// LDLᵀ in the order z, y, x
			if (!(zz > 0)) return false;
			const R lzy = h[2][1] / zz, lzx = h[2][0] / zz;
			const R dy  = h[1][1] - lzy * h[2][1];
			const R yx  = h[1][0] - lzy * h[2][0];
			const R lyx = yx / dy;
			const R dx  = h[0][0] - lzx * h[2][0] - lyx * yx;
			step.skewed = !(dy > kept * h[1][1]) || !(dx > kept * h[0][0]);
			if (step.skewed) return false;
			const R bz = -g[2], by = -g[1] - lzy * bz, bx = -g[0] - lzx * bz - lyx * by;
			const R sz = bz / zz, sy = by / dy, sx = bx / dx;
			step.direction[0] = sx;
			step.direction[1] = sy - lyx * sx;
			step.direction[2] = sz - lzy * step.direction[1] - lzx * sx;
			step.decrement    = sqrt(bz * sz + by * sy + bx * sx);
		}
	} else {
		const R dy = h[1][1];
		if (!(dy > 0)) return false;
		const R l   = h[1][0] / dy;
		const R dx  = h[0][0] - l * h[1][0];
		step.skewed = !(dx > kept * h[0][0]);
		if (step.skewed) return false;
		const R by = -g[1], bx = -g[0] - l * by;
		const R sy = by / dy, sx = bx / dx;
		step.direction[0] = sx;
		step.direction[1] = sy - l * sx;
		step.decrement    = sqrt(by * sy + bx * sx);
	}
	return step.decrement >= 0; // false for NaN
}

/// Axes in which the Hessian at the point of planes.slack is graded: the last along the nearest plane's normal, the one
/// before along the steepest plane across it (a_i/slack_i with the last axis taken out). QR factorisation of the rows
/// a_i/slack_i, with pivoting.
template <class R, int D> POLYTOPE_INLINE Rotation<R, D> stiffAxes(const PairPlanes<R, D>& planes)
{
	using std::sqrt;
	int nearest = 0;
	for (int i = 1; i < planes.total; ++i)
		if (planes.slack[i] < planes.slack[nearest]) nearest = i;
	R n[D], d;
	planes.plane(nearest, n, d);
	const R length = sqrt(dot<R, D>(n, n));
	for (int k = 0; k < D; ++k)
		n[k] /= length;
	if constexpr (D == 2) return axesAround<R, D>(n);
	else {
		R best = 0, y[D] = {};
		for (int i = 0; i < planes.total; ++i) {
			R a[D];
			planes.plane(i, a, d);
			for (int twice = 0; twice < 2; ++twice) {
				const R along = dot<R, D>(a, n);
				for (int k = 0; k < D; ++k)
					a[k] -= along * n[k];
			}
			const R across = dot<R, D>(a, a);
			if (!(across > best * planes.slack[i] * planes.slack[i])) continue;
			best = across / (planes.slack[i] * planes.slack[i]);
			for (int k = 0; k < D; ++k)
				y[k] = a[k] / sqrt(across);
		}
		return { { { y[1] * n[2] - y[2] * n[1], y[2] * n[0] - y[0] * n[2], y[0] * n[1] - y[1] * n[0] }, { y[0], y[1], y[2] },
			{ n[0], n[1], n[2] } } };
	}
}

/// Step length along the direction: (nearly) the zero of φ'(t) = Σ ρ_i/(1 − t ρ_i), from the slacks of the last
/// barrierDerivatives(). The pole nearest to t = 0 is treated exactly: t ← t_max + 1/S with S the other terms' sum.
template <class R, int D, int W> POLYTOPE_INLINE R stepLength(const PairPlanes<R, D>& planes, const BarrierStep<R, D>& step)
{
	using V = typename Lanes<R, W>::Type;
	V X[D];
	for (int k = 0; k < D; ++k)
		X[k] = broadcast<R, W>(step.direction[k]);
	V largest = broadcast<R, W>(0);
	for (int i = 0; i < planes.total; i += W) {
		V rate = load<R, W>(planes.normal[0] + i) * X[0];
		for (int k = 1; k < D; ++k)
			rate += load<R, W>(planes.normal[k] + i) * X[k];
		rate /= load<R, W>(planes.slack + i);
		store<R, W>(planes.rate + i, rate);
		largest = maxOf(largest, rate);
	}
	const R pole  = -horizontalMin<R, W>(-largest);
	const R slope = -step.decrement * step.decrement;
	if (!(pole > 0)) return 1;
	// towards a plane: the minimum of a bound from above, φ(t) ≤ φ(0) + φ'(0) (t + t/p + log(1 − t p)/p²), p the pole's rate.
	// Away from all near planes p is small, and the minimum may be many steps away: then it is searched for
	if (pole > R(tolerance::nearPole)) return 1 / (1 + pole);
	const R tMax = 1 / pole;
	R       low = 0, high = tMax;
	R       t = tMax + 1 / (slope - pole);
	for (int trial = 0; trial < tolerance::lineSearchSteps; ++trial) {
		// every third trial halves the bracket: the fixed point may swing between its ends
		if (trial % 3 == 2 || !(t > low && t < high)) t = (low + high) / 2;
		V       sum  = broadcast<R, W>(0);
		const V time = broadcast<R, W>(t);
		for (int i = 0; i < planes.total; i += W) {
			const V rate = load<R, W>(planes.rate + i);
			sum += rate / (R(1) - time * rate);
		}
		const R derivative = horizontalSum<R, W>(sum);
		if (abs(derivative) <= R(tolerance::lineSearchSlope) * -slope) break;
		(derivative < 0 ? low : high) = t;
		const R rest                  = derivative - 1 / (tMax - t);
		t                             = rest < 0 ? tMax + 1 / rest : (low + high) / 2;
	}
	return t < tMax ? t : low;
}

/// Newton from x (strictly inside). `accept`: the predicted local length of what remains after the last step.
template <class R, int D, int W>
POLYTOPE_INLINE CentreStatus analyticCentre(const PairPlanes<R, D>& planes, R* x, R accept, int& iterations, R& decrement)
{
	R previous = R(padOffset);
	for (;;) {
		R                 g[D], h[D][D];
		BarrierStep<R, D> step;
		if (!barrierDerivatives<R, D, W>(planes, x, g, h)) return CentreStatus::NotConverged;
		if (!newtonStep<R, D>(g, h, step)) return step.skewed ? CentreStatus::Skewed : CentreStatus::NotConverged;
		decrement = step.decrement;
		// a full step that did not reduce the decrement is due to rounding: keep the present point
		const bool stalled = previous <= R(tolerance::fullStep) && step.decrement > previous / 2;
		if (stalled && step.decrement <= R(tolerance::stagnation)) return CentreStatus::RoundingLimited;
		if (iterations >= tolerance::newtonIterations) return CentreStatus::NotConverged;
		++iterations;
		const R length = step.decrement <= R(tolerance::fullStep) ? R(1) : stepLength<R, D, W>(planes, step);
		for (int k = 0; k < D; ++k)
			x[k] += length * step.direction[k];
		// quadratic convergence of a self-concordant function: the next decrement is below decrement²/(1 − decrement)²
		if (step.decrement <= R(tolerance::fullStep) && step.decrement * step.decrement <= accept) return CentreStatus::Converged;
		previous = length == 1 ? step.decrement : R(padOffset);
	}
}

} // namespace polytope
