// SPDX-License-Identifier: GPL-2.0-or-later
#include "shape/ConvexShape.hpp"
#include "PairSamples.hpp"
#include "numbers/Lanes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <thread>

using namespace polytope;
using namespace polytope::samples;

namespace {

std::string refusal(const HalfSpaces& set, Real cornerRadius, Real thickness = 1)
{
	try {
		ConvexShape shape(set, cornerRadius, thickness);
	} catch (const std::invalid_argument& error) {
		return error.what();
	}
	return "";
}

TEST(ConvexShape, RefusesACornerRadiusThatFitsNoBody)
{
	const Real circumradius = std::sqrt(Real(3));
	for (Real good : { 0., 0.5, 0.999, 1.5 })
		EXPECT_EQ(refusal(cuboid(1, 1, 1), good), "") << good;
	for (Real bad : { -1e-9, circumradius * 1.0001, 10., std::nan(""), HUGE_VAL, -HUGE_VAL })
		EXPECT_EQ(refusal(cuboid(1, 1, 1), bad).rfind("cornerRadius", 0), 0u) << bad;
}

TEST(ConvexShape, AFarPlaneDoesNotBlurTheInscribedBall)
{
	std::mt19937_64 random(5);
	for (int repeat = 0; repeat < 20; ++repeat) {
		HalfSpaces set    = randomPlanes(20, random, 2 + repeat % 2);
		const Real radius = ConvexShape(set, 0).inscribedRadius();
		for (Real far : { 1e8, 1e14, 1e46 }) {
			set.normals.push_back(randomDirection(random, set.dimension));
			set.offsets.push_back(far);
			EXPECT_NEAR(ConvexShape(set, 0).inscribedRadius(), radius, 1e-14 * radius) << far;
		}
	}
}

TEST(ConvexShape, RefusesWhatIsNoBody)
{
	HalfSpaces open = cuboid(1, 1, 1);
	open.normals.pop_back();
	open.offsets.pop_back();
	EXPECT_NE(refusal(open, 0), "");
	HalfSpaces empty = cuboid(1, 1, 1);
	empty.offsets[0] = -2;
	EXPECT_NE(refusal(empty, 0), "");
	HalfSpaces notFinite = cuboid(1, 1, 1);
	notFinite.offsets[3] = std::nan("");
	EXPECT_EQ(refusal(notFinite, 0).rfind("offsets", 0), 0u);
	EXPECT_EQ(refusal(rectangle(1, 1), 0, -1).rfind("thickness", 0), 0u);
}

TEST(ConvexShape, InscribedBallOfKnownBodies)
{
	EXPECT_NEAR(ConvexShape(cuboid(3, 1, 2), 0).inscribedRadius(), 1, 1e-15);
	EXPECT_NEAR(ConvexShape(rectangle(3, Real(0.5)), 0).inscribedRadius(), 0.5, 1e-15);
	// a 3-4-5 triangle: radius 1
	HalfSpaces triangle;
	triangle.dimension = 2;
	triangle.normals   = { { -1, 0, 0 }, { 0, -1, 0 }, { 4, 3, 0 } };
	triangle.offsets   = { 0, 0, 12 };
	const ConvexShape shape(triangle, 0);
	EXPECT_NEAR(shape.inscribedRadius(), 1, 1e-15);
	EXPECT_NEAR(shape.boundingRadius(), 4, 1e-15) << "about the body's origin, here a corner";
}

TEST(ConvexShape, InscribedBallIsHeldByItsBasis)
{
	std::mt19937_64 random(1);
	for (int dimension = 2; dimension <= 3; ++dimension)
		for (const auto& shape : randomShapes(90, random, dimension)) {
			const HalfSpaces& set = shape->planes();
			// the ball's centre: the basis' planes are all one radius away
			Eigen::Matrix<Real, 4, 4> system = Eigen::Matrix<Real, 4, 4>::Identity();
			Eigen::Matrix<Real, 4, 1> right  = Eigen::Matrix<Real, 4, 1>::Zero();
			for (int k = 0; k <= dimension; ++k) {
				const int plane = shape->inscribedBasis()[k];
				ASSERT_LT(plane, shape->planeCount());
				system.row(k).setZero();
				system.row(k).head(dimension) = set.normals[plane].head(dimension).transpose();
				system(k, dimension)          = 1;
				right[k]                      = set.offsets[plane];
			}
			if (dimension == 2) system.row(3) << 0, 0, 0, 1;
			const Eigen::Matrix<Real, 4, 1> ball = system.fullPivLu().solve(right);
			const Real                      size = shape->boundingRadius();
			EXPECT_NEAR(ball[dimension], shape->inscribedRadius(), 1e-12 * size);
			Vector3 centre = ball.head<3>();
			if (dimension == 2) centre[2] = 0;
			for (std::size_t i = 0; i < set.size(); ++i)
				EXPECT_GE(set.offsets[i] - set.normals[i].dot(centre), shape->inscribedRadius() - 1e-9 * size);
			// no inner ball about the origin is larger
			EXPECT_GE(shape->inscribedRadius(), *std::min_element(set.offsets.begin(), set.offsets.end()) * (1 - 1e-12));
		}
}

TEST(ConvexShape, BoundingRadiusIsTheFarthestVertex)
{
	std::mt19937_64 random(2);
	for (const auto& shape : randomShapes(60, random)) {
		Real farthest = 0;
		for (const Vector3& vertex : shape->polyhedron().vertices)
			farthest = std::max(farthest, vertex.norm());
		EXPECT_EQ(shape->boundingRadius(), farthest);
		EXPECT_GE(shape->boundingRadius(), shape->inscribedRadius());
	}
	EXPECT_NEAR(ConvexShape(rectangle(3, 4), 0, 100).boundingRadius(), 5, 1e-15) << "thickness is not part of the plane";
}

TEST(ConvexShape, KeepsRedundantAndRepeatedPlanes)
{
	HalfSpaces set = cuboid(1, 1, 1);
	for (int i = 0; i < 3; ++i) {
		set.normals.push_back(Vector3(0, 0, 1));
		set.offsets.push_back(i == 0 ? 5 : 1);
	}
	const ConvexShape shape(set, Real(0.1));
	EXPECT_EQ(shape.planeCount(), 9);
	EXPECT_EQ(shape.polyhedron().faces.size(), 6u);
	EXPECT_NEAR(shape.mass().volume, 8, 1e-14);
	EXPECT_NEAR(shape.inscribedRadius(), 1, 1e-15);
}

TEST(ConvexShape, ArraysArePaddedWithNeutralPlanes)
{
	for (int planes : { 4, 7, 8, 9, 20 }) {
		std::mt19937_64   random(planes);
		const ConvexShape shape(randomPlanes(planes, random), 0);
		EXPECT_EQ(shape.paddedCount() % padWidth, 0);
		EXPECT_GE(shape.paddedCount(), shape.planeCount());
		EXPECT_LT(shape.paddedCount(), shape.planeCount() + padWidth);
		for (int i = 0; i < shape.paddedCount(); ++i)
			for (int k = 0; k < 3; ++k) {
				const bool real = i < shape.planeCount();
				EXPECT_EQ(shape.normalArray(k)[i], real ? shape.planes().normals[i][k] : 0);
				EXPECT_EQ(shape.offsetArray()[i], real ? shape.planes().offsets[i] : padOffset);
			}
	}
}

TEST(ConvexShape, EqualArgumentsShareOneInstance)
{
	const auto one = ConvexShape::shared(cuboid(1, 2, 3), Real(0.125));
	EXPECT_EQ(one, ConvexShape::shared(cuboid(1, 2, 3), Real(0.125)));
	EXPECT_NE(one, ConvexShape::shared(cuboid(1, 2, 3), Real(0.25)));
	EXPECT_NE(one, ConvexShape::shared(cuboid(1, 2, 4), Real(0.125)));
	const auto flat = ConvexShape::shared(rectangle(1, 2), Real(0.125));
	EXPECT_NE(flat, ConvexShape::shared(rectangle(1, 2), Real(0.125), 2));
	// kept by its users alone
	std::weak_ptr<const ConvexShape> watched = ConvexShape::shared(cuboid(7, 8, 9), 0);
	EXPECT_TRUE(watched.expired());
	// a refusal leaves nothing behind
	EXPECT_THROW(ConvexShape::shared(cuboid(1, 2, 3), 100), std::invalid_argument);
	EXPECT_THROW(ConvexShape::shared(cuboid(1, 2, 3), std::nan("")), std::invalid_argument);
	EXPECT_EQ(one, ConvexShape::shared(cuboid(1, 2, 3), Real(0.125)));
}

TEST(ConvexShape, SharingIsThreadSafe)
{
	std::vector<std::shared_ptr<const ConvexShape>> found(400);
	std::vector<std::thread>                        threads;
	for (int t = 0; t < 4; ++t)
		threads.emplace_back([&found, t] {
			for (int i = 0; i < 100; ++i)
				found[100 * t + i] = ConvexShape::shared(cuboid(1, 1, Real(1 + i % 20) / 8), 0);
		});
	for (std::thread& thread : threads)
		thread.join();
	for (int i = 0; i < 400; ++i)
		EXPECT_EQ(found[i], found[i % 20]);
}

// Boxes with near copies of their planes, of which construction said "the inscribed ball of a bounded set was not found":
// one in 100 000 of them.
TEST(ConvexShape, InscribedBallAmongNearlyParallelPlanes)
{
	const double planes[][4] = {
		{ -0.3074849274340794, 0.84158801450051701, -0.44405251181581717, 1 },
		{ 0.3074849274340794, -0.84158801450051701, 0.44405251181581717, 1 },
		{ -0.089374830952808904, -0.49014090972570812, -0.86704903448733073, 1.1773233682254044e-05 },
		{ 0.089374830952808904, 0.49014090972570812, 0.86704903448733073, 1.1773233682254044e-05 },
		{ -0.94734637751617323, -0.22691739127341665, 0.22592772858737675, 0.25191749776936578 },
		{ 0.94734637751617323, 0.22691739127341665, -0.22592772858737675, 0.25191749776936578 },
		{ -0.94734637751617323, -0.22691739127341665, 0.22592772858737684, 0.25191749776930256 },
		{ -0.089374834334954287, -0.49014089460709448, -0.86704904268522009, 1.1773212019926203e-05 },
		{ 0.9473445492162762, 0.22692502481505447, -0.22592772778678002, 0.25191750512944316 },
		{ 0.089374830953007939, 0.49014090972570939, 0.8670490344873093, 1.1773233682254044e-05 },
		{ -0.089374830952858281, -0.49014090972567148, -0.86704903448734627, 1.1773231180609296e-05 },
	};
	HalfSpaces set;
	for (const auto& plane : planes) {
		set.normals.push_back(Vector3(plane[0], plane[1], plane[2]));
		set.offsets.push_back(plane[3]);
	}
	const ConvexShape shape(set, 0);
	EXPECT_NEAR(shape.inscribedRadius(), 1.17732e-05, 1e-10);
	for (int plane : shape.inscribedBasis())
		EXPECT_LT(plane, shape.planeCount());
}

} // namespace
