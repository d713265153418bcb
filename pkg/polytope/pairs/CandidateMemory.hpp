// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/Interaction.hpp>

#include <src/contact/ContactTypes.hpp>

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>

namespace yade {

/// What pairs without a contact remember from step to step: the basis of the linear program and its weights, by which most are dismissed.
///
/// A pair that may touch soon has an Interaction of YADE's (0.35 kB); here it gets 48 bytes
/// more, while a PolytopeGeom (0.5 kB, and saved with the scene) is made when the bodies come into contact. The records lie in the order
/// in which the InteractionLoop visits the pairs, by Interaction::linIx. When YADE's collider deletes a pair, the last one takes its place in that
/// order: it finds a record of another pair there, and starts once without memory. Memory makes answers cheaper, never different: a new
/// contact is computed without it (PolytopeGeom.cpp).
///
/// Threads compute different pairs, so each record has one user at a time; room for more records is made by whichever thread needs it first.
class CandidateMemory {
public:
	CandidateMemory() = default;
	~CandidateMemory();
	CandidateMemory(const CandidateMemory&)            = delete;
	CandidateMemory& operator=(const CandidateMemory&) = delete;

	/// Memory of the pair from the step before this one; empty where there is none.
	polytope::PairMemory recall(const Interaction& pair, long step) const;
	/// Keeps the basis and weights of a pair that is apart. A memory with a contact point is none of them: it is not kept.
	void remember(const Interaction& pair, long step, const polytope::PairMemory& memory);

private:
	/// Zero: of no pair, for no body is in contact with itself.
	struct Record {
		std::array<Real, 3>          weights;
		Body::id_t                   id1, id2;
		std::int32_t                 step; ///< of the memory; the scene's number of steps without its highest digits
		std::array<std::uint16_t, 4> basis;
	};
	/// Records in a block, blocks on a shelf, shelves: pairs beyond have no memory.
	static constexpr std::size_t blockSize = 1024, shelfSize = 128, mostShelves = 1024;

	using Block = std::atomic<Record*>;
	using Shelf = std::atomic<Block*>;

	/// Null where the pair has no place: it is not in the loop, or beyond all shelves.
	const Record* find(const Interaction& pair) const;
	/// Makes room for it.
	Record* make(const Interaction& pair);

	std::atomic<Shelf*> shelves_ { nullptr };
};

} // namespace yade
