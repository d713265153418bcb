// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "contact/PairQuery.hpp"
#include "program/BasisSolver.hpp"
#include "program/PlaneCode.hpp"

#include <cmath>

/// What a query takes from the pair's last one (PairMemory) and leaves to the next: it makes answers cheaper, never different.
namespace polytope {

/// Marks the result and the memory as unusable.
POLYTOPE_INLINE void fail(PairMemory& memory, ContactResult& out)
{
	out.status      = ContactStatus::Failed;
	out.inContact   = false;
	out.hasGeometry = false;
	memory.hasBasis = memory.hasPoint = false;
}

/// A result with values that are not finite, as from poses that are not rigid motions, counts as failed.
template <int D> POLYTOPE_INLINE void failUnlessFinite(PairMemory& memory, ContactResult& out)
{
	using std::isfinite;
	Real all = out.depth + out.area + out.energy + out.turningArm;
	for (int k = 0; k < D; ++k)
		all += out.point[k] + out.normal[k] + out.dualDirection[k] + out.sectionCentroid[k];
	if (!isfinite(all)) fail(memory, out);
}

/// For a pair that is apart: remembers the weights of its basis. The basis itself is in the memory already.
template <int D, class Weights> POLYTOPE_INLINE void rememberWeights(const Weights& weights, PairMemory& memory)
{
	memory.hasBasis = true;
	memory.hasPoint = false;
	for (int k = 0; k < D; ++k)
		memory.weights[k] = weights[k];
}

/// `point`: the contact point, where the next step begins; `n`: unit normal; both in the planes' frame.
template <class R, int D> POLYTOPE_INLINE void publishContact(const PairQuery<R, D>& q, ContactStatus status, const R* point, const R* n)
{
	const ContactFrame<R, D>& f = q.frame;
	q.out.status                = status;
	q.memory.point              = { toBody<R, D>(f, 0, point), toBody<R, D>(f, 1, point) };
	q.memory.hasPoint           = true;
	q.out.normal                = worldDirection<R, D>(f, n);
	q.out.point                 = worldPoint<R, D>(q.in, f, q.memory.point[f.home]);
}

template <class R, int D> POLYTOPE_INLINE void recallBasis(const PairPlanes<R, D>& planes, const PairMemory& memory, LpBasis<R, D>& basis)
{
	for (int k = 0; k <= D; ++k)
		basis.plane[k] = rowOfCode(memory.basis[k], planes.first);
}

template <class R, int D>
POLYTOPE_INLINE void rememberBasis(const PairPlanes<R, D>& planes, const LpBasis<R, D>& basis, PairMemory& memory, ContactResult& out)
{
	for (int k = 0; k <= D; ++k) {
		memory.basis[k] = codeOfRow(basis.plane[k], planes.first);
		out.weights[k]  = basis.weight[k];
	}
	memory.hasBasis = true;
	out.basis       = memory.basis;
}

/// Whether the last step's weights alone still separate the bodies, without a basis: any λ ≥ 0 with Σ λ = 1 bounds s within
/// L of the smaller body's centre from below by −Σ λ d − |Σ λ a| L. A common point would be within the body's size. Where s* is
/// attained, that body grown by s* < |centre2| + size about its inscribed ball of radius r has the point: so L < 2 size (2 +
/// (|centre2| + size)/r) there, which gives a `bound` of s*, zero at least.
template <class R, int D>
POLYTOPE_INLINE bool separatedByWeights(const PlacedPair& in, const PairMemory& memory, int home, R size, R reach, Real& bound)
{
	using std::sqrt;
	R sum[2][D] = {}, world[2][D];
	R least = 0, square = 0, rest = 1;
	for (int k = 0; k <= D; ++k) {
		const int          index  = planeOfCode(memory.basis[k]);
		const bool         second = bodyOfCode(memory.basis[k]) == 1;
		const ConvexShape& shape  = *in.shape[second];
		const R            weight = maxOf<R>(k < D ? R(memory.weights[k]) : rest, 0);
		// added to both sums, to one as zero: selecting the sum would go through memory
		const R share[2] = { second ? R(0) : weight, second ? weight : R(0) };
		rest -= weight;
		least -= weight * shape.offsetArray()[index];
		for (int j = 0; j < D; ++j) {
			const R a = shape.normalArray(j)[index];
			sum[0][j] += share[0] * a;
			sum[1][j] += share[1] * a;
		}
	}
	for (int body = 0; body < 2; ++body)
		toWorldAxes<R, D>(*in.rotation[body], sum[body], world[body]);
	for (int j = 0; j < D; ++j) {
		const R residual = world[0][j] + world[1][j];
		square += residual * residual;
		least += (home == 0 ? -world[1][j] : world[0][j]) * (*in.centre2)[j];
	}
	least -= R(tolerance::contact) * reach;
	R apart = size;
	for (int j = 0; j < D; ++j)
		apart += abs((*in.centre2)[j]);
	const R left = sqrt(square);
	if (!(least > left * size)) return false;
	bound = maxOf<R>(least - left * 2 * size * (2 + apart / in.shape[home]->inscribedRadius()), 0);
	return true;
}

/// A point that both bodies carry along, in the planes' frame: half-way between where each has taken it. `own`: in each body's frame.
template <class R, int D> POLYTOPE_INLINE void carriedPoint(const ContactFrame<R, D>& f, const std::array<Vector3, 2>& own, R* out)
{
	R carried[2][D];
	for (int body = 0; body < 2; ++body)
		fromBody<R, D>(f, body, own[body], carried[body]);
	for (int k = 0; k < D; ++k)
		out[k] = (carried[0][k] + carried[1][k]) / 2;
}

/// The frame of the last step's contact: origin half-way between where both bodies have carried the contact point (`own`, in
/// each body's frame), last axis along `direction` (world axes). False where there is no such frame: the bodies disagree on
/// the point, having been moved by more than a step.
template <class R, int D, int W>
POLYTOPE_INLINE bool followContact(const PlacedPair& in, ContactFrame<R, D>& f, const std::array<Vector3, 2>& own, const Vector3& direction)
{
	R carried[2][D], half[D], n[D], middle[D];
	for (int body = 0; body < 2; ++body)
		toWorldAxes<R, D>(*in.rotation[body], own[body], carried[body]);
	for (int k = 0; k < D; ++k) {
		half[k] = (carried[1][k] + (*in.centre2)[k] - carried[0][k]) / 2;
		n[k]    = direction[k];
	}
	const R near   = R(tolerance::samePoint) * f.size / 2;
	const R length = norm<R, D>(n);
	if (!(dot<R, D>(half, half) < near * near) || !(length > R(tolerance::direction)) || !(length < R(padOffset))) return false;
	const R scale = 1 / length;
	for (int k = 0; k < D; ++k)
		n[k] *= scale;
	setAxes<R, D, W>(in, f, transposed<R, D>(axesAround<R, D>(n)));
	for (int k = 0; k < D; ++k)
		middle[k] = f.home == 0 ? carried[0][k] + half[k] : carried[1][k] - half[k];
	for (int body = 0; body < 2; ++body)
		toOwnAxes<R, D>(*in.rotation[body], middle, f.origin[body]);
	return dot<R, D>(middle, middle) < 2 * f.size * f.size;
}

/// Whether an overlap that is `thin` (over the bodies' size) is so oblique in the frame that its Hessian is not graded there.
template <class R, int D> POLYTOPE_INLINE bool leans(const R* dual, R thin)
{
	const R steep  = R(tolerance::lean) * thin * dual[D - 1];
	R       across = 0;
	for (int k = 0; k + 1 < D; ++k)
		across += dual[k] * dual[k];
	return !(across < steep * steep);
}

/// Slack of the frame's origin.
template <class R, int D, int W> POLYTOPE_INLINE R smallestOffset(const PairPlanes<R, D>& planes)
{
	auto least = load<R, W>(planes.offset);
	for (int i = W; i < planes.total; i += W)
		least = minOf(least, load<R, W>(planes.offset + i));
	return horizontalMin<R, W>(least);
}

} // namespace polytope
