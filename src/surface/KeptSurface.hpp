// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <array>
#include <cstdint>

/// The pieces of a pair's last contact surface: the two planes of each, and those along its edges, in order. From step to step they seldom change: then
/// SurfaceWalk::again() has the surface without looking for it.
namespace polytope {

/// Values, no pointers: copied and saved with the interaction. Any value is safe.
struct KeptSurface {
	static constexpr int room = 508, mostEdges = 16;

	std::uint16_t used      = 0; ///< numbers; 0: nothing is kept
	std::uint8_t  parts     = 0; ///< SurfaceParts
	std::uint8_t  exchanged = 0; ///< whether the bodies are in the other order than they were then
	/// Of each piece: both planes, the number of edges, the plane of each; planes as names (PlaneNames).
	std::array<std::uint16_t, room> number;
};

/// Planes by the bodies they belong to: a number among those that are near holds for one step only.
struct PlaneNames {
	static constexpr int noPressure = 65535, unknown = -1, mostOfBody = 32767;

	const int* all   = nullptr; ///< of each near plane: its row among all, or less than zero
	const int* near  = nullptr; ///< of each of all: its row among the near ones, or less than zero
	int        first = 0;       ///< rows of body 1 among all
	int        total = 0;       ///< rows of both
	int        none  = 0;       ///< number of the plane of no pressure among the near ones

	int name(int row) const
	{
		if (row == none) return noPressure;
		const int own = row >= 0 ? all[row] : unknown, second = own >= first, index = own - (second ? first : 0);
		return own >= 0 && index < mostOfBody ? 2 * index + second : unknown;
	}
	int row(int name) const
	{
		if (name == noPressure) return none;
		const int index = name >> 1, own = (name & 1) ? first + index : index;
		return own < ((name & 1) ? total : first) ? near[own] : unknown;
	}
};

/// Writes a surface as it is found. One that cannot be kept is left out as a whole: with more pieces than there is room for, with edges in which more
/// planes meet, so that it is not said which pieces follow each other, or with planes of both bodies that coincide.
class SurfaceRecord {
public:
	SurfaceRecord(KeptSurface* kept, const PlaneNames& names) : kept_(kept), names_(names) { }

	void begin()
	{
		if (kept_) kept_->used = 0;
		used_ = 0;
	}
	void giveUp() { used_ = KeptSurface::room + 1; }

	template <class Cut> void add(int i, int j, const Cut& cut)
	{
		const int edges = cut.count();
		if (!kept_ || used_ + 3 + edges > KeptSurface::room || edges > KeptSurface::mostEdges) return giveUp();
		put(names_.name(i));
		put(names_.name(j));
		put(edges);
		for (int t = 0; t < edges; ++t)
			put(names_.name(cut.tag(t)));
	}

	/// `between`: no pieces between planes of one body; `faces`: those on the overlap's surface.
	void end(int parts, bool between, bool faces)
	{
		if (!kept_ || used_ > KeptSurface::room || !isClosed(between, faces)) return;
		kept_->used      = std::uint16_t(used_);
		kept_->parts     = std::uint8_t(parts);
		kept_->exchanged = 0;
	}

private:
	/// Whether all pieces that meet in an edge of one of them are there. A piece so small that it has no area is not, and may grow.
	bool isClosed(bool between, bool faces) const
	{
		for (int at = 0; at < used_; at += 3 + number(at + 2))
			for (int t = 0; t < number(at + 2); ++t)
				for (int side = 0; side < 2; ++side) {
					const int  i = number(at + side), k = number(at + 3 + t), none = PlaneNames::noPressure;
					const bool asked = i == none || k == none ? faces : !between || (i & 1) != (k & 1);
					if (asked && !has(i, k)) return false;
				}
		return true;
	}
	bool has(int i, int j) const
	{
		for (int at = 0; at < used_; at += 3 + number(at + 2))
			if ((number(at) == i && number(at + 1) == j) || (number(at) == j && number(at + 1) == i)) return true;
		return false;
	}
	int number(int at) const { return kept_->number[std::size_t(at)]; }

	void put(int number)
	{
		if (number == PlaneNames::unknown) giveUp();
		else if (used_ < KeptSurface::room) kept_->number[std::size_t(used_++)] = std::uint16_t(number);
	}

	KeptSurface* kept_;
	PlaneNames   names_;
	int          used_ = 0;
};

/// One piece after the other.
class KeptPieces {
public:
	KeptPieces(const KeptSurface& kept, const PlaneNames& names) : kept_(kept), names_(names) { }

	int i = 0, j = 0, edges = 0;
	int tag[KeptSurface::mostEdges];

	/// Whether there is one more, all of whose planes are near.
	bool next()
	{
		const int used = kept_.used < KeptSurface::room ? kept_.used : KeptSurface::room;
		if (at_ + 3 > used) return false;
		i     = names_.row(get());
		j     = names_.row(get());
		edges = get();
		if (edges > KeptSurface::mostEdges || at_ + edges > used) return false;
		bool known = i >= 0 && j >= 0 && i < j;
		for (int t = 0; t < edges; ++t) {
			tag[t] = names_.row(get());
			known  = known && tag[t] >= 0;
		}
		return known;
	}
	bool atEnd() const { return at_ == kept_.used; }

private:
	int get() { return kept_.number[std::size_t(at_++)]; }

	const KeptSurface& kept_;
	PlaneNames         names_;
	int                at_ = 0;
};

} // namespace polytope
