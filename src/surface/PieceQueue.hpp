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

	int  count() const { return count_; }
	bool full() const { return full_; }
	int  first(int piece) const { return buffers_.queue[2 * piece]; }
	int  second(int piece) const { return buffers_.queue[2 * piece + 1]; }

	/// i < j. Does nothing if the pair is there.
	POLYTOPE_INLINE void add(int i, int j)
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
		buffers_.queue[2 * count_]     = i;
		buffers_.queue[2 * count_ + 1] = j;
		buffers_.slot[slot]            = ++count_;
	}

private:
	static constexpr int leastSlots = 256;

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
