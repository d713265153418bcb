// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "centre/AnalyticCentre.hpp"
#include "centre/IpoptCentre.hpp"
#include "contact/MoveInside.hpp"
#include "contact/OverlapPolygon.hpp"
#include "contact/OverlapPolyhedron.hpp"
#include "contact/WarmStart.hpp"
#include "program/SimplexLp.hpp"

/// The contact point by each of the rules of ContactPoint, from the linear program's point.
namespace polytope {

/// Newton from `start`, in axes turned to the overlap's own where the contact's axes lose digits; all that is in the frame turns with them.
template <class R, int D, int W> POLYTOPE_INLINE CentreStatus newtonCentre(const PairQuery<R, D>& q, R* start, R accept)
{
	for (int turns = 0;; ++turns) {
		const CentreStatus centre = analyticCentre<R, D, W>(q.planes, start, accept, q.out.newtonIterations, q.out.decrement);
		if (centre != CentreStatus::Skewed || turns == tolerance::turns) return centre;
		const Rotation<R, D> turn = stiffAxes<R, D>(q.planes);
		turnPlanes<R, D, W>(turn, q.planes);
		turnFrame<R, D, W>(q.frame, turn);
		turnVector<R, D>(turn, start);
		turnVector<R, D>(turn, q.x);
		turnVector<R, D>(turn, q.dual);
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

/// Where the search for the analytic centre begins: the last step's point, which the frame's origin is (`atOrigin`) or both bodies have
/// carried along, else the centre of the optimal basis' planes; from x, the linear program's point, as far as that is inside. `deep`: of
/// the overlap at x.
template <class R, int D, int W> POLYTOPE_INLINE void startOfCentre(const PairQuery<R, D>& q, bool atOrigin, R deep, R* start)
{
	if (atOrigin && smallestOffset<R, D, W>(q.planes) > R(tolerance::carriedRoom) * deep) {
		for (int k = 0; k < D; ++k)
			start[k] = 0;
		return;
	}
	R target[D];
	for (int k = 0; k < D; ++k)
		start[k] = q.x[k];
	if (q.settings.warmStart && q.memory.hasPoint) carriedPoint<R, D>(q.frame, q.memory.point, target);
	else simplexCentre<R, D>(q.basis, deep, q.x, target);
	moveInside<R, D, W>(q.planes, start, target);
}

/// Eq. 10: x from the linear program's point, or `start`, to the analytic centre by the chosen solver; all that is in the frame turns with it.
/// Where Newton does not converge, Ipopt, if the build has it.
template <class R, int D, int W> POLYTOPE_INLINE ContactStatus centrePoint(const PairQuery<R, D>& q, bool touching, R deep, R* start)
{
	R* const      x       = q.x;
	const bool    newton  = q.settings.solver == CentreSolver::Newton;
	ContactStatus outcome = touching ? ContactStatus::Contact : ContactStatus::Separated;
	// a remaining distance to the centre changes the depth by at most the same fraction
	const R            accept = minOf<R>(q.settings.newtonTolerance, R(tolerance::depth) * q.frame.size / deep);
	const CentreStatus centre = newton ? newtonCentre<R, D, W>(q, start, accept) : CentreStatus::NotConverged;
	if (centre == CentreStatus::NotConverged || centre == CentreStatus::Skewed) {
		// planes are rounded by the larger body's size: an overlap may be thinner, with no inside in this frame
		R room;
		mostViolated<R, D, W>(q.planes, x, room);
		const ContactStatus byIpopt = room > 0 ? ipoptCentre<R, D>(q.planes, x, q.out) : ContactStatus::RoundingLimited;
		if (byIpopt == ContactStatus::CentreByIpopt ? newton : room > 0 || touching) outcome = byIpopt;
		return outcome;
	}
	for (int k = 0; k < D; ++k)
		x[k] = start[k];
	return centre == CentreStatus::RoundingLimited && touching ? ContactStatus::RoundingLimited : outcome;
}

/// x: from the linear program's point to the contact point. `atOrigin`: the frame's origin is the last step's point.
template <class R, int D, int W> POLYTOPE_INLINE ContactStatus contactPoint(const PairQuery<R, D>& q, bool touching, bool atOrigin)
{
	if (q.settings.contactPoint == ContactPoint::AnalyticCentre) {
		const R deep = touching ? -q.basis.infeasibility : R(tolerance::gapSkin) * q.frame.size;
		R       start[D];
		startOfCentre<R, D, W>(q, atOrigin, deep, start);
		return centrePoint<R, D, W>(q, touching, deep, start);
	}
	if (q.settings.contactPoint == ContactPoint::Centroid) {
		OverlapMass<R, D> overlap;
		if (Overlap<R, D, W>(q.planes, q.x, 2 * q.frame.size, q.workspace).mass(q.x, overlap))
			for (int k = 0; k < D; ++k)
				q.x[k] = overlap.centroid[k];
	}
	return touching ? ContactStatus::Contact : ContactStatus::Separated; // x, the linear program's point, is the Chebyshev centre
}

} // namespace polytope
