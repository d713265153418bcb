// SPDX-License-Identifier: GPL-2.0-or-later
//
// A real interaction that opens needs point, normal and (negative) depth until its law ends it, and no jump where it opens.
#include "SameAnswer.hpp"

#include <gtest/gtest.h>

using namespace polytope;
using namespace polytope::samples;

namespace {

ContactSettings acrossGap()
{
	ContactSettings settings;
	settings.geometryAcrossGap = true;
	return settings;
}

ContactResult at(const Pair& pair, const Vector3& from, const Vector3& to, Real t, PairMemory* memory = nullptr)
{
	Pair here    = pair;
	here.centre2 = from + t * (to - from);
	return query(here, acrossGap(), memory);
}

Real jump(const ContactResult& one, const ContactResult& two) { return (one.point - two.point).norm() + (one.normal - two.normal).norm(); }

/// The answer is continuous: where two neighbouring answers differ most, halving their distance again and again
/// makes the difference vanish, but for what a skin of 1e-6 leaves.
Real lastingJump(const Pair& pair, const Vector3& from, const Vector3& to)
{
	const int steps = 64;
	Real      worst = 0, low = 0, high = 0;
	for (int k = 0; k < steps; ++k) {
		const Real t0 = Real(k) / steps, t1 = Real(k + 1) / steps, here = jump(at(pair, from, to, t0), at(pair, from, to, t1));
		if (here > worst) {
			worst = here;
			low   = t0;
			high  = t1;
		}
	}
	for (int halving = 0; halving < 30; ++halving) {
		const Real          middle = (low + high) / 2;
		const ContactResult m = at(pair, from, to, middle), a = at(pair, from, to, low), b = at(pair, from, to, high);
		(jump(a, m) > jump(m, b) ? high : low) = middle;
	}
	return jump(at(pair, from, to, low), at(pair, from, to, high));
}

TEST(GeometryAcrossGap, IsContinuousThroughTouchingAndBeyond)
{
	std::mt19937_64 random(200);
	const int       faces[] = { 4, 6, 8, 12, 20 };
	int             smooth = 0, crossings = 0;
	for (int trial = 0; trial < 200; ++trial) {
		Pair          pair = regularPair(faces[trial % 5], faces[trial / 5 % 5], Real(0.02), random);
		const Vector3 from = pair.centre2, aside = Real(0.02) * randomDirection(random);
		const Vector3 to    = Real(1.05) * from + aside;
		const auto    first = at(pair, from, to, 0), last = at(pair, from, to, 1);
		ASSERT_TRUE(first.inContact);
		crossings += !last.inContact;
		ASSERT_TRUE(last.hasGeometry && finite(last));
		smooth += lastingJump(pair, from, to) < 1e-3;
	}
	EXPECT_GT(crossings, 190);
	EXPECT_EQ(smooth, 200);
}

TEST(GeometryAcrossGap, IsTheSameAtAnySize)
{
	for (int faces : { 4, 6, 20 })
		for (Real apart : { 1e-3, 0.1, 2. }) {
			const auto found = [&](Real size) {
				std::mt19937_64 random(31);
				Pair            pair;
				for (int body = 0; body < 2; ++body) {
					const Real radius   = body == 0 ? size : size / 2;
					pair.shape[body]    = ConvexShape::shared(regularSolid(faces, radius), Real(0.1) * radius);
					pair.rotation[body] = randomRotation(random, 3);
				}
				moveTo(pair, Vector3(Real(0.6), 0, Real(-0.8)), apart * size);
				return query(pair, acrossGap());
			};
			const ContactResult one = found(1);
			EXPECT_FALSE(one.inContact);
			for (Real size : { 1. / 1024, 1024. }) {
				const ContactResult other = found(size);
				EXPECT_LT((other.point / size - one.point).norm(), 1e-9) << faces << ' ' << apart << ' ' << size;
				EXPECT_LT((other.normal - one.normal).norm(), 1e-9);
				EXPECT_NEAR(other.depth / size, one.depth, 1e-12);
			}
		}
}

TEST(GeometryAcrossGap, TheOverlapAtTheSkinHoldsTheTouchingPoint)
{
	// s* = 0⁻ and 0⁺: the point of the thin overlap lies in the skin's overlap, which lies in its Dikin ellipsoid times the
	// number of planes
	std::mt19937_64 random(201);
	for (int trial = 0; trial < 300; ++trial) {
		Pair          pair      = regularPair(12, 6, Real(0.02), random);
		const Vector3 direction = pair.centre2.normalized();
		moveTo(pair, direction, -1e-12);
		const ContactResult touching = query(pair, acrossGap());
		const Pair          apart    = movedApart(pair, 1e-11 * direction);
		const ContactResult open     = query(apart, acrossGap());
		ASSERT_TRUE(touching.inContact);
		ASSERT_FALSE(open.inContact);
		ASSERT_EQ(open.status, ContactStatus::Separated);
		PrecisePair grown(apart);
		for (auto& body : grown.planes)
			for (auto& plane : body)
				plane.offset += open.infeasibility + tolerance::gapSkin * pair.size();
		const QuadVector x = precise(open.point);
		EXPECT_LE(Real(grown.localLength(x, minus(precise(touching.point), x))), 18);
		EXPECT_LE((touching.normal - open.normal).norm(), 1e-2);
		EXPECT_NEAR(touching.depth, open.depth, 10 * tolerance::gapSkin);
	}
}

TEST(GeometryAcrossGap, DepthIsTheWayBetweenTheSurfaces)
{
	// never less than the bodies are apart, seldom more than a few times that: a plane nearly parallel to the normal does not count
	std::mt19937_64   random(204);
	const int         faces[] = { 4, 6, 8, 12, 20 };
	std::vector<Real> ratios;
	ContactSettings   settings = acrossGap();
	settings.section           = true;
	for (int trial = 0; trial < 1000; ++trial) {
		Pair          pair      = regularPair(faces[trial % 5], faces[trial / 5 % 5], Real(0.02), random);
		const Vector3 direction = pair.centre2.normalized();
		moveTo(pair, direction, decades(random, -5, -2));
		const ContactResult gap = query(pair, settings);
		ASSERT_FALSE(gap.inContact);
		ratios.push_back(-gap.depth * gap.dualDirection.norm() / gap.infeasibility);
		EXPECT_GT(gap.area, 0) << "of the grown bodies";
	}
	std::sort(ratios.begin(), ratios.end());
	EXPECT_GE(ratios.front(), 1 - 1e-9);
	EXPECT_LE(ratios[990], 3);
	EXPECT_LE(ratios.back(), 10);
}

TEST(GeometryAcrossGap, FaceOnFaceTheDepthIsMinusTheGap)
{
	Pair pair;
	pair.shape[0] = pair.shape[1] = ConvexShape::shared(cuboid(1, 1, 1), Real(0.1));
	for (Real gap : { 1e-12, 1e-6, 1e-3, 0.1 }) {
		pair.centre2               = Vector3(Real(0.5), Real(0.25), 2 + gap);
		const ContactResult result = query(pair, acrossGap());
		EXPECT_EQ(result.status, ContactStatus::Separated);
		EXPECT_FALSE(result.inContact);
		EXPECT_TRUE(result.hasGeometry);
		EXPECT_NEAR(result.depth, 2 - pair.centre2.z(), 1e-15);
		EXPECT_LE((result.normal - Vector3::UnitZ()).norm(), 1e-14);
		EXPECT_LE((result.point - pair.centre2 / 2).norm(), 1e-9);
	}
}

TEST(GeometryAcrossGap, IsGivenForEveryPairAndChangesNoContact)
{
	std::mt19937_64 random(202);
	for (int dimension = 2; dimension <= 3; ++dimension) {
		const Shapes shapes = randomShapes(60, random, dimension);
		int          open   = 0;
		for (int trial = 0; trial < 3000 && !HasFailure(); ++trial) {
			const Pair      pair       = randomPair(shapes, random);
			ContactSettings settings   = acrossGap();
			settings.section           = true;
			const ContactResult result = query(pair, settings), plain = query(pair);
			ASSERT_TRUE(finite(result) && result.hasGeometry);
			ASSERT_EQ(result.inContact, plain.inContact);
			if (result.inContact) {
				EXPECT_EQ(result.status, plain.status);
				EXPECT_EQ(result.point, plain.point);
				continue;
			}
			++open;
			EXPECT_EQ(result.status, ContactStatus::Separated);
			if (result.infeasibility > 0) {
				EXPECT_LT(result.depth, 0);
			}
			EXPECT_GE(result.area, 0);
			EXPECT_NEAR(result.normal.norm(), 1, 4e-15);
			EXPECT_NEAR(result.infeasibility, infeasibility(pair), 32 * tolerance::rounding * pair.reach());
		}
		EXPECT_GT(open, 600);
	}
}

TEST(GeometryAcrossGap, WarmStartedAcrossTheGapItIsTheSame)
{
	std::mt19937_64 random(203);
	for (int trial = 0; trial < 100; ++trial) {
		const Pair    pair = regularPair(8, 20, Real(0.01), random);
		const Vector3 from = pair.centre2, to = Real(1.02) * from;
		PairMemory    memory;
		for (int step = 0; step <= 40; ++step) {
			// apart and back
			const Real          t    = step <= 20 ? Real(step) / 20 : Real(40 - step) / 20;
			const ContactResult warm = at(pair, from, to, t, &memory), cold = at(pair, from, to, t);
			ASSERT_EQ(warm.inContact, cold.inContact);
			// of a skin of 1e-6 the point is known to 1e-10 in its own size, and to its planes' digits
			EXPECT_LE((warm.point - cold.point).norm(), 1e-9);
			EXPECT_LE((warm.normal - cold.normal).norm(), 1e-8);
			EXPECT_NEAR(warm.depth, cold.depth, 1e-8);
		}
	}
}

} // namespace
