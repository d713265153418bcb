// SPDX-License-Identifier: GPL-2.0-or-later
//
// What a query does, counted: regressions of speed are caught by counters, not by clocks. The bounds are what was measured
// when they were set, with some room for another compiler's rounding; a change that needs more has to give a reason.
#include "PairSamples.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <string>

using namespace polytope;
using namespace polytope::samples;

namespace {

/// Numbers of steps for a set of pairs: means, then the largest.
struct Counts {
	double meanPivots = 0, meanIterations = 0;
	int    mostPivots = 0, mostIterations = 0;
};

struct Bounds {
	const char* name;
	Counts      cold, warm;
};

/// Moved by 1e-4 of the size and turned by 1e-4: a step of DEM.
Pair afterStep(Pair pair, std::mt19937_64& random)
{
	pair.centre2 += Real(1e-4) * pair.size() * randomDirection(random);
	pair.rotation[1] = Eigen::AngleAxis<Real>(Real(1e-4), randomDirection(random)).toRotationMatrix() * pair.rotation[1];
	return pair;
}

/// Pairs from `make`; warm: each pair's query after one of the same pair a step before.
template <class Make> void expectWithin(const Bounds& bounds, Make make, ContactSettings settings = {})
{
	const int       count = 300;
	std::mt19937_64 random(20260);
	Counts          cold, warm;
	const auto      add = [](Counts& counts, const ContactResult& result) {
                counts.meanPivots += double(result.simplexPivots) / count;
                counts.meanIterations += double(result.newtonIterations) / count;
                counts.mostPivots     = std::max(counts.mostPivots, result.simplexPivots);
                counts.mostIterations = std::max(counts.mostIterations, result.newtonIterations);
	};
	for (int i = 0; i < count; ++i) {
		const Pair          pair = make(random);
		PairMemory          memory;
		const ContactResult first = query(pair, settings, &memory);
		ASSERT_TRUE(first.inContact) << bounds.name; // else nothing would be counted
		add(cold, first);
		add(warm, query(afterStep(pair, random), settings, &memory));
	}
	const auto expect = [&](const char* start, const Counts& found, const Counts& bound) {
		std::printf("%-18s %s: pivots %.2f (most %d), Newton iterations %.2f (most %d)\n", bounds.name, start, found.meanPivots,
		        found.mostPivots, found.meanIterations, found.mostIterations);
		EXPECT_LE(found.meanPivots, bound.meanPivots) << bounds.name << ", " << start;
		EXPECT_LE(found.mostPivots, bound.mostPivots) << bounds.name << ", " << start;
		EXPECT_LE(found.meanIterations, bound.meanIterations) << bounds.name << ", " << start;
		EXPECT_LE(found.mostIterations, bound.mostIterations) << bounds.name << ", " << start;
	};
	expect("cold", cold, bounds.cold);
	expect("warm", warm, bounds.warm);
}

constexpr Real touching = Real(0.005); // of the inscribed radius

TEST(Counters, RegularSolids)
{
	const std::pair<int, Bounds> solids[] = {
		{ 4, { "tetrahedron", { 2.3, 3.5, 4, 6 }, { 0.05, 3.2, 1, 4 } } },
		{ 6, { "cube", { 3.1, 3.8, 6, 7 }, { 0.05, 3.2, 1, 4 } } },
		{ 8, { "octahedron", { 3.4, 5.0, 7, 9 }, { 0.05, 3.2, 1, 4 } } },
		{ 12, { "dodecahedron", { 4.5, 4.2, 8, 8 }, { 0.05, 3.2, 1, 4 } } },
		{ 20, { "icosahedron", { 5.1, 5.7, 9, 10 }, { 0.05, 3.2, 1, 4 } } },
	};
	for (const auto& [faces, bounds] : solids)
		expectWithin(bounds, [faces = faces](std::mt19937_64& random) { return regularPair(faces, faces, touching, random); });
}

/// Hulls of 50 faces, all of which touch a ball: none is redundant.
TEST(Counters, HullsOfFiftyFaces)
{
	std::mt19937_64 own(50);
	Shapes          shapes;
	for (int i = 0; i < 20; ++i) {
		HalfSpaces set = randomPlanes(50, own);
		for (Real& offset : set.offsets)
			offset = 1;
		shapes.push_back(ConvexShape::shared(set, Real(0.1)));
	}
	expectWithin({ "hull 50", { 7, 5.5, 14, 9 }, { 0.05, 3.2, 1, 5 } }, [&](std::mt19937_64& random) {
		Pair pair;
		for (int body = 0; body < 2; ++body) {
			pair.shape[body]    = shapes[random() % shapes.size()];
			pair.rotation[body] = randomRotation(random);
		}
		moveTo(pair, randomDirection(random), -touching * pair.inscribedRadius());
		return pair;
	});
}

/// A cube that lies on another one: the usual contact in a settled heap and in a wall. The faces are parallel: many bases
/// are optimal, and the first step, which tilts them by 1e-4, makes another one so.
TEST(Counters, StackedCubes)
{
	expectWithin({ "stacked cubes", { 2.4, 5.3, 4, 8 }, { 2.3, 4.6, 6, 8 } }, [](std::mt19937_64& random) {
		Pair pair;
		pair.shape[0] = pair.shape[1] = ConvexShape::shared(cuboid(1, 1, 1), Real(0.1));
		pair.rotation[1]              = Eigen::AngleAxis<Real>(uniform(random, 0, 1), Vector3::UnitZ()).toRotationMatrix();
		pair.centre2                  = Vector3(uniform(random, -1, 1), uniform(random, -1, 1), 2 - touching * 2);
		return turned(pair, randomRotation(random));
	});
}

/// Times of the stages [ns], of a query of microseconds, where they are asked for.
TEST(Counters, TimesOfStagesAreSmall)
{
	std::mt19937_64 random(5);
	const Pair      pair = regularPair(6, 8, Real(0.02), random);
	for (bool timed : { true, false }) {
		ContactSettings settings;
		settings.timed             = timed;
		const ContactResult result = query(pair, settings);
		for (long time : { result.lpNanoseconds, result.centreNanoseconds }) {
			EXPECT_GE(time, 0);
			EXPECT_LT(time, timed ? 1000000000 : 1);
		}
	}
}

/// Separated pairs: nearly all are dismissed by the last step's basis, without a pivot.
TEST(Counters, SeparatedPairsAreDismissedAtOnce)
{
	const int count = 300;
	for (const int faces : { 4, 6, 8, 12, 20 }) {
		std::mt19937_64 random(77);
		int             dismissed = 0, pivots = 0;
		for (int i = 0; i < count; ++i) {
			const Pair pair = regularPair(faces, faces, Real(-0.05), random);
			PairMemory memory;
			ASSERT_FALSE(query(pair, {}, &memory).inContact);
			const ContactResult result = query(afterStep(pair, random), {}, &memory);
			ASSERT_FALSE(result.inContact);
			dismissed += result.dismissed;
			pivots += result.simplexPivots;
		}
		std::printf("%d faces: %d of %d dismissed, %d pivots\n", faces, dismissed, count, pivots);
		// an optimum with a weight of nearly zero may lose its basis to a step
		EXPECT_GE(dismissed, count - 3) << faces;
		EXPECT_LE(pivots, 10) << faces;
	}
}

/// Queries 20 pairs so often; but for cold ones back and forth by a step, from what the last query has left. surface: warm, with the contact model
/// spring. A function that callgrind finds by its name.
__attribute__((noinline)) void countedQueries(int faces, const std::string& kind, int repetitions)
{
	const bool        cold = kind == "cold", apart = kind == "apart";
	std::mt19937_64   random(1);
	std::vector<Pair> pairs, moved;
	for (int i = 0; i < 20; ++i) {
		pairs.push_back(regularPair(faces, faces, apart ? Real(-0.05) : touching, random));
		moved.push_back(afterStep(pairs.back(), random));
	}
	std::vector<PairMemory> memories(pairs.size());
	ContactSettings         settings;
	if (kind == "surface") settings.contactModel = ContactModel::Spring;
	int contacts = 0;
	for (int i = 0; i <= repetitions; ++i)
		for (std::size_t k = 0; k < pairs.size(); ++k)
			contacts += query(i % 2 ? moved[k] : pairs[k], settings, cold ? nullptr : &memories[k]).inContact;
	EXPECT_EQ(contacts, apart ? 0 : (repetitions + 1) * int(pairs.size()));
}

/// Not a test of its own: what callgrind counts for instructions.py. POLYTOPE_COUNTED: words <cold|warm|surface|apart>,<faces>,<repetitions>.
TEST(Counters, DISABLED_Queries)
{
	const char* text = std::getenv("POLYTOPE_COUNTED");
	ASSERT_NE(text, nullptr);
	std::printf("instruction set: %s\n", instructionSet());
	std::istringstream words(text);
	for (std::string word; words >> word;) {
		int  faces = 0, repetitions = 0;
		char kind[9] = "";
		ASSERT_EQ(std::sscanf(word.c_str(), "%8[a-z],%d,%d", kind, &faces, &repetitions), 3) << word;
		countedQueries(faces, kind, repetitions);
	}
}

} // namespace
