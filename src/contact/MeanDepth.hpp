// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "contact/ContactFrame.hpp"
#include "contact/ContactOutlineWriter.hpp"
#include "contact/OverlapVolume.hpp"

/// The contact of two bodies between which there is a pressure k h at each place, h the local depth along n and k a stiffness per
/// area [N/m³]: an elastic foundation (Winkler 1867) between their faces.
///
/// With V the overlap's volume, c its centroid and A its area as seen along n,
///
///     force = ∫ k h dA = k V = (k A) (V/A),      its line of action passes through c (∫ r h dA / ∫ h dA, r across n).
///
/// So the depth is V/A, the mean one. Where a face, an edge or a vertex of one body lies on a face of the other, n is that face's normal and the force
/// is the gradient of an energy,
///
///     U = ∫ ½ k h² dA = k ∫ t dV = k V t_c,      t the distance from that face along n, t_c at the centroid:
///
/// however a body tilts, rocks or lifts off, what it gets back is what it gave. And the overlap with a solid made of pieces is the sum of those with
/// the pieces: V, c and U, and so force, moment and energy, are those with the whole. Between two edges that cross, U is an approximation.
namespace polytope {

/// From x along n to the surface of the body that has a face there: of the planes through which n leaves one body and −n the other, the one more normal
/// to n. Two faces that are tilted against each other are equally far from the centroid.
template <class R, int D, int W> POLYTOPE_INLINE R distanceFromFace(const PairPlanes<R, D>& planes, const R* x, const R* n)
{
	using V      = typename Lanes<R, W>::Type;
	const V zero = broadcast<R, W>(0), far = broadcast<R, W>(R(padOffset));
	V       X[D];
	for (int k = 0; k < D; ++k)
		X[k] = broadcast<R, W>(x[k]);
	R distance = 0, steepest = 0;
	for (int body = 0; body < 2; ++body) {
		V N[D], nearest = far, rate = zero;
		for (int k = 0; k < D; ++k)
			N[k] = broadcast<R, W>(body == 0 ? n[k] : -n[k]);
		for (int i = planes.begin(body); i < planes.end(body); i += W) {
			V       a[D];
			const V slack   = slacksOf<R, D, W>(planes, i, X, a);
			V       leaving = a[0] * N[0];
			for (int k = 1; k < D; ++k)
				leaving += a[k] * N[k];
			const V way = leaving > zero ? slack / leaving : far;
			rate        = way < nearest ? leaving : rate;
			nearest     = minOf(nearest, way);
		}
		const R way  = horizontalMin<R, W>(nearest);
		const R most = -horizontalMin<R, W>(V(nearest <= broadcast<R, W>(way) ? -rate : zero));
		if (!(most > steepest)) continue;
		steepest = most;
		distance = maxOf<R>(0, way);
	}
	return distance;
}

/// How much a contact is one of two faces: 1 where the overlap is thin, 0 where it is as thick as wide (an edge or a vertex).
template <class R, int D> POLYTOPE_INLINE R onFaces(R chord, const Footprint<R>& seen)
{
	const R narrow = D == 2 ? seen.area : seen.area / sqrt(seen.gyrationSquared());
	const R thick  = chord / (R(tolerance::faceContact) * narrow);
	return 1 / (1 + thick * thick * thick * thick);
}

/// From the smaller body, unless it has many faces, most of them far from the contact. x: a point inside.
template <class R, int D, int W>
POLYTOPE_INLINE Overlap<R, D, W> overlapOfPair(
        const PairInput& in, const ContactFrame<R, D>& f, const PairPlanes<R, D>& planes, const R* x, ContactWorkspace& workspace)
{
	if constexpr (D == 3) {
		const Polyhedron& surface = in.shape[f.home]->polyhedron();
		if (surface.faces.size() <= std::size_t(tolerance::wholeBodyFaces)) {
			const auto place = [&](R* p, const Vector3& own) POLYTOPE_INLINE_LAMBDA { fromBody<R, 3>(f, f.home, own, p); };
			return Overlap<R, 3, W>(planes, f.home, surface, place, x, f.size, workspace);
		}
	}
	return Overlap<R, D, W>(planes, x, 2 * f.size, workspace);
}

/// Point, depth and area of a touching pair with normal n; x: a point inside. False, with nothing changed, if the overlap has no measurable volume.
template <class R, int D, int W>
POLYTOPE_INLINE bool meanDepth(const PairInput& in, const ContactSettings& settings, const ContactFrame<R, D>& f,
        const PairPlanes<R, D>& planes, const R* n, const R* x, ContactWorkspace& workspace, ContactResult& out)
{
	const Overlap<R, D, W> overlap = overlapOfPair<R, D, W>(in, f, planes, x, workspace);
	OverlapMass<R, D>      mass;
	if (!overlap.mass(x, mass)) return false;
	const R area = overlap.areaAlong(n);
	if (!(area > 0)) return false;
	const R mean   = mass.volume / area;
	const R energy = mean * distanceFromFace<R, D, W>(planes, mass.centroid, n);
	const R share  = settings.depthRule == DepthRule::Mean ? R(1) : onFaces<R, D>(out.depth, overlap.footprint(mass.centroid, n));
	R       point[D];
	for (int k = 0; k < D; ++k)
		point[k] = x[k] + share * (mass.centroid[k] - x[k]);
	out.energy = out.depth * out.depth / 2 + share * (energy - out.depth * out.depth / 2);
	out.depth += share * (mean - out.depth);
	out.area            = D == 2 ? area * minOf<R>(in.shape[0]->thickness(), in.shape[1]->thickness()) : area;
	out.point           = worldPoint<R, D>(in, f, toBody<R, D>(f, f.home, point));
	out.sectionCentroid = out.point;
	if constexpr (D == 3) {
		if (settings.outline) {
			ContactOutlineWriter<R> writer(f, out.normal, point, workspace.points(overlap.cornersAlong()));
			const bool              loop = overlap.visitAlong(n, writer);
			writer.publish(loop, out);
		}
	}
	return true;
}

} // namespace polytope
