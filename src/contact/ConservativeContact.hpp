// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "centre/AnalyticCentre.hpp"
#include "centre/BarrierValue.hpp"
#include "contact/ContactTypes.hpp"
#include "contact/ContactSection.hpp"
#include "program/SimplexLp.hpp"
#include "contact/WarmStart.hpp"

#include <cmath>

/// The conservative contact: a force that is the gradient of an energy, from the value Φ of BarrierValue.hpp. Where Φ < 0
///
///     U = 2 k Φ²,      on body 2: F = −∂U/∂(centre 2) = −4 k Φ n at the point x,      n = Σ over body 1 of λ_i a_i,
///
/// and the opposite on body 1, also at x: by the envelope theorem x, s and λ may be held while the bodies move, and then
/// translation and rotation of a body move Φ as a force n at x works. As a geometry for linear laws: contact point x,
/// normal n/|n|, depth −4 Φ |n|. Face on face that depth is the overlap, so k is the stiffness; |n| ≤ ½, and a sharp corner
/// is softer: (2|n|)² k. docs/conservative-contact.md has the derivation.
namespace polytope {

/// Start of the Newton iterations: the last minimiser, carried by both bodies, or, if that has become worse, the linear
/// programme's optimum (x, s). Lifted until every slack has room.
template <class R, int D, int W>
POLYTOPE_INLINE void startBarrier(const PairPlanes<R, D>& planes, const ContactFrame<R, D>& f, const PairMemory& memory, bool warm,
        const R* x, R s, R mu, BarrierPoint<R, D>& start)
{
	const R room = R(tolerance::barrierRoom) * mu;
	R       smallest;
	if (warm) {
		carriedPoint<R, D>(f, memory.point, start.x);
		mostViolated<R, D, W>(planes, start.x, smallest);
		start.level = maxOf<R>(R(memory.level), room / 4 - smallest);
		if (start.level < s + R(tolerance::barrierDetour) * mu) return;
	}
	for (int k = 0; k < D; ++k)
		start.x[k] = x[k];
	mostViolated<R, D, W>(planes, x, smallest);
	start.level = maxOf<R>(s + room, room / 4 - smallest);
}

/// After the linear programme: x its point in the planes' frame, s its value, `below` a bound of it from the weights alone.
template <class R, int D, int W>
POLYTOPE_INLINE void conservativeContact(const PairInput& in, const ContactSettings& settings, PairPlanes<R, D>& planes,
        ContactFrame<R, D>& f, const R* x, R s, R below, PairMemory& memory, ContactWorkspace& workspace, ContactResult& out)
{
	using std::isfinite;
	using std::sqrt;
	const R smaller = minOf<R>(in.shape[0]->inscribedRadius(), in.shape[1]->inscribedRadius());
	const R given   = settings.barrier * smaller;
	const R mu      = maxOf<R>(given, R(tolerance::gapBarrier) * s);
	const R root2   = sqrt(R(2));
	out.inContact   = false;
	out.hasGeometry = false;
	out.status      = ContactStatus::Separated;
	if (!(given > 0) || !isfinite(given)) {
		out.status = ContactStatus::Failed;
		return;
	}
	// weak duality: any weights with Σ λ = 1, Σ λ a = 0 bound Φ from below by −Σ λ d + 2μ (Σ √λ − √2)
	R sum = -root2;
	for (int k = 0; k <= D; ++k)
		sum += sqrt(maxOf<R>(R(out.weights[k]), 0));
	if (!settings.geometryAcrossGap && below + 2 * mu * sum >= 0) {
		rememberWeights<D>(out.weights, memory);
		return;
	}

	BarrierPoint<R, D> point;
	startBarrier<R, D, W>(planes, f, memory, settings.warmStart && memory.hasPoint, x, s, mu, point);
	BarrierWeights weights = BarrierWeights::FromSlacks;
	BarrierStatus  solved;
	for (int turns = 0;; ++turns) {
		solved = minimiseBarrier<R, D, W>(
		        planes, mu, settings.newtonTolerance, point, weights, turns < tolerance::turns, out.newtonIterations);
		if (solved != BarrierStatus::Skewed) break;
		const Rotation<R, D> turn = stiffAxes<R, D>(planes);
		turnPlanes<R, D, W>(turn, planes);
		turnFrame(f, turn);
		turnVector<R, D>(turn, point.x);
		weights = BarrierWeights::Stepped; // as they were before the turn
	}
	out.decrement = point.change;
	if (solved == BarrierStatus::NotConverged) out.status = ContactStatus::CentreNotConverged;

	R       n[D], held;
	const R value    = barrierValue<R, D, W>(planes, mu, point, n, held);
	const R length   = norm<R, D>(n);
	out.barrierValue = value;
	memory.level     = point.level;
	memory.point     = { toBody<R, D>(f, 0, point.x), toBody<R, D>(f, 1, point.x) };
	memory.hasPoint  = solved != BarrierStatus::NotConverged;
	if (!(value < 0) && !settings.geometryAcrossGap) return;

	out.inContact     = value < 0;
	out.hasGeometry   = true;
	out.depth         = -4 * value * length;
	out.energy        = value < 0 ? 2 * value * value : R(0);
	out.rockingArm    = solved == BarrierStatus::NotConverged ? R(0) : rockingArm<R, D>(point, n); // its Hessian is the minimiser's
	out.dualDirection = worldDirection<R, D>(f, n);
	if (out.inContact && solved != BarrierStatus::NotConverged)
		out.status = solved == BarrierStatus::RoundingLimited ? ContactStatus::RoundingLimited : ContactStatus::Contact;
	// flat faces of thin bodies: far side planes' barrier is all that holds the point along the face, and planes tilted by their own
	// rounding pull at it
	if (out.status == ContactStatus::Contact && R(tolerance::noise * tolerance::rounding) * length > R(tolerance::stagnation) * held)
		out.status = ContactStatus::RoundingLimited;
	if (length > R(tolerance::direction)) {
		for (int k = 0; k < D; ++k)
			n[k] /= length;
	} else {
		// coincident bodies, or one wholly inside the other: no force, so any direction will do
		if (out.inContact) out.status = ContactStatus::NoDirection;
		for (int k = 0; k < D; ++k)
			n[k] = k == D - 1;
	}
	out.normal = worldDirection<R, D>(f, n);
	out.point  = worldPoint<R, D>(in, f, memory.point[f.home]);

	if (settings.section) {
		// the point may be outside by as much as s: of bodies grown by that
		const R grown = maxOf<R>(0, point.level + R(tolerance::gapSkin) * f.size);
		for (int i = 0; i < planes.total; ++i)
			planes.offset[i] += grown;
		contactSection<R, D>(in, f, planes, point.x, n, workspace, out);
	}
	failUnlessFinite<D>(memory, out);
}

} // namespace polytope
