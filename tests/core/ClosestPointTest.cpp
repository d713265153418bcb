// SPDX-License-Identifier: GPL-2.0-or-later
#include "shape/ClosestPoint.hpp"
#include "PairSamples.hpp"
#include "numbers/NumberText.hpp"

#include <gtest/gtest.h>

#include <random>

using namespace polytope;
using namespace polytope::samples;

namespace {

void expectNearest(const ConvexShape& shape, const Vector3& query, const Vector3& point, const Vector3& outward, Real distance)
{
	const ClosestPoint found = closestPoint(shape, query);
	EXPECT_LT((found.point - point).norm(), 1e-14) << found.point.transpose();
	EXPECT_LT((found.outward - outward).norm(), 1e-14) << found.outward.transpose();
	EXPECT_NEAR(found.distance, distance, 1e-14);
}

} // namespace

// A polygon is a prism here: its caps have no half-space of their own.
TEST(ClosestPoint, OfAPolygonsPrismBeyondItsCaps)
{
	const auto shape = ConvexShape::shared(rectangle(Real(0.5), Real(0.3)), Real(0.05));
	const Real cap   = shape->thickness() / 2;
	for (Real side : { 1, -1 }) {
		const Vector3 out(0, 0, side);
		expectNearest(*shape, Vector3(Real(0.1), Real(-0.2), side * (cap + 1)), Vector3(Real(0.1), Real(-0.2), side * cap), out, 1);
		// beyond an edge of the cap
		const Vector3 edge(Real(0.5), Real(0.1), side * cap), away = Vector3(3, 0, 4 * side) / 5;
		expectNearest(*shape, edge + 2 * away, edge, away, 2);
	}
	expectNearest(*shape, Vector3(Real(0.1), 1, 0), Vector3(Real(0.1), Real(0.3), 0), Vector3(0, 1, 0), Real(0.7));
}

TEST(ClosestPoint, InsideIsThatOfTheNearestFace)
{
	const auto shape = ConvexShape::shared(cuboid(1, 2, 3), Real(0.1));
	expectNearest(*shape, Vector3(Real(0.75), 1, -1), Vector3(1, 1, -1), Vector3(1, 0, 0), Real(-0.25));
	expectNearest(*shape, Vector3(0, Real(-1.5), 1), Vector3(0, -2, 1), Vector3(0, -1, 0), Real(-0.5));
}

namespace {

/// Smallest distance at `count` + 1 places of a segment.
Real sampledDistance(const ConvexShape& shape, const Vector3& start, const Vector3& way, int count)
{
	Real least = std::numeric_limits<Real>::infinity();
	for (int k = 0; k <= count; ++k)
		least = std::min(least, closestPoint(shape, Vector3(start + Real(k) / count * way)).distance);
	return least;
}

} // namespace

/// The segments lie over a face, beside an edge, with an end at a corner, through the body.
TEST(ClosestPoint, OfASegmentIsTheMiddleOfWhereItIsNearest)
{
	const auto shape = ConvexShape::shared(cuboid(1, 2, 3), Real(0.1));
	const auto at    = [&](const Vector3& start, const Vector3& end) { return closestOnSegment(*shape, start, end - start); };
	const auto face  = at({ -5, 0, 4 }, { 3, 0, 4 }); // over the top from x = -1 to 1
	EXPECT_NEAR(face.along, 5. / 8, 1e-12);
	EXPECT_NEAR(face.nearest.distance, 1, 1e-12);
	EXPECT_LT((face.nearest.outward - Vector3(0, 0, 1)).norm(), 1e-12);
	const auto part = at({ 0, 0, 4 }, { 3, 0, 4 });
	EXPECT_NEAR(part.along, 1. / 6, 1e-6);
	const auto edge = at({ 2, -1, 3 }, { 2, 5, 5 }); // beside the edge x = 1, z = 3; nearest at its start
	EXPECT_NEAR(edge.along, 0, 1e-5);
	EXPECT_NEAR(edge.nearest.distance, 1, 1e-6);
	const auto through = at({ 0, 0, -4 }, { Real(0.2), 0, 4 }); // deepest where all of the walls are far
	EXPECT_NEAR(through.nearest.distance, -1 + Real(0.2) * through.along, 1e-9);
	EXPECT_LT(through.nearest.distance, -0.9);
}

TEST(ClosestPoint, OfASegmentIsTheLeastOfItsPlaces)
{
	std::mt19937                           random(3);
	std::uniform_real_distribution<double> number(-6, 6);
	const auto                             shape = ConvexShape::shared(cuboid(1, 2, 3), Real(0.1));
	for (int k = 0; k < 200; ++k) {
		const Vector3 start(number(random), number(random), number(random)), way(number(random), number(random), number(random));
		const auto    found   = closestOnSegment(*shape, start, way);
		const Real    sampled = sampledDistance(*shape, start, way, 2000);
		EXPECT_LE(found.nearest.distance, sampled + 1e-8);
		EXPECT_GE(found.nearest.distance, sampled - way.norm() / 2000);
		EXPECT_EQ(found.nearest.distance, closestPoint(*shape, Vector3(start + found.along * way)).distance);
	}
}

TEST(ClosestPoint, OfTwoSegments)
{
	const auto between = [](const Vector3& start1, const Vector3& end1, const Vector3& start2, const Vector3& end2) {
		return closestOnSegments(start1, end1 - start1, start2, end2 - start2);
	};
	EXPECT_LT((between({ -1, 0, 0 }, { 1, 0, 0 }, { 0.5, -1, 1 }, { 0.5, 3, 1 }) - Vector2(0.75, 0.25)).norm(), 1e-14);
	EXPECT_LT((between({ 0, 0, 0 }, { 1, 0, 0 }, { 3, 1, 0 }, { 4, 1, 0 }) - Vector2(1, 0)).norm(), 1e-14); // in a row
	EXPECT_LT((between({ 0, 0, 0 }, { 4, 0, 0 }, { 5, 1, 0 }, { 2, 1, 0 }) - Vector2(0.75, 2. / 3)).norm(),
	        1e-14); // beside each other from 2 to 4
	EXPECT_LT((between({ 1, 2, 3 }, { 1, 2, 3 }, { 0, 0, 3 }, { 4, 0, 3 }) - Vector2(0, 0.25)).norm(), 1e-14); // points
	EXPECT_LT((between({ 0, 0, 3 }, { 4, 0, 3 }, { 1, 2, 3 }, { 1, 2, 3 }) - Vector2(0.25, 0)).norm(), 1e-14);
	EXPECT_EQ(between({ 1, 2, 3 }, { 1, 2, 3 }, { 0, 0, 0 }, { 0, 0, 0 }), Vector2(0, 0));

	std::mt19937                           random(5);
	std::uniform_real_distribution<double> number(-2, 2);
	const auto                             any = [&] { return Vector3(number(random), number(random), number(random)); };
	for (int k = 0; k < 300; ++k) {
		const Vector3 start1 = any(), way1 = any(), start2 = any(), way2 = k % 3 ? any() : Vector3(number(random) * way1);
		const Vector2 found    = closestOnSegments(start1, way1, start2, way2);
		const auto    distance = [&](Real first, Real second) { return (start1 + first * way1 - start2 - second * way2).norm(); };
		Real          least    = std::numeric_limits<Real>::infinity();
		for (int i = 0; i <= 100; ++i)
			for (int j = 0; j <= 100; ++j)
				least = std::min(least, distance(i / 100., j / 100.));
		EXPECT_TRUE(found.minCoeff() >= 0 && found.maxCoeff() <= 1);
		EXPECT_LE(distance(found[0], found[1]), least + 1e-12);
	}
}

/// The segment's point that is nearest to a wall is an end, or the middle of a segment along the wall.
TEST(ClosestPoint, OfAHalfSpaceIsOnItsPlane)
{
	const auto wall = ConvexShape::halfSpace({ 0, 0, 1 }, 3);
	expectNearest(*wall, { 1, 2, 3 }, { 1, 2, 0 }, { 0, 0, 1 }, 3);
	expectNearest(*wall, { 1, 2, -3 }, { 1, 2, 0 }, { 0, 0, 1 }, -3);
	EXPECT_NEAR(closestOnSegment(*wall, { 0, 0, 1 }, { 4, 0, 1 }).along, 0, 1e-8);
	EXPECT_NEAR(closestOnSegment(*wall, { 0, 0, 1 }, { 4, 0, -2 }).along, 1, 1e-8);
	EXPECT_NEAR(closestOnSegment(*wall, { 0, 0, 1 }, { 4, 0, 0 }).along, 0.5, 1e-12);
}

TEST(NumberText, IsInTheUsualNotation)
{
	EXPECT_EQ(numberText(Real(1e-9)), "1e-9");
	EXPECT_EQ(numberText(Real(2.5e50)), "2.5e50");
	EXPECT_EQ(numberText(Real(1e-120)), "1e-120");
	EXPECT_EQ(numberText(Real(100)), "100");
	EXPECT_EQ(numberText(Real(-0.5)), "-0.5");
}
