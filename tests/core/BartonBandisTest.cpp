// SPDX-License-Identifier: GPL-2.0-or-later
#include "joint/BartonBandis.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace polytope;

namespace {

const Real degree = std::acos(Real(-1)) / 180;

BartonBandis joint(Real length = 0.1, Real roughness = 10)
{
	BartonBandis::Values values;
	values.roughness        = roughness;
	values.wallStrength     = 100e6;
	values.residualFriction = 30 * degree;
	values.jointLength      = length;
	return BartonBandis(values);
}

TEST(BartonBandis, PeakAndResidualAngle)
{
	const BartonBandis one = joint();
	for (const Real stress : { 1e5, 1e6, 1e7 }) {
		const Real peak = 30 + 10 * std::log10(100e6 / stress);
		EXPECT_NEAR(one.frictionAngle(stress, one.peakDisplacement()) / degree, peak, 1e-10);
		EXPECT_NEAR(one.frictionAngle(stress, 100 * one.peakDisplacement()) / degree, 30, 1e-10);
		EXPECT_NEAR(one.frictionAngle(stress, 0.3 * one.peakDisplacement()) / degree, 30, 1e-10);
		EXPECT_NEAR(one.frictionAngle(stress, 0.8 * one.peakDisplacement()) / degree, 30 + 0.875 * (peak - 30), 1e-10);
		EXPECT_NEAR(one.frictionAngle(stress, 7 * one.peakDisplacement()) / degree, 30 + 0.6 * (peak - 30), 1e-10);
	}
	EXPECT_NEAR(one.frictionAngle(2e8, one.peakDisplacement()) / degree, 30, 1e-10); // above JCS
	EXPECT_NEAR(one.frictionAngle(1, one.peakDisplacement()) / degree, 70, 1e-10);   // almost without stress
	EXPECT_NEAR(one.frictionAngle(0, one.peakDisplacement()) / degree, 70, 1e-10);
	EXPECT_NEAR(joint(0.1, 0).frictionAngle(1e6, 1e-3) / degree, 30, 1e-10); // smooth
	EXPECT_EQ(joint(0.1, 0).dilationAngle(1e6, 1e-3), 0);
}

TEST(BartonBandis, DilationIsHalfToAllOfTheRoughnessAngle)
{
	const BartonBandis one  = joint();
	const Real         peak = one.peakDisplacement();
	// M = 10/(12 log) + 0.7: 1.533 at σ = 10 MPa, 1.117 at 1 MPa, at most 2, at least 1
	EXPECT_NEAR(one.dilationAngle(1e7, peak) / degree, 10 / (10. / 12 + 0.7), 1e-10);
	EXPECT_NEAR(one.dilationAngle(1e6, peak) / degree, 20 / (10. / 24 + 0.7), 1e-10);
	EXPECT_NEAR(one.dilationAngle(5e7, peak) / degree, 10 * std::log10(2.) / 2, 1e-10);
	EXPECT_NEAR(one.dilationAngle(1e5, peak) / degree, 30, 1e-10);
	EXPECT_EQ(one.dilationAngle(1e7, 0.2 * peak), 0);
	EXPECT_EQ(one.dilationAngle(2e8, peak), 0);
}

TEST(BartonBandis, LongerJointsAreSmootherWeakerAndPeakLater)
{
	EXPECT_NEAR(joint().roughness(), 10, 1e-14);
	EXPECT_NEAR(joint().wallStrength(), 100e6, 1e-6);
	EXPECT_NEAR(joint().peakDisplacement(), 0.1 / 500 * std::pow(100., 0.33), 1e-15);
	const BartonBandis ten = joint(1);
	EXPECT_NEAR(ten.roughness(), 10 * std::pow(10., -0.2), 1e-12);
	EXPECT_NEAR(ten.wallStrength(), 100e6 * std::pow(10., -0.3), 1e-4);
	EXPECT_NEAR(ten.peakDisplacement(), 1. / 500 * std::pow(ten.roughness(), 0.33), 1e-15);
}

TEST(BartonBandis, MobilisedRoughnessRisesToThePeakAndFallsAfterIt)
{
	EXPECT_EQ(mobilisedRoughness(0), 0);
	EXPECT_NEAR(mobilisedRoughness(1), 1, 1e-15);
	EXPECT_EQ(mobilisedRoughness(1e9), 0);
	for (Real x = 0; x < 120; x += 0.05) {
		const Real change = mobilisedRoughness(x + 0.05) - mobilisedRoughness(x);
		EXPECT_LE(std::abs(change), 0.13);
		EXPECT_GE(x < 0.95 ? change : x > 1 ? -change : Real(0), -1e-15) << x;
	}
}

} // namespace
