// SPDX-License-Identifier: GPL-2.0-or-later
//
// The kinds of tests/reference/reference_cases.json taken further: thinner overlaps, smaller tilts, flatter plates, more
// copies of planes, other sizes. Bodies as in the file: world axes, each about its own centre. The answers come from
// ExactLp.hpp and PrecisePair.hpp; the kernel must reach what the file states as attainable in double.
#include "ExactLp.hpp"
#include "PrecisePair.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace polytope;
using namespace polytope::samples;

namespace {

HalfSpaces tilted(const HalfSpaces& set, const Vector3& turn)
{
	const Matrix3 rotation = Eigen::AngleAxis<Real>(turn.norm(), turn.normalized()).toRotationMatrix();
	return moved(set, rotation, Vector3::Zero());
}

Pair pairOf(const HalfSpaces& one, const HalfSpaces& two, const Vector3& centre2, Real cornerRadius)
{
	Pair pair;
	pair.shape[0] = ConvexShape::shared(one, cornerRadius);
	pair.shape[1] = ConvexShape::shared(two, cornerRadius);
	pair.centre2  = centre2;
	return pair;
}

void expectAttainableAsGiven(const Pair& pair)
{
	const ContactResult result = query(pair);
	const Real          size   = pair.size();
	const Real          s      = Real(ExactLp<3>(pair).infeasibility);
	EXPECT_NEAR(result.infeasibility, s, 1e-13 * size);
	ASSERT_EQ(result.inContact, s < -tolerance::contact * size) << statusName(result.status) << ' ' << s;
	if (!result.inContact) return;
	const PrecisePair exact(pair);
	QuadVector        centre = precise(result.point), normal;
	ASSERT_TRUE(exact.analyticCentre(centre));
	ASSERT_TRUE(result.status == ContactStatus::Contact || result.status == ContactStatus::RoundingLimited)
	        << statusName(result.status) << ' ' << s;
	// one rounding of the planes, by the body's size, and one of the point itself, by its distance from body 1's centre
	const Real loosened = 1e-9 + 1e-16 * (size + result.point.norm()) / -s;
	const Real moved    = Real(exact.localLength(centre, minus(precise(result.point), centre)));
	EXPECT_LE(moved, 2 * loosened) << s;
	ASSERT_TRUE(exact.normal(centre, normal));
	const Real slip = Real(exact.normalSlip(0, centre, 2 * loosened) + exact.normalSlip(1, centre, 2 * loosened));
	EXPECT_LE(Real(norm(minus(precise(result.normal), normal))), 1e-14 + slip);
	EXPECT_NEAR(result.depth, Real(exact.depth(centre, normal)), 1e-13 * size);
}

void expectAttainable(const Pair& given)
{
	for (const Pair& pair : { given, swapped(given) })
		expectAttainableAsGiven(pair);
}

const HalfSpaces cube = cuboid(0.5, 0.5, 0.5);

TEST(HarderCases, ThinnerFaceOnFace)
{
	for (int exponent = 3; exponent <= 45; ++exponent) {
		const Real overlap = std::ldexp(Real(1), -exponent);
		expectAttainable(pairOf(cube, cube, Vector3(0.25, -0.125, 1 - overlap), 0.125));
		expectAttainable(pairOf(cube, cube, Vector3(0, 0, 1 - overlap), 0.125));
	}
}

TEST(HarderCases, WiderGaps)
{
	for (int exponent = 1; exponent <= 50; ++exponent) {
		const Real gap = std::ldexp(Real(1), -exponent);
		expectAttainable(pairOf(cube, cube, Vector3(0.25, -0.125, 1 + gap), 0.125));
		expectAttainable(pairOf(cube, cube, Vector3(1 + gap, 1, 1), 0.125));
	}
}

TEST(HarderCases, SmallerTilts)
{
	std::mt19937_64 random(700);
	for (int digits = 2; digits <= 14; ++digits)
		for (int exponent : { 10, 24, 33, 38 })
			for (int trial = 0; trial < 3; ++trial) {
				const Vector3 turn = std::pow(Real(10), Real(-digits)) * randomDirection(random);
				expectAttainable(
				        pairOf(cube, tilted(cube, turn), Vector3(0.25, -0.125, 1 - std::ldexp(Real(1), -exponent)), 0.125));
			}
}

TEST(HarderCases, FlatterPlates)
{
	std::mt19937_64 random(701);
	for (int digits = 2; digits <= 7; ++digits)
		for (int trial = 0; trial < 6; ++trial) {
			const Real    half = std::pow(Real(10), Real(-digits)) / 2;
			const Vector3 turn = half * decades(random, -4, -1) * randomDirection(random); // no corner goes through
			const Vector3 above(Real(0.3), Real(-0.2), Real(0.5) + half - half * decades(random, -3, -1));
			expectAttainable(pairOf(cuboid(1, 1, half), tilted(cube, turn), above, 0.8 * half));
			// and as wide as in the file, 1000 × 1000
			expectAttainable(pairOf(cuboid(500, 500, half), tilted(cube, turn), above, 0.8 * half));
		}
}

TEST(HarderCases, VerticesAndEdgesOfAnySharpness)
{
	std::mt19937_64 random(702);
	for (int trial = 0; trial < 200; ++trial) {
		// a vertex, an edge or another shape of the second body into a face of the first, by 1e-1 … 1e-12
		const HalfSpaces solid = regularSolid(trial % 2 ? 4 : 8, 1);
		const Matrix3    turn  = randomRotation(random);
		Pair             pair
		        = pairOf(cuboid(1, 1, 1), tilted(moved(solid, turn, Vector3::Zero()), Vector3(0, 0, 1e-3)), Vector3::UnitZ(), 0.3);
		moveTo(pair, Vector3(Real(0.2), Real(0.1), 1).normalized(), -decades(random, -12, -1));
		expectAttainable(pair);
	}
}

TEST(HarderCases, MoreCopiesOfPlanes)
{
	for (int copies : { 2, 3, 10, 50 }) {
		HalfSpaces set = cube;
		for (int i = 1; i < copies; ++i) {
			set.normals.push_back(Vector3(0, 0, 1));
			set.offsets.push_back(0.5);
		}
		// redundant ones that touch, and that do not
		for (const Vector3& normal : { Vector3(1, 1, 0), Vector3(0, 1, 1), Vector3(1, 1, 1) }) {
			set.normals.push_back(normal.normalized());
			set.offsets.push_back(normal.dot(Vector3(0.5, 0.5, 0.5)) / normal.norm() * (copies % 2 ? 1 : Real(1.25)));
		}
		for (Real overlap : { 0x1p-5, 0x1p-20, 0x1p-38 })
			expectAttainable(pairOf(set, cube, Vector3(0.25, 0.125, 1 - overlap), 0.125));
	}
}

TEST(HarderCases, DeeperOverlaps)
{
	std::mt19937_64 random(703);
	for (int trial = 0; trial < 60; ++trial) {
		const HalfSpaces one = regularSolid(12, 1), two = moved(regularSolid(8, 1), randomRotation(random), Vector3::Zero());
		expectAttainable(pairOf(one, two, uniform(random, Real(0.05), Real(0.9)) * randomDirection(random), 0.95));
	}
}

TEST(HarderCases, OtherSizes)
{
	std::mt19937_64 random(704);
	for (int digits = -9; digits <= 4; ++digits) {
		const Real size = std::pow(Real(10), Real(digits));
		for (Real overlap : { 1e-3, 1e-8, 1e-11 }) {
			Pair pair = pairOf(cube, tilted(cube, 1e-6 * randomDirection(random)), Vector3(0.25, -0.125, 1 - overlap), 0.125);
			expectAttainable(scaled(pair, size));
		}
	}
	// a grain of a thousandth on a block
	for (Real overlap : { 1e-2, 1e-5, 1e-8 }) {
		const HalfSpaces grain = moved(scaled(ConvexShape(cube, 0), 1e-3)->planes(), randomRotation(random), Vector3::Zero());
		Pair             pair  = pairOf(cube, grain, Vector3::UnitZ(), 1e-4);
		moveTo(pair, Vector3(Real(0.3), Real(-0.1), 1).normalized(), -overlap * 1e-3);
		expectAttainable(pair);
	}
}

} // namespace
