// SPDX-License-Identifier: GPL-2.0-or-later
//
// A pair's memory makes the next query cheaper, never different.
#include "SameAnswer.hpp"

#include <gtest/gtest.h>

#include <limits>

using namespace polytope;
using namespace polytope::samples;

namespace {

void expectSameAsCold(const Pair& pair, const ContactResult& warm, SameAnswers& answers)
{
	const ContactResult cold     = query(pair);
	const Real          rounding = 32 * tolerance::rounding * pair.reach();
	ASSERT_TRUE(finite(warm));
	if (cold.status == ContactStatus::NoDirection) { // a body within the other: s* is that of one alone
		ASSERT_NEAR(cold.infeasibility, -pair.inscribedRadius(), rounding);
		ASSERT_EQ(warm.status, cold.status);
		return;
	}
	ASSERT_TRUE(answered(warm.status)) << statusName(warm.status);
	if (std::abs(cold.infeasibility + tolerance::contact * pair.size()) < rounding) return; // touching: either will do
	ASSERT_EQ(warm.inContact, cold.inContact);
	if (!cold.inContact || -cold.infeasibility < 10 * rounding) return;
	const PrecisePair exact(pair);
	answers.expect(exact, Allowance(pair, exact, cold), cold, warm);
}

Matrix3 smallTurn(std::mt19937_64& random, Real angle, int dimension)
{
	const Vector3 axis = dimension == 2 ? Vector3(0, 0, 1) : randomDirection(random);
	return Eigen::AngleAxis<Real>(uniform(random, -angle, angle), axis).toRotationMatrix();
}

struct Totals {
	long        contacts = 0, separated = 0, pivots = 0, iterations = 0;
	SameAnswers answers; ///< as cold

	void add(const ContactResult& result)
	{
		++(result.inContact ? contacts : separated);
		pivots += result.simplexPivots;
		iterations += result.newtonIterations;
	}
};

void walk(int dimension, Real stride, Totals& warm, Totals& cold)
{
	std::mt19937_64 random(100 + dimension);
	const Shapes    shapes = randomShapes(60, random, dimension, Real(-0.5));
	for (int path = 0; path < 120 && !testing::Test::HasFailure(); ++path) {
		Pair       pair = randomPair(shapes, random);
		const Real step = stride * pair.inscribedRadius();
		PairMemory memory;
		query(pair, {}, &memory);
		for (int k = 0; k < 60 && !testing::Test::HasFailure(); ++k) {
			pair.centre2 += step * randomDirection(random, dimension);
			for (Matrix3& rotation : pair.rotation)
				rotation = smallTurn(random, stride, dimension) * rotation;
			SCOPED_TRACE("path " + std::to_string(path) + " step " + std::to_string(k));
			const ContactResult result = query(pair, {}, &memory);
			warm.add(result);
			cold.add(query(pair));
			expectSameAsCold(pair, result, warm.answers);
		}
	}
	warm.answers.expectFew(0);
}

class Walks : public testing::TestWithParam<int> { };

TEST_P(Walks, SmallStepsAreCheaperAndTheSame)
{
	Totals warm, cold;
	walk(GetParam(), 1e-4, warm, cold);
	EXPECT_GT(warm.contacts, 2000);
	EXPECT_GT(warm.separated, 1000);
	EXPECT_LT(warm.pivots, 0.3 * cold.pivots);
	EXPECT_LT(warm.iterations, 0.9 * cold.iterations); // a thin overlap's point is no nearer than the linear program's
}

TEST_P(Walks, LargeStepsAreTheSame)
{
	Totals warm, cold;
	walk(GetParam(), 0.3, warm, cold);
	EXPECT_GT(warm.contacts, 1000);
	EXPECT_GT(warm.separated, 300);
}

INSTANTIATE_TEST_SUITE_P(Dimensions, Walks, testing::Values(2, 3), [](const auto& info) { return std::to_string(info.param) + "D"; });

TEST(PairMemory, AnyBasisAndPointAreAGoodEnoughStart)
{
	std::mt19937_64 random(102);
	const Shapes    shapes = randomShapes(60, random);
	int             kept   = 0;
	SameAnswers     answers;
	for (int trial = 0; trial < 3000 && !HasFailure(); ++trial) {
		const Pair pair = randomPair(shapes, random);
		PairMemory memory;
		memory.hasBasis      = true;
		memory.hasPoint      = trial % 2 == 0;
		memory.dualDirection = decades(random, -3, 3) * randomDirection(random);
		if (trial % 16 < 2) memory.dualDirection[trial % 3] = std::numeric_limits<Real>::quiet_NaN();
		memory.weights = memory.dualDirection;
		for (int& code : memory.basis) {
			const int body = int(random() % 2);
			code           = 2 * int(random() % pair.shape[body]->planeCount()) + body;
		}
		for (Vector3& point : memory.point)
			point = decades(random, -3, 3) * pair.size() * randomDirection(random);
		const ContactResult result = query(pair, {}, &memory);
		expectSameAsCold(pair, result, answers);
		kept += memory.hasPoint;
		EXPECT_EQ(memory.hasPoint, result.inContact);
	}
	EXPECT_GT(kept, 2000);
	answers.expectFew(0);
}

TEST(PairMemory, AnyDirectionIsAGoodEnoughStart)
{
	std::mt19937_64 random(104);
	const Shapes    shapes = randomShapes(60, random);
	int             kept   = 0;
	SameAnswers     answers;
	for (int trial = 0; trial < 3000 && !HasFailure(); ++trial) {
		Pair pair = randomPair(shapes, random);
		moveTo(pair, randomDirection(random), -decades(random, -9, -1));
		PairMemory memory;
		query(pair, {}, &memory);
		memory.dualDirection = decades(random, -3, 3) * randomDirection(random);
		if (trial % 16 < 2) memory.dualDirection *= std::numeric_limits<Real>::infinity();
		const ContactResult result = query(pair, {}, &memory);
		expectSameAsCold(pair, result, answers);
		kept += result.inContact;
	}
	EXPECT_EQ(kept, 3000);
	answers.expectFew(0);
}

TEST(PairMemory, HoldsTheContactPointInBothBodies)
{
	std::mt19937_64 random(103);
	for (int trial = 0; trial < 100; ++trial) {
		const Pair          pair = regularPair(12, 8, Real(0.05), random);
		PairMemory          memory;
		const ContactResult result = query(pair, {}, &memory);
		ASSERT_TRUE(result.inContact && memory.hasBasis && memory.hasPoint);
		EXPECT_LE((pair.rotation[0] * memory.point[0] - result.point).norm(), 1e-14);
		EXPECT_LE((pair.rotation[1] * memory.point[1] + pair.centre2 - result.point).norm(), 1e-14);
		EXPECT_EQ(memory.basis, result.basis);
	}
}

TEST(PairMemory, IsNotReadWhereWarmStartIsOff)
{
	std::mt19937_64 random(104);
	ContactSettings settings;
	settings.warmStart = false;
	for (int trial = 0; trial < 100; ++trial) {
		const Pair pair = regularPair(20, 4, Real(0.05), random);
		PairMemory memory;
		query(pair, {}, &memory);
		const ContactResult again = query(pair, settings, &memory), cold = query(pair);
		EXPECT_EQ(again.simplexPivots, cold.simplexPivots);
		EXPECT_EQ(again.newtonIterations, cold.newtonIterations);
		EXPECT_EQ(again.point, cold.point);
	}
}

TEST(PairMemory, DismissesASeparatedPairAtOnce)
{
	std::mt19937_64 random(105);
	int             dismissed = 0;
	for (int trial = 0; trial < 300; ++trial) {
		Pair       pair = regularPair(12, 12, Real(-0.1), random);
		PairMemory memory;
		query(pair, {}, &memory);
		pair.centre2 *= 1.001;
		const ContactResult result = query(pair, {}, &memory);
		EXPECT_FALSE(result.inContact);
		EXPECT_EQ(result.status, ContactStatus::Separated);
		EXPECT_EQ(result.simplexPivots, 0);
		EXPECT_EQ(result.newtonIterations, 0);
		EXPECT_LE(result.infeasibility, infeasibility(pair) + 1e-14) << "a lower bound";
		dismissed += result.dismissed;
	}
	EXPECT_GT(dismissed, 290);
}

} // namespace
