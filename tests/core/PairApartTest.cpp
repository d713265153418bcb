// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact/PairApart.hpp"

#include "PairSamples.hpp"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <memory>

using namespace polytope;
using namespace polytope::samples;

namespace {

std::shared_ptr<const ConvexShape> solid(int faces) { return ConvexShape::shared(regularSolid(faces, 1), 0); }

bool stay(const Pair& pair, Real way)
{
	ContactWorkspace workspace;
	return staysApart(pair.placed(), way, workspace);
}

} // namespace

TEST(PairApart, FacesMayComeNearerByHalfTheirGapEach)
{
	Pair pair;
	pair.shape[0] = pair.shape[1] = solid(6);
	const Real edge               = 2 * pair.inscribedRadius();
	for (const Real gap : { 1e-6, 1e-3, 0.1, 0.3 }) {
		pair.centre2 = Vector3(edge + gap, 0.1, 0.2);
		EXPECT_TRUE(stay(pair, Real(0.499) * gap));
		EXPECT_FALSE(stay(pair, Real(0.501) * gap));
	}
	pair.centre2 = Vector3(edge - 1e-6, 0, 0);
	EXPECT_FALSE(stay(pair, 0));
}

TEST(PairApart, ANegativeWayIsAnOverlap)
{
	Pair pair;
	pair.shape[0] = pair.shape[1] = solid(6);
	const Real edge               = 2 * pair.inscribedRadius();
	for (const Real overlap : { 1e-9, 1e-6, 1e-3, 0.1 }) {
		pair.centre2 = Vector3(edge - overlap, 0.1, 0.2);
		EXPECT_TRUE(stay(pair, Real(-0.501) * overlap));
		EXPECT_FALSE(stay(pair, Real(-0.499) * overlap));
	}
	EXPECT_FALSE(stay(pair, -std::numeric_limits<Real>::infinity()));
}

TEST(PairApart, WithoutALimitNoPairDoes)
{
	Pair pair;
	pair.shape[0] = pair.shape[1] = solid(6);
	pair.centre2                  = Vector3(100, 0, 0);
	EXPECT_FALSE(stay(pair, std::numeric_limits<Real>::infinity()));
	EXPECT_FALSE(stay(pair, std::numeric_limits<Real>::quiet_NaN()));
	EXPECT_TRUE(stay(pair, 10));
}

TEST(PairApart, AgreesWithTheLinearProgram)
{
	std::mt19937_64 random(1);
	int             apart = 0, near = 0;
	for (int k = 0; k < 2000; ++k) {
		Pair pair;
		for (int body = 0; body < 2; ++body) {
			pair.shape[body]    = solid(std::array<int, 5> { 4, 6, 8, 12, 20 }[random() % 5]);
			pair.rotation[body] = randomRotation(random);
		}
		pair.centre2 = uniform(random, 1, 2.2) * randomDirection(random);
		const Real s = infeasibility(pair);
		if (std::abs(s) < 1e-9) continue;
		EXPECT_EQ(stay(pair, 0), s > 0);
		if (!(s > 0)) continue;
		++apart;
		EXPECT_TRUE(stay(pair, Real(0.999) * s));
		// farther apart than balls around them: s* says less than those
		if (pair.centre2.norm() > pair.shape[0]->boundingRadius() + pair.shape[1]->boundingRadius() + Real(2.002) * s) continue;
		++near;
		EXPECT_FALSE(stay(pair, Real(1.001) * s));
	}
	EXPECT_GT(apart, 500);
	EXPECT_GT(near, 300);
}
