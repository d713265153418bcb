// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "centre/AnalyticCentre.hpp"
#include "centre/BarrierValue.hpp"
#include "contact/ContactSection.hpp"
#include "contact/ContactTypes.hpp"
#include "contact/MoveInside.hpp"
#include "contact/WarmStart.hpp"
#include "program/SimplexLp.hpp"

#include <cmath>

/// The conservative contact: a force that is the gradient of an energy, from the value Φ of BarrierValue.hpp. Where Φ < 0
///
///     U = 2 k Φ²,      on body 2: F = −∂U/∂(centre 2) = −4 k Φ n at the point x,      n = Σ over body 1 of λ_i a_i,
///
/// and the opposite on body 1, also at x: by the envelope theorem x, s and λ may be kept constant while the bodies move, and then
/// translation and rotation of a body change Φ by the work of a force n at x. As a geometry for linear laws: contact point x,
/// normal n/|n|, depth −4 Φ |n|. Face on face that depth is the overlap, so k is the stiffness; |n| ≤ ½, and a sharp corner
/// is softer: (2|n|)² k. docs/conservative-contact.md has the derivation.
namespace polytope {

/// Start of the Newton iterations: the last minimiser, carried by both bodies, or, if that has become worse, the linear
/// program's optimum (x, s). s is raised until every slack is positive by a margin.
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

/// Weak duality: any weights with Σ λ = 1, Σ λ a = 0 bound Φ from below by −Σ λ d + 2μ (Σ √λ − √2). `below`: −Σ λ d, at the least.
template <class R, int D> POLYTOPE_INLINE bool apartByWeights(const LpBasis<R, D>& basis, R below, R mu)
{
	using std::sqrt;
	R sum = -sqrt(R(2));
	for (int k = 0; k <= D; ++k)
		sum += sqrt(maxOf<R>(basis.weight[k], 0));
	return below + 2 * mu * sum >= 0;
}

/// Newton from `point`, in axes turned to the planes' own where the contact's axes lose digits; planes, frame and x turn with it.
template <class R, int D, int W>
POLYTOPE_INLINE BarrierStatus solveBarrier(const ContactSettings& settings, R mu, PairPlanes<R, D>& planes, ContactFrame<R, D>& f, R* x,
        BarrierPoint<R, D>& point, ContactResult& out)
{
	BarrierWeights weights = BarrierWeights::FromSlacks;
	for (int turns = 0;; ++turns) {
		const BarrierStatus solved = minimiseBarrier<R, D, W>(
		        planes, mu, settings.newtonTolerance, point, weights, turns < tolerance::turns, out.newtonIterations);
		if (solved != BarrierStatus::Skewed) return solved;
		const Rotation<R, D> turn = stiffAxes<R, D>(planes);
		turnPlanes<R, D, W>(turn, planes);
		turnFrame(f, turn);
		turnVector<R, D>(turn, point.x);
		turnVector<R, D>(turn, x);
		weights = BarrierWeights::Stepped; // as they were before the turn
	}
}

/// n to unit length; false for coincident bodies, or one wholly inside the other, where no direction separates them: any direction is used.
template <class R, int D> POLYTOPE_INLINE bool unitDirection(R length, R* n)
{
	const bool some = length > R(tolerance::direction);
	for (int k = 0; k < D; ++k)
		n[k] = some ? n[k] / length : R(k == D - 1);
	return some;
}

/// Status of a pair with Φ < 0, n its force direction of `length` before it is made a unit vector; `held`: how strongly
/// the planes fix the point along the contact face (see barrierValue()).
template <class R> POLYTOPE_INLINE ContactStatus barrierContactStatus(BarrierStatus solved, bool directed, R length, R held)
{
	if (!directed) return ContactStatus::NoDirection;
	if (solved == BarrierStatus::NotConverged) return ContactStatus::CentreNotConverged;
	// flat faces of thin bodies: only the barrier of the distant side planes fixes the point along the face, and rounding in the
	// planes' normals shifts it
	const bool drifts = R(tolerance::noise * tolerance::rounding) * length > R(tolerance::stagnation) * held;
	return solved == BarrierStatus::RoundingLimited || drifts ? ContactStatus::RoundingLimited : ContactStatus::Contact;
}

/// Section through the minimiser, or, where that is outside the overlap, through the last point inside on the way there from x, the linear
/// program's point. Bodies apart (`s` above zero) are grown until they just overlap.
template <class R, int D, int W>
POLYTOPE_INLINE void conservativeSection(const PairInput& in, const ContactSettings& settings, const ContactFrame<R, D>& f,
        PairPlanes<R, D>& planes, R s, const R* target, const R* n, R* x, ContactWorkspace& workspace, ContactResult& out)
{
	const R grown = maxOf<R>(0, s + R(tolerance::gapSkin) * f.size);
	for (int i = 0; i < planes.total; ++i)
		planes.offset[i] += grown;
	moveInside<R, D, W>(planes, x, target);
	contactSection<R, D>(in, settings, f, planes, x, n, target, workspace.polygons(sectionNumbers(planes.total)), workspace, out);
}

/// After the linear program, whose point x is in the planes' frame.
template <class R, int D, int W>
POLYTOPE_INLINE void conservativeContact(const PairInput& in, const ContactSettings& settings, PairPlanes<R, D>& planes,
        ContactFrame<R, D>& f, const LpBasis<R, D>& basis, R* x, R reach, PairMemory& memory, ContactWorkspace& workspace,
        ContactResult& out)
{
	using std::isfinite;
	const R    s     = basis.infeasibility;
	const R    given = settings.barrier * minOf<R>(in.shape[0]->inscribedRadius(), in.shape[1]->inscribedRadius());
	const R    mu    = maxOf<R>(given, R(tolerance::gapBarrier) * s);
	const bool may   = given > 0 && isfinite(given);
	out.inContact    = false;
	out.hasGeometry  = false;
	out.status       = may ? ContactStatus::Separated : ContactStatus::Failed;
	if (!may) return;
	if (!settings.geometryAcrossGap && apartByWeights<R, D>(basis, lowerBound<R, D>(basis, reach), mu)) {
		rememberWeights<D>(basis.weight, memory);
		return;
	}

	BarrierPoint<R, D> point;
	startBarrier<R, D, W>(planes, f, memory, settings.warmStart && memory.hasPoint, x, s, mu, point);
	const BarrierStatus solved    = solveBarrier<R, D, W>(settings, mu, planes, f, x, point, out);
	const bool          converged = solved != BarrierStatus::NotConverged;
	out.decrement                 = point.change;
	if (!converged) out.status = ContactStatus::CentreNotConverged;

	R       n[D], held;
	const R value    = barrierValue<R, D, W>(planes, mu, point, n, held);
	const R length   = norm<R, D>(n);
	out.barrierValue = value;
	memory.level     = point.level;
	memory.point     = { toBody<R, D>(f, 0, point.x), toBody<R, D>(f, 1, point.x) };
	memory.hasPoint  = converged;
	if (!(value < 0) && !settings.geometryAcrossGap) return;

	out.inContact   = value < 0;
	out.hasGeometry = true;
	// coincident bodies are in equilibrium; a normal with the length of rounding is enough to start separating them
	out.depth           = -4 * value * maxOf<R>(length, R(tolerance::direction));
	out.energy          = value < 0 ? 2 * value * value : R(0);
	out.rockingArm      = converged ? rockingArm<R, D>(point, n) : R(0); // its Hessian is the minimiser's
	out.dualDirection   = worldDirection<R, D>(f, n);
	const bool directed = unitDirection<R, D>(length, n);
	if (out.inContact) out.status = barrierContactStatus<R>(solved, directed, length, held);
	out.normal = worldDirection<R, D>(f, n);
	out.point  = worldPoint<R, D>(in, f, memory.point[f.home]);

	if (settings.section) conservativeSection<R, D, W>(in, settings, f, planes, s, point.x, n, x, workspace, out);
	failUnlessFinite<D>(memory, out);
}

} // namespace polytope
