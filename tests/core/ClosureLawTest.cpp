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

TEST(ClosureLaw, ANameThatIsTakenIsRefused)
{
	EXPECT_EQ(hyperbola.fault(), "");
	{
		const NormalLaw again("ClosureLawTest", hyperbola.pressure, hyperbola.tangent, hyperbola.energy);
		EXPECT_EQ(again.fault(), "there is a normal law ClosureLawTest already: give this one another name");
		EXPECT_THROW(ClosureLaw::own(again, 1), std::invalid_argument);
		EXPECT_EQ(&NormalLaw::named("ClosureLawTest"), &hyperbola);
		NormalLaw::all().pop_back(); // it ends here
	}
	EXPECT_NO_THROW(ClosureLaw::own(hyperbola, 1));
}

TEST(ClosureLaw, LawsWhoseFunctionsBelongTogetherHaveNoFault)
{
	EXPECT_EQ(ClosureLaw().fault(), "");
	for (const double most : { 1e-6, 1e-5, 2e-4, 1e-2, 1. })
		EXPECT_EQ(ClosureLaw::hyperbola(most).fault(), "") << most;
	for (const double exponent : { 0., 0.3, 0.5, 0.9 })
		for (const double length : { 1e-6, 1e-4, 1e-1 })
			EXPECT_EQ(ClosureLaw::power(exponent, length).fault(), "") << exponent << ' ' << length;
	for (const double most : { 1e-5, 2e-4, 1e-2, 1e-1 })
		EXPECT_EQ(ClosureLaw::own(hyperbola, most).fault(), "") << most;
}

/// The law stiffens at a closure p to q times its stiffness: the tangent jumps.
TEST(ClosureLaw, ATangentThatJumpsIsNoFault)
{
	const NormalLaw twoSlopes(
	        "ClosureLawTest twoSlopes", [](Real u, Real p, Real q) { return u < p ? u : p + q * (u - p); },
	        [](Real u, Real p, Real q) { return u < p ? Real(1) : q; },
	        [](Real u, Real p, Real q) { return u < p ? u * u / 2 : p * p / 2 + (u - p) * (p + q * (u - p) / 2); });
	for (const double p : { 3e-6, 1e-4, 1.1e-2 })
		EXPECT_EQ(ClosureLaw::own(twoSlopes, p, 50).fault(), "") << p;
	NormalLaw::all().pop_back();
}

/// The hyperbola from above, with one of its functions, or its end, written down wrong.
TEST(ClosureLaw, WhatDoesNotBelongTogetherIsNamed)
{
	const auto said = [](NormalLaw::Function pressure, NormalLaw::Function tangent, NormalLaw::Function energy, Real p = 2e-4) {
		const NormalLaw   law("ClosureLawTest wrong", pressure, tangent, energy);
		const std::string text = ClosureLaw::own(law, p).fault();
		NormalLaw::all().pop_back();
		return text;
	};
	const auto begins     = [](const std::string& text, const std::string& begin) { return text.compare(0, begin.size(), begin) == 0; };
	const std::string law = "the normal law ClosureLawTest wrong (p = 0.0002, q = 0): ";

	const auto slope = said(hyperbola.pressure, [](Real u, Real p, Real) { return 1 / (1 - partOf(u, p)); }, hyperbola.energy);
	EXPECT_TRUE(begins(slope, law + "its pressure is not the integral of its tangent: from ")) << slope;
	const auto work = said(
	        hyperbola.pressure, hyperbola.tangent, [](Real u, Real p, Real q) { return hyperbola.energy(u, p, q) * Real(1.01); });
	EXPECT_TRUE(begins(work, law + "its energy is not the integral of its pressure: from 1e-07 to 2e-07 m it grows by ")) << work;
	const auto pole = said([](Real u, Real p, Real) { return u / (1 - u / p); },
	        [](Real u, Real p, Real) { return 1 / ((1 - u / p) * (1 - u / p)); },
	        [](Real u, Real p, Real) { return p * p * (-u / p - std::log(std::abs(1 - u / p))); });
	EXPECT_TRUE(begins(pole, law + "the pressure must rise: from ")) << pole;
	const auto step = said(
	        [](Real u, Real p, Real q) { return hyperbola.pressure(u, p, q) + Real(1e-9); }, hyperbola.tangent, hyperbola.energy);
	EXPECT_TRUE(begins(step, law + "pressure and energy must be 0 at closure 0: ")) << step;
	const auto none = said(hyperbola.pressure, hyperbola.tangent, hyperbola.energy, std::nan(""));
	EXPECT_NE(none.find("pressure, tangent and energy must be finite for every closure: at 1e-07 m they are nan"), std::string::npos)
	        << none;
	const auto soft = said([](Real u, Real, Real) { return u / (1 + u); }, [](Real u, Real, Real) { return -1 / ((1 + u) * (1 + u)); },
	        [](Real u, Real, Real) { return u - std::log(1 + u); });
	EXPECT_TRUE(begins(soft, law + "the pressure must rise: ")) << soft;
}

TEST(ClosureLaw, ALawWithoutANameOrAFunctionIsRefused)
{
	const auto said = [](const char* name, NormalLaw::Function energy) {
		const NormalLaw   law(name, hyperbola.pressure, hyperbola.tangent, energy);
		const std::string text = law.fault();
		EXPECT_THROW(ClosureLaw::own(law, 1), std::invalid_argument);
		NormalLaw::all().pop_back();
		return text;
	};
	EXPECT_EQ(said("", hyperbola.energy), "a normal law must have a name");
	EXPECT_EQ(said(nullptr, hyperbola.energy), "a normal law must have a name");
	EXPECT_EQ(said("ClosureLawTest part", nullptr), "the normal law ClosureLawTest part must have all three functions");
}

} // namespace
