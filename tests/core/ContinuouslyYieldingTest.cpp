// SPDX-License-Identifier: GPL-2.0-or-later
#include "joint/ContinuouslyYielding.hpp"
#include "joint/JointTolerances.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace polytope;

namespace {

const Real degree = std::acos(Real(-1)) / 180;

ContinuouslyYielding::Values values()
{
	ContinuouslyYielding::Values values;
	values.friction          = 30 * degree;
	values.initialFriction   = 50 * degree;
	values.roughness         = 1e-3;
	values.stiffnessExponent = 0.5;
	values.referenceStress   = 1e6;
	return values;
}

const Vector3 x = Vector3::UnitX();

TEST(ContinuouslyYielding, YieldsFromTheStartAndIsElasticWhereItTurnsBack)
{
	ContinuouslyYielding joint(values());
	EXPECT_EQ(joint.elasticPart(x, 0), 1);
	EXPECT_NEAR(joint.elasticPart(x, 0.4), 0.6, 1e-15);
	EXPECT_EQ(joint.elasticPart(-x, -0.4), 1);
	EXPECT_NEAR(joint.elasticPart(-x, 0), 1 / 1.4, 1e-15);
	EXPECT_NEAR(joint.elasticPart(-x, 0.5), 0.5 / 1.4, 1e-15);
	EXPECT_EQ(joint.elasticPart(x, 0.3), 1); // again, under load
	EXPECT_NEAR(joint.elasticPart(x, 0.65), 0.5, 1e-15);
	EXPECT_EQ(joint.elasticPart(-x, -0.9), 1);
	EXPECT_NEAR(joint.elasticPart(x, 0.9), 0.1 / 0.25, 1e-15); // at most three quarters are remembered
	EXPECT_EQ(joint.elasticPart(x, 1.1), 0);
}

TEST(ContinuouslyYielding, WearsItsAsperities)
{
	ContinuouslyYielding joint(values());
	EXPECT_NEAR(joint.frictionAngle(), 50 * degree, 1e-15);
	for (int k = 0; k < 100; ++k)
		joint.wear(1e-5);
	EXPECT_NEAR(joint.frictionAngle(), (30 + 20 * std::exp(-1)) * degree, 1e-14);
	joint.wear(1);
	EXPECT_NEAR(joint.frictionAngle(), 30 * degree, 1e-14);
}

TEST(ContinuouslyYielding, StiffnessFollowsTheStress)
{
	const ContinuouslyYielding joint(values());
	EXPECT_NEAR(joint.stiffness(4e6), 2, 1e-14);
	EXPECT_NEAR(joint.stiffness(1e6), 1, 1e-15);
	EXPECT_EQ(joint.stiffness(0), tolerance::softestShear);
	EXPECT_EQ(joint.stiffness(-1), tolerance::softestShear);
	EXPECT_EQ(ContinuouslyYielding().stiffness(0), 1);
}

TEST(ContinuouslyYielding, DilatesByWhatItBearsAboveItsIntrinsicFriction)
{
	const ContinuouslyYielding joint(values());
	EXPECT_NEAR(joint.dilationAngle(std::tan(45 * degree)), 15 * degree, 1e-14);
	EXPECT_EQ(joint.dilationAngle(std::tan(20 * degree)), 0);
}

TEST(ContinuouslyYielding, OfTwoSidesTheWeakerHolds)
{
	ContinuouslyYielding::Values other = values();
	other.initialFriction              = 40 * degree;
	other.roughness                    = 2e-3;
	ContinuouslyYielding joint         = ContinuouslyYielding::between(ContinuouslyYielding(values()), ContinuouslyYielding(other));
	EXPECT_NEAR(joint.frictionAngle(), 40 * degree, 1e-15);
	joint.wear(1e-3);
	EXPECT_NEAR(joint.frictionAngle(), (30 + 10 * std::exp(-1)) * degree, 1e-14);
}

} // namespace
