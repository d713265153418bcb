// SPDX-License-Identifier: GPL-2.0-or-later
#include "joint/ClosureLaw.hpp"
#include "joint/JointTolerances.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace polytope;

namespace {

const ClosureLaw joint = ClosureLaw::hyperbola(2e-4);

TEST(ClosureLaw, HyperbolaHasThePressureOfBandisEquation)
{
	EXPECT_NEAR(joint.pressure(1e-4), 2e-4, 1e-18);    // half closed: twice the linear spring's
	EXPECT_NEAR(joint.pressure(1.8e-4), 18e-4, 1e-15); // nine tenths: ten times
	EXPECT_NEAR(joint.pressure(1e-9), 1e-9 * (1 + 0.5e-5), 1e-19);
	EXPECT_EQ(joint.pressure(-1e-5), -1e-5);
	EXPECT_EQ(joint.pressure(0), 0);
}

TEST(ClosureLaw, TangentIsTheSlopeAndEnergyTheIntegralOfThePressure)
{
	for (const ClosureLaw& law : { joint, ClosureLaw(), ClosureLaw::power(0.5, 1e-4), ClosureLaw::power(0, 1e-4) })
		for (const Real closure : { -3e-5, 1e-7, 9.9e-6, 1.01e-5, 1e-4, 1.9e-4, 1.979e-4, 1.99e-4, 3e-4 }) {
			SCOPED_TRACE(closure);
			const Real step = 1e-4 * std::min(std::abs(closure), std::abs(2e-4 - closure));
			EXPECT_NEAR(
			        (law.pressure(closure + step) - law.pressure(closure - step)) / (2 * step) / law.tangent(closure), 1, 1e-6);
			// Simpson's rule over a short way, whose error is of the fourth order
			const Real integral
			        = step / 3 * (law.pressure(closure - step) + 4 * law.pressure(closure) + law.pressure(closure + step));
			const Real rounding = 1e-14 * law.energy(closure);
			EXPECT_NEAR(
			        law.energy(closure + step) - law.energy(closure - step), integral, 1e-6 * std::abs(integral) + rounding);
		}
	// −x − ln(1 − x) at x = 0.9 and 0.01, to 16 digits
	EXPECT_NEAR(joint.energy(1.8e-4) / 4e-8, 1.402585092994046, 1e-14);
	EXPECT_NEAR(joint.energy(2e-6) / 4e-8 / 5.033585350144118e-05, 1, 1e-14);
}

TEST(ClosureLaw, HyperbolaGoesOnAsItsTangent)
{
	const Real end = tolerance::closureEnd * 2e-4;
	EXPECT_NEAR(joint.pressure(end), 99 * 2e-4, 1e-13);
	EXPECT_NEAR(joint.tangent(end), 1e4, 1e-6);
	EXPECT_NEAR(joint.pressure(end + 1e-6) - joint.pressure(end), 1e-2, 1e-9);
	EXPECT_NEAR(joint.energy(end + 1e-6) - joint.energy(end), 99 * 2e-4 * 1e-6 + 1e4 * 1e-12 / 2, 1e-15);
}

TEST(ClosureLaw, ClosureIsTheInverseOfPressure)
{
	for (const Real closure : { -1e-3, -1e-9, 1e-12, 1e-6, 1e-4, 1.95e-4, 1.98e-4, 1.9801e-4, 1e-2 })
		for (const ClosureLaw& law : { joint, ClosureLaw::power(0.3, 1e-4), ClosureLaw() })
			EXPECT_NEAR(law.closure(law.pressure(closure)) / closure, 1, 1e-13) << closure;
}

/// dσ/dδ = k (σ/σ₀)ᵉ, and k at σ₀.
TEST(ClosureLaw, PowerHasTheStiffnessOfItsStress)
{
	const Real       length = 1e-4; // σ₀/k
	const ClosureLaw law    = ClosureLaw::power(0.5, length);
	EXPECT_NEAR(law.pressure(2e-4) / length, 1, 1e-14); // √σ grows by half of k/σ₀ δ
	EXPECT_NEAR(law.tangent(2e-4), 1, 1e-14);
	for (const Real closure : { 1e-6, 1e-4, 1e-3 })
		EXPECT_NEAR(law.tangent(closure) / std::sqrt(law.pressure(closure) / length), 1, 1e-13);
	EXPECT_EQ(law.tangent(0), 1); // of the linear spring in tension
	EXPECT_NEAR(ClosureLaw::power(0, length).pressure(3e-5), 3e-5, 1e-19);
}

TEST(ClosureLaw, BetweenTwoSidesThatDiffer)
{
	const ClosureLaw soft = ClosureLaw::hyperbola(3e-4), both = ClosureLaw::between(joint, soft);
	EXPECT_NEAR(both.maximumClosure(), 2.5e-4, 1e-18);
	EXPECT_TRUE(joint.isLike(soft));
	EXPECT_FALSE(joint.isLike(ClosureLaw::power(0.5, 1e-4)));
	EXPECT_FALSE(joint.isLike(ClosureLaw()));
}

/// The hyperbola again, as a program would write it: straight from 0.99 of the maximum on.
Real partOf(Real u, Real most) { return std::min(u / most, Real(0.99)); }

const NormalLaw hyperbola(
        "ClosureLawTest",
        [](Real u, Real most, Real) {
	        const Real x = partOf(u, most);
	        return most * x / (1 - x) + (u - x * most) / ((1 - x) * (1 - x));
        },
        [](Real u, Real most, Real) { return 1 / ((1 - partOf(u, most)) * (1 - partOf(u, most))); },
        [](Real u, Real most, Real) {
	        const Real x = partOf(u, most), beyond = u - x * most;
	        return most * most * (-x - std::log(1 - x)) + beyond * (most * x / (1 - x) + beyond / 2 / ((1 - x) * (1 - x)));
        });

TEST(ClosureLaw, OfAProgramsOwnIsAsTheOneOfTheLibrary)
{
	const ClosureLaw own = ClosureLaw::own(hyperbola, 2e-4);
	EXPECT_FALSE(own.isLinear());
	EXPECT_FALSE(own.isLike(joint));
	EXPECT_FALSE(joint.isLike(own));
	EXPECT_TRUE(own.isLike(ClosureLaw::own(hyperbola, 1e-4)));
	for (const Real closure : { -3e-5, 1e-7, 1e-5, 1e-4, 1.9e-4, 1.99e-4, 3e-4 }) {
		EXPECT_NEAR(own.pressure(closure) / joint.pressure(closure), 1, 1e-14);
		EXPECT_NEAR(own.tangent(closure) / joint.tangent(closure), 1, 1e-14);
		EXPECT_NEAR(own.energy(closure) / joint.energy(closure), 1, 1e-8);
		EXPECT_NEAR(own.closure(own.pressure(closure)) / closure, 1, 1e-12);
	}
	const ClosureLaw between = ClosureLaw::between(own, ClosureLaw::own(hyperbola, 1e-4));
	EXPECT_NEAR(between.pressure(7.5e-5), 15e-5, 1e-18); // half of the mean maximum
}

TEST(ClosureLaw, OfAProgramsOwnIsKnownByItsName)
{
	EXPECT_EQ(&NormalLaw::named("ClosureLawTest"), &hyperbola);
	EXPECT_THROW(NormalLaw::named("another"), std::runtime_error);
}

} // namespace
