// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "program/PairPlanes.hpp"
#include "surface/SurfaceBuffers.hpp"

/// Planes that coincide (repeated ones of a body, sides of bodies that lie flush): one stands for all, the others are left out, for a plane as
/// near as another has no side on which it is nearer.
///
/// Where planes of both bodies coincide, space there belongs to either body, and the energy has a ridge: its derivatives to both sides
/// differ. `order` says whose it is, 0: body 1's, 1: body 2's.
namespace polytope {

template <class R, int D, int W> class TwinPlanes {
public:
	POLYTOPE_INLINE TwinPlanes(PairPlanes<R, D>& planes, const SurfaceBuffers<R, D>& buffers, R size, int order)
	        : planes_(planes), buffers_(buffers), order_(order), normal_(R(tolerance::twinPlanes)),
	          offset_(R(tolerance::twinPlanes) * size)
	{
		for (int k = 0; k < planes.total; ++k)
			buffers.twin[k] = -1;
	}

	/// The plane that stands for plane i.
	POLYTOPE_INLINE int of(int i)
	{
		while (buffers_.twin[i] != i) {
			if (buffers_.twin[i] >= 0) i = buffers_.twin[i];
			else if (alone(i)) buffers_.twin[i] = i;
			else i = leaveOut(i);
		}
		return i;
	}

	/// Whether any plane is left out.
	bool any() const { return left_ > 0; }

	/// Whether planes of both bodies coincide.
	bool shared() const { return shared_; }

	/// Puts the planes back that are left out.
	POLYTOPE_INLINE void restore()
	{
		for (int k = 0; k < planes_.total && left_ > 0; ++k)
			if (isLeftOut(k)) {
				planes_.offset[k] = buffers_.dropped[k];
				--left_;
			}
	}

private:
	using V = typename Lanes<R, W>::Type;

	POLYTOPE_INLINE bool alone(int i) const
	{
		R a[D], d;
		planes_.plane(i, a, d);
		const V own = broadcast<R, W>(d), one = broadcast<R, W>(1), zero = one - one, close = broadcast<R, W>(offset_),
		        parallel = broadcast<R, W>(normal_ * normal_);
		V same           = zero;
		for (int k = 0; k < planes_.total; k += W) {
			V square = zero;
			for (int c = 0; c < D; ++c) {
				const V step = load<R, W>(planes_.normal[c] + k) - broadcast<R, W>(a[c]);
				square += step * step;
			}
			const V apart = absolute(V(load<R, W>(planes_.offset + k) - own));
			const V near  = square <= parallel ? one : zero;
			same += apart <= close ? near : zero;
		}
		return horizontalSum<R, W>(same) < R(3) / 2;
	}

	int rank(int k) const { return (k < planes_.first) == (order_ == 0) ? k : k + planes_.total; }

	bool isLeftOut(int k) const { return buffers_.twin[k] >= 0 && buffers_.twin[k] != k; }

	/// Leaves out all planes that coincide with plane i but the one that stands for them, which it returns. Not a second time: planes without a normal
	/// (padding, and those of a pose that is no rotation) coincide with what is left out, and this would never end.
	POLYTOPE_APART int leaveOut(int i)
	{
		R a[D], d;
		planes_.plane(i, a, d);
		const auto same = [&](int k) {
			R square = 0;
			for (int c = 0; c < D; ++c)
				square += (planes_.normal[c][k] - a[c]) * (planes_.normal[c][k] - a[c]);
			return !isLeftOut(k) && square <= normal_ * normal_ && abs(planes_.offset[k] - d) <= offset_;
		};
		int stands = i;
		for (int k = 0; k < planes_.total; ++k)
			if (same(k) && rank(k) < rank(stands)) stands = k;
		bool any = false;
		for (int k = 0; k < planes_.total; ++k) {
			if (k == stands || !same(k)) continue;
			shared_             = shared_ || (k < planes_.first) != (stands < planes_.first);
			buffers_.twin[k]    = stands;
			buffers_.dropped[k] = planes_.offset[k];
			planes_.offset[k]   = R(padOffset);
			++left_;
			any = true;
		}
		if (!any) buffers_.twin[stands] = stands;
		return stands;
	}

	PairPlanes<R, D>&           planes_;
	const SurfaceBuffers<R, D>& buffers_;
	int                         order_;
	R                           normal_, offset_;
	int                         left_   = 0;
	bool                        shared_ = false;
};

} // namespace polytope
