// SPDX-License-Identifier: GPL-2.0-or-later
#include "program/SimplexLp.hpp"
#include "ExactLp.hpp"
#include "PlaneRows.hpp"
#include "PrecisePair.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

using namespace polytope;
using namespace polytope::samples;

namespace {

Pair boxes(const Vector3& half1, const Vector3& half2, const Vector3& centre2)
{
	Pair pair;
	pair.shape[0] = ConvexShape::shared(cuboid(half1[0], half1[1], half1[2]), 0);
	pair.shape[1] = ConvexShape::shared(cuboid(half2[0], half2[1], half2[2]), 0);
	pair.centre2  = centre2;
	return pair;
}

const Vector3 unit = Vector3::Ones();

TEST(SimplexLp, FaceOnFaceIsHalfTheOverlap)
{
	for (Real overlap : { 0.5, 1e-3, 1e-9, 1e-12, 0., -1e-12, -1e-3 }) {
		const Pair pair = boxes(unit, unit, Vector3(Real(0.25), Real(-0.125), 2 - overlap));
		EXPECT_NEAR(infeasibility(pair), (pair.centre2.z() - 2) / 2, 1e-16);
	}
}

TEST(SimplexLp, VertexOnFaceIsTheOverlapOverOnePlusRootThree)
{
	for (Real overlap : { 0.2, 1e-3, 1e-9, 1e-12 }) {
		Pair pair        = boxes(unit, unit, Vector3(Real(0.25), Real(-0.125), 1 + std::sqrt(Real(3)) - overlap));
		pair.rotation[1] = Quaternion::FromTwoVectors(unit, -Vector3::UnitZ()).toRotationMatrix();
		EXPECT_NEAR(infeasibility(pair), -overlap / (1 + std::sqrt(Real(3))), 1e-15);
	}
}

TEST(SimplexLp, OneInsideTheOtherIsTheInnerInscribedRadius)
{
	EXPECT_NEAR(infeasibility(boxes(Vector3(10, 10, 10), Vector3(1, 2, 3), Vector3(1, 2, 3))), -1, 1e-15);
	EXPECT_NEAR(infeasibility(boxes(Vector3(1, 2, 3), Vector3(10, 10, 10), Vector3(1, 2, 3))), -1, 1e-15);
}

/// The optimum against the exact rational one, in units of a rounding of the pair.
template <int D> Real roundingsFromExact(const Pair& pair)
{
	const Rational exact = ExactLp<D>(pair).infeasibility;
	return std::abs(Real(Rational(Rational(infeasibility(pair)) - exact))) / (tolerance::rounding * pair.reach());
}

TEST(SimplexLp, RandomPairsAgreeWithTheExactOptimum)
{
	std::mt19937_64 random(300);
	const Shapes    solid = randomShapes(60, random), flat = randomShapes(40, random, 2);
	for (int trial = 0; trial < 400; ++trial) {
		EXPECT_LE(roundingsFromExact<3>(randomPair(solid, random)), 4) << trial;
		EXPECT_LE(roundingsFromExact<2>(randomPair(flat, random)), 4) << trial;
	}
}

TEST(SimplexLp, DegeneratePairsAgreeWithTheExactOptimum)
{
	std::mt19937_64 random(301);
	const auto      eighths  = [&] { return Real(int(random() % 33) - 16) / 8; };
	int             touching = 0, overlapping = 0;
	for (int trial = 0; trial < 400; ++trial) {
		// aligned boxes on a grid: parallel faces, common planes, common edges and vertices, touching exactly
		Pair pair = boxes(Vector3(1, Real(0.5), 2), Vector3(1, 1, Real(0.25)), Vector3(eighths(), eighths(), eighths()));
		if (trial % 2) {
			// each plane again, once as it is and once looser
			HalfSpaces set = pair.shape[0]->planes();
			for (int i = 0; i < 6; ++i) {
				set.normals.insert(set.normals.end(), { set.normals[i], set.normals[i] });
				set.offsets.insert(set.offsets.end(), { set.offsets[i], set.offsets[i] + 1 });
			}
			pair.shape[0] = ConvexShape::shared(set, 0);
		}
		if (trial % 3 == 0) pair = turned(pair, randomRotation(random));
		EXPECT_LE(roundingsFromExact<3>(pair), 4) << trial;
		const Real s = infeasibility(pair);
		overlapping += s < -1e-14;
		touching += std::abs(s) <= 1e-14;
	}
	EXPECT_GT(overlapping, 100);
	EXPECT_GT(touching, 20);
}

TEST(SimplexLp, NearlyParallelPlanesAgreeWithTheExactOptimum)
{
	std::mt19937_64 random(302);
	for (int trial = 0; trial < 600; ++trial) {
		EXPECT_LE(roundingsFromExact<3>(nearlyParallelPair(random)), 8) << trial;
		EXPECT_LE(roundingsFromExact<2>(nearlyParallelPair(random, 2)), 8) << trial;
	}
}

/// Primal and dual feasibility and no gap between the two, in precise arithmetic. A weight has no sign below its noise, which
/// is large where the basis has nearly parallel planes.
void expectOptimal(const Pair& pair, Real noise)
{
	const ContactResult result = linearProgram(pair);
	const PrecisePair   exact(pair);
	const QuadVector    x        = precise(result.point);
	const Real          rounding = tolerance::rounding * pair.reach();
	const Real          primal   = Real(exact.violation(x));
	Quad                sum = 0, dual = 0;
	QuadVector          normal {};
	Vector3             first = Vector3::Zero();
	for (int k = 0; k <= pair.dimension(); ++k) {
		const int  body   = result.basis[k] & 1;
		const auto plane  = exact.planes[body][result.basis[k] >> 1];
		const Real weight = result.weights[k];
		EXPECT_GE(weight, -noise);
		sum += weight;
		normal = along(normal, weight, plane.normal);
		dual -= weight * plane.slack(x);
		if (body == 0) first += weight * rounded(plane.normal);
		// complementary slackness
		EXPECT_NEAR(weight * Real(plane.slack(x) + result.infeasibility), 0, 16 * rounding);
	}
	EXPECT_NEAR(Real(sum), 1, 1e-14);
	EXPECT_NEAR(Real(norm(normal)), 0, 1e-14);
	EXPECT_NEAR(result.infeasibility, primal, 16 * rounding);
	EXPECT_NEAR(result.infeasibility, Real(dual), 16 * rounding);
	EXPECT_NEAR((result.dualDirection - first).norm(), 0, 1e-14);
}

TEST(SimplexLp, OptimalityConditionsHold)
{
	std::mt19937_64 random(303);
	const Shapes    solid = randomShapes(150, random), flat = randomShapes(60, random, 2);
	for (int trial = 0; trial < 15000 && !testing::Test::HasFailure(); ++trial)
		expectOptimal(randomPair(solid, random), 1e-12);
	for (int trial = 0; trial < 5000 && !testing::Test::HasFailure(); ++trial)
		expectOptimal(randomPair(flat, random), 1e-12);
	for (int trial = 0; trial < 2000 && !testing::Test::HasFailure(); ++trial)
		expectOptimal(nearlyParallelPair(random), tolerance::noise * tolerance::singularBasis);
}

TEST(SimplexLp, MovedApartAlongTheDualDirectionThePairIsFree)
{
	std::mt19937_64 random(304);
	const Shapes    shapes = randomShapes(100, random);
	int             moved  = 0;
	for (int trial = 0; trial < 4000; ++trial) {
		const Pair          pair   = randomPair(shapes, random);
		const ContactResult result = query(pair);
		const Real          length = result.dualDirection.norm();
		if (!result.inContact || length < 1e-3) continue; // one inside the other: no short motion separates them
		++moved;
		const Real apart = -result.infeasibility / length;
		EXPECT_GE(infeasibility(movedApart(pair, apart * result.dualDirection / length)), -16 * tolerance::rounding * pair.reach());
	}
	EXPECT_GT(moved, 2500);
	EXPECT_LT(moved, 3500);
}

TEST(SimplexLp, EveryBasisBoundsTheOptimumFromBelow)
{
	std::mt19937_64 random(305);
	for (int trial = 0; trial < 500; ++trial) {
		const Pair                pair = regularPair(6, 12, Real(0.1), random);
		PlaneRows<long double, 3> rows(worldPlanes(pair, 0), worldPlanes(pair, 1));
		LpBasis<long double, 3>   basis;
		for (int k = 0; k < 4; ++k)
			basis.plane[k] = rows.row(0, pair.shape[0]->inscribedBasis()[k]);
		ASSERT_TRUE((solveBasis<long double, 3, 1>(rows.planes, basis)));
		long double last = basis.infeasibility;
		for (int pivots = 0, count = 0;; ++count) {
			// one pivot at a time
			const LpStatus status = solveLp<long double, 3, 1>(rows.planes, basis, 1, 1e9L, 4, count + 1, pivots);
			EXPECT_GE(basis.infeasibility, last - 1e-15L);
			last = basis.infeasibility;
			if (status == LpStatus::Optimal) break;
			ASSERT_LT(count, 40);
		}
		EXPECT_NEAR(double(last), infeasibility(pair), 1e-14);
	}
}

TEST(SimplexLp, SeparatedIsSaidAsSoonAsABoundSaysSo)
{
	PlaneRows<Real, 3> rows(cuboid(1, 1, 1), moved(cuboid(1, 1, 1), Matrix3::Identity(), Vector3(0, 0, 4)));
	LpBasis<Real, 3>   basis;
	const int          start[] = { rows.row(0, 4), rows.row(1, 5), rows.row(0, 0), rows.row(0, 2) }; // +z of 1, −z of 2
	std::copy(start, start + 4, basis.plane);
	ASSERT_TRUE((solveBasis<Real, 3, 4>(rows.planes, basis)));
	EXPECT_EQ(basis.infeasibility, 1);
	int pivots = 0;
	EXPECT_EQ((solveLp<Real, 3, 2>(rows.planes, basis, 1, 0, 10, 100, pivots)), LpStatus::Separated);
	EXPECT_EQ(pivots, 0);
	EXPECT_EQ((solveLp<Real, 3, 2>(rows.planes, basis, 1, 2, 10, 100, pivots)), LpStatus::Optimal);
}

TEST(SimplexLp, SingularBasesAreRefused)
{
	PlaneRows<Real, 3> rows(cuboid(1, 1, 1), cuboid(1, 1, 1));
	LpBasis<Real, 3>   basis;
	const int          belt[] = { rows.row(0, 0), rows.row(0, 1), rows.row(0, 2), rows.row(0, 3) }; // ±x, ±y
	std::copy(belt, belt + 4, basis.plane);
	EXPECT_FALSE((solveBasis<Real, 3, 4>(rows.planes, basis)));
	basis.plane[3] = rows.row(1, 0); // +x twice
	EXPECT_FALSE((solveBasis<Real, 3, 4>(rows.planes, basis)));
}

// A strip between two parallel planes, closed by planes that are nearly parallel to them: turned by a body's rotation, a
// weight of the inscribed circle's basis became −2e-12, the start was refused and the pair reported as failed.
TEST(SimplexLp, StartFromAStripWithANearlyParallelPlane)
{
	HalfSpaces strip;
	strip.dimension = 2;
	strip.normals   = { { -3.0881349026828529e-06, 0.99999999999523159, 0 }, { -6.5131567560953825e-05, -0.99999999787893945, 0 },
		  { 3.0881349026828529e-06, -0.99999999999523159, 0 }, { 1, 0, 0 }, { -1, 0, 0 } };
	strip.offsets   = { 1.42602e-06, 6.54896e-06, 1.42602e-06, 0.1, 0.1 };
	Pair pair;
	pair.shape[0] = ConvexShape::shared(strip, 0);
	pair.shape[1] = ConvexShape::shared(rectangle(Real(0.025), Real(0.025)), 0);
	for (int degree = 0; degree < 360; ++degree) {
		for (Matrix3& rotation : pair.rotation)
			rotation = Eigen::AngleAxis<Real>(degree * Real(M_PI) / 180, Vector3::UnitZ()).toRotationMatrix();
		pair.centre2 = pair.rotation[0] * Vector3(0, Real(0.0249), 0);
		EXPECT_TRUE(query(pair).inContact) << degree;
		EXPECT_TRUE(query(swapped(pair)).inContact) << degree;
	}
}

// Nearly parallel planes of a pair between whose bases the simplex in double cycled (lpNotConverged),
// 0.4 of the size from the optimum.
TEST(SimplexLp, NearlyParallelPlanesThatCycled)
{
	std::mt19937_64 random(801);
	for (int trial = 0; trial < 1500; ++trial)
		nearlyParallelPair(random, 2);
	for (int trial = 0; trial < 225; ++trial)
		nearlyParallelPair(random, 3);
	const Pair pair = nearlyParallelPair(random, 3);
	EXPECT_EQ(query(pair).status, ContactStatus::Contact);
	EXPECT_LE(roundingsFromExact<3>(pair), 4);
}

/// solveWide() alone against the exact optimum, from nothing.
TEST(SimplexLp, WithTwiceTheDigits)
{
	std::mt19937_64 random(306);
	const Shapes    shapes = randomShapes(30, random);
	for (int trial = 0; trial < 150; ++trial) {
		const Pair         pair = trial % 2 ? nearlyParallelPair(random) : randomPair(shapes, random);
		PlaneRows<Real, 3> rows(worldPlanes(pair, 0), worldPlanes(pair, 1));
		LpBasis<Real, 3>   basis;
		int                pivots = 0;
		ASSERT_TRUE((solveWide<Real, 3>(rows.planes, basis, pair.size(), 1000, pivots))) << trial;
		const Real off = std::abs(Real(Rational(Rational(basis.infeasibility) - ExactLp<3>(pair).infeasibility)));
		EXPECT_LE(off, 4 * tolerance::rounding * pair.reach()) << trial;
		for (int k = 0; k <= 3; ++k) {
			EXPECT_LT(basis.plane[k], rows.planes.total);
			EXPECT_GE(basis.weight[k], -tolerance::rounding * tolerance::rounding); // zero with twice the digits
		}
	}
}

/// D + 1 planes that touch a ball of radius 1e-3 about y, |y| = 1, their normals in a plane (on a line) but for some 0.03: the
/// longest rows of the inverse are 30 to 64, too short to be refined beforehand. s* against twice the digits.
template <int D> void valueWhereWeightsAreNoisy(unsigned seed)
{
	std::mt19937_64 random(seed);
	int             noisy = 0, solved = 0;
	Real            worst = 0;
	for (int trial = 0; trial < 4000; ++trial) {
		const Vector3 y = randomDirection(random, D), axis = randomDirection(random, D);
		Vector3       normals[D + 1], sum                  = Vector3::Zero();
		for (int k = 0; k < D; ++k) {
			normals[k] = randomDirection(random, D);
			normals[k] -= (normals[k].dot(axis) - Real(0.03) * uniform(random, -1, 1)) * axis;
			normals[k].normalize();
			sum += uniform(random, Real(0.2), 1) * normals[k];
		}
		normals[D] = -sum.normalized();
		HalfSpaces one, other;
		one.dimension = other.dimension = D;
		for (int k = 0; k <= D; ++k) {
			HalfSpaces& set = k < 2 ? one : other;
			set.normals.push_back(normals[(k + trial) % (D + 1)]);
			set.offsets.push_back(set.normals.back().dot(y) + Real(1e-3));
		}
		PlaneRows<Real, D> rows(one, other);
		LpBasis<Real, D>   basis, precise;
		for (int k = 0; k <= D; ++k)
			basis.plane[k] = rows.row(k / 2, k % 2);
		if (!solveBasis<Real, D, 4>(rows.planes, basis)) continue;
		const Real noise = *std::max_element(basis.noise, basis.noise + D + 1);
		if (!(noise > 30 * tolerance::rounding && noise < tolerance::refinedBasis)) continue;
		++noisy;
		int pivots = 0;
		if (solveLp<Real, D, 2>(rows.planes, basis, 1, padOffset, 2, 100, pivots) != LpStatus::Optimal) continue;
		++solved;
		ASSERT_TRUE((solveWide<Real, D>(rows.planes, precise, 1, 100, pivots)));
		worst = std::max(worst, std::abs(basis.infeasibility - precise.infeasibility) / (2 * tolerance::rounding));
	}
	EXPECT_LE(worst, tolerance::certain / tolerance::rounding);
	EXPECT_GT(noisy, 100);
	EXPECT_GT(solved, noisy * 9 / 10); // without the wider arithmetic
	std::cout << D << "-D: " << noisy << " noisy bases, " << solved << " solved, s* to " << worst << " roundings\n";
}

TEST(SimplexLp, ValueIsRightWhereWeightsAreNoisy)
{
	valueWhereWeightsAreNoisy<3>(307);
	valueWhereWeightsAreNoisy<2>(308);
}

} // namespace
