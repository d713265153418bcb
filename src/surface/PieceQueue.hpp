// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "surface/SurfaceBuffers.hpp"

/// Pairs of planes to look at, each once: a queue, and a table with open addressing of what is in it, which grows with it.
namespace polytope {

template <class R, int D> class PieceQueue {
public:
	explicit PieceQueue(const SurfaceBuffers<R, D>& buffers) : buffers_(buffers) { }

	void clear()
	{
		count_ = 0;
		full_  = false;
		clear(leastSlots);
	}

	int        count() const { return count_; }
	bool       full() const { return full_; }
	int        first(int piece) const { return buffers_.queue[queued * piece]; }
	int        second(int piece) const { return buffers_.queue[queued * piece + 1]; }
	const int* known(int piece) const { return buffers_.queue + queued * piece + 2; }

	/// i < j; a, b, c: planes known to meet the piece, or −1. Does nothing if the pair is there.
	POLYTOPE_INLINE void add(int i, int j, int a, int b, int c)
	{
		int slot = find(i, j);
		if (buffers_.slot[slot]) return;
		if (count_ == buffers_.pieces) {
			full_ = true;
			return;
		}
		if (4 * count_ >= slots_) {
			grow();
			slot = find(i, j);
		}
		int* const entry    = buffers_.queue + queued * count_;
		entry[0]            = i;
		entry[1]            = j;
		entry[2]            = a;
		entry[3]            = b;
		entry[4]            = c;
		buffers_.slot[slot] = ++count_;
	}

private:
	static constexpr int leastSlots = 256, queued = SurfaceBuffers<R, D>::queued;

	void clear(int slots)
	{
		slots_ = slots;
		for (int k = 0; k < slots_; ++k)
			buffers_.slot[k] = 0;
	}

	POLYTOPE_APART void grow()
	{
		clear(2 * slots_);
		for (int piece = 0; piece < count_; ++piece)
			buffers_.slot[find(first(piece), second(piece))] = piece + 1;
	}

	/// Where the pair is, or the free slot for it.
	POLYTOPE_INLINE int find(int i, int j) const
	{
		std::uint32_t slot = (std::uint32_t(i) * 2654435761u ^ std::uint32_t(j) * 2246822519u) >> 7;
		for (;; ++slot) {
			slot &= std::uint32_t(slots_ - 1);
			const int piece = buffers_.slot[slot] - 1;
			if (piece < 0 || (first(piece) == i && second(piece) == j)) return int(slot);
		}
	}

	const SurfaceBuffers<R, D>& buffers_;
	int                         slots_ = 0, count_ = 0;
	bool                        full_ = false;
};

} // namespace polytope
