// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "contact/BoundingPlanes.hpp"
#include "contact/ContactFrame.hpp"
#include "contact/ContactPointRules.hpp"
#include "contact/ContactSection.hpp"
#include "contact/ContactTypes.hpp"
#include "contact/NormalAndDepth.hpp"
#include "contact/PhaseOne.hpp"
#include "contact/WarmStart.hpp"
#include "program/LpBasis.hpp"
#include "surface/ContactSurface.hpp"
#include "surface/NearPlanes.hpp"

/// The contacts whose force is the gradient of the volume of the linear program's feasible set (ContactSurface.hpp), as a geometry for laws that
/// are linear in depth. With V = ∫ p dx and W = ∫ ½ p² dx over the overlap, p the least slack of both bodies,
///
///     foundation, stiffness per area K:   U = 2 K V,             F = 2 K ∫ p n dS over the contact surface (both bodies give way, each by half),
///     spring, stiffness k:                U = ½ k (6 W/V)²,      F = 36 k (W/V) ∇(W/V):
///
/// for a face on a face the volume is A h²/4 and W/V = h/6, so that both are K A h and k h. The normal is the force's direction, the area that of the
/// contact surface seen along it, the depth F/(K A) or F/k, and the point lies on the line of action: a law with the force K A × depth or
/// k × depth has the force, and the moment but for the part along the normal, which no single force has.
namespace polytope {

/// Force and moment on body 2 over the stiffness, about the frame's origin, and energy over it; 2-D: of unit thickness where per area.
template <class R, int D> struct SurfaceLoad {
	R force[D];
	R moment[SurfaceSums<R, D>::turns];
	R energy;

	POLYTOPE_INLINE SurfaceLoad(ContactModel model, const SurfaceSums<R, D>& sums)
	{
		const bool spring = model == ContactModel::Spring;
		const R    mean   = sums.volume > 0 ? sums.level / sums.volume : R(0);
		// weights of ∫ p n dS and ∫ ½ p² n dS
		const R plain = spring ? -36 * mean * mean / sums.volume : R(2), deeper = spring ? 36 * mean / sums.volume : R(0);
		energy = spring ? 18 * mean * mean : 2 * sums.volume;
		for (int k = 0; k < D; ++k)
			force[k] = plain * sums.force[k] + deeper * sums.deeper[k];
		for (int k = 0; k < SurfaceSums<R, D>::turns; ++k)
			moment[k] = plain * sums.moment[k] + deeper * sums.deeperTurn[k];
	}
};

/// The point of the force's line of action nearest to `from`; 3-D: also the moment along the force that is left, over the force [m].
template <class R, int D> POLYTOPE_INLINE R lineOfAction(const SurfaceLoad<R, D>& load, R length, const R* n, const R* from, R* point)
{
	R left[SurfaceSums<R, D>::turns], arm[SurfaceSums<R, D>::turns] = {};
	addCross<R, D>(from, load.force, arm);
	for (int k = 0; k < SurfaceSums<R, D>::turns; ++k)
		left[k] = (load.moment[k] - arm[k]) / length;
	for (int k = 0; k < D; ++k)
		point[k] = from[k];
	if constexpr (D == 2) {
		point[0] += n[1] * left[0];
		point[1] -= n[0] * left[0];
		return 0;
	} else {
		addCross<R, 3>(n, left, point);
		return dot<R, 3>(left, n);
	}
}

/// Of a pair: what its surface is found from, and the surface.
template <class R, int D> struct PairSurface {
	SurfaceSums<R, D>     sums;
	SurfaceOnPiece<R, D>* on = nullptr; ///< if internal faces are left out
	PairPlanes<R, D>      nearest;      ///< those of the program that matter
	R*                    spare;        ///< room for a section
	R                     deepest;      ///< −s*
	SurfaceStatus         status;

	/// Part of the solid's contact that is this contact's: all pieces add up to one.
	POLYTOPE_INLINE R share() const { return !on ? R(1) : sums.pressure > 0 ? on->pressure / sums.pressure : R(0); }
};

/// The contact surface of the planes that matter, with room for a section of all in `spare`; energy only if asked for. `kept`: ContactSurface.hpp.
template <class R, int D, int W>
POLYTOPE_INLINE void findSurface(const PairPlanes<R, D>& planes, const LpBasis<R, D>& optimum, R size, bool energy, KeptSurface* kept,
        ContactWorkspace& workspace, PairSurface<R, D>& surface)
{
	using Near     = NearPlanes<R, D, W>;
	using Buffers  = SurfaceBuffers<R, D>;
	const int most = planes.total + 2 * padWidth, own = Near::numbersNeeded(planes.total),
	          ownIndices  = Near::indicesNeeded(planes.total);
	R* const      numbers = workspace.polygons(own + Buffers::numbersNeeded(most) + sectionNumbers(most));
	int* const    indices = workspace.indices(ownIndices + Buffers::indicesNeeded(most));
	LpBasis<R, D> basis   = optimum;
	Near          near(planes, basis, size, numbers, indices);
	surface.nearest = near.planes();
	surface.spare   = numbers + own + Buffers::numbersNeeded(most);
	surface.deepest = -optimum.infeasibility;
	const Buffers      buffers(surface.nearest.total, numbers + own, indices + ownIndices);
	const SurfaceParts parts = energy ? SurfaceParts::Cells : near.facing() ? SurfaceParts::Facing : SurfaceParts::Contact;
	surface.status           = contactSurface<R, D, W>(
                surface.nearest, basis.plane, D + 1, size, surface.deepest, parts, buffers, surface.sums, kept, near.names(), surface.on);
}

/// The force's direction; where there is no force the dual's, or any: coincident bodies, or one wholly within the other, are in equilibrium.
template <class R, int D> POLYTOPE_INLINE bool directionOfForce(const SurfaceLoad<R, D>& load, R length, R least, const R* dual, R* n)
{
	const bool some = length > least;
	const R    way  = some ? length : norm<R, D>(dual);
	for (int k = 0; k < D; ++k)
		n[k] = way > R(tolerance::direction) || some ? (some ? load.force[k] : dual[k]) / way : R(k == D - 1);
	return some;
}

/// The planes that bound the overlap, with their slacks at its analytic centre. x and dual turn with the frame.
template <class R, int D, int W>
POLYTOPE_APART void boundingPlanesOf(const PairInput& in, const ContactSettings& settings, PairPlanes<R, D>& planes, ContactFrame<R, D>& f,
        R* x, R* dual, ContactResult& out)
{
	R centre[D];
	for (int k = 0; k < D; ++k)
		centre[k] = x[k];
	newtonCentre<R, D, W>(planes, f, centre, R(settings.newtonTolerance), x, dual, out);
	boundingPlanes<R, D, W>(planes, centre, *settings.bounding);
	settings.bounding->point = worldPoint<R, D>(in, f, toBody<R, D>(f, f.home, centre));
}

/// The surface without the planes of internal faces, and the part of it on the piece that has them. False where there is none, or where the overlap is not one
/// of a body that slides on these pieces.
template <class R, int D, int W>
POLYTOPE_APART bool surfaceOnPieces(const PairInput& in, const ContactSettings& settings, const ProgramLimits<R>& limits,
        PairPlanes<R, D>& planes, const ContactFrame<R, D>& f, bool energy, PairMemory& memory, ContactWorkspace& workspace,
        PairSurface<R, D>& surface)
{
	const InternalPlanes& internal = *settings.internal;
	surface.on->clips.count        = 0;
	for (int body = 0; body < 2; ++body)
		for (int k = 0; k < internal.count[body]; ++k)
			surface.on->clips.add(planes, planes.begin(body) + internal.plane[body][k]);
	R offset[2 * BoundingPlanes::most];
	takeOut<R, D>(planes, internal, offset);
	// the program of what is left, from the ball of the body that has no internal face
	PairMemory    start;
	LpBasis<R, D> basis;
	R             dual[D];
	int           pivots = 0;
	const int     ball   = internal.count[0] > 0 ? 1 : 0;
	bool          found  = in.shape[ball]->inscribedRadius() < R(padOffset) && !surface.on->clips.full();
	if (found) {
		for (int k = 0; k <= D; ++k)
			start.basis[k] = 2 * in.shape[ball]->inscribedBasis()[k] + ball;
		found = startFrom<R, D>(in, f, start.basis, basis, dual);
	}
	if (found) {
		recallBasis<R, D>(planes, start, basis);
		ProgramLimits<R> all = limits;
		all.dismissAbove     = R(padOffset);
		found                = solvePhaseOne<R, D, W>(StartBasis::Aimed, planes, all, f.size, basis, pivots) == LpStatus::Optimal;
		found                = found && basis.infeasibility < -limits.tolerance;
	}
	if (found) findSurface<R, D, W>(planes, basis, f.size, energy, settings.warmStart ? &memory.surface : nullptr, workspace, surface);
	putBack<R, D>(planes, internal, offset);
	if (!found || surface.status != SurfaceStatus::Found) return false;
	const R length = norm<R, D>(surface.sums.force);
	if (!(length > 0)) return false;
	R n[D];
	for (int k = 0; k < D; ++k)
		n[k] = surface.sums.force[k] / length;
	const R area = dot<R, D>(surface.sums.areaVector, n);
	return area > 0 && 2 * length < area * internalDepth<R, D>(in, f, internal, n);
}

/// After the linear program of a pair that touches; x: its point, in the planes' frame.
template <class R, int D, int W>
POLYTOPE_INLINE void surfaceContact(const PairInput& in, const ContactSettings& settings, const ProgramLimits<R>& limits,
        PairPlanes<R, D>& planes, ContactFrame<R, D>& f, const LpBasis<R, D>& basis, bool optimal, R* x, R* dual, PairMemory& memory,
        ContactWorkspace& workspace, ContactResult& out)
{
	const bool energy = settings.energy || settings.contactModel == ContactModel::Spring;
	if (settings.bounding) boundingPlanesOf<R, D, W>(in, settings, planes, f, x, dual, out);
	PairSurface<R, D>    surface;
	SurfaceOnPiece<R, D> piece;
	if (settings.internal) {
		surface.on = &piece;
		if (!surfaceOnPieces<R, D, W>(in, settings, limits, planes, f, energy, memory, workspace, surface)) surface.on = nullptr;
	}
	if (!surface.on)
		findSurface<R, D, W>(planes, basis, f.size, energy, settings.warmStart ? &memory.surface : nullptr, workspace, surface);
	out.surfaceKept = surface.sums.kept;

	// all pieces of a solid have its force, point and depth, and each the part that it has of the pressure: no piece is pressed aside by an edge on its seam
	const SurfaceSums<R, D>& sums    = surface.sums;
	const R                  deepest = surface.deepest;
	const SurfaceLoad<R, D>  load(settings.contactModel, sums);
	const R                  length = norm<R, D>(load.force);
	// what a pressure everywhere along one direction would be: rounding of that is no force
	const bool perArea = settings.contactModel == ContactModel::Foundation;
	const R    most    = perArea ? 2 * sums.pressure : 6 * deepest;
	R          n[D], centre[D], point[D];
	bool       directed = directionOfForce<R, D>(load, length, R(tolerance::direction) * most, dual, n);
	for (int k = 0; k < D; ++k)
		point[k] = centre[k] = sums.pressure > 0 ? sums.centre[k] / sums.pressure : x[k];
	if (directed) {
		out.turningArm = lineOfAction<R, D>(load, length, n, centre, point);
		// where one body pierces the other, pressures cancel and leave a couple, whose line of action is anywhere
		R aside = 0;
		for (int k = 0; k < D; ++k)
			aside += (point[k] - centre[k]) * (point[k] - centre[k]);
		const R farthest = R(tolerance::lineOfAction) * f.size;
		directed         = aside <= farthest * farthest && abs(out.turningArm) <= farthest;
		if (!directed) {
			out.turningArm = 0;
			for (int k = 0; k < D; ++k)
				point[k] = centre[k];
		}
	}

	// the mean of 2 p over the area is no more than its largest: so thin a view is of a surface that is folded
	R area = dot<R, D>(sums.areaVector, n);
	area   = maxOf<R>(area, sums.pressure / deepest);
	if (!(area > 0)) area = D == 3 ? deepest * deepest : deepest; // no surface
	out.depth  = perArea ? length / area : length;
	out.energy = !energy ? R(-1) : perArea ? load.energy / area : load.energy;
	out.share  = surface.share();
	if (perArea) area *= out.share;
	out.area = D == 2 ? area * minOf<R>(in.shape[0]->thickness(), in.shape[1]->thickness()) : area;

	const bool whole = surface.status == SurfaceStatus::Found || surface.status == SurfaceStatus::None;
	publishContact<R, D>(in, f,
	        !optimal            ? ContactStatus::LpNotConverged
	                : !whole    ? ContactStatus::SurfaceIncomplete
	                : !directed ? ContactStatus::NoDirection
	                            : ContactStatus::Contact,
	        point, n, memory, out);
	out.sectionCentroid = out.point;
	if constexpr (D == 3) {
		if (settings.outline) { // where friction acts: the plane through the point, on which a contact surface of two faces lies
			const Real              all    = out.area;
			const PairPlanes<R, 3>& bounds = surface.on ? planes : surface.nearest; // of the others none bounds the overlap
			contactSection<R, 3>(in, settings, f, bounds, point, n, point, surface.spare, workspace, out);
			out.area            = all;
			out.sectionCentroid = out.point;
		}
	}
	failUnlessFinite<D>(memory, out);
}

} // namespace polytope
