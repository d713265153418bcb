// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact/DualWeights.hpp"
#include "PlaneRows.hpp"
#include "PrecisePair.hpp"
#include "contact/BoundingPlanes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

using namespace polytope;
using namespace polytope::samples;

namespace {

Pair boxes(const Vector3& half1, const Vector3& half2, const Vector3& centre2, const Matrix3& rotation2 = Matrix3::Identity())
{
	Pair pair;
	pair.shape[0]    = ConvexShape::shared(cuboid(half1[0], half1[1], half1[2]), 0);
	pair.shape[1]    = ConvexShape::shared(cuboid(half2[0], half2[1], half2[2]), 0);
	pair.rotation[1] = rotation2;
	pair.centre2     = centre2;
	return pair;
}

Matrix3 turnedAbout(const Vector3& axis, Real angle) { return Eigen::AngleAxis<Real>(angle, axis.normalized()).toRotationMatrix(); }

/// Sine of the angle between them.
Real lean(const Vector3& normal, const Vector3& expected) { return normal.cross(expected).norm(); }

TEST(DualWeights, AsInWiderArithmetic)
{
	std::mt19937_64 random(7001);
	Real            worst    = 0;
	int             compared = 0;
	for (int dimension = 2; dimension <= 3; ++dimension) {
		const Shapes shapes = randomShapes(60, random, dimension);
		for (int trial = 0; trial < 2000; ++trial) {
			const Pair          pair   = randomPair(shapes, random);
			const ContactResult result = query(pair);
			if (result.status != ContactStatus::Contact) continue;
			const PrecisePair exact(pair);
			QuadVector        normal;
			// at our own point: the remaining error is the rounding of planes over the overlap
			const Real slip = Real(exact.balancedNormal(precise(result.point), normal));
			if (!(slip > 0) || slip > 1e4) continue;
			++compared;
			const Real local = 32 * tolerance::rounding * pair.reach() / -result.infeasibility;
			const Real error = Real(norm(minus(precise(result.normal), normal)));
			EXPECT_LE(error, 1e-13 + slip * local);
			if (local < 1e-13) worst = std::max(worst, error);
		}
	}
	EXPECT_GT(compared, 2000);
	std::printf("%d pairs; overlaps thicker than a thousandth: largest error %.1e\n", compared, double(worst));
}

TEST(DualWeights, AnEdgeOnAFaceHasTheFacesNormal)
{
	for (Real degrees : { 1., 5., 15., 30., 45. })
		for (Real overlap : { 1e-8, 1e-6, 1e-4, 1e-3 }) {
			const Real angle = degrees * Real(M_PI) / 180, half = 0.05;
			const Pair pair = boxes({ 1, 1, 0.1 }, { half, half, half },
			        { 0.2, 0.1, 0.1 + half * (std::sin(angle) + std::cos(angle)) - overlap * half },
			        turnedAbout({ 0, 1, 0 }, angle));
			// the way from the contact to the next plane is half a side's
			EXPECT_LE(lean(query(pair).normal, Vector3::UnitZ()), 1e-14 + std::pow(overlap * half, 2))
			        << degrees << "°, " << overlap;
		}
}

TEST(DualWeights, AVertexOnAFaceHasTheFacesNormalAndCrossedEdgesTheirCrossProduct)
{
	std::mt19937_64 random(7002);
	for (int trial = 0; trial < 200; ++trial) {
		Pair pair   = boxes({ 1, 1, 0.5 }, { 0.1, 0.1, 0.1 }, { 0.3, 0.2, 0 }, randomRotation(random));
		Real lowest = 0;
		for (int k = 0; k < 3; ++k)
			lowest -= Real(0.1) * std::abs(pair.rotation[1](2, k));
		pair.centre2[2] = Real(0.5) - lowest - Real(1e-6);
		EXPECT_LE(lean(query(pair).normal, Vector3::UnitZ()), 1e-9);
	}
	// the upper edges along x and along y, each turned by 45° about itself
	const Matrix3 standing = turnedAbout({ 1, 0, 0 }, Real(M_PI) / 4);
	for (Real angle : { 30., 60., 90. }) {
		Pair pair        = boxes({ 1, 0.1, 0.1 }, { 1, 0.1, 0.1 }, { 0, 0, 2 * Real(0.1) * std::sqrt(Real(2)) - Real(1e-6) },
		               turnedAbout({ 0, 0, 1 }, angle * Real(M_PI) / 180) * standing);
		pair.rotation[0] = standing;
		EXPECT_LE(lean(query(pair).normal, Vector3::UnitZ()), 1e-12);
	}
}

/// In an overlap no thicker than rounding the slacks at its point are rounding, of either sign, and one may be a millionth of another.
TEST(DualWeights, ACornerOnAFaceHasTheFacesNormalWhereSlacksAreAllRounding)
{
	const Real slacks[] = { 1.6e-16, 1e-17, -3e-18, 1e-20, 1e-24, 0 };
	for (Real degrees : { 20., 45., 60. })
		for (Real first : slacks)
			for (Real second : slacks)
				for (Real floor : slacks) {
					const Real angle = degrees * Real(M_PI) / 180, c = std::cos(angle), s = std::sin(angle);
					HalfSpaces corner, ground;
					corner.dimension = ground.dimension = 2;
					corner.normals                      = { { -c, -s, 0 }, { s, -c, 0 }, { c, s, 0 }, { -s, c, 0 } };
					corner.offsets                      = { first, second, 0.5, 0.5 };
					ground.normals                      = { { 0, 1, 0 }, { 1, 0, 0 }, { -1, 0, 0 }, { 0, -1, 0 } };
					ground.offsets                      = { floor, 1, 1, 1 };
					const PlaneRows<Real, 2> rows(corner, ground);
					const Real               x[] = { 0, 0 };
					Real                     n[2];
					const Real               weight = dualWeightsNormal<Real, 2, 1>(rows.planes, x, Real(0.5), n);
					EXPECT_GT(std::hypot(n[0], n[1]), tolerance::direction * weight);
					EXPECT_LE(lean(vectorOf(n, 2).normalized(), -Vector3::UnitY()), 1e-12)
					        << degrees << "°, slacks " << first << ", " << second << ", " << floor;
				}
}

/// A block on a plate that ends `beside` the contact's near side: the plate's side turns the normal by about (δ/2ℓ)³.
TEST(DualWeights, APlaneBesideTheContactTurnsTheNormalByTheThirdPower)
{
	const Real depth = 1e-3;
	for (Real width : { 3e-3, 1e-2, 3e-2, 0.1, 0.3 }) {
		const Pair pair = boxes({ 1, 1, 0.25 }, { 0.25, 0.25, 0.25 }, { 1.25 - width, 0, 0.5 - depth });
		const Real turn = lean(query(pair).normal, Vector3::UnitZ());
		EXPECT_LE(turn, 1e-15 + 1.5 * std::pow(depth / width, 3));
	}
	// as deep as it is wide: half-way between both faces
	const Vector3 corner = query(boxes({ 1, 1, 0.25 }, { 0.25, 0.25, 0.25 }, { 1.25 - depth, 0, 0.5 - depth })).normal;
	EXPECT_LE(lean(corner, Vector3(1, 0, 1).normalized()), 1e-6); // other planes are half a metre away
}

TEST(DualWeights, NoJumpAlongAPathOverFacesEdgesAndVertices)
{
	for (Real overlap : { 2e-3, 1e-2, 0.1 }) {
		Real largest[2] = { 0, 0 };
		for (int finer = 0; finer < 2; ++finer) {
			const int steps = int(40 / overlap) << finer; // the way over an edge is about the overlap's width
			Vector3   last  = Vector3::Zero();
			for (int k = 0; k <= steps; ++k) {
				const Real angle = Real(M_PI) * k / steps;
				Pair pair = boxes({ 0.5, 0.5, 0.5 }, { 0.5, 0.5, 0.5 }, {}, turnedAbout({ 1, 2, 3 }, Real(0.7) * angle));
				moveTo(pair, Vector3(std::cos(angle), std::sin(angle), Real(0.3) * std::sin(3 * angle)), -overlap / 2);
				const ContactResult result = query(pair);
				ASSERT_EQ(result.status, ContactStatus::Contact);
				if (k > 0) largest[finer] = std::max(largest[finer], (result.normal - last).norm());
				last = result.normal;
			}
		}
		// a smooth path: half the step, half the change
		EXPECT_LT(largest[1], Real(0.6) * largest[0]) << overlap;
		std::printf("overlap %.0e: largest change of the normal in a step %.2e, %.2e\n", double(overlap), double(largest[0]),
		        double(largest[1]));
	}
}

TEST(DualWeights, LaneWidthsAgree)
{
	std::mt19937_64 random(7003);
	for (int trial = 0; trial < 100; ++trial) {
		PlaneRows<Real, 3> rows(randomPlanes(4 + trial % 50, random), randomPlanes(9, random));
		const Vector3      x = Real(0.1) * randomDirection(random);
		Real               n[2][3];
		dualWeightsNormal<Real, 3, 1>(rows.planes, x.data(), 1, n[0]);
		const Real weight = dualWeightsNormal<Real, 3, 2>(rows.planes, x.data(), 1, n[1]);
		EXPECT_LE((vectorOf(n[1], 3) - vectorOf(n[0], 3)).norm(), 1e-12 * weight);
	}
}

/// As Ig2 does for a plate beside another one: the side face that the neighbour covers is left out.
TEST(DualWeights, WithoutAnInternalFaceASliverHasTheFloorsNormal)
{
	const Real depth = 1e-4;
	for (Real width : { 1e-7, 1e-5, 1e-4, 1e-3 }) {
		const Pair      pair = boxes({ 1, 1, 0.25 }, { 0.25, 0.25, 0.25 }, { 1.25 - width, 0, 0.5 - depth });
		ContactSettings settings;
		BoundingPlanes  bounding;
		settings.bounding = &bounding;
		settings.section  = true;
		query(pair, settings);
		InternalPlanes internal;
		for (int k = 0; k < bounding.count[0]; ++k) {
			const int plane = bounding.plane[0][k];
			if (pair.shape[0]->normalArray(0)[plane] < 0.5) continue;
			internal.plane[0][internal.count[0]++] = plane;
		}
		ASSERT_EQ(internal.count[0], 1);
		settings.bounding         = nullptr;
		settings.internal         = &internal;
		const ContactResult found = query(pair, settings);
		EXPECT_LE(lean(found.normal, Vector3::UnitZ()), 1e-9) << width;
		EXPECT_NEAR(found.depth, depth, 1e-12);
		EXPECT_NEAR(found.area, width * Real(0.5), 1e-9);
	}
}

// It is left out while the contact on the flush faces is thin beside the body, and no deeper than twice the piece, whatever the size: a body on thin tiles is not held by their sides.
TEST(DualWeights, AnInternalFaceIsLeftOutOfThinContactsOnly)
{
	for (Real size : { 1e-3, 1., 1e3 })
		for (Real part : { 0.02, 0.5, 0.9, 1.9, 2.1 })
			for (bool thick : { false, true }) {
				const Real thin = tolerance::thinContact * size / 4, thickness = thick ? size / 2 : thin / 2,
				           width      = thin / 20;
				const Real      depth = part * (thick ? thin : thickness);
				const Pair      pair  = boxes({ size, size, thickness / 2 }, { size / 4, size / 4, size / 4 },
				              { Real(1.25) * size - width, 0, thickness / 2 + size / 4 - depth });
				InternalPlanes  internal;
				ContactSettings settings;
				for (int i = 0; i < pair.shape[0]->planeCount(); ++i)
					if (pair.shape[0]->normalArray(0)[i] > 0.5) internal.plane[0][internal.count[0]++] = i;
				ASSERT_EQ(internal.count[0], 1);
				settings.internal           = &internal;
				const ContactResult found   = query(pair, settings);
				const Vector3       outward = part < 2 ? Vector3::UnitZ() : Vector3::UnitX();
				EXPECT_LE(lean(found.normal, outward), 0.1)
				        << size << ' ' << part << ' ' << thick << ": " << found.normal.transpose();
			}
}

TEST(InternalPlanes, NoneMeansOfNeitherBody)
{
	InternalPlanes internal;
	EXPECT_TRUE(internal.none());
	internal.count[0] = 1;
	EXPECT_FALSE(internal.none());
	internal.count[1] = 1;
	EXPECT_FALSE(internal.none());
	internal.count[0] = 0;
	EXPECT_FALSE(internal.none());
}

TEST(BoundingPlanes, ThoseOfTheLargestLeverageAreKept)
{
	constexpr int  most = BoundingPlanes::most, all = 3 * most;
	BoundingPlanes kept;
	for (int i = 0; i < all; ++i) { // each number below `all` once, in no order
		const int rank = i * 5 % all;
		keepLargest(1, i, Real(0.5) * rank, rank, kept);
	}
	EXPECT_EQ(kept.count[0], 0);
	ASSERT_EQ(kept.count[1], most);
	std::vector<int> ranks;
	for (int k = 0; k < most; ++k) {
		ranks.push_back(int(kept.leverage[1][k]));
		EXPECT_EQ(kept.plane[1][k] * 5 % all, ranks.back());
		EXPECT_EQ(kept.slack[1][k], Real(0.5) * ranks.back());
	}
	std::sort(ranks.begin(), ranks.end());
	for (int k = 0; k < most; ++k)
		EXPECT_EQ(ranks[std::size_t(k)], all - most + k);
}

TEST(BoundingPlanes, OfManyTheFaceThatTheBodyLiesOnIsAmongThem)
{
	std::mt19937_64 random(7004);
	HalfSpaces      round;
	for (int k = 0; k < 60; ++k) {
		round.normals.push_back(randomDirection(random));
		round.offsets.push_back(1);
	}
	// cut off: a face as wide as the body, at the end of the list
	round.normals.push_back(-Vector3::UnitZ());
	round.offsets.push_back(Real(0.2));
	Pair pair;
	pair.shape[0] = ConvexShape::shared(cuboid(5, 5, 1), Real(0.1));
	pair.shape[1] = ConvexShape::shared(round, Real(0.01));
	pair.centre2  = Vector3(0, 0, Real(1.2) - Real(1e-3));
	ContactSettings settings;
	BoundingPlanes  bounding;
	settings.bounding = &bounding;
	ASSERT_TRUE(query(pair, settings).inContact);
	EXPECT_EQ(bounding.count[1], BoundingPlanes::most);
	int faces = 0;
	for (int k = 0; k < bounding.count[1]; ++k)
		faces += pair.shape[1]->normalArray(2)[bounding.plane[1][k]] == -1;
	EXPECT_EQ(faces, 1);
}

} // namespace
