// SPDX-License-Identifier: GPL-2.0-or-later
#include "neighbours/BoxGrid.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

namespace polytope {

namespace {

	constexpr double infinity = std::numeric_limits<double>::infinity();

	double widest(const BoxGrid::Box& box)
	{
		double most = 0;
		for (int k = 0; k < 3; ++k)
			most = std::max(most, box.high[k] - box.low[k]);
		return most;
	}

	bool isBox(const BoxGrid::Box& box)
	{
		bool is = true;
		for (int k = 0; k < 3; ++k)
			is = is && box.low[k] <= box.high[k];
		return is;
	}

	/// Width of the middle level's cells: that of the widest box among those up to twice the median width. Most boxes of a sample are in this level.
	double middleWidth(const std::vector<BoxGrid::Box>& boxes)
	{
		std::vector<double> widths;
		widths.reserve(boxes.size());
		for (const BoxGrid::Box& box : boxes)
			if (const double width = widest(box); width > 0 && width < infinity) widths.push_back(width);
		if (widths.empty()) return 1;
		const auto middle = widths.begin() + widths.size() / 2;
		std::nth_element(widths.begin(), middle, widths.end());
		const double most  = 2 * *middle;
		double       found = *middle;
		for (const double width : widths)
			if (width <= most) found = std::max(found, width);
		return found;
	}

	/// Widths of levels differ by factors of two.
	int levelOf(const BoxGrid::Box& box, double middle)
	{
		const double width = widest(box);
		int          level = std::max(std::ilogb(width / middle), -tolerance::boxLevels); // of nothing: the least number
		while (std::ldexp(middle, level) < width) // also where the quotient has been rounded
			++level;
		return level;
	}

	bool hasCell(const BoxGrid::Box& box, double width)
	{
		double farthest = 0;
		for (int k = 0; k < 3; ++k)
			farthest = std::max({ farthest, std::abs(box.low[k]), std::abs(box.high[k]) });
		return farthest / width < tolerance::farthestCell;
	}

} // namespace

void BoxGrid::reset(std::vector<Box> boxes)
{
	boxes.erase(std::remove_if(boxes.begin(), boxes.end(), [](const Box& box) { return !isBox(box); }), boxes.end());
	const double                    middle = middleWidth(boxes);
	std::map<int, std::vector<Box>> byLevel;
	std::vector<Box>                everywhere;
	for (const Box& box : boxes) {
		const int level = widest(box) < infinity ? levelOf(box, middle) : 0;
		if (hasCell(box, std::ldexp(middle, level))) byLevel[level].push_back(box);
		else everywhere.push_back(box);
	}
	boxes_.clear();
	boxes_.reserve(boxes.size());
	levels_.clear();
	for (auto& [number, ofLevel] : byLevel) {
		levels_.emplace_back();
		levels_.back().width = std::ldexp(middle, number);
		fill(levels_.back(), ofLevel);
	}
	levels_.emplace_back();
	levels_.back().first = boxes_.size();
	boxes_.insert(boxes_.end(), everywhere.begin(), everywhere.end());
	levels_.back().end = boxes_.size();
	levels_.back().begins.assign(2, 0);
}

void BoxGrid::remove(std::size_t place) { boxes_[place].low.fill(std::numeric_limits<double>::quiet_NaN()); }

void BoxGrid::fill(Level& level, std::vector<Box>& boxes)
{
	Cell low = level.cellOf(boxes.front().low), high = low;
	for (const Box& box : boxes) {
		const Cell cell = level.cellOf(box.low);
		for (int k = 0; k < 3; ++k) {
			low[k]  = std::min(low[k], cell[k]);
			high[k] = std::max(high[k], cell[k]);
		}
	}
	for (int k = 1; k < 3; ++k)
		level.stride[k] = level.stride[k - 1] * std::size_t(high[k - 1] - low[k - 1] + 1);
	std::size_t entries = 1;
	while (entries < 2 * boxes.size())
		entries *= 2;
	level.begins.assign(entries + 1, 0);

	// sorted by counting
	std::vector<std::uint32_t> entryOfBox(boxes.size());
	for (std::size_t i = 0; i < boxes.size(); ++i)
		++level.begins[(entryOfBox[i] = std::uint32_t(level.entryOf(level.cellOf(boxes[i].low))))];
	level.first        = boxes_.size();
	std::uint32_t next = std::uint32_t(level.first);
	for (std::uint32_t& begin : level.begins)
		next += std::exchange(begin, next);
	boxes_.resize(level.first + boxes.size());
	for (std::size_t i = 0; i < boxes.size(); ++i)
		boxes_[level.begins[entryOfBox[i]]++] = boxes[i];
	for (std::size_t entry = entries; entry > 0; --entry)
		level.begins[entry] = level.begins[entry - 1]; // each has moved on to the next one's first
	level.begins[0] = std::uint32_t(level.first);
	level.end       = boxes_.size();
}

} // namespace polytope
