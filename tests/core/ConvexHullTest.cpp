// SPDX-License-Identifier: GPL-2.0-or-later
#include "shape/ConvexHull.hpp"

#include "shape/CgalGeometry.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>
#include <set>
#include <utility>

using namespace polytope;

namespace {

using Points = std::vector<Vector3>;

/// Closed, V − E + F = 2, each triangle's points counter-clockwise, and no point above any, exactly.
void expectHull(const Points& points, const Triangles& triangles)
{
	std::set<std::pair<int, int>> edges;
	std::set<int>                 corners;
	for (const Triangle& t : triangles) {
		EXPECT_EQ(*std::min_element(t.begin(), t.end()), t[0]);
		for (std::size_t k = 0; k < 3; ++k) {
			EXPECT_TRUE(edges.insert({ t[k], t[(k + 1) % 3] }).second) << "an edge twice in one direction";
			corners.insert(t[k]);
		}
	}
	for (const auto& edge : edges)
		EXPECT_EQ(edges.count({ edge.second, edge.first }), 1u);
	EXPECT_EQ(corners.size() + triangles.size(), edges.size() / 2 + 2);
	EXPECT_TRUE(std::is_sorted(triangles.begin(), triangles.end()));
	for (const Triangle& t : triangles) {
		bool any = false;
		for (const Vector3& p : points) {
			const int side
			        = exact::orientation(points[std::size_t(t[0])], points[std::size_t(t[1])], points[std::size_t(t[2])], p);
			EXPECT_LE(side, 0);
			any = any || side < 0;
		}
		EXPECT_TRUE(any) << "a triangle without area";
	}
}

TEST(ConvexHull, latticePointsWithManyInOnePlane)
{
	std::mt19937_64 random(51);
	int             flat = 0, hulls = 0;
	for (int i = 0; i < 300; ++i) {
		std::uniform_int_distribution<int> lattice(-1 - i % 3, 1 + i % 3);
		Points                             points;
		for (int k = 0; k < 8 + i % 40; ++k) {
			const int x = lattice(random), y = lattice(random), z = lattice(random);
			points.emplace_back(x, y, z);
		}
		bool spans = false;
		for (std::size_t a = 1; a < points.size() && !spans; ++a)
			for (std::size_t b = 1; b < a && !spans; ++b)
				for (std::size_t c = 1; c < b && !spans; ++c)
					spans = exact::orientation(points[0], points[a], points[b], points[c]) != 0;
		if (!spans) {
			++flat;
			EXPECT_THROW(hullTriangles(points), std::logic_error);
			continue;
		}
		++hulls;
		expectHull(points, hullTriangles(points));
	}
	EXPECT_GT(hulls, 250);
}

/// Rounding decides no sign: points lie within a few roundings of common planes, far from the origin and near it.
TEST(ConvexHull, pointsThatMissCommonPlanesByRounding)
{
	std::mt19937_64                        random(52);
	std::uniform_real_distribution<double> along(-1, 1);
	int                                    inexact = 0;
	for (Real away : { 0., 1., 1e3, 1e8 })
		for (int i = 0; i < 30; ++i) {
			Points points;
			for (int k = 0; k < 40; ++k) { // on the faces of a turned box, rounded
				Vector3 p(along(random), along(random), along(random));
				p[k % 3]           = k % 2 ? 1 : -1;
				const Matrix3 turn = Eigen::AngleAxis<Real>(i, Vector3(1, 2, 3).normalized()).toRotationMatrix();
				points.push_back(turn * p + away * Vector3(1, -1, Real(0.5)));
			}
			const Triangles triangles = hullTriangles(points);
			expectHull(points, triangles);
			for (const Triangle& t : triangles) // in double the sign would now and then be wrong
				for (const Vector3& p : points) {
					const Vector3 a = points[std::size_t(t[0])] - p, b = points[std::size_t(t[1])] - p,
					              c   = points[std::size_t(t[2])] - p;
					const Real volume = a.dot(b.cross(c));
					const int  side   = exact::orientation(
                                                points[std::size_t(t[0])], points[std::size_t(t[1])], points[std::size_t(t[2])], p);
					inexact += (volume < 0 ? 1 : volume > 0 ? -1 : 0) != side;
				}
		}
	EXPECT_GT(inexact, 0) << "the sample holds no case that needs exact arithmetic";
}

TEST(ConvexHull, repeatedPointsAppearUnderTheFirstIndex)
{
	std::mt19937_64                  random(53);
	std::normal_distribution<double> gauss;
	for (int i = 0; i < 50; ++i) {
		Points points;
		for (int k = 0; k < 30; ++k) {
			const double x = gauss(random), y = gauss(random), z = gauss(random);
			points.push_back(Vector3(x, y, z).normalized());
		}
		const Triangles once = hullTriangles(points);
		EXPECT_EQ(once.size(), 56u);
		for (int k = 0; k < 30; ++k)
			points.push_back(points[std::size_t(k)]);
		points.push_back(Vector3::Zero());
		EXPECT_EQ(hullTriangles(points), once);
	}
}

} // namespace
