// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "surface/SurfacePiece.hpp"

/// Many planes that meet in one edge of a piece (the sides of a cone meet in its axis): which pairs of them have a piece of the surface there.
///
/// About the edge each plane's slack falls along its normal, seen along the edge. So the planes that are nearest somewhere are the corners of the convex
/// hull of these normals, and two of them have a piece between them where they are neighbours on it. The plane of no pressure is the point zero.
///
/// Planes meet but for rounding. There are pieces between others then, as wide as a rounding over the square of the angle between neighbours, which are left
/// out: less than 1e-9 of the energy of cones on their tip (ContactSurfaceTest.cpp).
namespace polytope {

template <class R, int D> class MeetingPlanes {
public:
	/// `across`: unit, in the piece and across its edge; `planes`: those that meet, the piece's own two among them; in D = 2 an edge is a point.
	POLYTOPE_INLINE MeetingPlanes(
	        const PairPlanes<R, D>& all, const SurfacePiece<R, D>& piece, const R* across, const int* planes, int count)
	        : all_(all), piece_(piece), planes_(planes), count_(count)
	{
		for (int k = 0; k < D; ++k) {
			across_[k] = 0;
			for (int m = 0; m < D - 1; ++m)
				across_[k] += across[m] * piece.axis[m][k];
		}
	}

	/// Calls add(plane, plane) for the pieces on both sides of this one or, with `around`, for all about the edge.
	template <class Add> POLYTOPE_INLINE void neighbours(bool around, const Add& add) const
	{
		const Point i = pointOf(piece_.i), j = pointOf(piece_.j);
		const R     turn  = j.along > i.along ? R(1) : R(-1);
		int         plane = next(piece_.j, turn, add);
		for (int steps = 0; around && plane >= 0 && plane != piece_.i && steps < count_; ++steps)
			plane = next(plane, turn, add);
		if (!around) next(piece_.i, -turn, add);
	}

private:
	struct Point {
		R along, across;
	};

	POLYTOPE_INLINE Point pointOf(int plane) const
	{
		R a[D], d;
		planeOrNone<R, D>(all_, plane, a, d);
		return { dot<R, D>(a, piece_.normal), dot<R, D>(a, across_) };
	}

	/// The next corner of the hull, −1: none. Those which rounding may have on the side between are told of, too.
	template <class Add> POLYTOPE_INLINE int next(int plane, R turn, const Add& add) const
	{
		const Point from    = pointOf(plane);
		int         found   = -1;
		R           best[2] = {};
		const auto  toward  = [&](int k, R* way) {
                        const Point to = pointOf(planes_[k]);
                        way[0]         = to.along - from.along;
                        way[1]         = to.across - from.across;
                        return way[0] * way[0] + way[1] * way[1];
		};
		const auto cross = [&](const R* way) { return turn * (best[0] * way[1] - best[1] * way[0]); };
		for (int k = 0; k < count_; ++k) {
			R       way[2];
			const R square = toward(k, way), longest = best[0] * best[0] + best[1] * best[1];
			if (planes_[k] == plane || !(square > 0)) continue;
			const R    beside = cross(way), sharp = R(tolerance::crossingPlanes);
			const bool inLine = beside * beside <= sharp * sharp * square * longest;
			if (found >= 0 && !(inLine ? square > longest : beside > 0)) continue;
			found   = planes_[k];
			best[0] = way[0];
			best[1] = way[1];
		}
		if (found < 0) return found;
		add(plane, found);
		const R longest = best[0] * best[0] + best[1] * best[1], sharp = R(tolerance::crossingPlanes);
		for (int k = 0; k < count_; ++k) {
			R       way[2];
			const R square = toward(k, way), beside = cross(way);
			if (planes_[k] == found || planes_[k] == plane || !(square > 0)
			        || beside * beside > sharp * sharp * square * longest)
				continue;
			add(plane, planes_[k]);
			add(planes_[k], found);
		}
		return found;
	}

	const PairPlanes<R, D>&   all_;
	const SurfacePiece<R, D>& piece_;
	const int*                planes_;
	int                       count_;
	R                         across_[D];
};

} // namespace polytope
