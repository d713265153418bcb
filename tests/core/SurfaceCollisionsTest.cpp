// SPDX-License-Identifier: GPL-2.0-or-later
//
// Two free bodies collide: with force, and moment, of a contact surface the remaining error of the energy is the integrator's.
#include "Collisions.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

using namespace polytope;
using namespace polytope::samples;

namespace {

struct Errors {
	Real median, largest, steps;
};

/// Errors of the energy over the largest elastic energy, of those collisions that are over.
Errors errors(std::vector<Collision> collisions, ContactModel model, int steps, bool turning)
{
	ContactSettings settings;
	settings.contactModel = model;
	std::vector<Real> all;
	for (Collision& collision : collisions) {
		collision.turning = turning;
		if (model == ContactModel::Foundation) {
			// about as deep as with a spring
			const Real inner = std::min(collision.body[0].shape->inscribedRadius(), collision.body[1].shape->inscribedRadius());
			collision.stiffness /= Real(0.02) * inner * inner;
		}
		const Outcome outcome = run(collision, settings, steps);
		if (outcome.over && outcome.ofElastic < 1e300) all.push_back(outcome.ofElastic);
	}
	EXPECT_GT(all.size(), collisions.size() * 3 / 4);
	std::sort(all.begin(), all.end());
	return { all[all.size() / 2], all.back(), Real(steps) };
}

TEST(SurfaceCollisions, EnergyErrorFallsWithTheSquareOfTheTimeStep)
{
	std::mt19937_64        random(600);
	std::vector<Collision> collisions;
	for (int k = 0; k < 60; ++k)
		collisions.push_back(randomCollision(random));
	for (const ContactModel model : { ContactModel::Foundation, ContactModel::Spring }) {
		std::vector<Errors> all;
		for (const int steps : { 500, 1000, 2000 }) {
			all.push_back(errors(collisions, model, steps, true));
			const Errors without = errors(collisions, model, steps, false);
			std::printf("%s, %d steps: energy error over elastic energy, median / largest %.2e / %.2e; without the moment "
			            "about the "
			            "normal %.2e / %.2e\n",
			        model == ContactModel::Foundation ? "foundation" : "spring", steps, double(all.back().median),
			        double(all.back().largest), double(without.median), double(without.largest));
		}
		EXPECT_LT(all.back().median, 1e-5);
		EXPECT_GT(all.front().median / all.back().median, 10);
	}
}

} // namespace
