// SPDX-License-Identifier: GPL-2.0-or-later
//
// What holds for every pair: swap, rigid motion and scale change nothing but rounding; the status describes the answer.
#include "contact/ContactQuery.hpp"
#include "SameAnswer.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <map>
#include <set>

using namespace polytope;
using namespace polytope::samples;

namespace {

ContactResult backSwapped(ContactResult result, const Vector3& centre2)
{
	result.point += centre2;
	result.normal = -result.normal;
	return result;
}

ContactResult backTurned(ContactResult result, const Matrix3& rotation)
{
	result.point  = rotation.transpose() * result.point;
	result.normal = rotation.transpose() * result.normal;
	return result;
}

/// The status names where it comes from.
void expectDocumentedStatus(const Pair& pair, const PrecisePair& exact, const Allowance& allowed, const ContactResult& result)
{
	const QuadVector x = precise(result.point);
	Vector3          direction[2];
	bool             has[2];
	for (int body = 0; body < 2; ++body) {
		direction[body]   = rounded(exact.innerGradient(body, x));
		const Real length = direction[body].norm();
		has[body]         = length > 0;
		if (has[body] && length < 1e-9 * pair.size()) return; // on the border
		if (has[body]) direction[body] /= body == 0 ? length : -length;
	}
	EXPECT_NEAR(result.normal.norm(), 1, 4e-15);
	EXPECT_GT(result.depth, 0);
	if (result.status == ContactStatus::RoundingLimited) return;
	if (has[0] && has[1]) {
		EXPECT_EQ(result.status, ContactStatus::Contact);
		EXPECT_LE((result.normal - (direction[0] + direction[1]).normalized()).norm(), allowed.normal);
	} else if (has[0] || has[1]) {
		EXPECT_EQ(result.status, ContactStatus::NormalFromOneBody);
		EXPECT_LE((result.normal - direction[has[0] ? 0 : 1]).norm(), allowed.normal);
	} else {
		EXPECT_EQ(result.status, ContactStatus::NormalFromDual);
		EXPECT_LE((result.normal - result.dualDirection.normalized()).norm(), 1e-13);
	}
}

class RandomPairs : public testing::TestWithParam<int> {
protected:
	std::mt19937_64 random { 20000u + unsigned(GetParam()) };
	const Shapes    shapes = randomShapes(GetParam() == 3 ? 150 : 80, random, GetParam());
	const int       trials = GetParam() == 3 ? 15000 : 6000;

	/// Each status' number of pairs.
	std::map<ContactStatus, int> swapAndMove();
};

std::map<ContactStatus, int> RandomPairs::swapAndMove()
{
	std::map<ContactStatus, int> count;
	SameAnswers                  exchanged, rotated;
	for (int trial = 0; trial < trials && !HasFailure(); ++trial) {
		SCOPED_TRACE("trial " + std::to_string(trial));
		const Pair      pair = randomPair(shapes, random);
		ContactSettings settings;
		settings.section           = true;
		const ContactResult result = query(pair, settings), back = query(swapped(pair), settings);
		++count[result.status];
		EXPECT_TRUE(finite(result) && finite(back));
		EXPECT_EQ(result.inContact, back.inContact);
		EXPECT_EQ(result.inContact, result.status != ContactStatus::Separated) << statusName(result.status);
		const Matrix3       rotation = randomRotation(random, pair.dimension());
		const ContactResult there    = query(turned(pair, rotation), settings);
		EXPECT_EQ(result.inContact, there.inContact);
		if (!result.inContact) {
			EXPECT_FALSE(result.hasGeometry);
			EXPECT_LE(result.infeasibility, infeasibility(pair) + 8 * tolerance::rounding * pair.reach());
			EXPECT_GE(result.infeasibility, -tolerance::contact * pair.size());
			continue;
		}
		const PrecisePair exact(pair);
		EXPECT_LT(exact.violation(precise(result.point)), 0);
		const Allowance allowed(pair, exact, result);
		expectDocumentedStatus(pair, exact, allowed, result);
		exchanged.expect(exact, allowed, result, backSwapped(back, pair.centre2));
		rotated.expect(exact, allowed, result, backTurned(there, rotation));
	}
	for (const SameAnswers& answers : { exchanged, rotated })
		answers.expectFew(0);
	const int contacts = trials - count[ContactStatus::Separated];
	EXPECT_GT(contacts, 0.7 * trials);
	EXPECT_LT(contacts, 0.8 * trials);
	// what this status excuses above: no overlap here is as thin as that, and none was called so
	EXPECT_LE(count[ContactStatus::RoundingLimited], 2e-3 * contacts);
	for (const auto& [status, number] : count)
		EXPECT_TRUE(answered(status) || number == 0) << number << ' ' << statusName(status);
	return count;
}

TEST_P(RandomPairs, SwapAndRigidMotionChangeNothing)
{
	const auto count = swapAndMove();
	EXPECT_GT(count.at(ContactStatus::Contact), 0.3 * trials);
	EXPECT_GT(count.at(ContactStatus::NormalFromOneBody), 0.02 * trials);
	EXPECT_GT(count.at(ContactStatus::NormalFromDual), 0.01 * trials);
}

TEST_P(RandomPairs, ScaledByAPowerOfTwoTheAnswerIsScaledToTheLastBit)
{
	for (int exponent : { -30, 13 }) {
		const Real                                                       factor = std::ldexp(Real(1), exponent);
		std::map<const ConvexShape*, std::shared_ptr<const ConvexShape>> larger;
		for (const auto& shape : shapes)
			larger[shape.get()] = scaled(*shape, factor);
		for (int trial = 0; trial < 2000 && !HasFailure(); ++trial) {
			const Pair pair  = randomPair(shapes, random);
			Pair       other = pair;
			for (auto& shape : other.shape)
				shape = larger[shape.get()];
			other.centre2 *= factor;
			ContactSettings settings;
			settings.section        = true;
			const ContactResult one = query(pair, settings), two = query(other, settings);
			EXPECT_EQ(two.status, one.status);
			EXPECT_EQ(two.infeasibility, factor * one.infeasibility);
			EXPECT_EQ(two.point, factor * one.point);
			EXPECT_EQ(two.normal, one.normal);
			EXPECT_EQ(two.depth, factor * one.depth);
			EXPECT_EQ(two.area, factor * factor * one.area);
			EXPECT_EQ(two.weights, one.weights);
			EXPECT_EQ(two.newtonIterations, one.newtonIterations);
			EXPECT_EQ(two.simplexPivots, one.simplexPivots);
		}
	}
}

TEST_P(RandomPairs, ScaledByAnyFactorTheAnswerIsScaledToRounding)
{
	int         contacts = 0;
	SameAnswers answers;
	for (int trial = 0; trial < 150; ++trial) {
		const Pair pair   = randomPair(shapes, random);
		const Real factor = decades(random, -6, 6);
		const auto result = query(pair);
		auto       other  = query(scaled(pair, factor));
		if (!result.inContact) continue;
		++contacts;
		other.infeasibility /= factor;
		other.point /= factor;
		other.depth /= factor;
		const PrecisePair exact(pair);
		answers.expect(exact, Allowance(pair, exact, result), result, other);
	}
	EXPECT_GT(contacts, 90);
	answers.expectFew(0);
}

INSTANTIATE_TEST_SUITE_P(Dimensions, RandomPairs, testing::Values(2, 3), [](const auto& info) { return std::to_string(info.param) + "D"; });

TEST(ContactQuery, ThePlaneContactOfPrismsIsThatOfTheirSections)
{
	std::mt19937_64 random(23);
	int             contacts = 0;
	for (int trial = 0; trial < 500; ++trial) {
		Pair flat, solid;
		for (int body = 0; body < 2; ++body) {
			HalfSpaces set   = randomPlanes(4 + int(random() % 12), random, 2);
			flat.shape[body] = ConvexShape::shared(set, Real(0.3));
			for (int side = -1; side <= 1; side += 2) {
				set.normals.push_back(side * Vector3::UnitZ());
				set.offsets.push_back(2);
			}
			set.dimension       = 3;
			solid.shape[body]   = ConvexShape::shared(set, Real(0.3));
			flat.rotation[body] = solid.rotation[body] = randomRotation(random, 2);
		}
		const Vector3 direction = randomDirection(random, 2);
		moveTo(flat, direction, -decades(random, -10, -1));
		solid.centre2           = flat.centre2;
		const ContactResult one = query(flat), two = query(solid);
		ASSERT_TRUE(one.inContact && two.inContact);
		++contacts;
		// the prism's caps are planes of z alone: x and y are as without them
		const Real loose = 1e-9 + 1e-15 / -one.infeasibility;
		EXPECT_LE((one.point - two.point).norm(), loose);
		EXPECT_NEAR(one.infeasibility, two.infeasibility, 1e-15);
		if (one.status != two.status || one.status == ContactStatus::NormalFromDual) continue;
		EXPECT_LE((one.normal - two.normal).norm(), 100 * loose);
		EXPECT_NEAR(one.depth, two.depth, 1e-13 + 100 * loose * one.depth);
		EXPECT_EQ(one.point.z(), 0);
		EXPECT_EQ(one.normal.z(), 0);
	}
	EXPECT_EQ(contacts, 500);
}

TEST(ContactQuery, WhatTheBuffersHeldBeforeDoesNotMatter)
{
	std::mt19937_64  random(25);
	ContactWorkspace used;
	for (int dimension = 2; dimension <= 3; ++dimension) {
		const Shapes shapes = randomShapes(40, random, dimension);
		for (int trial = 0; trial < 1000; ++trial) {
			const Pair      pair = randomPair(shapes, random);
			ContactSettings settings;
			settings.section = settings.geometryAcrossGap = true;
			settings.contactPoint                         = ContactPoint(trial % 3);
			ContactWorkspace fresh;
			PairMemory       memory[2];
			ContactResult    result[2];
			for (int again = 0; again < 2; ++again)
				for (int k = 0; k < 2; ++k)
					contactQuery(pair.placed(), settings, memory[k], k ? used : fresh, result[k]);
			EXPECT_EQ(result[0].point, result[1].point);
			EXPECT_EQ(result[0].normal, result[1].normal);
			EXPECT_EQ(result[0].depth, result[1].depth);
			EXPECT_EQ(result[0].area, result[1].area);
			EXPECT_EQ(result[0].basis, result[1].basis);
			EXPECT_EQ(memory[0].point, memory[1].point);
		}
	}
}

TEST(ContactQuery, NormalsAreWeightedAsAsked)
{
	std::mt19937_64 random(24);
	for (int trial = 0; trial < 200; ++trial) {
		const Pair        pair = regularPair(6, 20, Real(0.05), random);
		const PrecisePair exact(pair);
		ContactSettings   settings;
		const QuadVector  x     = precise(query(pair).point);
		const Vector3     first = rounded(exact.innerGradient(0, x)).normalized(),
		              second    = -rounded(exact.innerGradient(1, x)).normalized();
		for (const auto& weights : { std::pair<Real, Real>(1, 0), { 0, 1 }, { 3, 1 }, { 1e-3, 2e-3 } }) {
			settings.normalWeight[0] = weights.first;
			settings.normalWeight[1] = weights.second;
			EXPECT_LE((query(pair, settings).normal - (weights.first * first + weights.second * second).normalized()).norm(),
			        1e-9);
		}
	}
}

TEST(ContactQuery, ToleranceIsTheLeastOverlapOverTheSmallerBody)
{
	Pair pair;
	pair.shape[0] = ConvexShape::shared(cuboid(1, 1, 1), Real(0.1));
	pair.shape[1] = ConvexShape::shared(cuboid(4, 4, 4), Real(0.1));
	ContactSettings settings;
	settings.tolerance = 1e-3;
	const Real least   = 1e-3 * std::sqrt(Real(3));
	for (Real over : { 0.99, 1.01 }) {
		pair.centre2 = Vector3(0, 0, 5 - 2 * over * least);
		EXPECT_EQ(query(pair, settings).inContact, over > 1);
		EXPECT_EQ(query(swapped(pair), settings).inContact, over > 1);
	}
}

TEST(ContactQuery, StatusesHaveNamesOfTheirOwn)
{
	std::set<std::string> names;
	for (int status = 0; status < contactStatusCount; ++status)
		names.insert(statusName(ContactStatus(status)));
	EXPECT_EQ(names.size(), std::size_t(contactStatusCount));
	EXPECT_EQ(names.count("unknown"), 0u);
	EXPECT_GT(std::strlen(instructionSet()), 0u);
}

// The list of what a script must not take for an answer, by the names it reads; docs/statuses.md has the same.
TEST(ContactQuery, UnansweredAreAllStatusesButThoseWithTheAnswerAskedFor)
{
	std::set<std::string> unanswered;
	for (int status = 0; status < contactStatusCount; ++status)
		if (!answered(ContactStatus(status))) unanswered.insert(statusName(ContactStatus(status)));
	const std::set<std::string> expected { "centreNotConverged", "ipoptNotAvailable", "lpNotConverged", "noDirection", "failed",
		"surfaceIncomplete" };
	EXPECT_EQ(unanswered, expected);
}

} // namespace
