// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "contact/ContactNormal.hpp"
#include "contact/ContactPointRules.hpp"
#include "contact/ContactSection.hpp"
#include "contact/PenetrationDepth.hpp"
#include "contact/PhaseOne.hpp"
#include "contact/SurfaceContact.hpp"

#include <chrono>

/// The stages of one query in order, for one dimension D and lane width W. Included by ContactQuery.cpp alone, which
/// compiles it once per instruction set.
namespace polytope {

/// Time of the stages, if asked for.
class StageTimer {
public:
	explicit StageTimer(bool on) : on_(on), last_(on ? now() : 0) { }

	/// Since the last stage's end [ns].
	void end(long& stage)
	{
		if (!on_) return;
		const long time = now();
		stage           = time - last_;
		last_           = time;
	}

private:
	static long now()
	{
		return long(
		        std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now().time_since_epoch()).count());
	}

	bool on_;
	long last_;
};

template <class R, int D> POLYTOPE_INLINE PairPlanes<R, D> pairRows(const PlacedPair& in, ContactWorkspace& workspace)
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

/// Whether the last step's weights still separate the bodies, checked before any plane is transformed.
template <class R, int D>
POLYTOPE_INLINE bool dismissedByLastWeights(const PlacedPair& in, const ContactSettings& settings, const PairMemory& memory,
        const ContactFrame<R, D>& f, const ProgramLimits<R>& limits, ContactResult& out)
{
	if (!settings.warmStart || !memory.hasBasis || memory.hasPoint || settings.geometryAcrossGap) return false;
	if (!separatedByWeights<R, D>(in, memory, f.home, f.size, limits.reach, out.infeasibility)) return false;
	out.dismissed = true;
	return true;
}

/// Turns the frame to the optimum's dual direction and moves its origin to x, unless the overlap is so thick, or has turned so little, that
/// the digits of the present frame are enough. Whether it did; x and dual go along.
template <class R, int D, int W> POLYTOPE_INLINE bool alignFrame(const PairQuery<R, D>& q, StartBasis start, bool pivoted)
{
	const R thickness = -q.basis.infeasibility / q.frame.size;
	if (thickness > R(tolerance::thin)) return false;
	const bool aimed = start == StartBasis::LastContact ? !leans<R, D>(q.dual, thickness) : !pivoted && start != StartBasis::AimedFar;
	if (aimed) return false;
	const Rotation<R, D> turn = aim<R, D, W>(q.frame, q.dual, q.x);
	placePair<R, D, W>(q.in, q.frame, q.planes);
	turnVector<R, D>(turn, q.dual);
	for (int k = 0; k < D; ++k)
		q.x[k] = 0;
	return true;
}

/// Contact point, normal, depth and section of the paper's contact (Eqs 10-18) after the linear program, whose point is x. `atOrigin`: the
/// frame's origin is the last step's point.
template <class R, int D, int W>
POLYTOPE_INLINE void paperContact(const PairQuery<R, D>& q, bool optimal, bool touching, bool atOrigin, StageTimer& timer)
{
	PairPlanes<R, D>& planes = q.planes;
	ContactResult&    out    = q.out;
	const R           apart  = q.basis.infeasibility;
	const R           grown  = touching ? R(0) : growUntilTouching<R, D>(planes, apart, R(tolerance::gapSkin) * q.frame.size);
	ContactStatus     status = optimal ? contactPoint<R, D, W>(q, touching, atOrigin) : ContactStatus::LpNotConverged;
	timer.end(out.centreNanoseconds);

	R                   n[D];
	const ContactStatus normal = contactNormal<R, D, W>(q, n);
	if (touching) {
		if (status == ContactStatus::Contact) status = normal;
		out.depth  = chord<R, D, W>(planes, n);
		out.energy = out.depth * out.depth / 2;
	} else out.depth = depthAcrossGap<R, D>(planes, n, grown, apart, q.dual);
	publishContact<R, D>(q, status, q.x, n);
	if (q.settings.section) contactSection<R, D>(q, planes, q.x, n, q.x, q.workspace.polygons(sectionNumbers(planes.total)));
	failUnlessFinite<D>(q.memory, out);
}

/// `Surface`: for models that have one (hasSurface()), and for them alone: the other contacts' instructions are not to change with it.
template <class R, int D, int W, bool Surface>
POLYTOPE_INLINE void contactKernel(
        const PlacedPair& in, const ContactSettings& settings, PairMemory& memory, ContactWorkspace& workspace, ContactResult& out)
{
	StageTimer             timer(settings.timed);
	ContactFrame<R, D>     f      = unplacedFrame<R, D>(in);
	const ProgramLimits<R> limits = programLimits<R, D>(in, settings, f);
	if (dismissedByLastWeights<R, D>(in, settings, memory, f, limits, out)) {
		timer.end(out.lpNanoseconds);
		return;
	}

	PairPlanes<R, D>      planes = pairRows<R, D>(in, workspace);
	LpBasis<R, D>         basis;
	R                     x[D], dual[D];
	const PairQuery<R, D> q { in, settings, limits, f, planes, basis, x, dual, memory, workspace, out };
	const StartBasis      start = startBasis<R, D, W>(q);
	if (start == StartBasis::NoPose) {
		fail(memory, out);
		return;
	}
	if (start == StartBasis::Separating) {
		publishSeparation<R, D>(in, limits, basis, memory, out);
		timer.end(out.lpNanoseconds);
		return;
	}

	int            pivots = 0;
	const LpStatus lp     = solvePhaseOne<R, D, W>(start, planes, limits, f.size, basis, pivots);
	out.simplexPivots     = pivots;
	if (lp == LpStatus::Undecided && start == StartBasis::None) {
		fail(memory, out);
		return;
	}
	publishProgram<R, D>(q, lp);
	timer.end(out.lpNanoseconds);
	const bool touching = basis.infeasibility < -limits.tolerance;
	out.inContact       = touching;
	if (settings.programAlone || (!touching && !settings.geometryAcrossGap)) {
		rememberWeights<D>(basis.weight, memory);
		return;
	}
	out.hasGeometry      = true;
	memory.dualDirection = out.dualDirection;

	for (int k = 0; k < D; ++k)
		x[k] = basis.point[k];
	const bool aligned = alignFrame<R, D, W>(q, start, pivots > 0), optimal = lp != LpStatus::Undecided;
	if constexpr (Surface) {
		const R grown = touching
		        ? R(0)
		        : growUntilTouching<R, D>(planes, basis.infeasibility, skinAcrossGap<R>(basis.infeasibility, f.size));
		basis.infeasibility -= grown;
		surfaceContact<R, D, W>(q, optimal, !touching, grown);
		timer.end(out.centreNanoseconds);
	} else {
		const bool atOrigin = start == StartBasis::LastContact && !aligned;
		paperContact<R, D, W>(q, optimal, touching, atOrigin, timer);
	}
}

} // namespace polytope
