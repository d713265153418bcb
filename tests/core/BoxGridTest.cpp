// SPDX-License-Identifier: GPL-2.0-or-later
#include <gtest/gtest.h>

#include "neighbours/BoxGrid.hpp"

#include <algorithm>
#include <limits>
#include <random>
#include <set>

using polytope::BoxGrid;

namespace {

using Box   = BoxGrid::Box;
using Pairs = std::set<std::pair<int, int>>;

constexpr double infinity = std::numeric_limits<double>::infinity();

std::pair<int, int> ordered(int one, int other) { return { std::min(one, other), std::max(one, other) }; }

Pairs byComparingAll(const std::vector<Box>& boxes)
{
	Pairs pairs;
	for (const Box& one : boxes)
		for (const Box& other : boxes)
			if (one.id < other.id && one.overlaps(other)) pairs.insert({ one.id, other.id });
	return pairs;
}

/// Expects that the grid finds each pair that overlaps, once. Returns their number.
std::size_t expectAllPairs(const std::vector<Box>& boxes)
{
	BoxGrid grid;
	grid.reset(boxes);
	Pairs found;
	for (std::size_t place = 0; place < grid.boxes().size(); ++place)
		grid.forPartners(place, [&](const Box& other) {
			const auto pair = ordered(grid.boxes()[place].id, other.id);
			EXPECT_TRUE(found.insert(pair).second) << "twice: " << pair.first << ", " << pair.second;
		});
	EXPECT_EQ(found, byComparingAll(boxes));
	return found.size();
}

/// Boxes at random in a cube of this edge, their extents between these, on a logarithmic scale.
std::vector<Box> randomBoxes(int number, double edge, double least, double most, unsigned seed, double centre = 0)
{
	std::mt19937                           random(seed);
	std::uniform_real_distribution<double> place(-edge / 2, edge / 2), size(std::log(least), std::log(most));
	std::vector<Box>                       boxes;
	for (int id = 0; id < number; ++id) {
		Box box;
		box.id = id;
		for (int k = 0; k < 3; ++k) {
			box.low[k]  = centre + place(random);
			box.high[k] = box.low[k] + std::exp(size(random));
		}
		boxes.push_back(box);
	}
	return boxes;
}

} // namespace

TEST(BoxGrid, FindsAllPairsOfBoxesOfOneSize) { EXPECT_GT(expectAllPairs(randomBoxes(3000, 12, 0.9, 1.1, 1)), 3000u); }

TEST(BoxGrid, FindsAllPairsOfBoxesOfAllSizes)
{
	EXPECT_GT(expectAllPairs(randomBoxes(2000, 30, 0.01, 10, 2)), 1000u);
	EXPECT_GT(expectAllPairs(randomBoxes(2000, 1, 1e-9, 1, 3)), 500u); // below the least level
}

TEST(BoxGrid, FindsAllPairsFarFromTheOrigin)
{
	// where coordinates have few digits left of a cell, and where there are no cells any more
	for (const double centre : { 1e6, -1e11, 3e12, 1e15 })
		EXPECT_GT(expectAllPairs(randomBoxes(500, 8, 0.9, 1.1, 4, centre)), 200u) << centre;
}

TEST(BoxGrid, FindsAllPairsOfFewBoxes)
{
	for (int number = 0; number < 9; ++number)
		for (unsigned seed = 0; seed < 50; ++seed)
			expectAllPairs(randomBoxes(number, 4, 0.5, 5, seed));
}

TEST(BoxGrid, FindsBoxesThatTouch)
{
	// 6 x 6 x 6 boxes without a gap, on the borders of cells
	std::vector<Box> boxes;
	for (int id = 0; id < 216; ++id) {
		const double x = id % 6, y = id / 6 % 6, z = id / 36;
		boxes.push_back({ { { x, y, z } }, { { x + 1, y + 1, z + 1 } }, id });
	}
	EXPECT_EQ(expectAllPairs(boxes), (16 * 16 * 16 - 216) / 2u); // along an axis 16 ordered pairs touch or are the same
}

TEST(BoxGrid, WallsMeetAll)
{
	auto boxes = randomBoxes(400, 10, 0.9, 1.1, 5);
	boxes.push_back({ { { -infinity, -infinity, -1 } }, { { infinity, infinity, -1 } }, 400 });
	boxes.push_back({ { { 2, -infinity, -infinity } }, { { 2, infinity, infinity } }, 401 });
	boxes.push_back({ { { -50, -50, -2 } }, { { 50, 50, -1.5 } }, 402 });
	EXPECT_GT(expectAllPairs(boxes), 100u);
}

TEST(BoxGrid, FarFragmentCostsNothing)
{
	auto boxes = randomBoxes(1000, 10, 0.9, 1.1, 6);
	boxes.push_back({ { { 1e9, 1e9, -1e9 } }, { { 1e9 + 1, 1e9 + 1, -1e9 + 1 } }, 1000 });
	boxes.push_back({ { { 1e9, 1e9, -1e9 } }, { { 1e9 + 1, 1e9 + 1, -1e9 + 1 } }, 1001 });
	boxes.push_back({ { { 1e300, 1e9, -1e9 } }, { { 1e300, 1e9 + 1, -1e9 + 1 } }, 1002 });
	EXPECT_GT(expectAllPairs(boxes), 1000u);
}

TEST(BoxGrid, LeavesOutWhatIsNoBox)
{
	const double     none  = std::numeric_limits<double>::quiet_NaN();
	std::vector<Box> boxes = randomBoxes(20, 2, 0.9, 1.1, 7);
	const auto       pairs = byComparingAll(boxes).size();
	boxes.push_back({ { { none, 0, 0 } }, { { none, 1, 1 } }, 20 });
	boxes.push_back({ { { 1, 1, 1 } }, { { -1, -1, -1 } }, 21 });
	BoxGrid grid;
	grid.reset(boxes);
	EXPECT_EQ(grid.boxes().size(), 20u);
	std::size_t found = 0;
	for (std::size_t place = 0; place < 20; ++place)
		grid.forPartners(place, [&](const Box&) { ++found; });
	EXPECT_EQ(found, pairs);
}

TEST(BoxGrid, RemovedBoxesMeetNone)
{
	auto boxes = randomBoxes(300, 6, 0.9, 1.1, 11);
	boxes.push_back({ { { -infinity, -infinity, -infinity } }, { { infinity, infinity, infinity } }, 300 });
	BoxGrid grid;
	grid.reset(boxes);
	for (std::size_t place = 0; place < grid.boxes().size(); ++place)
		if (grid.boxes()[place].id % 3 == 1) grid.remove(place);
	Pairs found;
	for (std::size_t place = 0; place < grid.boxes().size(); ++place)
		grid.forPartners(place, [&](const Box& other) { found.insert(ordered(grid.boxes()[place].id, other.id)); });
	boxes.erase(std::remove_if(boxes.begin(), boxes.end(), [](const Box& box) { return box.id % 3 == 1; }), boxes.end());
	EXPECT_EQ(found, byComparingAll(boxes));
	EXPECT_GT(found.size(), 50u);
}

TEST(BoxGrid, FindsAllOfABoxThatIsNotInIt)
{
	const auto boxes = randomBoxes(1000, 20, 0.1, 3, 8);
	BoxGrid    grid;
	grid.reset(boxes);
	for (const Box& box : randomBoxes(100, 25, 0.1, 30, 9)) {
		std::multiset<int> found, wanted;
		grid.forOverlaps(box, [&](const Box& other) { found.insert(other.id); });
		for (const Box& other : boxes)
			if (box.overlaps(other)) wanted.insert(other.id);
		EXPECT_EQ(found, wanted);
	}
}

/// Boxes that are compared must not be many more than those that overlap: cells, not luck, find them.
TEST(BoxGrid, ComparesFewBoxes)
{
	const auto boxes = randomBoxes(20000, 27, 0.8, 1.2, 10);
	BoxGrid    grid;
	grid.reset(boxes);
	// neighbours in the list are neighbours in space: the mean distance along it is far below that of boxes in any order
	double near = 0;
	for (std::size_t place = 1; place < grid.boxes().size(); ++place)
		for (int k = 0; k < 3; ++k)
			near += std::abs(grid.boxes()[place].low[k] - grid.boxes()[place - 1].low[k]) / double(grid.boxes().size());
	EXPECT_LT(near, 3);
}
