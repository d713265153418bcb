// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "surface/FeasibleBuffers.hpp"
#include "surface/SurfaceSums.hpp"

/// The outline of a plane's section of the overlap, from the vertices and edges of the pair's feasible set (FeasibleSet.hpp).
///
/// The set's vertices without pressure are those of the overlap, and so are the edges between them, each with two planes. Where the plane
/// cuts one of them is a corner of the outline; along a side of it one plane is tight, which the corners at both ends have.
namespace polytope {

/// The plane in which the contact surface of two faces lies, through the middle of the pressure. False: no surface has pressure.
template <class R> POLYTOPE_INLINE bool mainPlane(const SurfaceSums<R, 3>& sums, R* normal, R* place)
{
	const R far = norm<R, 3>(sums.mainNormal);
	if (!(far > 0 && sums.weight > 0)) return false;
	for (int k = 0; k < 3; ++k) {
		normal[k] = sums.mainNormal[k] / far;
		place[k]  = sums.mainCentre[k] / sums.weight;
	}
	return true;
}

template <class R> class FeasibleOutline {
public:
	POLYTOPE_INLINE FeasibleOutline(const FeasibleBuffers<R>& set, const R* normal, const R* place) : corner_(set.outline)
	{
		const R       level = dot<R, 3>(normal, place);
		std::uint64_t none  = 0;
		R             height[mostVertices];
		std::uint8_t  without[2][mostVertices]; // of the vertices without pressure those below the plane, and those above
		int           count[2] = { 0, 0 };
		for (int v = 0; v < set.vertices; ++v) {
			const int last = set.tight[v][3];
			if (set.owner[last] != FeasibleBuffers<R>::NoBody) continue;
			height[v]                      = dot<R, 3>(normal, set.point + 4 * v) - level;
			const bool above               = height[v] >= 0;
			without[above][count[above]++] = std::uint8_t(v);
			none                           = std::uint64_t(1) << last;
		}
		std::uint8_t cut[3 * mostVertices / 2 + 1][2]; // one more than there are edges without pressure
		int          cuts = 0;
		for (int i = 0; i < count[0]; ++i)
			for (int j = 0; j < count[1]; ++j) {
				const int v = without[0][i], w = without[1][j];
				cut[cuts][0] = std::uint8_t(v);
				cut[cuts][1] = std::uint8_t(w);
				cuts += set.areJoined(v, w);
			}
		if (cuts < 3 || cuts > most) return;
		std::memset(on_, nothing, sizeof on_);
		bool twice = true; // each plane has two corners or none
		for (int c = 0; c < cuts; ++c) {
			const int v = cut[c][0], w = cut[c][1];
			const R   part = height[v] / (height[v] - height[w]);
			const R * p = set.point + 4 * v, *q = set.point + 4 * w;
			for (int m = 0; m < 3; ++m)
				corner_[4 * c + m] = p[m] + part * (q[m] - p[m]);
			const std::uint64_t both = set.mask[v] & set.mask[w] & ~none;
			for (int side = 0; side < 2; ++side) {
				const int k       = __builtin_ctzll(side ? both & (both - 1) : both);
				plane_[c][side]   = std::uint8_t(k);
				const bool second = on_[k][0] != nothing;
				twice             = twice && on_[k][1] == nothing;
				on_[k][second]    = std::uint8_t(c);
			}
		}
		if (twice) goAround(cuts, normal);
	}

	/// Corners in order; 0: the edges do not say.
	int count() const { return count_; }
	/// The first of them counter-clockwise seen against the normal, and from it to the next.
	const R* first() const { return corner_ + 4 * most + (turned_ ? 3 * (count_ - 1) : 0); }
	int      stride() const { return turned_ ? -3 : 3; }

private:
	static constexpr int          most = FeasibleBuffers<R>::mostPlanes, mostVertices = FeasibleBuffers<R>::mostVertices;
	static constexpr std::uint8_t nothing = 255;
	static_assert(4 + 3 == FeasibleBuffers<R>::outlineRows); // for each corner, in either order

	POLYTOPE_INLINE void goAround(int cuts, const R* normal)
	{
		int at = 0, side = 0, found = 0;
		R   twice = 0, last[3] = { 0, 0, 0 }; // area; the corner before, from the first
		R*  to = corner_ + 4 * most;
		do {
			R next[3], across[3] = { 0, 0, 0 };
			for (int m = 0; m < 3; ++m) {
				to[3 * found + m] = corner_[4 * at + m];
				next[m]           = corner_[4 * at + m] - corner_[m];
			}
			addCross<R, 3>(last, next, across);
			twice += dot<R, 3>(across, normal);
			for (int m = 0; m < 3; ++m)
				last[m] = next[m];
			++found;
			const int k = plane_[at][side];
			at          = on_[k][on_[k][0] == at];
			if (at == nothing) return;
			side = plane_[at][0] == k;
		} while (at != 0 && found < cuts);
		if (at != 0 || found != cuts) return;
		turned_ = twice < 0;
		count_  = cuts;
	}

	R*           corner_; ///< x, y, z and nothing, in any order; then in the right one
	int          count_  = 0;
	bool         turned_ = false;
	std::uint8_t plane_[most][2]; ///< of a corner
	std::uint8_t on_[most][2];    ///< corners of a plane
};

} // namespace polytope
