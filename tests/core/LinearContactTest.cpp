// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact/LinearContact.hpp"
#include "ContactLoad.hpp"
#include "PairSamples.hpp"
#include "numbers/PlaneAxes.hpp"
#include "surface/SurfaceTolerances.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

using namespace polytope;
using namespace polytope::samples;

namespace {

constexpr ContactModel models[] = { ContactModel::Foundation, ContactModel::Spring };

/// A pair with what the second of two queries in one place has left.
struct Started {
	Pair            pair;
	ContactSettings settings;
	PairMemory      memory;
	LinearContact   linear;
	ContactResult   result;

	Started(const Pair& pair_, ContactModel model, bool energy = true) : pair(pair_)
	{
		settings.contactModel = model;
		settings.energy       = energy;
		query(pair, settings, &memory);
		ContactSettings first = settings;
		first.linear          = &linear;
		result                = query(pair, first, &memory);
	}

	bool follow(const Pair& there, ContactResult& followed, OutlineMotion& outline)
	{
		return linear.follow(there.placed(), settings, memory.point[0], memory.point[1], followed, outline);
	}
};

/// Body 2 moved by `by` at the contact point, and as far by its rotation at the distance `radius` from it; then both in the space.
Pair moved(const Started& from, Real by, Real radius, std::mt19937_64& random)
{
	Pair          pair = from.pair;
	const Vector3 way = randomDirection(random), &x = from.result.point;
	const Matrix3 turn = Eigen::AngleAxis<Real>(by / radius, randomDirection(random)).toRotationMatrix();
	pair.centre2       = turn * (pair.centre2 - x) + x + by * way;
	pair.rotation[1]   = turn * pair.rotation[1];
	const Matrix3 all  = randomRotation(random);
	for (Matrix3& rotation : pair.rotation)
		rotation = all * rotation;
	pair.centre2 = all * pair.centre2;
	return pair;
}

/// The largest differences between a full query and the linear contact, over the force, its moment over the surface's radius, and the energy.
struct Difference {
	Real force = 0, energy = 0;
};

Difference difference(Started start, Real fraction, std::mt19937_64& random)
{
	Difference found;
	for (int trial = 0; trial < 8; ++trial) {
		const Pair    there = moved(start, fraction * start.linear.across, start.linear.radius, random);
		ContactResult followed;
		OutlineMotion outline;
		EXPECT_TRUE(start.follow(there, followed, outline));
		const ContactResult full = query(there, start.settings);
		EXPECT_TRUE(followed.linear && followed.inContact);
		EXPECT_EQ(followed.status, full.status);
		EXPECT_NEAR(followed.normal.norm(), 1, 1e-12);
		const ContactModel model = start.settings.contactModel;
		const ContactLoad  one(followed, model), other(full, model);
		const Real         force = other.force.norm();
		found.force              = std::max({ found.force, (one.force - other.force).norm() / force,
		                     (one.moment - other.moment - full.point.cross(one.force - other.force)).norm() / (force * start.linear.radius) });
		found.energy             = std::max(found.energy, std::abs(one.energy - other.energy) / other.energy);
	}
	return found;
}

/// Regular bodies, hulls, thin overlaps.
std::vector<Started> someContacts(ContactModel model, int count)
{
	std::mt19937_64      random(2020);
	const Shapes         shapes = randomShapes(30, random, 3, -1);
	std::vector<Started> all;
	for (int trial = 0; int(all.size()) < count && trial < 20 * count; ++trial) {
		const int faces[] = { 4, 6, 8, 12, 20 };
		Pair      pair    = trial % 2 ? regularPair(faces[trial % 5], faces[trial / 5 % 5], decades(random, -5, -1), random)
		                              : randomPair(shapes, random);
		if (!(infeasibility(pair) < Real(-1e-6) * pair.size())) continue; // else rounding shows
		const Started start(pair, model);
		if (start.linear.known) all.push_back(start);
	}
	EXPECT_EQ(int(all.size()), count);
	return all;
}

} // namespace

/// What is left out falls with the square of the motion, in the energy with its cube: force and moment have their first derivative.
TEST(LinearContact, HasForceMomentAndEnergyToTheirOrder)
{
	std::mt19937_64 random(2021);
	for (const ContactModel model : models)
		for (const Started& start : someContacts(model, 100)) {
			const Difference far = difference(start, Real(0.4), random), near = difference(start, Real(0.04), random);
			const Real       rounding = 64 * tolerance::rounding * start.pair.reach() / -start.result.infeasibility;
			EXPECT_LE(far.force, 1e-5);
			EXPECT_LE(far.energy, 1e-8);
			EXPECT_LE(near.force, 1e-7);
			EXPECT_LE(near.energy, 1e-11 + rounding);
		}
}

/// The corners of the outline over which friction acts go with the bodies.
TEST(LinearContact, TakesTheOutlineAlong)
{
	std::mt19937_64 random(2022);
	int             outlines = 0;
	for (Started& start : someContacts(ContactModel::Foundation, 60)) {
		start.settings.outline = true;
		ContactWorkspace     workspace;
		ContactResult        full;
		PairMemory           memory = start.memory;
		std::vector<Vector2> corners;
		contactQuery(start.pair.placed(), start.settings, memory, workspace, full);
		corners.assign(full.outline, full.outline + full.outlineCount);
		for (int step = 0; step < 3; ++step) { // three steps, for each begins where the last one ended
			const Pair    there = moved(start, Real(0.4) * start.linear.across, start.linear.radius, random);
			ContactResult followed;
			OutlineMotion outline;
			ASSERT_TRUE(start.follow(there, followed, outline));
			for (Vector2& corner : corners)
				corner = outline.moved(corner);
			memory = start.memory;
			contactQuery(there.placed(), start.settings, memory, workspace, full);
			if (int(corners.size()) != full.outlineCount) continue;
			const PlaneAxes one(followed.normal), other(full.normal);
			Real            size = 0, far = 0;
			for (const Vector2& corner : corners) {
				Real least = start.linear.radius;
				for (int k = 0; k < full.outlineCount; ++k) {
					const Vector3 apart
					        = followed.point + one.inSpace(corner) - full.point - other.inSpace(full.outline[k]);
					least = std::min(least, apart.norm());
				}
				far  = std::max(far, least);
				size = std::max(size, corner.norm());
			}
			EXPECT_LE(far, 0.05 * size);
			++outlines;
		}
	}
	EXPECT_GT(outlines, 100);
}

/// Equal blocks side by side, whose other faces are in line: the piece between those must not be followed.
TEST(LinearContact, DoesNotFollowFacesInLine)
{
	std::mt19937_64 random(2023);
	int             asked = 0;
	for (const ContactModel model : models)
		for (const Real tilt : { 1e-12, 1e-9, 1e-7, 1e-6 }) {
			Pair       pair = regularPair(6, 6, Real(-1e-5), random);
			const Real half = pair.shape[0]->inscribedRadius(), depth = half / 100000;
			pair.rotation[0] = Matrix3::Identity();
			pair.rotation[1] = Eigen::AngleAxis<Real>(tilt, randomDirection(random)).toRotationMatrix();
			pair.centre2     = Vector3(0, 0, 2 * half - depth);
			Started start(pair, model);
			if (!start.linear.known) continue; // coinciding planes
			++asked;
			Pair there = pair;
			there.centre2 += Vector3(1, 1, 0) * Real(0.1) * start.linear.along;
			ContactResult followed;
			OutlineMotion outline;
			ASSERT_TRUE(start.follow(there, followed, outline));
			EXPECT_NEAR(followed.depth / query(there, start.settings).depth, 1, 2 * tolerance::leftOut);
			EXPECT_LE(followed.normal.cross(Vector3::UnitZ()).norm(), depth / half);
		}
	EXPECT_GE(asked, 4);
}

/// What it cannot answer is computed in full.
TEST(LinearContact, IsRefusedWhereItDoesNotHold)
{
	std::mt19937_64 random(2024);
	ContactResult   result;
	OutlineMotion   outline;
	Started         start = someContacts(ContactModel::Foundation, 1)[0];
	EXPECT_TRUE(start.follow(start.pair, result, outline));
	EXPECT_FALSE(start.follow(moved(start, 3 * start.linear.along, start.linear.radius, random), result, outline));
	Pair closer = start.pair;
	closer.centre2 -= 2 * start.linear.across * start.result.normal;
	EXPECT_FALSE(start.follow(closer, result, outline));

	Pair other     = start.pair;
	other.shape[1] = ConvexShape::shared(regularSolid(start.pair.shape[1]->planeCount() == 8 ? 6 : 8, 1), 0);
	EXPECT_FALSE(start.follow(other, result, outline));
	start.settings.contactModel = ContactModel::Spring;
	EXPECT_FALSE(start.follow(start.pair, result, outline));

	Started withoutEnergy(start.pair, ContactModel::Foundation, false);
	EXPECT_TRUE(withoutEnergy.follow(start.pair, result, outline));
	EXPECT_EQ(result.energy, -1);
	withoutEnergy.settings.energy = true;
	EXPECT_FALSE(withoutEnergy.follow(start.pair, result, outline));
	EXPECT_FALSE(LinearContact().follow(start.pair.placed(), start.settings, Vector3::Zero(), Vector3::Zero(), result, outline));

	// joints that stiffen as they close have no derivative
	ClosureLaw    closure;
	LinearContact linear;
	start.settings.closure = &closure;
	start.settings.linear  = &linear;
	query(start.pair, start.settings, &start.memory);
	EXPECT_FALSE(linear.known);
}
