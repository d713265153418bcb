// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "contact/PenetrationDepth.hpp"
#include "contact/SurfaceDerivative.hpp"
#include "contact/SurfaceOnPieces.hpp"
#include "contact/WarmStart.hpp"
#include "joint/ClosureLaw.hpp"

/// The contacts whose force is the gradient of the volume of the linear program's feasible set (ContactSurface.hpp), as a geometry for laws that
/// are linear in depth. With V = ∫ p dx and W = ∫ ½ p² dx over the overlap, p the least slack of both bodies,
///
///     foundation, stiffness per area K:   U = 2 K V,             F = 2 K ∫ p n dS over the contact surface (both bodies give way, each by half),
///     spring, stiffness k:                U = ½ k (6 W/V)²,      F = 36 k (W/V) ∇(W/V):
///
/// for a face on a face the volume is A h²/4 and W/V = h/6, so that both are K A h and k h. The normal is the force's direction, the area that of the
/// contact surface seen along it, the depth F/(K A) or F/k, and the point lies on the line of action: a law with the force K A × depth or
/// k × depth has the force, and the moment but for the part along the normal, which no single force has.
///
/// A joint that stiffens as it closes (joint/ClosureLaw.hpp), with u(h) the energy of a closure h over the initial stiffness:
///
///     per area:     U = 4 K V u(h)/h²,   h = 6 W/V,     which is A u(h) for a face on a face, and 2 K V for every pair if u is that of a linear spring,
///     per contact:  U = k u(6 W/V).
///
/// The force is the gradient of that. The depth is the closure at which the law gives it: a law with the force K A σ(depth) has it. The
/// energy is over the stiffness that the joint has at this depth.
namespace polytope {

/// Force and moment on body 2 over the stiffness, about the frame's origin, and energy over it; 2-D: for unit thickness where the stiffness
/// is per area.
template <class R, int D> struct SurfaceLoad {
	R force[D];
	R moment[SurfaceSums<R, D>::turns];
	R energy;

	POLYTOPE_INLINE SurfaceLoad(const ContactSettings& settings, const SurfaceSums<R, D>& sums)
	{
		const bool spring = settings.contactModel == ContactModel::Spring;
		const R    mean   = sums.volume > 0 ? sums.level / sums.volume : R(0);
		// weights of ∫ p n dS and ∫ ½ p² n dS
		R plain = spring ? -36 * mean * mean / sums.volume : R(2), deeper = spring ? 36 * mean / sums.volume : R(0);
		energy = spring ? 18 * mean * mean : 2 * sums.volume;
		if (settings.closure && mean > 0) close(*settings.closure, spring, 6 * mean, plain, deeper);
		for (int k = 0; k < D; ++k)
			force[k] = plain * sums.force[k] + deeper * sums.deeper[k];
		for (int k = 0; k < SurfaceSums<R, D>::turns; ++k)
			moment[k] = plain * sums.moment[k] + deeper * sums.deeperTurn[k];
	}

private:
	/// Turns the energy of a linear spring, and the factors of its force, into those of a joint which has closed by h.
	POLYTOPE_APART void close(const ClosureLaw& law, bool spring, R h, R& plain, R& deeper)
	{
		// g = 2 u/h², and h g' from σ = h g + ½ h² g'
		const R secant = R(law.pressure(Real(h))) / h, g = 2 * R(law.energy(Real(h))) / (h * h), rise = 2 * (secant - g);
		energy *= g;
		if (spring) {
			plain *= secant;
			deeper *= secant;
		} else {
			plain  = 2 * (g - rise);
			deeper = 12 * rise / h;
		}
	}
};

/// The point of the force's line of action nearest to `from`; 3-D: also the moment along the force that is left, over the force [m].
template <class R, int D> POLYTOPE_INLINE R lineOfAction(const SurfaceLoad<R, D>& load, R length, const R* n, const R* from, R* point)
{
	R left[SurfaceSums<R, D>::turns], arm[SurfaceSums<R, D>::turns] = {};
	addCross<R, D>(from, load.force, arm);
	const R inverse = 1 / length;
	for (int k = 0; k < SurfaceSums<R, D>::turns; ++k)
		left[k] = (load.moment[k] - arm[k]) * inverse;
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

/// The force's direction; where there is no force the dual's, or any: coincident bodies, or one wholly within the other, are in equilibrium.
template <class R, int D> POLYTOPE_INLINE bool directionOfForce(const SurfaceLoad<R, D>& load, R length, R least, const R* dual, R* n)
{
	const bool some = length > least;
	const R    way  = some ? length : norm<R, D>(dual);
	for (int k = 0; k < D; ++k)
		n[k] = way > R(tolerance::direction) || some ? (some ? load.force[k] : dual[k]) / way : R(k == D - 1);
	return some;
}

/// How far s* is below zero for bodies that are `apart` (s*) when they are grown for a contact: it is chosen so that it moves with their
/// tilt as s* does for bodies which overlap as far as these are apart, and not with rounding.
template <class R> POLYTOPE_INLINE R skinAcrossGap(R apart, R size)
{
	return maxOf<R>(R(tolerance::gapSkin) * size, minOf<R>(apart, R(tolerance::widestSkin) * size));
}

/// The surface of the pair; of pieces that of their solids, with its part on them. `across`: the pair does not touch.
template <class R, int D, int W>
POLYTOPE_INLINE void surfaceOfPair(const PairQuery<R, D>& q, bool across, SurfaceOnPiece<R, D>& piece, PairSurface<R, D>& surface)
{
	const InternalPlanes* const internal = across ? nullptr : q.settings.internal;
	SolidsPlanes<R, D>          solids;
	LpBasis<R, D>               ofSolids;
	if (internal && clipsOfPieces<R, D>(*internal, q.planes, piece.clips)) {
		surface.on   = &piece;
		surface.size = maxOf<R>(q.frame.size, sizeOfOverlap<R>(q.in, *internal));
		solids.begin(q, *internal, surface.size);
	}
	const auto optimum = [&]() POLYTOPE_INLINE_LAMBDA -> const LpBasis<R, D>* {
		if (!surface.on) return &q.basis;
		return solids.template solve<W>(q, surface.size, ofSolids) ? &ofSolids : nullptr;
	};
	// one call, so that the code of the surface is there once: a second time only where the solid of several pieces has none
	for (bool found = false; !found;) {
		findSurface<R, D, W>(surface.on ? solids.planes() : q.planes, optimum, q.workspace, surface);
		found = !surface.on || isFoundOnPieces<R, D>(q.limits, surface);
		if (!found) surface = PairSurface<R, D>(q.frame.size, surface.energy, surface.outline, surface.kept);
	}
}

/// Where the force of a contact acts, and along which direction; in the frame.
template <class R, int D> struct SurfaceForce {
	R    n[D];
	R    centre[D]; ///< of the pressure, of one of several pieces that on this piece
	R    point[D];
	bool directed; ///< or n is any direction
};

/// All pieces of a solid have the force's direction: no piece is pressed aside by an edge on its seam. `across`: that of what separates the
/// bodies. `length`: of the force.
template <class R, int D>
POLYTOPE_INLINE void placeForce(const PairQuery<R, D>& q, const PairSurface<R, D>& surface, const SurfaceLoad<R, D>& load, R length,
        bool across, SurfaceForce<R, D>& force)
{
	const SurfaceSums<R, D>& sums = surface.sums;
	ContactResult&           out  = q.out;
	const R* const           dual = q.dual;
	R *const n = force.n, *const centre = force.centre, *const point = force.point;
	// what a pressure everywhere along one direction would be: rounding of that is no force
	const R most   = q.settings.contactModel == ContactModel::Foundation ? 2 * sums.pressure : 6 * surface.deepest;
	force.directed = across ? norm<R, D>(dual) > R(tolerance::direction)
	                        : directionOfForce<R, D>(load, length, R(tolerance::direction) * most, dual, n);
	for (int k = 0; k < D && across; ++k)
		n[k] = force.directed ? dual[k] / norm<R, D>(dual) : R(k == D - 1);
	const bool pressed = sums.pressure > 0 && (!across || surface.status == SurfaceStatus::Found);
	const R    inverse = 1 / (pressed ? sums.pressure : R(1));
	for (int k = 0; k < D; ++k)
		point[k] = centre[k] = pressed ? sums.centre[k] * inverse : q.x[k];
	if (force.directed && !across) {
		out.turningArm = lineOfAction<R, D>(load, length, n, centre, point);
		// where one body pierces the other, pressures cancel and leave a couple, whose line of action is anywhere
		R aside = 0;
		for (int k = 0; k < D; ++k)
			aside += (point[k] - centre[k]) * (point[k] - centre[k]);
		const R farthest = R(tolerance::lineOfAction) * surface.size;
		force.directed   = aside <= farthest * farthest && abs(out.turningArm) <= farthest;
		if (!force.directed) {
			out.turningArm = 0;
			for (int k = 0; k < D; ++k)
				point[k] = centre[k];
		}
	}
	// each piece's part acts at the centre of the pressure on it, and all together along the solid's line of action
	for (int k = 0; k < D && surface.isParted(); ++k) {
		const R own = surface.on->centre[k] / surface.on->pressure;
		point[k] += own - centre[k];
		centre[k] = own;
	}
}

/// Area along the normal n, and the depth and energy that go with it.
template <class R, int D>
POLYTOPE_INLINE void publishLoad(
        const PairQuery<R, D>& q, const PairSurface<R, D>& surface, const SurfaceLoad<R, D>& load, R length, const R* n)
{
	const ContactSettings&   settings = q.settings;
	const SurfaceSums<R, D>& sums     = surface.sums;
	ContactResult&           out      = q.out;
	const R                  deepest  = surface.deepest;
	const bool               perArea = settings.contactModel == ContactModel::Foundation, parted = surface.isParted();
	// the mean of 2 p over the area is no more than its largest: so thin a view is of a surface that is folded
	R area = dot<R, D>(parted ? surface.on->areaVector : sums.areaVector, n);
	area   = maxOf<R>(area, (parted ? surface.on->pressure : sums.pressure) / deepest);
	if (!(area > 0)) area = D == 3 ? deepest * deepest : deepest; // no surface
	out.share       = surface.share();
	const R onPiece = parted ? out.share : R(1);
	out.depth       = perArea ? length * onPiece / area : length;
	R stiffening    = 1;
	if (settings.closure) {
		out.depth  = settings.closure->closure(out.depth);
		stiffening = R(settings.closure->tangent(out.depth));
	}
	out.energy
	        = !surface.energy ? R(-1) : (perArea ? load.energy * onPiece / area : load.energy) / (stiffening > 0 ? stiffening : R(1));
	if (surface.on && !parted) area = 0;
	out.area = D == 2 ? area * R(q.in.thickness()) : area;
}

/// The outline over which friction acts: in the plane in which the contact surface of two faces lies.
template <class R>
POLYTOPE_INLINE void outlineOfSurface(const PairQuery<R, 3>& q, const PairSurface<R, 3>& surface, const SurfaceForce<R, 3>& force)
{
	if (surface.corners > 0) {
		publishOutline<R>(q, surface.corners, force.point, [&](int k, R* p) POLYTOPE_INLINE_LAMBDA {
			for (int m = 0; m < 3; ++m)
				p[m] = surface.corner[surface.stride * k + m];
		});
		return;
	}
	const Real              all    = q.out.area;
	const PairPlanes<R, 3>& bounds = surface.on ? q.planes : surface.nearest; // of the others none bounds the overlap
	R                       plane[3], place[3];
	if (!mainPlane<R>(surface.sums, plane, place))
		for (int k = 0; k < 3; ++k) {
			plane[k] = force.n[k];
			place[k] = force.point[k];
		}
	if (surface.isParted()) { // within the piece, which may be far from the middle of the solid
		R above = 0;
		for (int k = 0; k < 3; ++k)
			above += (force.centre[k] - place[k]) * plane[k];
		for (int k = 0; k < 3; ++k)
			place[k] = force.centre[k] - above * plane[k];
	}
	contactSection<R, 3>(q, bounds, place, plane, force.point, surface.spare);
	q.out.area            = all;
	q.out.sectionCentroid = q.out.point;
}

/// Finds the contact by its surface after the linear program, whose point is x. `across`: the pair does not touch, and its bodies were
/// grown by `grown` until it does.
template <class R, int D, int W> POLYTOPE_INLINE void surfaceContact(const PairQuery<R, D>& q, bool optimal, bool across, R grown)
{
	const ContactSettings& settings = q.settings;
	ContactResult&         out      = q.out;

	const bool energy = settings.energy || settings.contactModel == ContactModel::Spring || settings.closure;
	if (settings.inside && !across) *settings.inside = worldPoint<R, D>(q.in, q.frame, toBody<R, D>(q.frame, q.frame.home, q.x));
	PairSurface<R, D> surface(
	        q.frame.size + grown, energy, settings.outline, settings.warmStart && !across ? &q.memory.surface : nullptr);
	SurfaceStiffness<R> stiffness;
	if constexpr (D == 3) {
		if (settings.linear && !across && !settings.closure) surface.stiffness = &stiffness;
	}
	SurfaceOnPiece<R, D> piece;
	surfaceOfPair<R, D, W>(q, across, piece, surface);
	out.surfaceKept = surface.sums.kept;

	const SurfaceLoad<R, D> load(settings, surface.sums);
	const R                 length = norm<R, D>(load.force);
	SurfaceForce<R, D>      force;
	placeForce<R, D>(q, surface, load, length, across, force);
	publishLoad<R, D>(q, surface, load, length, force.n);
	if (across) {
		out.turningArm = out.energy = 0;
		R least;
		mostViolated<R, D, W>(q.planes, force.point, least); // leaves the slacks
		out.depth = depthAcrossGap<R, D>(q.planes, force.n, grown, q.basis.infeasibility + grown, q.dual);
	}

	// across a gap the program's own point will do as well
	const bool whole = across || surface.status == SurfaceStatus::Found || surface.status == SurfaceStatus::None;
	publishContact<R, D>(q,
	        !optimal                  ? ContactStatus::LpNotConverged
	                : !whole          ? ContactStatus::SurfaceIncomplete
	                : !force.directed ? ContactStatus::NoDirection
	                : across          ? ContactStatus::Separated
	                                  : ContactStatus::Contact,
	        force.point, force.n);
	out.sectionCentroid = out.point;
	if constexpr (D == 3) {
		if (settings.outline) outlineOfSurface<R>(q, surface, force);
		if (surface.differentiated && out.status == ContactStatus::Contact)
			keepLinear<R>(q, surface, load, force.point, *settings.linear);
	}
	failUnlessFinite<D>(q.memory, out);
}

} // namespace polytope
