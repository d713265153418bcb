// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "shape/RingsOfNumbers.hpp"
#include "surface/SurfaceSegment.hpp"

/// The part of a contact surface that lies on one piece of a larger solid.
///
/// A face of the piece that its neighbours cover presses on nothing: it has no cell, so the surface is the one that the solid has, and goes
/// on beyond the piece. But it parts the surface among the pieces: what they have of it adds up to the whole, and so do their forces and,
/// each at the centre of the pressure on the piece, their moments.
namespace polytope {

/// Half-spaces a·x ≤ d in the planes' frame.
template <class R, int D> struct SurfaceClips {
	static constexpr int most = 64;

	int count = 0;
	R   normal[most][D], offset[most];

	POLYTOPE_INLINE void add(const PairPlanes<R, D>& planes, int i)
	{
		if (count < most) planes.plane(i, normal[count], offset[count]);
		++count;
	}
	/// Whether there were more than fit.
	bool full() const { return count > most; }

	/// How the slack of half-space c changes over a piece of the surface: rest + rate·u.
	POLYTOPE_INLINE R slackOn(int c, const SurfacePiece<R, D>& piece, R* rate) const
	{
		for (int m = 0; m < D - 1; ++m)
			rate[m] = -dot<R, D>(normal[c], piece.axis[m]);
		return offset[c] - dot<R, D>(normal[c], piece.foot);
	}
};

template <class R, int D> class ClippedPiece;

/// A polygon within the half-spaces.
template <class R> class ClippedPiece<R, 3> {
public:
	template <class Cut>
	POLYTOPE_INLINE ClippedPiece(
	        const SurfacePiece<R, 3>& piece, const Cut& cut, const SurfaceClips<R, 3>& clips, const SurfaceBuffers<R, 3>& buffers)
	        : buffers_(buffers), count_(cut.count())
	{
		for (int t = 0; t < count_; ++t) {
			R uv[2];
			cut.vertex(t, uv);
			put(0, t, uv);
		}
		for (int c = 0; c < clips.count && count_ > 0; ++c) {
			R       rate[2];
			const R rest = clips.slackOn(c, piece, rate);
			clip(rest, rate);
		}
		if (count_ < 3) count_ = 0;
	}

	int                  count() const { return count_; }
	POLYTOPE_INLINE void vertex(int t, R* uv) const { get(now_, t, uv); }

private:
	POLYTOPE_INLINE void put(int side, int t, const R* uv)
	{
		buffers_.clipped[side][0][t] = uv[0];
		buffers_.clipped[side][1][t] = uv[1];
	}
	POLYTOPE_INLINE void get(int side, int t, R* uv) const
	{
		uv[0] = buffers_.clipped[side][0][t];
		uv[1] = buffers_.clipped[side][1][t];
	}

	POLYTOPE_INLINE void clip(R rest, const R* rate)
	{
		const int from = now_, to = 1 - now_;
		count_ = keepAbove<R>(
		        count_, [&](int k, R* uv) POLYTOPE_INLINE_LAMBDA { get(from, k, uv); },
		        [&](int, const R* uv) POLYTOPE_INLINE_LAMBDA { return rest + rate[0] * uv[0] + rate[1] * uv[1]; },
		        [&](int k, const R* uv) POLYTOPE_INLINE_LAMBDA { put(to, k, uv); });
		now_ = to;
	}

	const SurfaceBuffers<R, 3>& buffers_;
	int                         count_, now_ = 0;
};

/// A segment within the half-spaces.
template <class R> class ClippedPiece<R, 2> {
public:
	template <class Cut>
	POLYTOPE_INLINE ClippedPiece(
	        const SurfacePiece<R, 2>& piece, const Cut& cut, const SurfaceClips<R, 2>& clips, const SurfaceBuffers<R, 2>&)
	{
		cut.vertex(0, &end_[0]);
		cut.vertex(1, &end_[1]);
		bool some = true;
		for (int c = 0; c < clips.count; ++c) {
			R       rate[1];
			const R rest = clips.slackOn(c, piece, rate);
			if (rate[0] > 0) end_[0] = maxOf<R>(end_[0], -rest / rate[0]);
			else if (rate[0] < 0) end_[1] = minOf<R>(end_[1], -rest / rate[0]);
			else some = some && rest >= 0;
		}
		count_ = some && end_[0] < end_[1] ? 2 : 0;
	}

	int                  count() const { return count_; }
	POLYTOPE_INLINE void vertex(int t, R* u) const { u[0] = end_[t]; }

private:
	R   end_[2];
	int count_;
};

} // namespace polytope
