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

/// δ_peak of a joint of this length and its JRC.
Real peakOf(Real length, Real roughness) { return length / 500 * std::pow(roughness / length, 0.33); }

TEST(BartonBandis, PeakAndResidualAngle)
{
	const BartonBandis one = joint();
	const Real         at  = peakOf(0.1, 10);
	for (const Real stress : { 1e5, 1e6, 1e7 }) {
		const Real peak = 30 + 10 * std::log10(100e6 / stress);
		EXPECT_NEAR(one.frictionAngle(stress, at) / degree, peak, 1e-10);
		EXPECT_NEAR(one.frictionAngle(stress, 100 * at) / degree, 30, 1e-10);
		EXPECT_NEAR(one.frictionAngle(stress, 0.3 * at) / degree, 30, 1e-10);
		EXPECT_NEAR(one.frictionAngle(stress, 0.8 * at) / degree, 30 + 0.875 * (peak - 30), 1e-10);
		EXPECT_NEAR(one.frictionAngle(stress, 7 * at) / degree, 30 + 0.6 * (peak - 30), 1e-10);
	}
	EXPECT_NEAR(one.frictionAngle(2e8, at) / degree, 30, 1e-10); // above JCS
	EXPECT_NEAR(one.frictionAngle(1, at) / degree, 70, 1e-10);   // almost without stress
	EXPECT_NEAR(one.frictionAngle(0, at) / degree, 70, 1e-10);
	EXPECT_NEAR(joint(0.1, 0).frictionAngle(1e6, 1e-3) / degree, 30, 1e-10); // smooth
	EXPECT_EQ(joint(0.1, 0).dilationAngle(1e6, 1e-3), 0);
}

TEST(BartonBandis, DilationIsHalfToAllOfTheRoughnessAngle)
{
	const BartonBandis one  = joint();
	const Real         peak = peakOf(0.1, 10);
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
	for (const Real length : { 0.1, 1. }) {
		const BartonBandis one   = joint(length);
		const Real         scale = length / 0.1, roughness = 10 * std::pow(scale, -0.2), strength = 100e6 * std::pow(scale, -0.3);
		const Real         peak = peakOf(length, roughness);
		const auto above = [&](Real stress, Real displacement) { return one.frictionAngle(stress, displacement) / degree - 30; };
		for (const Real stress : { 1e5, 1e6, 1e7 })
			EXPECT_NEAR(above(stress, peak), roughness * std::log10(strength / stress), 1e-10);
		EXPECT_GT(above(0.999 * strength, peak), 0);
		EXPECT_NEAR(above(1.001 * strength, peak), 0, 1e-12);
		// the angle is largest at the peak, with a bend to either side
		EXPECT_LT(above(1e6, 0.999 * peak), above(1e6, peak));
		EXPECT_LT(above(1e6, 1.001 * peak), above(1e6, peak));
	}
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
