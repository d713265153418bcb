// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "contact/ContactOutlineWriter.hpp"
#include "contact/PairQuery.hpp"
#include "numbers/Tolerances.hpp"
#include "shape/RingsOfNumbers.hpp"

#include <cmath>

/// Where a plane cuts the overlap of both bodies: polygon, area, centroid (3-D); length and midpoint (2-D).
/// The contact section is that of the plane through the contact point, normal to n.
namespace polytope {

template <class R, int D> struct Section {
	R        area        = 0;
	R        centroid[D] = {};      ///< in the frame of the planes
	const R* corner      = nullptr; ///< 3-D: (u, v) along axesAround(normal) from the origin of the plane, in the buffer
	int      count       = 0;
};

/// Area and centroid of the polygon of `count` corners u, v about the origin along the axes.
template <class R> POLYTOPE_INLINE Section<R, 3> polygonSection(const R* corner, int count, const R* origin, const Rotation<R, 3>& axes)
{
	const RingArea<R> ring = ringArea<R>(count, [&](int k, R* uv) POLYTOPE_INLINE_LAMBDA {
		uv[0] = corner[2 * k];
		uv[1] = corner[2 * k + 1];
	});
	Section<R, 3>     section;
	section.area = ring.area;
	for (int k = 0; k < 3; ++k)
		section.centroid[k] = origin[k] + ring.centroid[0] * axes.m[0][k] + ring.centroid[1] * axes.m[1][k];
	section.corner = corner;
	section.count  = count;
	return section;
}

/// How many numbers clipPlane() needs for that many planes.
constexpr int sectionNumbers(int planes) { return 5 * (planes + 5); }

/// The polygon {p = origin + u t1 + v t2 : a_i·p ≤ d_i for all i} by successive clipping of a square of the given half width.
template <class R>
POLYTOPE_INLINE Section<R, 3> clipPlane(const PairPlanes<R, 3>& planes, const R* origin, const R* normal, R halfWidth, R* buffer)
{
	const Rotation<R, 3> axes       = axesAround<R, 3>(normal);
	R*                   here       = buffer;
	R*                   there      = buffer + 2 * (planes.total + 5);
	R* const             value      = buffer + 4 * (planes.total + 5);
	const R              corners[8] = { -halfWidth, -halfWidth, halfWidth, -halfWidth, halfWidth, halfWidth, -halfWidth, halfWidth };
	int                  count      = 4;
	for (int k = 0; k < 8; ++k)
		here[k] = corners[k];
	for (int i = 0; i < planes.total && count > 0; ++i) {
		R a[3], d;
		planes.plane(i, a, d);
		if (d >= R(padOffset) / 2) continue;
		const R au = dot<R, 3>(a, axes.m[0]), av = dot<R, 3>(a, axes.m[1]);
		const R rest = d - dot<R, 3>(a, origin);
		R       most = -R(padOffset);
		for (int k = 0; k < count; ++k) {
			value[k] = au * here[2 * k] + av * here[2 * k + 1] - rest;
			most     = maxOf<R>(most, value[k]);
		}
		if (!(most > 0)) continue;
		const auto corner = [&](int k, R* uv) POLYTOPE_INLINE_LAMBDA {
			uv[0] = here[2 * k];
			uv[1] = here[2 * k + 1];
		};
		const auto put = [&](int k, const R* uv) POLYTOPE_INLINE_LAMBDA {
			there[2 * k]     = uv[0];
			there[2 * k + 1] = uv[1];
		};
		const int kept = keepAbove<R>(count, corner, [&](int k, const R*) POLYTOPE_INLINE_LAMBDA { return -value[k]; }, put);
		R*        swap = here;
		here           = there;
		there          = swap;
		count          = kept;
	}
	return polygonSection<R>(here, count, origin, axes);
}

/// 2-D: the segment of the line through origin, normal to `normal`, inside both bodies.
template <class R>
POLYTOPE_INLINE Section<R, 2> clipPlane(const PairPlanes<R, 2>& planes, const R* origin, const R* normal, R halfWidth, R*)
{
	const Rotation<R, 2> axes = axesAround<R, 2>(normal);
	R                    low = -halfWidth, high = halfWidth;
	for (int i = 0; i < planes.total; ++i) {
		R a[2], d;
		planes.plane(i, a, d);
		const R rate = dot<R, 2>(a, axes.m[0]);
		const R rest = d - dot<R, 2>(a, origin);
		if (rate > 0) high = minOf<R>(high, rest / rate);
		else if (rate < 0) low = maxOf<R>(low, rest / rate);
		else if (rest < 0) high = low;
	}
	Section<R, 2> section;
	section.area = high > low ? high - low : R(0);
	const R t    = section.area > 0 ? (low + high) / 2 : R(0);
	for (int k = 0; k < 2; ++k)
		section.centroid[k] = origin[k] + t * axes.m[0][k];
	return section;
}

/// The outline of `count` corners, corner(k, p) in the planes' frame, seen from `point` along the contact normal.
template <class R, class Corner>
POLYTOPE_INLINE void publishOutline(const PairQuery<R, 3>& q, int count, const R* point, const Corner& corner)
{
	ContactOutlineWriter<R> writer(q.frame, q.out.normal, point, q.workspace.points(count));
	for (int k = 0; k < count; ++k) {
		R p[3];
		corner(k, p);
		writer.add(p);
	}
	writer.publish(q.out);
}

/// Area (2-D: times the smaller thickness), centroid and, seen from `point` along the contact normal, outline of the section through
/// `origin`, normal to n, of what the planes bound. `buffer`: room for sectionNumbers().
template <class R, int D>
POLYTOPE_INLINE void contactSection(
        const PairQuery<R, D>& q, const PairPlanes<R, D>& planes, const R* origin, const R* n, const R* point, R* buffer)
{
	const ContactFrame<R, D>& f       = q.frame;
	const Section<R, D>       section = clipPlane(planes, origin, n, 2 * f.size, buffer);
	q.out.area                        = section.area;
	if (D == 2) q.out.area *= R(q.in.thickness());
	q.out.sectionCentroid = worldPoint<R, D>(q.in, f, toBody<R, D>(f, f.home, section.centroid));
	if constexpr (D == 3) {
		if (!q.settings.outline) return;
		const Rotation<R, 3> axes = axesAround<R, 3>(n);
		publishOutline<R>(q, section.count, point, [&](int k, R* p) POLYTOPE_INLINE_LAMBDA {
			for (int m = 0; m < 3; ++m)
				p[m] = origin[m] + section.corner[2 * k] * axes.m[0][m] + section.corner[2 * k + 1] * axes.m[1][m];
		});
	}
}

} // namespace polytope
