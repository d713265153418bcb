// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "numbers/Rotation.hpp"

/// Plane convex polygons in memory that is there already. For code that is compiled for several instruction sets, which must not emit
/// Eigen's functions nor take memory; elsewhere Rings.hpp.
namespace polytope {

/// What of a ring lies where a linear function of the place is not negative.
/// \param corner corner(k, uv): the ring's k-th of `count`
/// \param height height(k, uv): the function there
/// \param put    put(k, uv): the k-th of what is kept
/// \returns how many are kept
template <class R, class Corner, class Height, class Put>
POLYTOPE_INLINE int keepAbove(int count, const Corner& corner, const Height& height, const Put& put)
{
	int kept = 0;
	R   last[2];
	corner(count - 1, last);
	R before = height(count - 1, last);
	for (int k = 0; k < count; ++k) {
		R uv[2];
		corner(k, uv);
		const R here = height(k, uv);
		if ((here >= 0) != (before >= 0)) {
			const R part        = before / (before - here);
			const R crossing[2] = { last[0] + part * (uv[0] - last[0]), last[1] + part * (uv[1] - last[1]) };
			put(kept++, crossing);
		}
		if (here >= 0) put(kept++, uv);
		last[0] = uv[0];
		last[1] = uv[1];
		before  = here;
	}
	return kept;
}

template <class R> struct RingArea {
	R area        = 0; ///< not negative
	R centroid[2] = {};
};

/// Area and centroid of a counter-clockwise ring, by a fan of triangles from its first corner. A ring of no area has its first corner for a centroid, one
/// without corners the origin.
/// \param corner corner(k, uv): the ring's k-th of `count`
template <class R, class Corner> POLYTOPE_INLINE RingArea<R> ringArea(int count, const Corner& corner)
{
	RingArea<R> ring;
	if (count > 0) corner(0, ring.centroid);
	R moment[2] = { 0, 0 };
	for (int k = 1; k + 1 < count; ++k) {
		R one[2], two[2];
		corner(k, one);
		corner(k + 1, two);
		const R u1 = one[0] - ring.centroid[0], v1 = one[1] - ring.centroid[1];
		const R u2 = two[0] - ring.centroid[0], v2 = two[1] - ring.centroid[1];
		const R twice = u1 * v2 - v1 * u2;
		ring.area += twice / 2;
		moment[0] += twice * (u1 + u2) / 6;
		moment[1] += twice * (v1 + v2) / 6;
	}
	if (ring.area > 0)
		for (int k = 0; k < 2; ++k)
			ring.centroid[k] += moment[k] / ring.area;
	else ring.area = 0; // rounding of a sliver
	return ring;
}

} // namespace polytope
