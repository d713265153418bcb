// SPDX-License-Identifier: GPL-2.0-or-later
#include "bolt/BoltLayout.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace polytope;

/// A bolt along its axis against closed forms: shear lag, bond strength, yield, rupture, jacking, energy.
namespace {

constexpr double EA = 1e8, inRock = 1.5, gap = 0.1;

/// Plate on block 0, free up to block 1, grouted in it from 0.5 on.
BoltLayout anchor(double stiffness, double strength, double length = inRock)
{
	BoltDesign design;
	design.axialStiffness = EA;
	design.groutStiffness = stiffness;
	design.groutStrength  = strength;
	design.groutedFrom    = 0.5;
	return layOut({ { 0, 0, 0.25 }, { 1, 0.25, 0.5 + length } }, design, 0.5 + length);
}

/// Grouted in both blocks, no plate.
BoltLayout grouted(double stiffness, double strength)
{
	BoltDesign design;
	design.axialStiffness = EA;
	design.plate          = false;
	design.groutStiffness = stiffness;
	design.groutStrength  = strength;
	design.freeLength     = gap;
	return layOut({ { 0, 0, inRock }, { 1, inRock, 3.5 } }, design, 3.5);
}

double lagStiffness(double grout, double length) { return std::sqrt(EA * grout) * std::tanh(length * std::sqrt(grout / EA)); }

double pulled(BoltLayout& bolt, double by)
{
	std::vector<Real> openings(bolt.chain.elements.size(), 0);
	openings[bolt.crossings[0].element] = by;
	EXPECT_TRUE(bolt.chain.solve(openings).solved);
	return double(bolt.chain.elements[bolt.crossings[0].element].force);
}

} // namespace

TEST(BoltChain, EndAnchoredIsOneSpring)
{
	BoltDesign design;
	design.axialStiffness = EA;
	design.yieldForce     = 1e5;
	design.ruptureStrain  = 0.01;
	auto bolt             = layOut({ { 0, 0, 1 }, { 1, 1, 2 }, { 2, 2, 5 } }, design, 4);
	ASSERT_EQ(bolt.crossings.size(), 1u);
	EXPECT_EQ(bolt.crossings[0].block2, 2);
	EXPECT_EQ(bolt.chain.elasticStiffness(0), EA / 4);
	bolt.chain.jack(2e4);
	EXPECT_NEAR(pulled(bolt, 0), 2e4, 1e-9);
	EXPECT_NEAR(pulled(bolt, 1e-3), 4.5e4, 1e-9);
	EXPECT_EQ(pulled(bolt, 1e-2), 1e5);
	EXPECT_NEAR(pulled(bolt, 0.9e-2), 7.5e4, 1e-8); // unloading is elastic
	EXPECT_EQ(pulled(bolt, 0), 0);                  // and slack in the end
	EXPECT_NEAR(pulled(bolt, 0.9e-2), 7.5e4, 1e-8);
	EXPECT_EQ(pulled(bolt, 0.0391), 1e5); // with 0.8 mm locked in: strain 0.009975
	EXPECT_EQ(pulled(bolt, 0.0393), 0);
	EXPECT_EQ(pulled(bolt, 0), 0);
	EXPECT_TRUE(bolt.chain.elements[0].broken);
}

TEST(BoltChain, ElasticPullOutIsShearLag)
{
	for (double stiffness : { 1e7, 3e8, 1e10, 1e14, 1e20 }) {
		auto         bolt   = anchor(stiffness, 1e9);
		const double expect = 1 / (0.5 / EA + 1 / lagStiffness(stiffness, inRock));
		EXPECT_NEAR(pulled(bolt, 1e-5) / 1e-5, expect, 1e-8 * expect) << stiffness;
		EXPECT_NEAR(double(bolt.chain.elasticStiffness(bolt.crossings[0].element)), expect, 1e-8 * expect);
		auto         both = grouted(stiffness, 1e9);
		const double joined
		        = 1 / (gap / EA + 1 / lagStiffness(stiffness, inRock - gap / 2) + 1 / lagStiffness(stiffness, 2 - gap / 2));
		EXPECT_NEAR(pulled(both, 1e-5) / 1e-5, joined, 1e-8 * joined) << stiffness;
	}
}

TEST(BoltChain, SlipSpreadsAsInTheClosedForm)
{
	// grout slips over a from the mouth on, the rest is elastic: T = s a + (s/λ) tanh λ(L − a), and the mouth moves by v_s + s a²/2EA + T_rest a/EA
	const double k = 3e8, s = 1e5, lambda = std::sqrt(k / EA);
	auto         bolt = anchor(k, s);
	for (double a : { 0.2, 0.5, 1.0, 1.4 }) {
		const double rest = s / lambda * std::tanh(lambda * (inRock - a)), tension = rest + s * a;
		const double moved = s / k + rest * a / EA + s * a * a / (2 * EA) + tension * 0.5 / EA;
		EXPECT_NEAR(pulled(bolt, moved), tension, 3e-3 * tension) << a;
	}
	EXPECT_NEAR(pulled(bolt, 0.05), s * inRock, 1e-5 * s * inRock);
	EXPECT_NEAR(pulled(bolt, 0.5), s * inRock, 1e-5 * s * inRock);
	EXPECT_LT(pulled(bolt, 0.499), 0.5 * s * inRock); // unloading is elastic
}

TEST(BoltChain, SuddenPullOutIsTheSameAsASlowOne)
{
	auto slow = anchor(1e10, 1e5), sudden = anchor(1e10, 1e5);
	for (int k = 1; k <= 400; ++k)
		pulled(slow, 1e-5 * k);
	EXPECT_NEAR(pulled(sudden, 4e-3), pulled(slow, 4e-3), 1e-6 * pulled(slow, 4e-3));
}

TEST(BoltChain, SteelYieldsAndBreaksAtTheJoint)
{
	auto bolt                = grouted(1e9, 1e6);
	bolt.chain.yieldForce    = 2e5;
	bolt.chain.ruptureStrain = 0.1;
	EXPECT_NEAR(pulled(bolt, 8e-3), 2e5, 1e-6);
	const Real across = bolt.chain.elements[bolt.crossings[0].element].length;
	EXPECT_NEAR(pulled(bolt, 0.09 * double(across)), 2e5, 1e-6);
	EXPECT_EQ(pulled(bolt, 0.11 * double(across) + 1e-3), 0);
	EXPECT_NEAR(double(bolt.chain.energy()), 0, 1e-2); // what is left of it is locked in by slip, of which there was none
}

TEST(BoltChain, JackingGivesTheHeadItsForce)
{
	auto bolt = anchor(1e9, 2e5);
	EXPECT_NEAR(double(bolt.chain.groutStrength()), 2e5 * inRock, 1e-6);
	EXPECT_TRUE(bolt.chain.jack(1.2e5).solved);
	EXPECT_NEAR(pulled(bolt, 0), 1.2e5, 1e-4);
	EXPECT_LT(bolt.chain.nodes[0].plasticSlip, 0); // towards the head, at the mouth
	EXPECT_EQ(bolt.chain.nodes.back().plasticSlip, 0);
	const double first = pulled(bolt, 1e-6), expect = double(bolt.chain.elasticStiffness(bolt.crossings[0].element)) * 1e-6;
	EXPECT_LE(first - 1.2e5, expect);
	EXPECT_GT(first, 1.2e5);
}

TEST(BoltChain, ForcesOfTheGroutAreTheTensionsDifference)
{
	auto bolt = grouted(1e9, 5e4);
	pulled(bolt, 1e-3);
	double first = 0, second = 0;
	for (std::size_t i = 0; i < bolt.chain.nodes.size(); ++i)
		(i <= bolt.crossings[0].element ? first : second) += double(bolt.chain.nodes[i].force);
	const double tension = double(bolt.chain.elements[bolt.crossings[0].element].force);
	EXPECT_NEAR(first, tension, 1e-6 * tension);
	EXPECT_NEAR(second, -tension, 1e-6 * tension);
}

TEST(BoltChain, WorkIsStoredOrDissipated)
{
	auto   bolt = grouted(1e9, 1e5);
	double work = 0, last = 0, stored = 0;
	for (int k = 1; k <= 1000; ++k) {
		const double by = 1e-6 * (k < 500 ? k : 1000 - k), force = pulled(bolt, by);
		work += (force + last) / 2 * (k <= 499 ? 1e-6 : k == 500 ? 1e-6 : -1e-6);
		last             = force;
		const double now = double(bolt.chain.energy());
		EXPECT_GE(work - now, stored - 1e-9 * work); // what is lost never falls
		stored = work - now;
	}
	EXPECT_GT(stored, 0.05 * work);
}

TEST(BoltLayout, PassagesOfALineThroughBlocks)
{
	const auto found = inOrder({ { 2, 2.0, 3 }, { 0, 0, 1.001 }, { 1, 0.999, 2 }, { 3, 1.2, 1.5 }, { 4, 3, 3.0000001 } }, 1e-6 * 3);
	ASSERT_EQ(found.size(), 3u);
	EXPECT_EQ(found[1].block, 1);
	EXPECT_NEAR(double(found[0].to), 1, 1e-12);
	EXPECT_NEAR(double(found[1].from), 1, 1e-12);
	EXPECT_EQ(inOrder({ { 7, 0, 1 }, { 7, 1, 2 } }, 1e-6).size(), 1u);
}

TEST(BoltLayout, JointsAreFreeOfGroutAndCountAsDowels)
{
	const auto bolt = grouted(1e9, 1e5);
	ASSERT_EQ(bolt.crossings.size(), 1u);
	EXPECT_TRUE(bolt.crossings[0].atJoint);
	EXPECT_NEAR(double(bolt.crossings[0].to - bolt.crossings[0].from), gap, 1e-12);
	EXPECT_FALSE(anchor(1e9, 1e5).crossings[0].atJoint);
	EXPECT_NEAR(double(bolt.firstStation), double(bolt.chain.elements[0].length) / 2, 1e-12); // no plate: the middle of the first part
	EXPECT_TRUE(layOut({ { 0, 0, 3 } }, BoltDesign(), 3).crossings.empty());
}

TEST(BoltChain, IsSolvedWhateverTheHistory)
{
	std::mt19937                           random(3);
	std::uniform_real_distribution<double> number(-1, 1);
	for (int trial = 0; trial < 60; ++trial) {
		BoltDesign design;
		design.axialStiffness  = EA;
		design.plate           = trial % 2;
		design.groutStiffness  = std::pow(10, 8 + 2 * number(random));
		design.groutStrength   = std::pow(10, 5 + number(random));
		design.yieldForce      = 2e5;
		design.ruptureStrain   = trial % 3 ? 0.1 : 1e9;
		design.freeLength      = gap;
		auto              bolt = layOut({ { 0, 0, 0.7 }, { 1, 0.7, 1.5 }, { 2, 1.5, 1.8 }, { 3, 1.8, 4 } }, design, 4);
		std::vector<Real> openings(bolt.chain.elements.size(), 0);
		const double      size = std::pow(10, -4 + 2 * number(random));
		for (int step = 0; step < 300; ++step) {
			for (const auto& crossing : bolt.crossings)
				openings[crossing.element] += size * (number(random) + 0.1);
			ASSERT_TRUE(bolt.chain.solve(openings).solved) << trial << " " << step;
			for (const BoltElement& element : bolt.chain.elements)
				ASSERT_LE(abs(element.force), 2e5);
		}
	}
}
