// SPDX-License-Identifier: GPL-2.0-or-later
#include "shear/ShearLayers.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

using namespace polytope;

namespace {

const Vector3 x = Vector3::UnitX();

/// Many springs, one after the other: what ShearLayers stands for. The last to come are the first to leave.
struct Springs {
	struct Spring {
		Real    area;
		Vector3 displacement;
	};
	std::vector<Spring> springs;

	void setArea(Real present)
	{
		Real change = present;
		for (const Spring& spring : springs)
			change -= spring.area;
		if (change > 0) springs.push_back({ change, Vector3::Zero() });
		while (change < 0 && !springs.empty()) {
			Spring&    last = springs.back();
			const Real gone = std::min(last.area, -change);
			last.area -= gone;
			change += gone;
			if (last.area <= 0) springs.pop_back();
		}
	}
	Vector3 sum() const
	{
		Vector3 sum = Vector3::Zero();
		for (const Spring& spring : springs)
			sum += spring.area * spring.displacement;
		return sum;
	}
	void move(const Vector3& by)
	{
		for (Spring& spring : springs)
			spring.displacement += by;
	}
};

TEST(ShearLayers, WhatJoinsIsUnstrainedAndLeavesFirst)
{
	ShearLayers bed(2, 0.1 * x);
	bed.setArea(3);
	EXPECT_NEAR(bed.sum()[0], 0.2, 1e-15);
	EXPECT_NEAR(bed.area(), 3, 1e-15);
	bed.setArea(2);
	EXPECT_NEAR(bed.sum()[0], 0.2, 1e-15);
	bed.setArea(1);
	EXPECT_NEAR(bed.sum()[0], 0.1, 1e-15);
	bed.setArea(0);
	EXPECT_EQ(bed.sum()[0], 0);
	EXPECT_EQ(bed.count(), 0);
	bed.setArea(1);
	EXPECT_EQ(bed.sum()[0], 0);
	EXPECT_NEAR(bed.area(), 1, 1e-15);
}

// All go but for the rounding of the sum of their areas, and no layer goes that is not there.
TEST(ShearLayers, OfNoAreaAreNoMoreThanRoundingLeaves)
{
	std::mt19937_64                        random(4);
	std::uniform_real_distribution<double> uniform(0, 1);
	for (int trial = 0; trial < 1000; ++trial) {
		ShearLayers bed;
		for (int layer = 0; layer < tolerance::shearLayers; ++layer) {
			bed.setArea(bed.area() + 0.1 + uniform(random));
			bed.setArea(bed.area() * (1 - 1e-3)); // what comes next is another layer
		}
		ASSERT_EQ(bed.count(), tolerance::shearLayers);
		bed.setArea(0);
		ASSERT_GE(bed.count(), 0);
		ASSERT_LE(bed.area(), 4 * tolerance::rounding * 4.4); // of sums up to 4.4
		ASSERT_EQ(bed.count(), bed.area() > 0);
	}
}

/// Patches of springs that come, are moved and turned, and leave where they are: what the layers stand for where rims lift in turn. All about the origin.
struct Patches {
	struct Patch {
		Real    area;
		Vector3 place, displacement;
	};
	std::vector<Patch> patches;

	Real area() const
	{
		Real sum = 0;
		for (const Patch& patch : patches)
			sum += patch.area;
		return sum;
	}
	Vector3 centroid() const
	{
		Vector3 sum = Vector3::Zero();
		for (const Patch& patch : patches)
			sum += patch.area * patch.place;
		return sum / area();
	}
	/// Adds or takes away the patch, and does the same with the layers.
	template <class Act> void change(ShearLayers& bed, const Vector3& rotation, const Act& act)
	{
		const Vector3 before = centroid();
		act(patches);
		bed.setArea(area(), { centroid() - before, rotation, 2 });
	}
	void move(ShearLayers& bed, const Vector3& by, const Vector3& rotation)
	{
		for (Patch& patch : patches)
			patch.displacement += by + rotation.cross(patch.place - centroid());
		bed.move(by);
		bed.strain(rotation);
	}
	void expectLike(const ShearLayers& bed) const
	{
		Vector3 sum = Vector3::Zero(), moment = Vector3::Zero();
		Real    energy = 0, spread = 0;
		for (const Patch& patch : patches) {
			const Vector3 arm = patch.place - centroid();
			sum += patch.area * patch.displacement;
			moment += patch.area * arm.cross(patch.displacement);
			energy += patch.area * patch.displacement.squaredNorm() / 2;
			spread += patch.area * arm.squaredNorm();
		}
		EXPECT_NEAR((bed.sum() - sum).norm(), 0, 1e-14);
		EXPECT_NEAR((bed.moment() - moment).norm(), 0, 1e-14);
		EXPECT_NEAR(bed.energy(), energy, 1e-14);
		EXPECT_NEAR(bed.spread(), spread, 1e-14);
	}
};

TEST(ShearLayers, OfRimsThatLiftInTurnThoseLeaveThatLift)
{
	const Vector3 turn = 0.05 * Vector3::UnitZ();
	ShearLayers   bed(1, 0.1 * x);
	Patches       real { { { 1, Vector3::Zero(), 0.1 * x } } };
	const auto    join = [&](Real area, const Vector3& place) {
                real.change(bed, Vector3::Zero(), [&](auto& all) { all.push_back({ area, place, Vector3::Zero() }); });
                real.expectLike(bed);
	};
	const auto leave = [&](std::size_t k) {
		real.change(bed, Vector3::Zero(), [&](auto& all) { all.erase(all.begin() + long(k)); });
		real.expectLike(bed);
	};
	join(0.2, Vector3(0.6, 0, 0));
	real.move(bed, Vector3(0, 0.02, 0), turn);
	// what comes next is a layer of its own after a loss
	real.change(bed, Vector3::Zero(), [](auto& all) { all[1].area -= 0.02; });
	real.expectLike(bed);
	join(0.1, Vector3(0, 0.7, 0));
	real.move(bed, Vector3(0.01, 0, 0), -turn);
	real.expectLike(bed);
	leave(1); // the one that came first
	leave(1);
	EXPECT_EQ(bed.count(), 1);
	EXPECT_NEAR(bed.moment().norm(), 0, 1e-14);
}

// What stays of a turned patch has another middle, and there another displacement; the bed's energy is less than before.
TEST(ShearLayers, WhatStaysIsStrainedAsItWas)
{
	const Vector3 turn = -0.1 * Vector3::UnitZ();
	ShearLayers   bed(1, 0.1 * Vector3::UnitY());
	bed.setArea(0.75, { Vector3(-0.125, 0, 0), turn, 2 }); // a quarter at the end x = 1/2 of a unit square
	EXPECT_NEAR(bed.sum()[1] / bed.area(), 0.1 + 0.1 * 0.125, 1e-15);
	ShearLayers other(1, 0.1 * Vector3::UnitY());
	other.setArea(0.9, { Vector3(-0.8, 0, 0), 10 * turn, 2 }); // no bed is like that
	EXPECT_LE(other.energy(), 0.1 * 0.1 / 2);
}

TEST(ShearLayers, AreNoFartherApartThanTheBedReaches)
{
	ShearLayers bed(1, x);
	bed.setArea(1.5, { Vector3(0.4, 0, 0), Vector3::Zero(), 2 });
	const Real before = bed.spread();
	bed.limitSpread(10);
	EXPECT_EQ(bed.spread(), before);
	bed.limitSpread(0.1);
	EXPECT_NEAR(bed.spread(), tolerance::mostSpread * 0.1, 1e-15);
	bed.limitSpread(0);
	EXPECT_EQ(bed.spread(), 0);
}

/// Layers of area 1, 2, 3, 4 with displacements 0.7, 0.6, 0.4 and 0.1, the last of which does not grow.
ShearLayers fourLayers()
{
	const Real  steps[] = { 0.1, 0.2, 0.3, 0.1 };
	ShearLayers bed;
	Real        area = 0;
	for (int k = 0; k < 4; ++k) {
		area += k + 1;
		bed.setArea(area + 0.5);
		bed.setArea(area);
		bed.move(steps[k] * x);
	}
	return bed;
}

TEST(ShearLayers, EnergyAndForceAreThoseOfTheSprings)
{
	const ShearLayers bed = fourLayers();
	EXPECT_EQ(bed.count(), 4);
	EXPECT_NEAR(bed.area(), 10, 1e-14);
	EXPECT_NEAR((bed.sum() - (0.7 + 2 * 0.6 + 3 * 0.4 + 4 * 0.1) * x).norm(), 0, 1e-14);
	EXPECT_NEAR(bed.energy(), (0.49 + 2 * 0.36 + 3 * 0.16 + 4 * 0.01) / 2, 1e-14);
	EXPECT_EQ(ShearLayers().energy(), 0);
}

TEST(ShearLayers, TheSameAreaChangesNothing)
{
	ShearLayers bed  = fourLayers();
	const Real  area = bed.area(), energy = bed.energy();
	for (int step = 0; step < 5; ++step)
		bed.setArea(area);
	EXPECT_EQ(bed.count(), 4);
	EXPECT_EQ(bed.energy(), energy);
}

/// As a saved state has them.
struct LayersSaved {
	std::vector<Springs::Spring> layers;

	void operator()(const std::string& name, const Real& value)
	{
		if (name == "area") layers.push_back({ value, Vector3::Zero() });
	}
	void operator()(const std::string& name, const Vector3& value)
	{
		if (name == "displacement") layers.back().displacement = value;
	}
	void operator()(const std::string&, int) { }
	void operator()(const std::string&, bool) { }
};

std::vector<Springs::Spring> layersOf(ShearLayers bed)
{
	LayersSaved saved;
	visitParts(bed, [&](const char* name, auto& value) { saved(name, value); });
	return saved.layers;
}

// Without room for one more the two are united whose union loses the least, ½ a₁a₂/(a₁ + a₂) |e₁ − e₂|²; the force stays.
TEST(ShearLayers, ThoseThatDifferLeastAreUnited)
{
	ShearLayers   bed    = fourLayers();
	const Real    energy = bed.energy();
	const Vector3 sum    = bed.sum();
	bed.setArea(12);
	EXPECT_EQ(bed.count(), tolerance::shearLayers);
	EXPECT_NEAR((bed.sum() - sum).norm(), 0, 1e-14);
	EXPECT_NEAR(energy - bed.energy(), 0.01 / 3, 1e-14); // the first two: areas 1 and 2, displacements 0.7 and 0.6
	const std::vector<Springs::Spring> layers = layersOf(bed);
	ASSERT_EQ(layers.size(), 4u);
	EXPECT_NEAR(layers[0].area, 3, 1e-14);
	EXPECT_NEAR(layers[0].displacement[0], (0.7 + 2 * 0.6) / 3, 1e-14);
	EXPECT_NEAR(layers[1].displacement[0], 0.4, 1e-14);
	EXPECT_NEAR(layers[2].displacement[0], 0.1, 1e-14);
	EXPECT_EQ(layers[3].displacement, Vector3::Zero());
}

// Force is held constant while the area goes up and down: the displacement ends, where a bed with one displacement creeps on.
TEST(ShearLayers, LoadCyclesDoNotCreep)
{
	ShearLayers bed(1, x);
	Real        oneDisplacement = 1, area = 1, creep = 0, shown = 0, late = 0;
	for (int step = 0; step < 4000; ++step) {
		// a cycle with a shorter one on it, and rounding
		const Real next
		        = 1 + 0.3 * std::sin(2 * M_PI * step / 100.) + 0.05 * std::sin(2 * M_PI * step / 7.) + 1e-12 * std::cos(1e3 * step);
		bed.setArea(next);
		if (next < area) oneDisplacement *= next / area; // its force
		creep += (1 - oneDisplacement) / next;
		oneDisplacement = 1;
		area            = next;
		const Real by   = (1 - bed.sum()[0]) / bed.area();
		bed.move(by * x);
		shown += by;
		if (step >= 2000) late += by;
	}
	EXPECT_GT(creep, 15);
	EXPECT_LT(shown, 1.2);
	EXPECT_LT(late, 1e-3);
}

TEST(ShearLayers, FollowManySpringsAndNeverGainEnergy)
{
	std::mt19937_64                  random(2);
	std::normal_distribution<double> normal;
	ShearLayers                      bed(1, 0.02 * x);
	Springs                          springs { { { 1, 0.02 * x } } };
	Real                             area = 1, worst = 0, largest = 0;
	for (int step = 0; step < 3000; ++step) {
		area              = std::abs(1 + 0.4 * std::sin(step / 40.) + 0.02 * normal(random));
		const Real before = bed.energy();
		bed.setArea(area);
		springs.setArea(area);
		EXPECT_LE(bed.energy(), before * (1 + 1e-12));
		ASSERT_LE(bed.count(), tolerance::shearLayers);
		const Vector3 by = 1e-3 * std::sin(step / 90.) * x;
		bed.move(by);
		springs.move(by);
		worst   = std::max(worst, std::abs(bed.sum()[0] - springs.sum()[0]));
		largest = std::max(largest, std::abs(springs.sum()[0]));
	}
	EXPECT_LT(worst, 0.15 * largest);
}

TEST(ShearLayers, NeverGainEnergyWhereverTheirAreaGoes)
{
	std::mt19937_64                  random(3);
	std::normal_distribution<double> normal;
	const auto                       inPlane = [&](double size) { return Vector3(size * normal(random), size * normal(random), 0); };
	ShearLayers                      bed(1, 0.02 * x);
	for (int step = 0; step < 20000; ++step) {
		const Real before = bed.energy();
		bed.setArea(std::abs(1 + 0.4 * std::sin(step / 40.) + 0.05 * normal(random)),
		        { inPlane(0.1), 0.1 * normal(random) * Vector3::UnitZ(), 1 });
		ASSERT_LE(bed.energy(), before * (1 + 1e-12));
		ASSERT_LE(bed.count(), tolerance::shearLayers);
		ASSERT_TRUE(std::isfinite(double(bed.spread())));
		bed.move(inPlane(1e-2));
	}
}

TEST(ShearLayers, SavedStateHasAllOfIt)
{
	ShearLayers bed(1, x);
	bed.setArea(1.5, { Vector3(0.1, 0, 0), Vector3::Zero(), 1 });
	bed.move(0.5 * x);
	ShearLayers          other;
	std::vector<Real>    numbers;
	std::vector<Vector3> vectors;
	struct Writer {
		std::vector<Real>&    numbers;
		std::vector<Vector3>& vectors;
		void                  operator()(const char*, const int& value) const { numbers.push_back(value); }
		void                  operator()(const char*, const bool& value) const { numbers.push_back(value); }
		void                  operator()(const char*, const Real& value) const { numbers.push_back(value); }
		void                  operator()(const char*, const Vector3& value) const { vectors.push_back(value); }
	};
	visitParts(bed, Writer { numbers, vectors });
	std::size_t number = 0, vector = 0;
	struct Reader {
		const std::vector<Real>&    numbers;
		const std::vector<Vector3>& vectors;
		std::size_t &               number, &vector;
		void                        operator()(const char*, int& value) const { value = int(numbers[number++]); }
		void                        operator()(const char*, bool& value) const { value = numbers[number++] != 0; }
		void                        operator()(const char*, Real& value) const { value = numbers[number++]; }
		void                        operator()(const char*, Vector3& value) const { value = vectors[vector++]; }
	};
	visitParts(other, Reader { numbers, vectors, number, vector });
	EXPECT_EQ(other.count(), 2);
	EXPECT_EQ(other.sum(), bed.sum());
	EXPECT_GT(bed.spread(), 0);
	EXPECT_EQ(other.spread(), bed.spread());
	other.setArea(1.6); // goes on growing the same layer
	EXPECT_EQ(other.count(), 2);
}

} // namespace
