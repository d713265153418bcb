// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "centre/AnalyticCentre.hpp"
#include "centre/IpoptCentre.hpp"
#include "contact/MoveInside.hpp"
#include "contact/OverlapVolume.hpp"
#include "contact/WarmStart.hpp"
#include "program/SimplexLp.hpp"

/// The contact point by each of the rules of ContactPoint, from the linear program's point.
namespace polytope {

/// Newton from `start`, in axes turned to the overlap's own where the contact's axes lose digits; x and dual turn with them.
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

/// Where the search for the analytic centre begins: the last step's point, which the frame's origin is (`atOrigin`) or both bodies have
/// carried along, else the centre of the optimal basis' planes; from x, the linear program's point, as far as that is inside. `deep`: of
/// the overlap at x.
template <class R, int D, int W>
POLYTOPE_INLINE void startOfCentre(const ContactSettings& settings, const PairPlanes<R, D>& planes, const ContactFrame<R, D>& f,
        const LpBasis<R, D>& basis, const PairMemory& memory, bool atOrigin, R deep, const R* x, R* start)
{
	if (atOrigin && smallestOffset<R, D, W>(planes) > R(tolerance::carriedRoom) * deep) {
		for (int k = 0; k < D; ++k)
			start[k] = 0;
		return;
	}
	R target[D];
	for (int k = 0; k < D; ++k)
		start[k] = x[k];
	if (settings.warmStart && memory.hasPoint) carriedPoint<R, D>(f, memory.point, target);
	else simplexCentre<R, D>(basis, deep, x, target);
	moveInside<R, D, W>(planes, start, target);
}

/// Eq. 10: x from the linear program's point, or `start`, to the analytic centre by the chosen solver; frame, planes and dual turn with it.
/// Where Newton does not converge, Ipopt, if the build has it.
template <class R, int D, int W>
POLYTOPE_INLINE ContactStatus centrePoint(const ContactSettings& settings, PairPlanes<R, D>& planes, ContactFrame<R, D>& f, bool touching,
        R deep, R* start, R* x, R* dual, ContactResult& out)
{
	ContactStatus outcome = touching ? ContactStatus::Contact : ContactStatus::Separated;
	// a remaining distance to the centre changes the depth by at most the same fraction
	const R            accept = minOf<R>(settings.newtonTolerance, R(tolerance::depth) * f.size / deep);
	const CentreStatus centre = settings.solver == CentreSolver::Newton ? newtonCentre<R, D, W>(planes, f, start, accept, x, dual, out)
	                                                                    : CentreStatus::NotConverged;
	if (centre == CentreStatus::NotConverged || centre == CentreStatus::Skewed) {
		// planes are rounded by the larger body's size: an overlap may be thinner, with no inside in this frame
		R room;
		mostViolated<R, D, W>(planes, x, room);
		const ContactStatus byIpopt = room > 0 ? ipoptCentre<R, D>(planes, x, out) : ContactStatus::RoundingLimited;
		if (byIpopt == ContactStatus::CentreByIpopt ? settings.solver == CentreSolver::Newton : room > 0 || touching)
			outcome = byIpopt;
		return outcome;
	}
	for (int k = 0; k < D; ++k)
		x[k] = start[k];
	return centre == CentreStatus::RoundingLimited && touching ? ContactStatus::RoundingLimited : outcome;
}

/// x: from the linear program's point to the contact point. `atOrigin`: the frame's origin is the last step's point.
template <class R, int D, int W>
POLYTOPE_INLINE ContactStatus contactPoint(const ContactSettings& settings, PairPlanes<R, D>& planes, ContactFrame<R, D>& f,
        const LpBasis<R, D>& basis, const PairMemory& memory, bool touching, bool atOrigin, R* x, R* dual, ContactWorkspace& workspace,
        ContactResult& out)
{
	if (settings.contactPoint == ContactPoint::AnalyticCentre) {
		const R deep = touching ? -basis.infeasibility : R(tolerance::gapSkin) * f.size;
		R       start[D];
		startOfCentre<R, D, W>(settings, planes, f, basis, memory, atOrigin, deep, x, start);
		return centrePoint<R, D, W>(settings, planes, f, touching, deep, start, x, dual, out);
	}
	if (settings.contactPoint == ContactPoint::Centroid) {
		OverlapMass<R, D> overlap;
		if (Overlap<R, D, W>(planes, x, 2 * f.size, workspace).mass(x, overlap))
			for (int k = 0; k < D; ++k)
				x[k] = overlap.centroid[k];
	}
	return touching ? ContactStatus::Contact : ContactStatus::Separated; // x, the linear program's point, is the Chebyshev centre
}

} // namespace polytope
