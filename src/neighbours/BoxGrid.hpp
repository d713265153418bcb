// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "numbers/Tolerances.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

/// All pairs of boxes that overlap, by a grid that is made anew each time.
///
/// Problem: which of n axis-parallel boxes of any sizes overlap? Boxes of about one size are a level. Each lies in one cell of its level, that
/// of its lowest corner, and cells are as wide as the level's widest box: so a box overlaps with those of the cells that it reaches, and of
/// the next lower ones. It is compared with its own level and with all wider ones, of which it reaches few cells. Boxes without an end (walls),
/// and those farther away than cells can be numbered, are compared with all. Time and memory grow as n where bodies do not lie in each other.
///
/// Boxes are kept in the order of their cells: those of neighbours are near each other in memory.
namespace polytope {

class BoxGrid {
public:
	struct Box {
		std::array<double, 3> low, high;
		std::int32_t          id; ///< the caller's

		bool overlaps(const Box& other) const
		{
			bool all = true; // no branches: two of three boxes that are compared do not overlap, in no order
			for (int k = 0; k < 3; ++k)
				all &= (low[k] <= other.high[k]) & (other.low[k] <= high[k]);
			return all;
		}
	};

	/// Boxes whose corners are no numbers, or in the wrong order, are left out.
	void reset(std::vector<Box> boxes);

	/// The boxes, in the order of their cells.
	const std::vector<Box>& boxes() const { return boxes_; }

	/// The box at this place overlaps with none any more.
	void remove(std::size_t place);

	/// Calls visit(other) for boxes that overlap with boxes()[place]: over all places, each pair comes once.
	template <class Visit> void forPartners(std::size_t place, const Visit& visit) const;

	/// Calls visit(other) for all boxes that overlap with one that is not in the grid.
	template <class Visit> void forOverlaps(const Box& box, const Visit& visit) const;

private:
	using Cell = std::array<std::int64_t, 3>;

	/// Cells are numbered along the axes; their numbers beyond the length of the list begin anew (a box's own cell tells cells of one entry apart).
	struct Level {
		double                     width = 0; ///< of a cell
		std::array<std::size_t, 3> stride { { 1, 1, 1 } };
		std::vector<std::uint32_t> begins;             ///< first box of each entry of the list, and the end; 2^k + 1
		std::size_t                first = 0, end = 0; ///< places of the level's boxes

		Cell        cellOf(const std::array<double, 3>& corner) const;
		std::size_t entryOf(const Cell& cell) const;
		std::size_t entries() const { return begins.size() - 1; }
	};

	void                        fill(Level& level, std::vector<Box>& boxes);
	template <class Visit> void visitLevel(const Level& level, const Box& box, std::size_t from, const Visit& visit) const;
	template <class Visit> void visitPlaces(std::size_t from, std::size_t end, const Box& box, const Visit& visit) const;

	std::vector<Box>   boxes_;
	std::vector<Level> levels_; ///< narrow ones first; the last, without cells, has the boxes that are compared with all
};

inline BoxGrid::Cell BoxGrid::Level::cellOf(const std::array<double, 3>& corner) const
{
	Cell cell;
	for (int k = 0; k < 3; ++k)
		cell[k] = std::int64_t(std::floor(corner[k] / width));
	return cell;
}

inline std::size_t BoxGrid::Level::entryOf(const Cell& cell) const
{
	std::size_t number = 0;
	for (int k = 0; k < 3; ++k)
		number += std::size_t(cell[k]) * stride[k];
	return number & (entries() - 1);
}

template <class Visit> void BoxGrid::visitPlaces(std::size_t from, std::size_t end, const Box& box, const Visit& visit) const
{
	for (std::size_t place = from; place < end; ++place)
		if (boxes_[place].overlaps(box)) visit(boxes_[place]);
}

template <class Visit> void BoxGrid::visitLevel(const Level& level, const Box& box, std::size_t from, const Visit& visit) const
{
	const std::size_t first = from < level.first ? level.first : from;
	if (!(first < level.end)) return;
	double cells = 1;
	for (int k = 0; k < 3; ++k)
		cells *= (box.high[k] - box.low[k]) / level.width + 3;
	if (!(level.width > 0) || !(cells < double(level.entries()))) { // also a box without an end
		visitPlaces(first, level.end, box, visit);
		return;
	}
	std::array<double, 3> lower;
	for (int k = 0; k < 3; ++k)
		lower[k] = box.low[k] - tolerance::cellRoom * level.width;
	const Cell low = level.cellOf(lower), high = level.cellOf(box.high);
	Cell       cell;
	for (cell[2] = low[2]; cell[2] <= high[2]; ++cell[2])
		for (cell[1] = low[1]; cell[1] <= high[1]; ++cell[1]) {
			cell[0]                 = low[0];
			const std::size_t entry = level.entryOf(cell), past = entry + std::size_t(high[0] - low[0]) + 1,
			                  all = level.entries();
			const auto ofThisRow  = [&](const Box& other) {
                                const Cell own = level.cellOf(other.low);
                                if (own[1] == cell[1] && own[2] == cell[2] && own[0] >= low[0] && own[0] <= high[0]) visit(other);
			};
			const auto visitEntries = [&](std::size_t one, std::size_t end) {
				const std::size_t begin = level.begins[one];
				visitPlaces(begin < first ? first : begin, level.begins[end], box, ofThisRow);
			};
			visitEntries(entry, past < all ? past : all);
			if (past > all) visitEntries(0, past - all);
		}
}

template <class Visit> void BoxGrid::forPartners(std::size_t place, const Visit& visit) const
{
	for (const Level& level : levels_)
		if (place < level.end) visitLevel(level, boxes_[place], place + 1, visit);
}

template <class Visit> void BoxGrid::forOverlaps(const Box& box, const Visit& visit) const
{
	for (const Level& level : levels_)
		visitLevel(level, box, 0, visit);
}

} // namespace polytope
