// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "AnalyticCentre.hpp"
#include "BoundingPlanes.hpp"
#include "ConservativeContact.hpp"
#include "ContactNormal.hpp"
#include "FirstBasis.hpp"
#include "IpoptCentre.hpp"
#include "OverlapCentroid.hpp"
#include "PenetrationDepth.hpp"
#include "SimplexLp.hpp"
#include "WarmStart.hpp"

#include <chrono>
#include <cmath>

/// The stages of one query in order, for one dimension D and lane width W. Included by ContactQuery.cpp alone, which
/// compiles it once per instruction set.
namespace polytope {

inline long nanoseconds()
{
	return long(std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now().time_since_epoch()).count());
}

/// What is said of s* for a pair that a basis separates: a bound from below wherever s* is taken on, rounding of the weights
/// included, above `least`.
template <class R, int D> POLYTOPE_INLINE R separatedBound(const LpBasis<R, D>& basis, R reach, const PairInput& in, R least)
{
	R noise = 0;
	for (int k = 0; k < D; ++k)
		reach += abs((*in.centre2)[k]);
	for (int k = 0; k <= D; ++k)
		noise += basis.noise[k];
	return maxOf<R>(lowerBound<R, D>(basis, reach) - noise * reach, least);
}

/// n_λ = Σ over body 1 of λ_k a_k in the planes' frame.
template <class R, int D> POLYTOPE_INLINE void dualDirection(const PairPlanes<R, D>& planes, const LpBasis<R, D>& basis, R* dual)
{
	R share[D + 1];
	for (int k = 0; k <= D; ++k)
		share[k] = basis.plane[k] < planes.first ? basis.weight[k] : R(0);
	for (int j = 0; j < D; ++j) {
		dual[j] = share[0] * basis.normal[j][0];
		for (int k = 1; k <= D; ++k)
			dual[j] += share[k] * basis.normal[j][k];
	}
}

/// Goes from x (inside) towards `target` as far as it stays inside.
template <class R, int D, int W> POLYTOPE_INLINE void moveInside(const PairPlanes<R, D>& planes, R* x, const R* target)
{
	using V = typename Lanes<R, W>::Type;
	V X[D], step[D];
	for (int k = 0; k < D; ++k) {
		X[k]    = broadcast<R, W>(x[k]);
		step[k] = broadcast<R, W>(target[k] - x[k]);
	}
	V largest = broadcast<R, W>(R(tolerance::interiorStep));
	for (int i = 0; i < planes.total; i += W) {
		V rate  = load<R, W>(planes.normal[0] + i) * step[0];
		V slack = load<R, W>(planes.offset + i) - load<R, W>(planes.normal[0] + i) * X[0];
		for (int k = 1; k < D; ++k) {
			const V a = load<R, W>(planes.normal[k] + i);
			rate += a * step[k];
			slack -= a * X[k];
		}
		largest = maxOf(largest, V(rate / slack));
	}
	// largest = 1/t_max where a plane is met before the target
	const R t = R(tolerance::interiorStep) / -horizontalMin<R, W>(-largest);
	if (!(t > 0)) return;
	for (int k = 0; k < D; ++k)
		x[k] += t * (target[k] - x[k]);
}

/// Newton from `start`, in axes turned to the overlap's own where those of the contact do not do; x and dual turn with them.
template <class R, int D, int W>
POLYTOPE_INLINE CentreStatus newtonCentre(
        PairPlanes<R, D>& planes, ContactFrame<R, D>& f, R* start, R accept, R* x, R* dual, ContactResult& out)
{
	for (int turns = 0;; ++turns) {
		const CentreStatus centre = analyticCentre<R, D, W>(planes, start, accept, out.newtonIterations, out.decrement);
		if (centre != CentreStatus::Skewed || turns == tolerance::turns) return centre;
		const Rotation<R, D> turn = stiffAxes<R, D>(planes);
		turnPlanes<R, D, W>(turn, planes);
		turnFrame<R, D>(f, turn);
		turnVector<R, D>(turn, start);
		turnVector<R, D>(turn, x);
		turnVector<R, D>(turn, dual);
	}
}

/// Ipopt from the LP's point x, which is left alone where it fails.
template <class R, int D> POLYTOPE_INLINE ContactStatus ipoptCentre(const PairPlanes<R, D>& planes, R* x, ContactResult& out)
{
	const IpoptOutcome outcome = ipoptCentre(D, planes.total, planes.normal, planes.offset, x, out.ipoptIterations);
	if (outcome == IpoptOutcome::NotAvailable) return ContactStatus::IpoptNotAvailable;
	out.ipoptSolved = true;
	return outcome == IpoptOutcome::Converged ? ContactStatus::CentreByIpopt : ContactStatus::CentreNotConverged;
}

template <class R, int D> POLYTOPE_INLINE PairPlanes<R, D> pairRows(const PairInput& in, ContactWorkspace& workspace)
{
	PairPlanes<R, D> planes;
	planes.first = in.shape[0]->paddedCount();
	planes.total = planes.first + in.shape[1]->paddedCount();
	R* row       = workspace.rows(D + 3, planes.total);
	for (int k = 0; k < D; ++k)
		planes.normal[k] = row + k * planes.total;
	planes.offset = row + D * planes.total;
	planes.slack  = row + (D + 1) * planes.total;
	planes.rate   = row + (D + 2) * planes.total;
	return planes;
}

/// Moves internal faces out of reach, and back; `offset`: room for what they had.
template <class R, int D> POLYTOPE_INLINE void takeOut(PairPlanes<R, D>& planes, const InternalPlanes& internal, R* offset)
{
	for (int body = 0, next = 0; body < 2; ++body)
		for (int k = 0; k < internal.count[body]; ++k) {
			R& one         = planes.offset[planes.begin(body) + internal.plane[body][k]];
			offset[next++] = one;
			one            = R(padOffset);
		}
}

template <class R, int D> POLYTOPE_INLINE void putBack(PairPlanes<R, D>& planes, const InternalPlanes& internal, const R* offset)
{
	for (int body = 0, next = 0; body < 2; ++body)
		for (int k = 0; k < internal.count[body]; ++k)
			planes.offset[planes.begin(body) + internal.plane[body][k]] = offset[next++];
}

/// Largest depth of a contact of two flush faces, which is what is left where internal faces are taken out.
template <class R> POLYTOPE_INLINE R internalDepth(const PairInput& in)
{
	return 2 * R(tolerance::thinContact) * minOf<R>(in.shape[0]->inscribedRadius(), in.shape[1]->inscribedRadius());
}

/// Depth along n through the contact point, whose slacks are in the planes (an overlap thinner than the planes' rounding may have its
/// point outside).
template <class R, int D, int W> POLYTOPE_INLINE R chord(const PairPlanes<R, D>& planes, const R* n)
{
	return maxOf<R>(0, exitDistance<R, D, W>(planes, 0, n, 1) + exitDistance<R, D, W>(planes, 1, n, -1));
}

template <class R, int D, int W>
POLYTOPE_INLINE void contactKernel(
        const PairInput& in, const ContactSettings& settings, PairMemory& memory, ContactWorkspace& workspace, ContactResult& out)
{
	const long         started   = settings.timed ? nanoseconds() : 0;
	ContactFrame<R, D> f         = unplacedFrame<R, D>(in);
	const bool         paper     = settings.contactModel == ContactModel::Paper; // the conservative contact begins where Φ = 0
	const R            tolerance = paper ? settings.tolerance * f.size : R(0);
	const R            dismiss   = settings.geometryAcrossGap ? R(padOffset) : -tolerance;
	// no point of the overlap is farther from any plane (a wall's only plane: than the body is wide)
	const R larger = in.shape[1 - f.home]->boundingRadius();
	const R reach  = 2 * (larger < R(padOffset) ? larger : f.size);

	const bool known = settings.warmStart && memory.hasBasis;
	if (known && !memory.hasPoint && !settings.geometryAcrossGap
	        && heldApart<R, D>(in, memory, f.home, f.size, reach, out.infeasibility)) {
		out.dismissed = true;
		if (settings.timed) out.lpNanoseconds = nanoseconds() - started;
		return;
	}

	// 1. the last step's contact, where both bodies have carried it along: its frame and basis
	LpBasis<R, D>    basis;
	PairPlanes<R, D> planes = pairRows<R, D>(in, workspace);
	R                dual[D];
	setCentres<R, D>(in, f);
	bool followed = known && memory.hasPoint && followContact<R, D>(in, f, memory.point, memory.dual);
	bool solved   = false;
	bool far      = false;
	if (followed) {
		placePair<R, D, W>(in, f, planes);
		recallBasis<R, D>(planes, memory, basis);
		followed = solved = solveBasis<R, D>(planes, basis) && dualFeasible<R, D>(basis);
	}
	if (!followed) {
		if (!finitePose<R, D>(in)) { // planes that are no numbers hold nobody off
			fail(memory, out);
			return;
		}
		homeFrame<R, D>(in, f);
		// else a first basis, the last step's or the smaller inscribed ball's, in the smaller body's frame
		const bool warm = known && startFrom<R, D>(in, f, memory.basis, basis, dual) && dualFeasible<R, D>(basis);
		if (!warm && startFromOwnBall<R, D>(in, f, memory, basis)) {
			placePairAtHome<R, D, W>(in, f, planes);
			recallBasis<R, D>(planes, memory, basis);
			solved = true;
		} else {
			if (!warm) startFromBall<R, D>(in, f, memory, basis, dual);
			const R least = memory.hasBasis ? lowerBound<R, D>(basis, reach) : -R(padOffset);
			if (least > dismiss) {
				out.status        = ContactStatus::Separated;
				out.infeasibility = separatedBound<R, D>(basis, reach, in, -tolerance);
				out.dismissed     = true;
				rememberWeights<D>(basis.weight, memory);
				if (settings.timed) out.lpNanoseconds = nanoseconds() - started;
				return;
			}

			// 2. all planes, in a frame turned and moved by what that basis knows
			// (its point may be far outside both bodies: there every plane would lose digits)
			const R away = maxOf<R>(1, norm<R, D>(basis.point) / f.size);
			far          = away > 1;
			R origin[D];
			for (int k = 0; k < D; ++k)
				origin[k] = basis.point[k] / away;
			const Rotation<R, D> turn = aim<R, D>(f, dual, origin);
			placePair<R, D, W>(in, f, planes);
			recallBasis<R, D>(planes, memory, basis);
			solved = memory.hasBasis && moveBasis<R, D>(planes, turn, origin, -R(tolerance::thin) * f.size, basis);
		}
	}

	// 3. LP
	const int limit = maxOf<int>(tolerance::pivotsAtLeast, tolerance::pivotsPerPlane * planes.total);
	LpStatus  lp    = LpStatus::Undecided;
	if (solved) lp = solveLp<R, D, W>(planes, basis, f.size, dismiss, reach, limit, out.simplexPivots);
	if (lp == LpStatus::Undecided) {
		if (solveWide<R, D>(planes, basis, f.size, limit, out.simplexPivots)) lp = LpStatus::Optimal;
		else if (!memory.hasBasis) { // no basis at all
			fail(memory, out);
			return;
		}
	}
	rememberBasis<R, D>(planes, basis, memory, out);
	const long lpDone   = settings.timed ? nanoseconds() : 0;
	out.lpNanoseconds   = lpDone - started;
	out.infeasibility   = lp == LpStatus::Separated ? separatedBound<R, D>(basis, reach, in, -tolerance) : basis.infeasibility;
	const bool touching = basis.infeasibility < -tolerance;
	dualDirection<R, D>(planes, basis, dual);
	out.dualDirection = worldDirection<R, D>(f, dual);
	if (!touching && !settings.geometryAcrossGap) {
		out.status = lp == LpStatus::Undecided ? ContactStatus::LpNotConverged : ContactStatus::Separated;
		rememberWeights<D>(basis.weight, memory);
		return;
	}
	memory.dual     = out.dualDirection;
	out.inContact   = touching;
	out.hasGeometry = true;

	// 4. the frame for the centre: turned to the optimum's dual direction, origin at the LP's point
	R x[D];
	for (int k = 0; k < D; ++k)
		x[k] = basis.point[k];
	// (where the overlap is thick, or has hardly turned, the frame there is does: its digits are enough; a far point was not its origin)
	const R    thickness = -basis.infeasibility / f.size;
	const bool skew      = followed ? leans<R, D>(dual, thickness) : out.simplexPivots > 0 || far;
	const bool anew      = skew && !(thickness > R(tolerance::thin));
	if (anew) {
		const Rotation<R, D> turn = aim<R, D>(f, dual, x);
		placePair<R, D, W>(in, f, planes);
		R turned[D];
		rotate<R, D>(turn, dual, turned);
		for (int k = 0; k < D; ++k) {
			dual[k] = turned[k];
			x[k]    = 0;
		}
	}
	if (settings.contactModel == ContactModel::Conservative) {
		conservativeContact<R, D, W>(
		        in, settings, planes, f, x, basis.infeasibility, lowerBound<R, D>(basis, reach), memory, workspace, out);
		if (settings.timed) out.centreNanoseconds = nanoseconds() - lpDone;
		return;
	}
	// a separated pair gets the point, normal and section it would have if both bodies were grown until they just overlap
	R grown = 0;
	if (!touching) {
		grown = basis.infeasibility + R(tolerance::gapSkin) * f.size;
		for (int i = 0; i < planes.total; ++i)
			planes.offset[i] += grown;
	}

	// 5. contact point
	ContactStatus outcome = touching ? ContactStatus::Contact : ContactStatus::Separated;
	if (lp == LpStatus::Undecided) outcome = ContactStatus::LpNotConverged;
	else if (settings.contactPoint == ContactPoint::AnalyticCentre) {
		const R deep = touching ? -basis.infeasibility : R(tolerance::gapSkin) * f.size;
		R       start[D], target[D];
		for (int k = 0; k < D; ++k)
			start[k] = x[k];
		if (followed && !anew && smallestOffset<R, D, W>(planes) > R(tolerance::carriedRoom) * deep) {
			// the frame's origin is the carried point
			for (int k = 0; k < D; ++k)
				start[k] = 0;
		} else {
			if (settings.warmStart && memory.hasPoint) carriedPoint<R, D>(f, memory.point, target);
			else simplexCentre<R, D>(basis, deep, x, target);
			moveInside<R, D, W>(planes, start, target);
		}
		// what is left of the way to the centre moves the depth by at most that part of itself
		const R            accept = minOf<R>(settings.newtonTolerance, R(tolerance::depth) * f.size / deep);
		const CentreStatus centre = settings.solver == CentreSolver::Newton
		        ? newtonCentre<R, D, W>(planes, f, start, accept, x, dual, out)
		        : CentreStatus::NotConverged;
		if (centre == CentreStatus::NotConverged || centre == CentreStatus::Skewed) {
			// planes are rounded by the larger body's size: an overlap may be thinner, with no inside in this frame
			R room;
			mostViolated<R, D, W>(planes, x, room);
			const ContactStatus byIpopt = room > 0 ? ipoptCentre<R, D>(planes, x, out) : ContactStatus::RoundingLimited;
			if (byIpopt == ContactStatus::CentreByIpopt ? settings.solver == CentreSolver::Newton : room > 0 || touching)
				outcome = byIpopt;
		} else {
			if (centre == CentreStatus::RoundingLimited && touching) outcome = ContactStatus::RoundingLimited;
			for (int k = 0; k < D; ++k)
				x[k] = start[k];
		}
	} else if (settings.contactPoint == ContactPoint::Centroid) {
		overlapCentroid<R, D>(planes, x, 2 * f.size, workspace.polygons(4 * (planes.total + 5)));
	}

	if (settings.timed) out.centreNanoseconds = nanoseconds() - lpDone;

	if (settings.bounding && touching) boundingPlanes<R, D, W>(planes, x, *settings.bounding);

	// 6. normal and depth, without internal faces where what is left bounds the contact
	R             n[D];
	ContactStatus normal = outcome;
	if (settings.internal && touching) {
		R internalOffset[2 * BoundingPlanes::most];
		takeOut<R, D>(planes, *settings.internal, internalOffset);
		normal    = contactNormal<R, D, W>(in, settings, planes, f, x, dual, n);
		out.depth = chord<R, D, W>(planes, n);
		putBack<R, D>(planes, *settings.internal, internalOffset);
	}
	const bool bounded = settings.internal && touching && out.depth < internalDepth<R>(in);
	if (!bounded) normal = contactNormal<R, D, W>(in, settings, planes, f, x, dual, n);
	if (outcome == ContactStatus::Contact) outcome = normal;
	if (touching) {
		if (!bounded) out.depth = chord<R, D, W>(planes, n);
	} else {
		// where the normal is no way out the chord says nothing; the bodies are s*/|n_λ| apart at the least
		const R apart = maxOf<R>(basis.infeasibility, 0) / maxOf<R>(norm<R, D>(dual), R(tolerance::direction));
		out.depth     = minOf<R>(exitOfGrown<R, D>(planes, 0, n, 1, grown) + exitOfGrown<R, D>(planes, 1, n, -1, grown), -apart);
	}

	out.status      = outcome;
	memory.point    = { toBody<R, D>(f, 0, x), toBody<R, D>(f, 1, x) };
	memory.hasPoint = true;
	out.normal      = worldDirection<R, D>(f, n);
	out.point       = worldPoint<R, D>(in, f, memory.point[f.home]);

	// 7. contact section, for laws that ask for it
	if (settings.section) contactSection<R, D>(in, f, planes, x, n, workspace, out);
	failUnlessFinite<D>(memory, out);
}

} // namespace polytope
