// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "surface/SurfacePolygon.hpp"

/// A piece of the surface in 2-D: a segment. Each of its two ends carries the number of the plane that has the same slack there, as an edge of
/// a polygon does.
namespace polytope {

template <class R, int W> class SurfaceCut<R, 2, W> {
public:
	POLYTOPE_INLINE SurfaceCut(const SurfaceBuffers<R, 2>& buffers, R reach, R deepest, const int*)
	        : buffers_(buffers), deepest_(deepest), end_ { -reach, reach }
	{
		bool some = true;
		for (int k = 0; k <= buffers.planes; ++k) {
			const R rate = buffers.rate[0][k], rest = buffers.rest[k];
			// whether a plane that is parallel but for rounding cuts is seen at the ends
			if (rest + rate * end_[0] >= 0 && rest + rate * end_[1] >= 0) continue;
			if (rate > 0) {
				end_[0] = -rest / rate;
				tag_[0] = k;
			} else if (rate < 0) {
				end_[1] = -rest / rate;
				tag_[1] = k;
			} else some = false;
			if (!(end_[0] < end_[1])) some = false;
			if (!some) break;
		}
		count_ = some ? 2 : 0;
	}

	int                  count() const { return count_; }
	POLYTOPE_INLINE void vertex(int t, R* u) const { u[0] = end_[t]; }
	int                  tag(int t) const { return tag_[t]; }

	POLYTOPE_INLINE void across(int, R* u) const { u[0] = 1; }
	/// An end is one, and no other leads to the pieces about it.
	bool isPoint(int) const { return false; }

	POLYTOPE_INLINE int meeting(int t, int* found, int room) const
	{
		const R close = R(tolerance::meetingPlanes) * (abs(end_[t]) + deepest_);
		int     count = 0;
		for (int k = 0; k <= buffers_.planes && count < room; ++k)
			if (k != tag_[t] && abs(buffers_.rest[k] + buffers_.rate[0][k] * end_[t]) <= close) found[count++] = k;
		return count;
	}

private:
	const SurfaceBuffers<R, 2>& buffers_;
	R                           deepest_;
	R                           end_[2];
	int                         tag_[2] = { -1, -1 };
	int                         count_  = 0;
};

} // namespace polytope
