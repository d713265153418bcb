// SPDX-License-Identifier: GPL-2.0-or-later
//
// Distance and nearest points of two bodies.
#include "contact/PairDistance.hpp"

#include "SameAnswer.hpp"

#include <gtest/gtest.h>

using namespace polytope;
using namespace polytope::samples;

namespace {

PairDistance distanceOf(const Pair& pair) { return pairDistance(pair.placed()); }

Vector3 vertexOf(const Pair& pair, int body, const Vector3& own)
{
	Vector3 place = pair.rotation[body] * own + (body ? pair.centre2 : Vector3(Vector3::Zero()));
	if (pair.shape[0]->dimension() == 2) place[2] = 0;
	return place;
}

/// The points belong to the bodies, and the planes through them, normal to their connection, have one body on each side: then no others are nearer.
void expectNearest(const Pair& pair, const PairDistance& found)
{
	const Real rounding = 64 * tolerance::rounding * pair.reach();
	ASSERT_NEAR((found.point[1] - found.point[0] - found.distance * found.normal).norm(), 0, rounding);
	ASSERT_NEAR(found.normal.norm(), 1, 64 * tolerance::rounding);
	for (int body = 0; body < 2; ++body) {
		const HalfSpaces& planes = pair.shape[body]->planes();
		const Vector3     from   = found.point[body] - (body ? pair.centre2 : Vector3(Vector3::Zero()));
		for (std::size_t k = 0; k < planes.size(); ++k)
			ASSERT_LE((pair.rotation[body] * planes.normals[k]).dot(from) - planes.offsets[k], rounding);
		// the direction is as exact as rounding of the places is small beside the distance
		for (const Vector3& vertex : pair.shape[body]->polyhedron().vertices)
			ASSERT_LE((body ? -1 : 1) * found.normal.dot(vertexOf(pair, body, vertex) - found.point[body]),
			        rounding * (1 + pair.reach() / (16 * found.distance)));
	}
}

class Distances : public testing::TestWithParam<int> { };

TEST_P(Distances, AreThoseOfTheNearestPoints)
{
	const int       dimension = GetParam();
	std::mt19937_64 random(700 + dimension);
	const Shapes    shapes = randomShapes(60, random, dimension);
	int             apart = 0, touching = 0;
	for (int trial = 0; trial < 6000 && !testing::Test::HasFailure(); ++trial) {
		SCOPED_TRACE(trial);
		const Pair          pair    = randomPair(shapes, random);
		const PairDistance  found   = distanceOf(pair);
		const ContactResult contact = query(pair);
		if (found.distance > 0) {
			expectNearest(pair, found);
			EXPECT_FALSE(contact.inContact && -contact.infeasibility > 64 * tolerance::rounding * pair.reach());
		} else EXPECT_LT(contact.infeasibility, 64 * tolerance::rounding * pair.reach());
		++(found.distance > 0 ? apart : touching);
	}
	EXPECT_GT(apart, 1000);
	EXPECT_GT(touching, 1000);
}

TEST_P(Distances, OfBodiesThatOverlapByLittleAreZero)
{
	const int       dimension = GetParam();
	std::mt19937_64 random(83 + dimension);
	const Shapes    shapes = randomShapes(60, random, dimension);
	int             thin   = 0;
	for (int trial = 0; trial < 6000; ++trial) {
		SCOPED_TRACE(trial);
		Pair                pair  = randomPair(shapes, random);
		const ContactResult deep  = linearProgram(pair);
		const Vector3&      way   = deep.dualDirection;
		const Real          least = decades(random, -12, -7) * pair.size();
		if (!(deep.infeasibility < -least && way.norm() > 1e-3)) continue;
		pair.centre2 += (-deep.infeasibility - least) / way.squaredNorm() * way;
		const Real depth = -linearProgram(pair).infeasibility;
		if (!(depth > 64 * tolerance::rounding * pair.reach() && depth < 2 * least)) continue;
		++thin;
		EXPECT_EQ(distanceOf(pair).distance, 0);
	}
	EXPECT_GT(thin, 1000);
}

TEST(DistanceOfPoints, IsThatOfTheirHulls)
{
	std::mt19937_64 random(31);
	const Shapes    shapes = randomShapes(30, random, 3);
	int             apart  = 0;
	for (int trial = 0; trial < 2000 && !testing::Test::HasFailure(); ++trial) {
		const Pair           pair = randomPair(shapes, random);
		std::vector<Vector3> points[2];
		for (int body = 0; body < 2; ++body)
			for (const Vector3& vertex : pair.shape[body]->polyhedron().vertices)
				points[body].push_back(vertexOf(pair, body, vertex));
		const PairDistance known = distanceOf(pair), found = pairDistance(points[0], points[1]);
		EXPECT_NEAR(found.distance, known.distance, 64 * tolerance::rounding * pair.reach());
		apart += known.distance > 0;
	}
	EXPECT_GT(apart, 300);
}

TEST(DistanceOfPoints, OfATriangleAndASegment)
{
	const PairDistance found
	        = pairDistance({ Vector3(0, 0, 0), Vector3(1, 0, 0), Vector3(0, 1, 0) }, { Vector3(2, 2, 0.5), Vector3(0.2, 0.2, 0.25) });
	EXPECT_NEAR(found.distance, 0.25, 1e-15);
	EXPECT_NEAR((found.normal - Vector3(0, 0, 1)).norm(), 0, 1e-14);
	EXPECT_NEAR((found.point[0] - Vector3(0.2, 0.2, 0)).norm(), 0, 1e-14);
}

INSTANTIATE_TEST_SUITE_P(Dimensions, Distances, testing::Values(2, 3), [](const auto& info) { return std::to_string(info.param) + "D"; });

std::shared_ptr<const ConvexShape> cube()
{
	HalfSpaces planes;
	for (int k = 0; k < 3; ++k)
		for (int sign : { -1, 1 }) {
			planes.normals.push_back(sign * Vector3::Unit(k));
			planes.offsets.push_back(1);
		}
	return ConvexShape::shared(planes, 0);
}

TEST(PairDistance, OfCubes)
{
	const Matrix3 one      = Matrix3::Identity();
	const auto    shape    = cube();
	const Real    places[] = { 2.5, 3 }; // faces, edges, corners
	for (int axes = 1; axes <= 3; ++axes)
		for (const Real place : places) {
			Vector3 centre = Vector3::Zero();
			for (int k = 0; k < axes; ++k)
				centre[k] = place;
			const PairDistance found = pairDistance({ *shape, one, *shape, one, centre });
			EXPECT_NEAR(found.distance, (place - 2) * sqrt(Real(axes)), 32 * tolerance::rounding);
			EXPECT_NEAR((found.normal - centre.normalized()).norm(), 0, 32 * tolerance::rounding);
		}
	EXPECT_EQ(pairDistance({ *shape, one, *shape, one, Vector3(1.5, 0, 0) }).distance, 0); // overlap
	EXPECT_EQ(pairDistance({ *shape, one, *shape, one, Vector3(2, 0, 0) }).distance, 0);   // touch
}

TEST(PairDistance, FromAHalfSpace)
{
	const auto         wall = ConvexShape::halfSpace(Vector3(0, 0, 1), 3), shape = cube();
	const Matrix3      one   = Matrix3::Identity();
	const PairDistance above = pairDistance({ *wall, one, *shape, one, Vector3(5, 6, 1.25) }),
	                   below = pairDistance({ *shape, one, *wall, one, Vector3(0, 0, -1.25) });
	EXPECT_NEAR(above.distance, 0.25, 8 * tolerance::rounding);
	EXPECT_NEAR(below.distance, 0.25, 8 * tolerance::rounding);
	EXPECT_EQ(above.normal, Vector3(0, 0, 1));
	EXPECT_EQ(below.normal, Vector3(0, 0, -1));
	EXPECT_NEAR(above.point[0][2], 0, 8 * tolerance::rounding);
	EXPECT_NEAR(below.point[1][2], -1.25, 8 * tolerance::rounding);
	EXPECT_EQ(pairDistance({ *wall, one, *shape, one, Vector3(0, 0, 0.9) }).distance, 0);
}

TEST(ConvexShape, SupportIsTheFarthestVertex) { EXPECT_EQ(cube()->support(Vector3(1, -2, 3)), Vector3(1, -1, 1)); }

} // namespace

TEST(PairDistance, OfAnEmptySetIsZero)
{
	const std::vector<Vector3> none, one { Vector3(1, 2, 3) };
	EXPECT_EQ(pairDistance(none, one).distance, 0);
	EXPECT_EQ(pairDistance(one, none).distance, 0);
	EXPECT_EQ(pairDistance(one, one).distance, 0);
}
