// SPDX-License-Identifier: GPL-2.0-or-later
#include "timestep/ClosingStep.hpp"
#include "timestep/ApproachLimit.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace polytope {
namespace {

	constexpr double maximum = 2e-4;

	TEST(ClosingStep, AHyperbolaMayCloseByTheSamePartOfWhatIsLeft)
	{
		const ClosureLaw law  = ClosureLaw::hyperbola(maximum);
		const double     part = 1 - 1 / std::sqrt(tolerance::closingGrowth);
		for (const double closure : { 0., 0.3, 0.8 })
			EXPECT_NEAR(double(closingWay(law, closure * maximum, 1)), part * (1 - closure) * maximum, 2e-6);
		EXPECT_NEAR(double(closingWay(law, 0, maximum)), part * maximum, 1e-6 * maximum);
	}

	TEST(ClosingStep, ASpringThatDoesNotStiffenLimitsNothing)
	{
		EXPECT_EQ(double(closingWay(ClosureLaw(), 0, 3)), 3);
		// a power is softer than its stiffness below the reference stress, at a closure of 0.2 here
		EXPECT_EQ(double(closingWay(ClosureLaw::power(0.5, 0.1), 0, Real(0.19))), 0.19);
		EXPECT_LT(double(closingWay(ClosureLaw::power(0.5, 0.1), Real(0.2), Real(0.2))), 0.2);
	}

	TEST(ClosingStep, WhatIsFarHasHalfOfTheTimeUntilItTouches)
	{
		EXPECT_DOUBLE_EQ(double(closingStep(Real(0.5), 2, 0, 50)), 0.25);
		EXPECT_DOUBLE_EQ(double(closingStep(Real(0.5), 2, 1, 50)), 0.25);
		EXPECT_DOUBLE_EQ(double(closingStep(Real(0.5), 2, 100, 50)), 1);
	}

	/// A function says what two bodies limit; it is asked of those alone that may come nearer by their way, which a change of velocity counts in.
	TEST(ClosingStep, OfTwoBodiesAFunctionIsAsked)
	{
		const auto box = [](const Real& height, const Real& velocity, const Real& way, int id) {
			MovingBox made;
			made.low      = Vector3(-1, -1, height - 1);
			made.high     = Vector3(1, 1, height + 1);
			made.velocity = Vector3(0, 0, velocity);
			made.radius   = way;
			made.free     = true;
			made.id       = id;
			return made;
		};
		const auto limit = [&](const Real& velocity, const Real& change) {
			int        asked = 0;
			const auto found = approachLimit({ box(0, 0, Real(0.1), 3), box(Real(2.5), velocity, Real(0.1), 5) }, 1, 1, change,
			        1, [&](int id1, int id2) {
				        EXPECT_EQ(id1 + id2, 8);
				        ++asked;
				        return Real(0.25);
			        });
			EXPECT_EQ(asked, found.id < 0 ? 0 : 1);
			return found.id < 0 ? -1. : double(found.step);
		};
		EXPECT_EQ(limit(-1, 0), 0.25);
		EXPECT_EQ(limit(1, 0), -1);
		EXPECT_EQ(limit(0, 0), -1);
		EXPECT_EQ(limit(0, 1), 0.25);
	}

} // namespace
} // namespace polytope
