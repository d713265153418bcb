// SPDX-License-Identifier: GPL-2.0-or-later
#include "timestep/ApproachLimit.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace polytope {
namespace {

	constexpr Real infinite = std::numeric_limits<Real>::infinity();

	MovingBox box(const Vector3& centre, const Real& half, const Vector3& velocity, int id, bool free = true)
	{
		MovingBox made;
		made.low      = centre - Vector3::Constant(half);
		made.high     = centre + Vector3::Constant(half);
		made.velocity = velocity;
		made.radius   = half;
		made.free     = free;
		made.id       = id;
		return made;
	}

	ApproachLimit limitOf(const std::vector<MovingBox>& bodies, const Real& horizon = 1, const Real& change = 0)
	{
		return approachLimit(bodies, Real(0.1), horizon, change, infinite);
	}

	TEST(ApproachLimit, IsTheSmallerBodysRadiusOverTheRelativeSpeed)
	{
		const auto limit = limitOf({ box({ 0, 0, 0 }, 1, { 0, 0, 3 }, 4), box({ 0, -2, 3 }, Real(0.5), { 0, 4, 0 }, 7) });
		EXPECT_DOUBLE_EQ(double(limit.step), 0.1 * 0.5 / 5);
		EXPECT_EQ(limit.id, 7);
	}

	TEST(ApproachLimit, WhatPartsOrPassesDoesNotCount)
	{
		EXPECT_EQ(limitOf({ box({ 0, 0, 0 }, 1, { 0, 0, 0 }, 0), box({ 0, 0, -3 }, 1, { 0, 0, -100 }, 1) }).id, -1);
		EXPECT_EQ(limitOf({ box({ 0, 0, 0 }, 1, { 0, 0, 0 }, 0), box({ 3, 0, 50 }, 1, { 0, 0, -100 }, 1) }).id, -1);
		// it comes down along the diagonal, and reaches the height of the other when it has passed beside it
		EXPECT_EQ(limitOf({ box({ 0, 0, 0 }, 1, { 0, 0, 0 }, 0), box({ 5, 0, 50 }, 1, { -100, 0, -50 }, 1) }).id, -1);
		EXPECT_EQ(limitOf({ box({ 0, 0, 0 }, 1, { 0, 0, 0 }, 0), box({ 50, 0, 50 }, 1, { -60, 0, -60 }, 1) }).id, 0);
	}

	TEST(ApproachLimit, OnlyUntilTheHorizonAndWithTheChangeUntilThen)
	{
		const std::vector<MovingBox> bodies { box({ 0, 0, 0 }, 1, { 0, 0, 0 }, 0), box({ 0, 0, 12 }, 1, { 0, 0, -10 }, 1) };
		EXPECT_EQ(limitOf(bodies, Real(0.99)).id, -1);
		EXPECT_EQ(limitOf(bodies, Real(1.01)).id, 0);
		EXPECT_EQ(limitOf(bodies, Real(0.99), Real(0.2)).id, 0);
	}

	TEST(ApproachLimit, WhatIsCarriedAlongIsAtRest)
	{
		const Vector3 fast(150, 0, 0);
		EXPECT_EQ(limitOf({ box({ 0, 0, 0 }, 1, fast, 0, false), box({ 0, 0, 2 }, 1, fast, 1), box({ 2, 0, 2 }, 1, fast, 2) }).id,
		        -1);
	}

	TEST(ApproachLimit, TwoThatForcesDoNotMoveHaveNoContact)
	{
		EXPECT_EQ(limitOf({ box({ 0, 0, 0 }, 1, { 0, 0, 0 }, 0, false), box({ 0, 0, 2 }, 1, { 0, 0, -9 }, 1, false) }).id, -1);
	}

	TEST(ApproachLimit, AWallHasNoEndAndNoSize)
	{
		MovingBox wall = box({ 0, 0, 0 }, 0, { 0, 0, 0 }, 0, false);
		wall.low       = { -infinite, -infinite, 0 };
		wall.high      = { infinite, infinite, 0 };
		wall.radius    = infinite;
		EXPECT_DOUBLE_EQ(double(limitOf({ wall, box({ 1000, 0, 5 }, 1, { 0, 0, -10 }, 1) }).step), 0.01);
		EXPECT_EQ(limitOf({ wall, box({ 1000, 0, -5 }, 1, { 0, 0, -10 }, 1) }).id, -1);
	}

	TEST(ApproachLimit, ABodyThatTurnsSweepsMore)
	{
		MovingBox blade = box({ 0, 0, 0 }, 1, { 0, 0, 0 }, 0, false);
		blade.spin      = 20;
		EXPECT_DOUBLE_EQ(double(limitOf({ blade, box({ 0, 0, Real(2.5) }, 1, { 0, 0, 0 }, 1) }).step), 0.1 / 20);
	}

	/// The limit of all pairs, looked at one by one, at many times.
	Real slowly(const std::vector<MovingBox>& bodies, const Real& fraction, const Real& horizon)
	{
		Real best = infinite;
		for (std::size_t i = 0; i < bodies.size(); ++i)
			for (std::size_t j = 0; j < i; ++j) {
				const MovingBox &a = bodies[i], &b = bodies[j];
				if (!a.free && !b.free) continue;
				const Vector3 relative = b.velocity - a.velocity;
				for (int k = 0; k <= 400; ++k) {
					const Vector3 way = relative * (horizon * k / 400);
					if (((b.low + way).array() <= a.high.array()).all()
					        && (a.low.array() <= (b.high + way).array()).all()) {
						best = std::min(best, Real(fraction * std::min(a.radius, b.radius) / relative.norm()));
						break;
					}
				}
			}
		return best;
	}

	TEST(ApproachLimit, OfManyBodiesIsThatOfAllPairs)
	{
		std::mt19937                           random(1);
		std::uniform_real_distribution<double> unit(-1, 1);
		const auto any     = [&](double size) { return Vector3(size * unit(random), size * unit(random), size * unit(random)); };
		int        limited = 0;
		for (int scene = 0; scene < 200; ++scene) {
			std::vector<MovingBox> bodies;
			for (int k = 0; k < 40; ++k)
				bodies.push_back(box(any(7), Real(0.3 + 0.2 * unit(random)), any(k % 7 ? 2 : 20), k, k % 5 != 0));
			const Real expected = slowly(bodies, Real(0.1), Real(0.3)), found = limitOf(bodies, Real(0.3)).step;
			EXPECT_LE(found, expected * (1 + 1e-12)); // the slow search may overlook a pair that meets between two times
			if (expected < infinite) {
				++limited;
				EXPECT_GE(found, expected * 0.5);
			}
		}
		EXPECT_GT(limited, 100);
	}

	TEST(ApproachLimit, LongerThanAskedForIsNotFound)
	{
		const std::vector<MovingBox> bodies { box({ 0, 0, 0 }, 1, { 0, 0, 0 }, 0), box({ 0, 0, 3 }, 1, { 0, 0, -10 }, 1) };
		EXPECT_EQ(approachLimit(bodies, Real(0.1), 1, 0, Real(0.009)).id, -1);
		EXPECT_EQ(approachLimit(bodies, Real(0.1), 1, 0, Real(0.011)).id, 0);
	}

} // namespace
} // namespace polytope
