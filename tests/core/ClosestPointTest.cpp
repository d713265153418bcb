// SPDX-License-Identifier: GPL-2.0-or-later
#include "shape/ClosestPoint.hpp"
#include "PairSamples.hpp"
#include "numbers/NumberText.hpp"

#include <gtest/gtest.h>

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

TEST(NumberText, IsInTheUsualNotation)
{
	EXPECT_EQ(numberText(Real(1e-9)), "1e-9");
	EXPECT_EQ(numberText(Real(2.5e50)), "2.5e50");
	EXPECT_EQ(numberText(Real(1e-120)), "1e-120");
	EXPECT_EQ(numberText(Real(100)), "100");
	EXPECT_EQ(numberText(Real(-0.5)), "-0.5");
}
