// SPDX-License-Identifier: GPL-2.0-or-later
#include "bond/TensionFibres.hpp"

#include <gtest/gtest.h>

using namespace polytope;

namespace {

/// An irregular pentagon about its centroid.
std::vector<Vector3> pentagon()
{
	std::vector<Vector3> corners { { 0, -1, -1 }, { 0, 2, -1.5 }, { 0, 2.5, 1 }, { 0, 0.5, 2 }, { 0, -1.5, 0.5 } };
	Vector3              centroid = Vector3::Zero();
	Real                 area     = 0;
	for (std::size_t k = 0; k < corners.size(); ++k) {
		const Vector3 &a = corners[k], &b = corners[(k + 1) % corners.size()];
		const Real     twice = a[1] * b[2] - a[2] * b[1];
		area += twice / 2;
		centroid += twice / 6 * (a + b);
	}
	for (Vector3& corner : corners)
		corner -= centroid / area;
	return corners;
}

/// Area, and ∫ y² dA, ∫ z² dA, ∫ y z dA by Green's theorem.
std::array<Real, 4> moments(const std::vector<Vector3>& corners)
{
	std::array<Real, 4> sum { { 0, 0, 0, 0 } };
	for (std::size_t k = 0; k < corners.size(); ++k) {
		const Vector3 &a = corners[k], &b = corners[(k + 1) % corners.size()];
		const Real     twice = a[1] * b[2] - a[2] * b[1];
		sum[0] += twice / 2;
		sum[1] += twice / 12 * (a[1] * a[1] + a[1] * b[1] + b[1] * b[1]);
		sum[2] += twice / 12 * (a[2] * a[2] + a[2] * b[2] + b[2] * b[2]);
		sum[3] += twice / 24 * (2 * a[1] * a[2] + a[1] * b[2] + b[1] * a[2] + 2 * b[1] * b[2]);
	}
	return sum;
}

} // namespace

TEST(TensionFibres, AreaAndSecondMomentsAreThoseOfThePolygon)
{
	const auto          corners  = pentagon();
	const auto          expected = moments(corners);
	std::array<Real, 4> sum { { 0, 0, 0, 0 } };
	std::size_t         count = 0;
	forFibres(corners, [&](const Vector3& place, Real area, std::size_t index) {
		EXPECT_EQ(index, count++);
		EXPECT_EQ(place[0], 0);
		sum[0] += area;
		sum[1] += area * place[1] * place[1];
		sum[2] += area * place[2] * place[2];
		sum[3] += area * place[1] * place[2];
	});
	EXPECT_EQ(count, fibreCount(corners.size()));
	for (std::size_t k = 0; k < 4; ++k)
		EXPECT_NEAR(double(sum[k]), double(expected[k]), 1e-12);
}

TEST(TensionFibres, BelowTheStrengthTheyAreTheSpringsOfTheArea)
{
	const auto        corners = pentagon();
	const auto        m       = moments(corners);
	std::vector<Real> lasting(fibreCount(corners.size()), 0);
	const Real        d = 1e-3, t1 = 2e-4, t2 = -3e-4, k = 1e6;
	const FibreSum    sum = fibreForces(corners, d, t1, t2, k, 1e9, lasting);
	EXPECT_NEAR(double(sum.force), double(k * m[0] * d), 1e-8);
	EXPECT_NEAR(double(sum.moment1), double(k * (m[2] * t1 - m[3] * t2)), 1e-8);
	EXPECT_NEAR(double(sum.moment2), double(k * (m[1] * t2 - m[3] * t1)), 1e-8);
	EXPECT_NEAR(double(sum.energy), double((sum.force * d + sum.moment1 * t1 + sum.moment2 * t2) / 2), 1e-12);
	EXPECT_EQ(sum.work, 0);
	for (const Real p : lasting)
		EXPECT_EQ(p, 0);
}

TEST(TensionFibres, TornOpenTheyBearTheStrengthAndNothingUntilTheyTouchAgain)
{
	const auto        corners = pentagon();
	const Real        area = moments(corners)[0], k = 1e6, strength = 1e3;
	std::vector<Real> lasting(fibreCount(corners.size()), 0);
	const FibreSum    open = fibreForces(corners, 5e-3, 0, 0, k, strength, lasting);
	EXPECT_NEAR(double(open.force), double(strength * area), 1e-9);
	EXPECT_NEAR(double(open.work), double(strength * area * 4e-3), 1e-9);
	EXPECT_NEAR(double(fibreForces(corners, 4.5e-3, 0, 0, k, strength, lasting).force), double(strength * area / 2), 1e-9);
	EXPECT_EQ(fibreForces(corners, 3e-3, 0, 0, k, strength, lasting).force, 0);
	EXPECT_NEAR(double(fibreForces(corners, -1e-3, 0, 0, k, strength, lasting).force), double(-k * area * 1e-3), 1e-9);
	EXPECT_EQ(fibreForces(corners, 4e-3, 0, 0, k, strength, lasting).work, 0);
}
