// SPDX-License-Identifier: GPL-2.0-or-later
//
// Two free bodies collide without damping or friction: the remaining error of the energy is the
// integrator's, and falls with the square of the time step.
#include "Collisions.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <map>

using namespace polytope;
using namespace polytope::samples;

namespace {

struct Errors {
	Real median, rootMeanSquare, largest, momentum;
};

Errors errors(const std::vector<Collision>& collisions, const ContactSettings& settings, int steps)
{
	std::vector<Real> all;
	Errors            sum { 0, 0, 0, 0 };
	for (const Collision& collision : collisions) {
		const Outcome outcome = run(collision, settings, steps);
		sum.momentum          = std::max(sum.momentum, outcome.momentumError);
		if (!outcome.over && settings.contactModel == ContactModel::Paper) continue; // it has no elastic energy
		all.push_back(outcome.energyError);
		sum.rootMeanSquare += outcome.energyError * outcome.energyError;
	}
	std::sort(all.begin(), all.end());
	sum.rootMeanSquare = std::sqrt(sum.rootMeanSquare / Real(all.size()));
	sum.median         = all[all.size() / 2];
	sum.largest        = all.back();
	return sum;
}

TEST(ConservativeCollisions, EnergyErrorFallsWithTheSquareOfTheTimeStep)
{
	std::mt19937_64        random(600);
	std::vector<Collision> collisions;
	for (int k = 0; k < 100; ++k)
		collisions.push_back(randomCollision(random));
	ContactSettings paper, conservative;
	conservative.contactModel = ContactModel::Conservative;
	std::vector<Errors> all;
	for (int steps : { 2000, 4000, 8000 }) {
		all.push_back(errors(collisions, conservative, steps));
		const Errors other = errors(collisions, paper, steps);
		std::printf("%d steps: energy error, median / root mean square / largest: conservative %.2e / %.2e / %.2e, paper %.2e / "
		            "%.2e / %.2e\n",
		        steps, double(all.back().median), double(all.back().rootMeanSquare), double(all.back().largest),
		        double(other.median), double(other.rootMeanSquare), double(other.largest));
		EXPECT_LT(all.back().momentum, 1e-11);
		EXPECT_GT(other.median, 100 * all.back().median);
	}
	// a quarter of the step, a sixteenth of the error: over both halvings, since one alone depends on which collisions were drawn. The root
	// mean square is that of a few collisions whose kink falls between steps as it may: of four draws it fell to a tenth at the least
	EXPECT_GT(all.front().median / all.back().median, 12);
	EXPECT_GT(all.front().rootMeanSquare / all.back().rootMeanSquare, 8);
}

TEST(ConservativeCollisions, DefaultBarrierIsNotMuchWorseThanAnyOther)
{
	std::mt19937_64        random(600);
	std::vector<Collision> collisions;
	for (int k = 0; k < 100; ++k)
		collisions.push_back(randomCollision(random));
	std::map<Real, Errors> coarse;
	for (Real barrier : { 5e-4, 1e-3, 2e-3, tolerance::barrier, 5e-3, 1e-2 }) {
		ContactSettings settings;
		settings.contactModel = ContactModel::Conservative;
		settings.barrier      = barrier;
		for (int steps : { 1000, 500 }) {
			const Errors found = coarse[barrier] = errors(collisions, settings, steps);
			std::printf("barrier %.0e, %d steps: energy error, median / root mean square / largest: %.1e / %.1e / %.1e\n",
			        double(barrier), steps, double(found.median), double(found.rootMeanSquare), double(found.largest));
		}
	}
	for (const auto& [barrier, found] : coarse)
		EXPECT_LT(coarse[tolerance::barrier].rootMeanSquare, 2 * found.rootMeanSquare) << barrier;
	EXPECT_LT(coarse[tolerance::barrier].rootMeanSquare, coarse[Real(5e-4)].rootMeanSquare / 2);
}

/// Cause of the remaining error. An energy ∝ Φ² has a force with a kink where contact begins and ends, as every linear spring;
/// steps that pass it leave an error ∝ Δt². With an energy ∝ Φ⁴, from the same Φ, n and x, leapfrog leaves almost no error: a
/// symplectic scheme's error oscillates while a smooth force acts, and vanishes afterwards.
TEST(ConservativeCollisions, WithoutTheKinkOfALinearSpringLeapfrogLeavesNextToNothing)
{
	std::mt19937_64        random(600);
	std::vector<Collision> linear;
	for (int k = 0; k < 100; ++k)
		linear.push_back(randomCollision(random));
	std::vector<Collision> smooth = linear;
	for (Collision& one : smooth)
		one.smooth = Real(0.01) * std::min(one.body[0].shape->inscribedRadius(), one.body[1].shape->inscribedRadius());
	ContactSettings conservative;
	conservative.contactModel    = ContactModel::Conservative;
	conservative.newtonTolerance = 1e-20; // the solver's error must be negligible
	for (int steps : { 2000, 4000 }) {
		const Errors two = errors(linear, conservative, steps), four = errors(smooth, conservative, steps);
		std::printf("%d steps: energy error, median / root mean square / largest: energy ∝ Φ² %.1e / %.1e / %.1e, ∝ Φ⁴ %.1e / %.1e "
		            "/ %.1e\n",
		        steps, double(two.median), double(two.rootMeanSquare), double(two.largest), double(four.median),
		        double(four.rootMeanSquare), double(four.largest));
		EXPECT_LT(four.median, two.median / 1000);
		EXPECT_LT(four.rootMeanSquare, two.rootMeanSquare / 3);
	}
}

/// A unit cube that stands on a wall, rocking by a tilt far below what would shift its contact point to an edge.
struct Rocking {
	Body    cube;
	Real    stiffness, weight;
	Real    frequency; ///< predicted, rad per time: √(force × rocking arm / moment of inertia)
	Vector3 force = Vector3::Zero(), at = Vector3::Zero();

	Rocking()
	{
		cube.shape    = ConvexShape::shared(cuboid(0.5, 0.5, 0.5), 0);
		cube.mass     = 1;
		cube.inertia  = cube.shape->mass().inertia.diagonal();
		cube.velocity = cube.spin = Vector3::Zero();
		cube.orientation          = Quaternion::Identity();
		stiffness                 = 1e6;
		weight                    = 1000;
		// at rest on the wall
		Real low = 0.4, high = 0.5;
		for (int halving = 0; halving < 60; ++halving) {
			cube.position                                       = Vector3(0, 0, (low + high) / 2);
			(stiffness * contact().depth > weight ? low : high) = (low + high) / 2;
		}
		frequency        = std::sqrt(weight * contact().rockingArm / cube.inertia.y());
		cube.orientation = Quaternion(Eigen::AngleAxis<Real>(1e-8, Vector3::UnitY()));
		contact();
	}
	ContactResult contact()
	{
		Pair pair;
		pair.shape[0]    = ConvexShape::halfSpace(Vector3::UnitZ(), 3);
		pair.shape[1]    = cube.shape;
		pair.rotation[1] = cube.orientation.toRotationMatrix();
		pair.centre2     = cube.position;
		ContactSettings settings;
		settings.contactModel      = ContactModel::Conservative;
		const ContactResult result = query(pair, settings);
		force = result.inContact ? Vector3(stiffness * result.depth * result.normal) : Vector3(Vector3::Zero());
		at    = result.point;
		return result;
	}
	void step(Real time)
	{
		const auto kick = [&] {
			cube.kick(force, at, time / 2);
			cube.velocity.z() -= weight / cube.mass * time / 2;
		};
		kick();
		cube.drift(time);
		contact();
		kick();
	}
	Real tilt() const { return 2 * cube.orientation.y(); }
};

TEST(ConservativeCollisions, RockingFrequencyIsThatOfTheRockingArm)
{
	Rocking    rocking;
	const Real step = 2 * Real(M_PI) / rocking.frequency / 1000;
	Real       time = 0;
	while (rocking.tilt() > 0 && time < 10 / rocking.frequency) {
		rocking.step(step);
		time += step;
	}
	EXPECT_NEAR(time * rocking.frequency, Real(M_PI) / 2, 0.01);
	// face on face, length 1: 0.306 √(k/m) √(depth × length)/μ
	const Real mu = tolerance::barrier / 2, depth = rocking.weight / rocking.stiffness;
	EXPECT_NEAR(rocking.frequency / (std::sqrt(rocking.stiffness) * std::sqrt(depth) / mu), std::sqrt(Real(6) / 64), 0.01);
}

TEST(ConservativeCollisions, StepsBelowTwoOverTheRockingFrequencyAreStable)
{
	for (Real part : { 0.95, 1.05 }) {
		Rocking rocking;
		Real    most = 0;
		for (int k = 0; k < 200; ++k) {
			rocking.step(part * 2 / rocking.frequency);
			most = std::max(most, std::abs(rocking.tilt()));
		}
		std::printf("step of %.2f of 2/frequency: largest tilt %.1e of 1e-8 at the start\n", double(part), double(most));
		EXPECT_EQ(most < 1e-7, part < 1);
	}
}

} // namespace
