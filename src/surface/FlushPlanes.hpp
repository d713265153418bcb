// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "surface/FeasibleBuffers.hpp"

/// Planes of both bodies that lie by each other, as the sides of blocks in a row do, in the feasible set of a pair (FeasibleSet.hpp).
///
/// They are told apart by their true offsets: of two, the farther one bounds nothing. Where they coincide the energy has a ridge, and the
/// plane belongs to either body by half. TwinPlanes.hpp has what SurfaceWalk does with planes that coincide, be they of both bodies or of
/// one.
namespace polytope {

template <class R, int W> class FlushPlanes {
public:
	using Buffers = FeasibleBuffers<R>;

	POLYTOPE_INLINE FlushPlanes(const PairPlanes<R, 3>& planes, R size, Buffers& buffers)
	        : planes_(planes), size_(size), buffers_(buffers)
	{
	}

	/// Leaves out the farther one of two planes of both bodies that lie so near by each other that changed offsets would hide which is nearer.
	/// Whether there are any.
	POLYTOPE_INLINE bool leaveOutTwins()
	{
		bool any = false;
		for (int k = planes_.begin(1); k < planes_.end(1); ++k) {
			if (planes_.offset[k] >= R(padOffset) / 2) continue;
			const int twin = twinOf(k);
			if (twin < 0) continue;
			buffers_.split[planes_.offset[k] < planes_.offset[twin] ? twin : k] = R(padOffset);
			any                                                                 = true;
		}
		return any;
	}

	/// The plane that stands for one of the optimum's.
	int nearerTwin(int row) const
	{
		if (row == planes_.total || buffers_.split[row] < R(padOffset) / 2) return row;
		const int twin = twinOf(row);
		return twin < 0 ? row : twin;
	}

	/// Gives planes that coincide to both bodies, and returns which of the tight ones do, a bit for each.
	POLYTOPE_APART std::uint64_t shareCoinciding()
	{
		std::uint64_t shared = 0;
		for (int k = 0; k < buffers_.planes; ++k) {
			if (buffers_.owner[k] == Buffers::NoBody) continue;
			const int other = buffers_.owner[k] == Buffers::Body1;
			if (twinAmong(other, buffers_.plane + 4 * k, R(tolerance::twinPlanes)) < 0) continue;
			buffers_.owner[k] = Buffers::Both;
			shared |= std::uint64_t(1) << k;
		}
		return shared;
	}

private:
	using V = typename Lanes<R, W>::Type;

	/// The plane of a body that lies by this one, by no more than `within` in its normal and `within` × size in its offset; −1: none.
	POLYTOPE_INLINE int twinAmong(int body, const R* a, R within) const
	{
		const V own[3] = { broadcast<R, W>(a[0]), broadcast<R, W>(a[1]), broadcast<R, W>(a[2]) }, d = broadcast<R, W>(a[3]),
		        far = broadcast<R, W>(R(1)), offset = broadcast<R, W>(within * size_);
		for (int i = planes_.begin(body); i < planes_.end(body); i += W) {
			V square = far - far;
			for (int m = 0; m < 3; ++m) {
				const V step = load<R, W>(planes_.normal[m] + i) - own[m];
				square += step * step;
			}
			const V apart = absolute(V(load<R, W>(planes_.offset + i) - d));
			square        = apart <= offset ? square : far;
			if (horizontalMin<R, W>(square) > within * within) continue;
			R each[W];
			store<R, W>(each, square);
			for (int lane = 0; lane < W; ++lane)
				if (each[lane] <= within * within) return i + lane;
		}
		return -1;
	}

	/// The row of the other body's plane that lies by this one; −1: none.
	POLYTOPE_INLINE int twinOf(int row) const
	{
		R a[4];
		planes_.plane(row, a, a[3]);
		return twinAmong(row < planes_.first, a, R(tolerance::splitPlanes));
	}

	const PairPlanes<R, 3>& planes_;
	R                       size_;
	Buffers&                buffers_;
};

} // namespace polytope
