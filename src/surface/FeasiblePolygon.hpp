// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "surface/FeasibleSet.hpp"
#include "surface/SurfacePiece.hpp"

#include <algorithm>

/// One piece of the contact surface, of planes i and j, as a polygon: the vertices of the feasible set at which both are tight, one after
/// the other. It has what ClippedPiece asks of a SurfaceCut.
namespace polytope {

template <class R> class FeasiblePolygon {
public:
	POLYTOPE_INLINE FeasiblePolygon(const FeasibleBuffers<R>& buffers, int i, int j, int first, const SurfacePiece<R, 3>& piece)
	        : buffers_(buffers), piece_(piece)
	{
		const std::uint64_t both = std::uint64_t(1) << i | std::uint64_t(1) << j;
		int                 last = -1, here = first;
		do {
			vertex_[count_++] = std::uint8_t(here);
			const int next    = after(here, last, both);
			last              = here;
			here              = next;
		} while (here >= 0 && here != first && count_ < FeasibleBuffers<R>::mostVertices);
		if (turnsBack()) std::reverse(vertex_, vertex_ + count_);
	}

	int                  count() const { return count_; }
	POLYTOPE_INLINE void vertex(int t, R* uv) const
	{
		const R* const x = buffers_.point + 4 * vertex_[t];
		for (int m = 0; m < 2; ++m) {
			uv[m] = 0;
			for (int k = 0; k < 3; ++k)
				uv[m] += piece_.axis[m][k] * (x[k] - piece_.foot[k]);
		}
	}

private:
	/// The vertex next to `here` along an edge on which both planes are tight, other than `last`.
	int after(int here, int last, std::uint64_t both) const
	{
		for (int v = 0; v < buffers_.vertices; ++v)
			if (v != last && (buffers_.mask[v] & both) == both && buffers_.areJoined(here, v)) return v;
		return -1;
	}

	/// Whether it is clockwise.
	bool turnsBack() const
	{
		R area = 0, o[2], a[2], b[2];
		vertex(0, o);
		for (int t = 2; t < count_; ++t) {
			vertex(t - 1, a);
			vertex(t, b);
			area += (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]);
		}
		return area < 0;
	}

	const FeasibleBuffers<R>& buffers_;
	const SurfacePiece<R, 3>& piece_;
	int                       count_ = 0;
	std::uint8_t              vertex_[FeasibleBuffers<R>::mostVertices];
};

} // namespace polytope
