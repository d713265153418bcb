// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "numbers/Tolerances.hpp"
#include "program/PairPlanes.hpp"

#include <cmath>

/// Value of the phase-one linear program (SimplexLp.hpp) with an inverse barrier of length μ: over all planes of both bodies
///
///     Φ = min over (x, s) of [ s + μ² Σ 1/σ_i ] − 2√2 μ,      σ_i = s + d_i − a_i·x > 0.
///
/// Smooth in the bodies' poses, and the energy of the conservative contact is a function of it (ConservativeContact.hpp).
/// With λ_i = μ²/σ_i² the minimiser has Σ λ_i a_i = 0, Σ λ_i = 1: weights of the linear program's dual. Unit normals make
/// every λ_i ≤ ½ (λ_i = |Σ over the others of λ_j a_j| ≤ 1 − λ_i), hence Φ ≥ s*: separated bodies have Φ ≥ 0.
///
/// Newton on D + 1 unknowns in primal-dual form: with u_i = √λ_i, the equations σ_i u_i = μ, Σ u_i² z_i = (0; 1) with
/// z_i = (−a_i; 1) are linearised in (x, s, u); u is eliminated plane by plane. What is linear in u_i converges from a distant start,
/// where Newton on x and s alone would take very short steps (σ ≪ μ) or overshoot (σ ≫ μ).
///
/// The frame must be as for the analytic centre (AnalyticCentre.hpp), for the same reason: last axis along the contact
/// normal; on `Skewed` the caller turns to stiffAxes().
namespace polytope {

enum class BarrierStatus { Converged, RoundingLimited, Skewed, NotConverged };

/// Minimiser, factors and accuracy of the last step. Unknowns in the order of elimination: s, then the axes from the last to the first.
template <class R, int D> struct BarrierPoint {
	R x[D];
	R level = 0;           ///< s
	R lower[D + 1][D + 1]; ///< Hessian's LDLᵀ factors, at the iterate before the last step
	R pivot[D + 1];
	R change = 0; ///< largest relative change of a slack in the last step
};

/// Solves H v = b with the factors; b is overwritten.
template <class R, int D> POLYTOPE_INLINE void solveFactored(const BarrierPoint<R, D>& point, R (&b)[D + 1])
{
	for (int k = 1; k <= D; ++k)
		for (int j = 0; j < k; ++j)
			b[k] -= point.lower[k][j] * b[j];
	for (int k = 0; k <= D; ++k)
		b[k] /= point.pivot[k];
	for (int k = D - 1; k >= 0; --k)
		for (int j = k + 1; j <= D; ++j)
			b[k] -= point.lower[j][k] * b[j];
}

/// How the u_i are obtained: as μ/σ_i, or from the last iterate and the step that barrierMove() computed.
enum class BarrierWeights { FromSlacks, Stepped };

/// Slacks at the point (left in planes.slack), u_i (in planes.rate), Hessian and right-hand side of the Newton step. False
/// if a slack is not positive.
template <class R, int D, int W>
POLYTOPE_INLINE bool barrierSystem(const PairPlanes<R, D>& planes, R mu, BarrierWeights weights, R dualStep,
        const BarrierPoint<R, D>& point, R (&h)[D + 1][D + 1], R (&b)[D + 1])
{
	using V             = typename Lanes<R, W>::Type;
	constexpr int N     = D + 1;
	constexpr int count = N + N * (N + 1) / 2;
	V             X[D], sum[count];
	const V       level = broadcast<R, W>(point.level), Mu = broadcast<R, W>(mu), step = broadcast<R, W>(dualStep);
	for (int k = 0; k < D; ++k)
		X[k] = broadcast<R, W>(point.x[k]);
	for (V& s : sum)
		s = broadcast<R, W>(0);
	V smallest = broadcast<R, W>(R(padOffset));
	for (int i = 0; i < planes.total; i += W) {
		V z[N]; // z[0] = 1 is not used
		V sigma = load<R, W>(planes.offset + i);
		for (int k = 0; k < D; ++k) {
			const V a = load<R, W>(planes.normal[k] + i);
			z[D - k]  = -a;
			sigma -= a * X[k];
		}
		sigma += level;
		smallest        = minOf(smallest, sigma);
		const V inverse = R(1) / sigma;
		V       u       = Mu * inverse;
		if (weights == BarrierWeights::Stepped) {
			const V old = load<R, W>(planes.rate + i);
			u           = old + step * load<R, W>(planes.slack + i) * old;
		}
		store<R, W>(planes.slack + i, sigma);
		store<R, W>(planes.rate + i, u);
		const V square = u * u;
		const V w      = 2 * square * inverse;
		const V r      = 2 * Mu * u * inverse - square;
		sum[0] += r;
		sum[N] += w;
		for (int k = 1, next = N + 1; k < N; ++k) {
			const V wz = w * z[k];
			sum[k] += r * z[k];
			sum[next++] += wz;
			for (int j = 1; j <= k; ++j, ++next)
				sum[next] += wz * z[j];
		}
	}
	R total[count];
	horizontalSums<R, W>(sum, total);
	for (int k = 0, next = N; k < N; ++k) {
		b[k] = total[k];
		for (int j = 0; j <= k; ++j, ++next)
			h[k][j] = total[next];
	}
	b[0] -= 1;
	return horizontalMin<R, W>(smallest) > 0;
}

/// LDLᵀ of the lower triangle h into the point. False if digits cancel in these axes and these may be turned; if they have
/// been turned enough, a pivot below rounding is raised to that value: the step is shorter along an axis that no other plane bounds.
template <class R, int D> POLYTOPE_INLINE bool factoriseBarrier(const R (&h)[D + 1][D + 1], bool turnable, BarrierPoint<R, D>& point)
{
	for (int k = 0; k <= D; ++k) {
		for (int j = 0; j < k; ++j) {
			R sum = h[k][j];
			for (int i = 0; i < j; ++i)
				sum -= point.lower[k][i] * point.lower[j][i] * point.pivot[i];
			point.lower[k][j] = sum / point.pivot[j];
		}
		R rest = h[k][k];
		for (int i = 0; i < k; ++i)
			rest -= point.lower[k][i] * point.lower[k][i] * point.pivot[i];
		if (turnable && rest <= R(tolerance::cancellation) * h[k][k]) return false;
		point.pivot[k] = maxOf<R>(rest, R(tolerance::noise * tolerance::rounding) * h[k][k]);
	}
	return true;
}

/// What a step does to slacks and weights; Δu_i/u_i is left in planes.slack for barrierSystem().
template <class R> struct BarrierMove {
	R slackFall, weightFall; ///< largest −Δσ/σ and −Δu/u
	R change;                ///< largest |Δσ/σ|
	R mismatch;              ///< largest |μ/(σ u) − 1| before the step
};

template <class R, int D, int W> POLYTOPE_INLINE BarrierMove<R> barrierMove(const PairPlanes<R, D>& planes, R mu, const R (&step)[D + 1])
{
	using V = typename Lanes<R, W>::Type;
	V       X[D];
	const V level = broadcast<R, W>(step[0]), Mu = broadcast<R, W>(mu), zero = broadcast<R, W>(0);
	for (int k = 0; k < D; ++k)
		X[k] = broadcast<R, W>(step[D - k]);
	V least = zero, most = zero, fall = zero, low = zero, high = zero;
	for (int i = 0; i < planes.total; i += W) {
		V change = level;
		for (int k = 0; k < D; ++k)
			change -= load<R, W>(planes.normal[k] + i) * X[k];
		const V sigma    = load<R, W>(planes.slack + i);
		const V u        = load<R, W>(planes.rate + i);
		change           = change / sigma;
		const V mismatch = Mu / (sigma * u) - R(1);
		const V relative = mismatch - change;
		least            = minOf(least, change);
		most             = maxOf(most, change);
		low              = minOf(low, mismatch);
		high             = maxOf(high, mismatch);
		fall             = minOf(fall, relative);
		store<R, W>(planes.slack + i, relative);
	}
	const R down = -horizontalMin<R, W>(least), up = -horizontalMin<R, W>(-most);
	const R under = -horizontalMin<R, W>(low), over = -horizontalMin<R, W>(-high);
	return { down, -horizontalMin<R, W>(fall), maxOf<R>(down, up), maxOf<R>(under, over) };
}

/// Newton from the point (all σ_i > 0 there), u_i from the slacks or, after the axes were turned, as they are. Converged when
/// what remains after the last step is predicted below `accept`, relative to each slack. `turnable`: return Skewed where
/// other axes would keep more digits.
template <class R, int D, int W>
POLYTOPE_INLINE BarrierStatus minimiseBarrier(
        const PairPlanes<R, D>& planes, R mu, R accept, BarrierPoint<R, D>& point, BarrierWeights weights, bool turnable, int& iterations)
{
	R dualStep = 0, previous = R(padOffset);
	for (;;) {
		R h[D + 1][D + 1], step[D + 1];
		if (!barrierSystem<R, D, W>(planes, mu, weights, dualStep, point, h, step)) return BarrierStatus::NotConverged;
		if (!factoriseBarrier<R, D>(h, turnable, point)) return BarrierStatus::Skewed;
		solveFactored<R, D>(point, step);
		const BarrierMove<R> move = barrierMove<R, D, W>(planes, mu, step);
		if (!(move.change >= 0)) return BarrierStatus::NotConverged;
		const R reach   = R(tolerance::barrierStep);
		const R length  = move.slackFall > reach ? reach / move.slackFall : R(1);
		dualStep        = move.weightFall > reach ? reach / move.weightFall : R(1);
		weights         = BarrierWeights::Stepped;
		const bool full = length == 1 && dualStep == 1;
		const R    size = maxOf<R>(move.change, move.mismatch);
		// a full step that gains nothing is due to rounding; before the second small one convergence may not be quadratic yet
		const bool stalled = full && previous <= R(tolerance::stagnation) && size > previous / 2;
		if (stalled && size <= R(tolerance::stagnation)) return BarrierStatus::RoundingLimited;
		if (iterations >= tolerance::newtonIterations) return BarrierStatus::NotConverged;
		++iterations;
		point.level += length * step[0];
		for (int k = 0; k < D; ++k)
			point.x[k] += length * step[D - k];
		point.change = move.change;
		if (full && size * size <= accept) return BarrierStatus::Converged;
		previous = full ? size : R(padOffset);
	}
}

/// Φ, and n = Σ over body 1 of λ_i a_i = −Σ over body 2: at the minimiser dΦ = n·(motion of body 2's material point at x).
/// `held` = Σ λ_i |a_i across the last axis|²: how strongly the planes fix the point along the contact face.
template <class R, int D, int W>
POLYTOPE_INLINE R barrierValue(const PairPlanes<R, D>& planes, R mu, const BarrierPoint<R, D>& point, R* n, R& held)
{
	using std::sqrt;
	using V = typename Lanes<R, W>::Type;
	V       X[D];
	const V level = broadcast<R, W>(point.level), Mu = broadcast<R, W>(mu);
	for (int k = 0; k < D; ++k)
		X[k] = broadcast<R, W>(point.x[k]);
	R barrier = 0, sums[2][D];
	V across  = broadcast<R, W>(0);
	for (int body = 0; body < 2; ++body) {
		V sum[D + 1];
		for (V& s : sum)
			s = broadcast<R, W>(0);
		for (int i = planes.begin(body); i < planes.end(body); i += W) {
			V       a[D];
			const V sigma = slacksOf<R, D, W>(planes, i, X, a) + level;
			const V u     = Mu / sigma;
			sum[D] += u;
			for (int k = 0; k < D; ++k) {
				const V share = u * u * a[k];
				sum[k] += share;
				if (k < D - 1) across += share * a[k];
			}
		}
		for (int k = 0; k < D; ++k)
			sums[body][k] = horizontalSum<R, W>(sum[k]);
		barrier += mu * horizontalSum<R, W>(sum[D]);
	}
	for (int k = 0; k < D; ++k)
		n[k] = (sums[0][k] - sums[1][k]) / 2;
	held = horizontalSum<R, W>(across);
	return point.level + (barrier - 2 * sqrt(R(2)) * mu);
}

/// Largest distance that x moves across n per angle by which the bodies are tilted against each other about an axis across n [m/rad]:
/// a tilt moves the gradient in x by |n| across n, so it is |n| × the largest eigenvalue of the inverse Hessian across n.
template <class R, int D> POLYTOPE_INLINE R rockingArm(const BarrierPoint<R, D>& point, const R* n)
{
	using std::sqrt;
	const R length = sqrt(dot<R, D>(n, n));
	if (!(length > R(tolerance::direction))) return 0;
	R unit[D];
	for (int k = 0; k < D; ++k)
		unit[k] = n[k] / length;
	const Rotation<R, D> axes = axesAround<R, D>(unit);
	R                    c[D - 1][D - 1];
	for (int i = 0; i < D - 1; ++i) {
		R v[D + 1];
		v[0] = 0;
		for (int k = 0; k < D; ++k)
			v[D - k] = axes.m[i][k];
		solveFactored<R, D>(point, v);
		for (int j = 0; j < D - 1; ++j) {
			c[i][j] = 0;
			for (int k = 0; k < D; ++k)
				c[i][j] += axes.m[j][k] * v[D - k];
		}
	}
	if constexpr (D == 2) return length * c[0][0];
	else {
		const R half = (c[0][0] - c[1][1]) / 2, mixed = (c[0][1] + c[1][0]) / 2;
		return length * ((c[0][0] + c[1][1]) / 2 + sqrt(half * half + mixed * mixed));
	}
}

} // namespace polytope
