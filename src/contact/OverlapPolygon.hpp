// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "contact/ContactTypes.hpp"
#include "contact/OverlapSums.hpp"
#include "numbers/Rotation.hpp"
#include "numbers/Tolerances.hpp"
#include "program/PairPlanes.hpp"
#include "shape/RingsOfNumbers.hpp"

namespace polytope {

/// The overlap of two polygons: a loop of corners, cut by one line after the other. Area, centroid, and what is seen of it along a direction.
template <class R, int W> class Overlap<R, 2, W> {
public:
	POLYTOPE_INLINE Overlap(const PairPlanes<R, 2>& planes, const R*, R halfWidth, ContactWorkspace& workspace)
	        : planes_(planes), here_(workspace.polygons(4 * (planes.total + 5))), there_(here_ + 2 * (planes.total + 5))
	{
		const R corners[8] = { -halfWidth, -halfWidth, halfWidth, -halfWidth, halfWidth, halfWidth, -halfWidth, halfWidth };
		for (int k = 0; k < 8; ++k)
			here_[k] = corners[k];
		const R tolerance = R(tolerance::violation) * halfWidth;
		for (int i = 0; i < planes.total && count_ > 0; ++i)
			if (planes.offset[i] < R(padOffset) / 2) cut(i, tolerance);
	}

	/// False if there is no measurable area.
	POLYTOPE_INLINE bool mass(const R*, OverlapMass<R, 2>& result) const
	{
		const RingArea<R> ring = ringArea<R>(count_, [&](int k, R* uv) POLYTOPE_INLINE_LAMBDA {
			uv[0] = here_[2 * k];
			uv[1] = here_[2 * k + 1];
		});
		result.volume          = ring.area;
		for (int k = 0; k < 2; ++k)
			result.centroid[k] = ring.centroid[k];
		return ring.area > 0;
	}

	POLYTOPE_INLINE Footprint<R> footprint(const R* p, const R* n) const
	{
		const Rotation<R, 2> axes = axesAround<R, 2>(n);
		R                    low = 0, high = 0;
		for (int v = 0; v < count_; ++v) {
			const R from[2] = { here_[2 * v] - p[0], here_[2 * v + 1] - p[1] }, at = dot<R, 2>(axes.m[0], from);
			low  = v > 0 ? minOf<R>(low, at) : at;
			high = v > 0 ? maxOf<R>(high, at) : at;
		}
		Footprint<R> result;
		result.area      = high - low;
		result.second[0] = (high * high * high - low * low * low) / 3;
		return result;
	}

private:
	/// Removes what lies beyond line i. A corner beyond it by up to the tolerance stays, and a side that leaves is cut at the line itself, or at such
	/// a corner. keepAbove() has one line for both: moved by the tolerance it would leave a larger polygon, at the line it would make short sides.
	POLYTOPE_INLINE void cut(int i, R tolerance)
	{
		R a[2], d;
		planes_.plane(i, a, d);
		const auto beyond = [&](int v) POLYTOPE_INLINE_LAMBDA { return a[0] * here_[2 * v] + a[1] * here_[2 * v + 1] - d; };
		int        kept   = 0;
		R          before = beyond(count_ - 1);
		for (int v = 0, last = count_ - 1; v < count_; last = v++) {
			const R value = beyond(v);
			if ((value > tolerance) != (before > tolerance)) {
				const int inner = value > tolerance ? last : v, outer = value > tolerance ? v : last;
				const R   in = minOf<R>(value, before), out = maxOf<R>(value, before), t = maxOf<R>(0, in / (in - out));
				for (int k = 0; k < 2; ++k)
					there_[2 * kept + k] = here_[2 * inner + k] + t * (here_[2 * outer + k] - here_[2 * inner + k]);
				++kept;
			}
			if (!(value > tolerance)) {
				for (int k = 0; k < 2; ++k)
					there_[2 * kept + k] = here_[2 * v + k];
				++kept;
			}
			before = value;
		}
		R* const swap = here_;
		here_         = there_;
		there_        = swap;
		count_        = kept;
	}

	const PairPlanes<R, 2>& planes_;
	R *                     here_, *there_;
	int                     count_ = 4;
};

} // namespace polytope
