// SPDX-License-Identifier: GPL-2.0-or-later
#include "pairs/CandidateMemory.hpp"

#include <limits>
#include <new>

namespace yade {
namespace {

	/// The array at `place`, made by the first thread that asks for it, all zero. Null if there is no memory.
	template <class Item> Item* arrayAt(std::atomic<Item*>& place, std::size_t size)
	{
		Item* found = place.load(std::memory_order_acquire);
		if (found) return found;
		Item* const made = new (std::nothrow) Item[size]();
		if (place.compare_exchange_strong(found, made, std::memory_order_acq_rel)) return made;
		delete[] made; // another thread was first
		return found;
	}

	std::int32_t shortened(long step) { return std::int32_t(std::uint32_t(step)); }

} // namespace

CandidateMemory::~CandidateMemory()
{
	Shelf* const shelves = shelves_.load();
	for (std::size_t k = 0; shelves && k < mostShelves; ++k) {
		Block* const blocks = shelves[k].load();
		for (std::size_t j = 0; blocks && j < shelfSize; ++j)
			delete[] blocks[j].load();
		delete[] blocks;
	}
	delete[] shelves;
}

const CandidateMemory::Record* CandidateMemory::find(const Interaction& pair) const
{
	const auto         index   = std::size_t(pair.linIx);
	const Shelf* const shelves = shelves_.load(std::memory_order_acquire);
	if (!shelves || pair.linIx < 0 || index >= blockSize * shelfSize * mostShelves) return nullptr;
	const Block* const blocks = shelves[index / (blockSize * shelfSize)].load(std::memory_order_acquire);
	if (!blocks) return nullptr;
	const Record* const block = blocks[index / blockSize % shelfSize].load(std::memory_order_acquire);
	return block ? block + index % blockSize : nullptr;
}

CandidateMemory::Record* CandidateMemory::make(const Interaction& pair)
{
	const auto index = std::size_t(pair.linIx);
	if (pair.linIx < 0 || index >= blockSize * shelfSize * mostShelves) return nullptr;
	Shelf* const shelves = arrayAt(shelves_, mostShelves);
	if (!shelves) return nullptr;
	Block* const blocks = arrayAt(shelves[index / (blockSize * shelfSize)], shelfSize);
	if (!blocks) return nullptr;
	Record* const block = arrayAt(blocks[index / blockSize % shelfSize], blockSize);
	return block ? block + index % blockSize : nullptr;
}

polytope::PairMemory CandidateMemory::recall(const Interaction& pair, long step) const
{
	polytope::PairMemory memory;
	const Record* const  record = find(pair);
	if (!record || record->id1 != pair.getId1() || record->id2 != pair.getId2()) return memory;
	if (record->step != shortened(step - 1) && record->step != shortened(step)) return memory; // of an earlier run of these engines
	memory.hasBasis = true;
	for (int k = 0; k < 4; ++k)
		memory.basis[k] = record->basis[k];
	memory.weights = Vector3r(record->weights[0], record->weights[1], record->weights[2]);
	return memory;
}

void CandidateMemory::remember(const Interaction& pair, long step, const polytope::PairMemory& memory)
{
	constexpr int largest = std::numeric_limits<std::uint16_t>::max();
	bool          keep    = memory.hasBasis && !memory.hasPoint;
	for (const int code : memory.basis)
		keep = keep && code >= 0 && code <= largest;
	Record* const record = make(pair);
	if (!record) return;
	if (!keep) {
		record->id1 = record->id2 = 0;
		return;
	}
	record->id1  = pair.getId1();
	record->id2  = pair.getId2();
	record->step = shortened(step);
	for (int k = 0; k < 4; ++k)
		record->basis[k] = std::uint16_t(memory.basis[k]);
	for (int k = 0; k < 3; ++k)
		record->weights[k] = memory.weights[k];
}

} // namespace yade
