// SPDX-License-Identifier: GPL-2.0-or-later
#include "shape/ShapeFactory.hpp"

#include "ShapeSamples.hpp"
#include "shape/ConstructionTolerances.hpp"
#include "shape/ShapeOrNull.hpp"

using namespace polytope;
using namespace polytope::samples;

namespace {

ShapeOptions withCorner(Real fraction = Real(0.1))
{
	ShapeOptions options;
	options.cornerFraction = fraction;
	return options;
}

std::vector<Vector3> pointsOnSphere(int count, std::mt19937_64& random)
{
	std::vector<Vector3> points;
	for (int i = 0; i < count; ++i)
		points.push_back(someDirection(random));
	return points;
}

TEST(ShapeFactory, aKnownShapeIsSharedWithItsPlace)
{
	std::mt19937_64  random(61);
	const auto       points = pointsOnSphere(20, random);
	const auto       first = centralHull(points, 3, 0, withCorner()), again = centralHull(points, 3, 0, withCorner());
	const HalfSpaces set = moved(box(1, 2, 3), someRotation(random), Vector3(4, 5, 6));
	EXPECT_EQ(first.shape, again.shape);
	EXPECT_EQ(first.position, again.position);
	EXPECT_EQ(first.rotation, again.rotation);
	EXPECT_NE(first.shape, centralHull(points, 3, 0, withCorner(Real(0.2))).shape);
	EXPECT_EQ(centralShape(set, withCorner()).shape, centralShape(set, withCorner()).shape);
	// each is kept by its users alone
	std::weak_ptr<const ConvexShape> watched = centralShape(set, withCorner()).shape;
	EXPECT_TRUE(watched.expired());
}

TEST(ShapeFactory, planesAboutTheirCentroidAndAxesStayAsTheyAre)
{
	for (int faces : { 4, 6, 8, 12, 20 })
		for (Real length : lengths) {
			const HalfSpaces set     = regularSolid(faces, length);
			const auto       central = centralShape(set, withCorner());
			EXPECT_EQ(central.position, Vector3(Vector3::Zero()));
			EXPECT_EQ(central.rotation, Matrix3(Matrix3::Identity()));
			EXPECT_EQ(central.shape->planes().offsets, set.offsets) << faces << " faces, " << length;
			EXPECT_EQ(central.shape->planes().normals, set.normals);
			EXPECT_EQ(central.shape, ConvexShape::shared(set, central.shape->cornerRadius())) << "a load finds the same one";
		}
}

TEST(ShapeFactory, putsTheBodyBackWhereItWas)
{
	std::mt19937_64 random(62);
	for (Real length : lengths)
		for (Real away : { 0., 1., 100. })
			for (int i = 0; i < 10; ++i) {
				const Vector3    centre = away * length * someDirection(random);
				const HalfSpaces set
				        = moved(tangentPlanes(30, length * Vector3(1, 2, 3), random), someRotation(random), centre);
				const auto       central = centralShape(set, withCorner());
				const HalfSpaces back    = moved(central.shape->planes(), central.rotation, central.position);
				ASSERT_EQ(back.size(), set.size());
				for (std::size_t k = 0; k < set.size(); ++k) {
					// the axes are orthonormal to a few roundings, and turn it there and back
					EXPECT_LE((back.normals[k] - set.normals[k]).norm(), 16 * construction::rounding);
					EXPECT_NEAR(back.offsets[k], set.offsets[k], 1e-15 * (4 + away) * 3 * length);
				}
				const MassProperties& mass = central.shape->mass();
				EXPECT_LE(mass.centroid.norm(), 1e-13 * (1 + away) * length);
				EXPECT_LE(std::abs(mass.inertia(0, 1)) + std::abs(mass.inertia(0, 2)) + std::abs(mass.inertia(1, 2)),
				        1e-12 * (1 + away) * mass.inertia.trace());
				EXPECT_NEAR(central.shape->cornerRadius(), central.shape->inscribedRadius() / 10, 1e-16 * length);
			}
}

/// One construction and another give the same numbers: a loaded scene continues as the saved one would have.
TEST(ShapeFactory, theSamePlanesBuiltAnewAreTheSameToTheLastBit)
{
	std::mt19937_64 random(63);
	int             same = 0, all = 0;
	const auto      expectSame = [&](const CentralShape& central) {
                const ConvexShape& made = *central.shape;
                const ConvexShape  anew(made.planes(), made.cornerRadius(), made.thickness());
                EXPECT_EQ(anew.polyhedron().faces, made.polyhedron().faces);
                EXPECT_EQ(anew.inscribedRadius(), made.inscribedRadius());
                same += anew.polyhedron().vertices == made.polyhedron().vertices && anew.boundingRadius() == made.boundingRadius()
                        && anew.mass().inertia == made.mass().inertia;
                ++all;
	};
	for (int i = 0; i < 50; ++i) {
		expectSame(centralHull(pointsOnSphere(6 + i, random), 3, 0, withCorner()));
		expectSame(centralShape(moved(regularSolid(std::vector<int> { 4, 6, 8, 12, 20 }[std::size_t(i % 5)], 1),
		                                someRotation(random), 3 * someDirection(random)),
		        withCorner()));
		HalfSpaces polygon = moved(regularPolygon(3 + i % 9, 2), Matrix3::Identity(), Vector3(1, 2, 0));
		expectSame(centralShape(polygon, withCorner()));
	}
	EXPECT_EQ(same, all);
}

TEST(ShapeFactory, redundantPlanesStayOrGo)
{
	std::mt19937_64 random(64);
	HalfSpaces      set = box(1, 2, 3);
	add(set, Vector3(1, 1, 0).normalized(), 5);
	add(set, Vector3(1, 0, 0), 1); // repeated
	set                  = moved(set, someRotation(random), Vector3(1, 2, 3));
	ShapeOptions options = withCorner();
	EXPECT_EQ(centralShape(set, options).shape->planeCount(), 7);
	options.keepRedundant = false;
	EXPECT_EQ(centralShape(set, options).shape->planeCount(), 6);
}

TEST(ShapeFactory, anotherCornerRadiusChangesNothingElse)
{
	const auto central = centralShape(box(1, 2, 3), withCorner());
	const auto other   = central.shape->withCornerRadius(Real(0.5));
	EXPECT_EQ(other->cornerRadius(), Real(0.5));
	EXPECT_EQ(other, ConvexShape::shared(box(1, 2, 3), Real(0.5)));
	EXPECT_EQ(other->polyhedron().vertices, central.shape->polyhedron().vertices);
	EXPECT_THROW(central.shape->withCornerRadius(100), std::invalid_argument);
	EXPECT_THROW(central.shape->withCornerRadius(std::nan("")), std::invalid_argument);
	EXPECT_EQ(central.shape->cornerRadius(), central.shape->inscribedRadius() / 10);
}

TEST(ShapeFactory, refusesWithTheWordsOfConstruction)
{
	HalfSpaces open = box(1, 1, 1);
	open.normals.pop_back();
	open.offsets.pop_back();
	EXPECT_TRUE(
	        says(refusal([&] { centralShape(open, {}); }), "normals: the set is unbounded (it extends without end along (0, 0, 1))"));
	EXPECT_TRUE(says(refusal([&] { centralShape(box(1, 0, 1), {}); }), "offsets: the set is flat"));
	EXPECT_TRUE(says(refusal([&] { centralHull({ Vector3(0, 0, 0) }, 3, 0, {}); }), "points: 1 cannot span a body"));
	ShapeOptions options;
	options.cornerRadius = 3;
	EXPECT_TRUE(
	        says(refusal([&] { centralShape(box(1, 1, 1), options); }), "cornerRadius: must be at least 0 and fit inside the body"));
	options.thickness = -1;
	EXPECT_TRUE(says(refusal([&] { centralShape(regularPolygon(4, 1), options); }), "thickness: it must be positive"));
}

TEST(ShapeOrNull, nothingThatConstructionThrowsLeavesIt)
{
	using Shape = std::shared_ptr<const ConvexShape>;
	EXPECT_EQ(shapeOrNull([] { return ConvexShape::shared(box(1, 1, 1), 0); })->planeCount(), 6);
	EXPECT_EQ(shapeOrNull([] { return ConvexShape::shared(box(1, 0, 1), 0); }), nullptr);
	EXPECT_EQ(shapeOrNull([]() -> Shape { throw std::runtime_error("the inscribed ball was not found"); }), nullptr);
	EXPECT_EQ(shapeOrNull([]() -> Shape { throw std::bad_alloc(); }), nullptr);
	EXPECT_EQ(shapeOrNull([]() -> Shape { throw 1; }), nullptr);
}

} // namespace
