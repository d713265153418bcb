// SPDX-License-Identifier: GPL-2.0-or-later
#include "shape/ShapeConstruction.hpp"

#include "ShapeSamples.hpp"
#include "shape/MassProperties.hpp"

#include <limits>

using namespace polytope;
using namespace polytope::samples;

namespace {

std::string polyhedronSays(const HalfSpaces& set, Real thickness = 1)
{
	return refusal([&] { polyhedron(set, thickness); });
}

// ---- vertices that many planes share ----------------------------------------------------------------------------------

struct Solid {
	int faces, corners, vertices;
};
const Solid solids[] = { { 4, 3, 4 }, { 6, 4, 8 }, { 8, 3, 6 }, { 12, 5, 20 }, { 20, 3, 12 } };

TEST(ShapeConstruction, regularSolidsAtEverySizeAndOrientation)
{
	std::mt19937_64 random(11);
	for (const Solid& solid : solids)
		for (Real length : lengths)
			for (int turn = 0; turn < 20; ++turn) {
				HalfSpaces set = regularSolid(solid.faces, length);
				if (turn > 0) set = moved(set, someRotation(random), 3 * length * someDirection(random));
				const Polyhedron shape = polyhedron(set);
				ASSERT_EQ(int(shape.vertices.size()), solid.vertices) << solid.faces << " faces, circumradius " << length;
				ASSERT_EQ(facesByCorners(shape), (std::map<int, int> { { solid.corners, solid.faces } }));
				expectSound(shape, set, 1e-14);
			}
}

TEST(ShapeConstruction, aPyramidHasOneApex)
{
	for (Real length : lengths)
		for (int sides : { 3, 4, 50, 300 })
			for (Real height : { 1e-3, 1., 1e3 }) {
				const HalfSpaces set   = pyramid(sides, length, height * length);
				const Polyhedron shape = polyhedron(set);
				EXPECT_EQ(int(shape.vertices.size()), sides + 1) << sides << " sides, height " << height << " x " << length;
				EXPECT_EQ(int(shape.faces.size()), sides + 1);
				EXPECT_EQ(facesByCorners(shape)[3], sides + (sides == 3));
				expectSound(shape, set);
			}
}

TEST(ShapeConstruction, turnedPyramidsFarOutHaveOneApex)
{
	std::mt19937_64 random(12);
	for (int i = 0; i < 20; ++i) {
		const HalfSpaces set   = moved(pyramid(20, 1e-3, 1e-3), someRotation(random), 1e3 * someDirection(random));
		const Polyhedron shape = polyhedron(set);
		EXPECT_EQ(shape.vertices.size(), 21u);
		EXPECT_EQ(shape.faces.size(), 21u);
		expectSound(shape, set);
	}
}

TEST(ShapeConstruction, planesThatTouchInAnEdgeOrACornerOwnNoFace)
{
	std::mt19937_64 random(13);
	for (Real length : lengths)
		for (int turn = 0; turn < 20; ++turn) {
			HalfSpaces set = box(length, length, length);
			add(set, Vector3(1, 1, 0).normalized(), std::sqrt(Real(2)) * length);  // along an edge
			add(set, Vector3(1, 1, -1).normalized(), std::sqrt(Real(3)) * length); // in a corner
			add(set, Vector3(1, 0, 0), 2 * length);                                // clear of it
			set                    = moved(set, someRotation(random), length * someDirection(random));
			const Polyhedron shape = polyhedron(set);
			EXPECT_EQ(shape.vertices.size(), 8u);
			EXPECT_EQ(shape.faces.size(), 6u);
			EXPECT_EQ(withoutRedundant(set).size(), 6u);
			expectSound(shape, set);
		}
}

TEST(ShapeConstruction, planesEqualToRoundingAreOneFace)
{
	std::mt19937_64 random(14);
	for (int i = 0; i < 200; ++i) {
		const Matrix3    rotation = someRotation(random);
		const HalfSpaces cube     = moved(box(1, 1, 1), rotation, Vector3::Zero());
		HalfSpaces       set      = cube;
		for (std::size_t k = 0; k < 6; ++k)
			add(set, (cube.normals[k] + 2e-16 * someDirection(random)).normalized(), cube.offsets[k] * (1 + 2e-16));
		const Polyhedron shape = polyhedron(set);
		ASSERT_EQ(shape.vertices.size(), 8u);
		ASSERT_EQ(facesByCorners(shape), (std::map<int, int> { { 4, 6 } }));
	}
}

// Between "one plane" and "two planes" either answer is right; a surface that is not closed is not.
TEST(ShapeConstruction, nearlyEqualPlanesStaySound)
{
	std::mt19937_64 random(15);
	int             merged = 0, apart = 0;
	for (Real turn = 1e-17; turn < 1e-9; turn *= 2) {
		for (int i = 0; i < 10; ++i) {
			HalfSpaces set = moved(box(1, 1, 1), someRotation(random), Vector3::Zero());
			for (std::size_t k = 0; k < 6; ++k)
				add(set, (set.normals[k] + turn * someDirection(random)).normalized(), set.offsets[k]);
			const Polyhedron shape = polyhedron(set);
			expectSound(shape, set, 1e-12);
			merged += shape.faces.size() == 6;
			apart += shape.faces.size() == 12;
		}
	}
	EXPECT_GT(merged, 50);
	EXPECT_GT(apart, 50);
}

// ---- short edges and thin shapes --------------------------------------------------------------------------------------

TEST(ShapeConstruction, shortEdgesAreKept)
{
	std::mt19937_64 random(16);
	for (Real length : lengths)
		for (Real edge : { 1e-3, 1e-6, 1e-9 }) {
			HalfSpaces set = box(length, length, length);
			add(set, Vector3(1, 1, 1).normalized(), (3 - edge) * length / std::sqrt(Real(3)));   // a corner cut off
			add(set, Vector3(-1, -1, 0).normalized(), (2 - edge) * length / std::sqrt(Real(2))); // an edge bevelled
			for (int turn = 0; turn < 5; ++turn) {
				const HalfSpaces turned = turn == 0 ? set : moved(set, someRotation(random), Vector3::Zero());
				const Polyhedron shape  = polyhedron(turned);
				EXPECT_EQ(shape.vertices.size(), 12u) << edge;
				EXPECT_EQ(shape.faces.size(), 8u) << edge;
				expectSound(shape, turned);
			}
		}
}

TEST(ShapeConstruction, platesAndNeedlesOfAspect1e8)
{
	std::mt19937_64 random(17);
	for (Real length : lengths)
		for (const Vector3& half : { Vector3(1, 1, 1e-8), Vector3(1e-8, 1e-8, 1), Vector3(1, 1e-4, 1e-8) })
			for (int turn = 0; turn < 10; ++turn) {
				const Matrix3    rotation = turn == 0 ? Matrix3(Matrix3::Identity()) : someRotation(random);
				const Vector3    corner   = length * half;
				const HalfSpaces set      = moved(box(corner.x(), corner.y(), corner.z()), rotation, Vector3::Zero());
				const Polyhedron shape    = polyhedron(set);
				ASSERT_EQ(shape.vertices.size(), 8u);
				ASSERT_EQ(facesByCorners(shape), (std::map<int, int> { { 4, 6 } }));
				expectSound(shape, set, 1e-15);
				for (const Vector3& vertex : shape.vertices) {
					const Vector3 back = (rotation.transpose() * vertex).cwiseAbs();
					EXPECT_LT((back - corner).norm(), 1e-15 * length);
				}
			}
}

TEST(ShapeConstruction, stretchedOctahedraAndBipyramids)
{
	std::mt19937_64 random(18);
	for (Real stretch : { 1e-8, 1e-4, 1e4, 1e8 }) {
		HalfSpaces set;
		for (const Vector3& normal : regularSolid(8, 1).normals)
			add(set, Vector3(normal.x(), normal.y(), normal.z() / stretch).normalized(),
			        (normal.cwiseAbs().x()) / Vector3(normal.x(), normal.y(), normal.z() / stretch).norm());
		for (int turn = 0; turn < 10; ++turn) {
			const HalfSpaces turned = turn == 0 ? set : moved(set, someRotation(random), Vector3::Zero());
			const Polyhedron shape  = polyhedron(turned);
			EXPECT_EQ(shape.vertices.size(), 6u) << stretch;
			EXPECT_EQ(shape.faces.size(), 8u) << stretch;
			expectSound(shape, turned);
		}
	}
}

/// A regular solid, stretched by up to 1e8 in two directions, turned, scaled and moved: the faces stay the same in number.
TEST(ShapeConstruction, affineImagesOfRegularSolidsKeepTheirCombinatorics)
{
	std::mt19937_64                        random(27);
	std::uniform_real_distribution<double> uniform(0, 1);
	for (int i = 0; i < 500; ++i) {
		const Solid&  solid    = solids[i % 5];
		const double  exponent = 8 * uniform(random);
		const Vector3 stretch(1, std::pow(10, -exponent * uniform(random)), std::pow(10, -exponent));
		const Real    length = std::pow(10, 13 * uniform(random) - 9);
		const Matrix3 before = someRotation(random), after = someRotation(random);
		const Vector3 centre = (i % 3 == 0 ? std::pow(10, 3 * uniform(random)) : 0) * length * someDirection(random);
		HalfSpaces    set;
		const auto    regular = regularSolid(solid.faces, 1);
		for (std::size_t k = 0; k < regular.size(); ++k) {
			const Vector3 normal = after * (before * regular.normals[k]).cwiseQuotient(stretch);
			add(set, normal.normalized(), regular.offsets[k] / normal.norm() * length + normal.normalized().dot(centre));
		}
		const Polyhedron shape = polyhedron(set);
		ASSERT_EQ(int(shape.vertices.size()), solid.vertices) << "stretch " << stretch.transpose() << ", length " << length;
		ASSERT_EQ(facesByCorners(shape), (std::map<int, int> { { solid.corners, solid.faces } }));
		ASSERT_EQ(int(hullOf(shape.vertices).size()), solid.faces) << "stretch " << stretch.transpose() << ", length " << length;
	}
}

// ---- random properties ------------------------------------------------------------------------------------------------

TEST(ShapeConstruction, randomPolytopesAreSimpleAndSound)
{
	std::mt19937_64 random(19);
	for (const Vector3& axes : { Vector3(1, 1, 1), Vector3(1, 0.3, 0.01), Vector3(1e-6, 1, 1), Vector3(1e4, 3e3, 2e4) })
		for (int planes : { 20, 60, 200 })
			for (int i = 0; i < 3; ++i) {
				const HalfSpaces set = tangentPlanes(planes, axes, random);
				if (!polyhedronSays(set).empty()) continue; // 20 random planes need not close
				const Polyhedron shape = polyhedron(set);
				// planes in general position: every vertex on three, so V = 2F − 4; tangent planes all own a face
				EXPECT_EQ(int(shape.faces.size()), planes);
				EXPECT_EQ(int(shape.vertices.size()), 2 * planes - 4);
				expectSound(shape, set);
				EXPECT_NEAR(volumeFromVertex(shape, 0) / volumeFromVertex(shape, shape.vertices.size() / 2), 1, 1e-9);
			}
}

TEST(ShapeConstruction, fewRandomPlanesCloseAsOftenAsWendelSays)
{
	std::mt19937_64 random(20);
	int             closed = 0;
	const int       trials = 400, planes = 8;
	for (int i = 0; i < trials; ++i) {
		const HalfSpaces  set     = tangentPlanes(planes, Vector3(1, 1, 1), random);
		const std::string message = polyhedronSays(set);
		closed += message.empty();
		EXPECT_TRUE(message.empty() || says(message, "normals: the set is unbounded")) << message;
	}
	// Wendel (1962): all of N random directions lie in one half space with probability 2^(1−N) Σ_{k<3} C(N−1, k)
	const double open = (1 + 7 + 21) / 128., expected = trials * (1 - open);
	EXPECT_NEAR(closed, expected, 4 * std::sqrt(expected * open));
}

TEST(ShapeConstruction, powersOfTwoScaleExactly)
{
	std::mt19937_64  random(21);
	const HalfSpaces set   = moved(tangentPlanes(50, Vector3(1, 2, 3), random), Matrix3::Identity(), Vector3(1, 2, 3));
	const Polyhedron shape = polyhedron(set);
	for (int power : { -40, -30, -1, 13, 30 }) {
		HalfSpaces scaled = set;
		for (Real& offset : scaled.offsets)
			offset = std::ldexp(offset, power);
		const Polyhedron result = polyhedron(scaled);
		ASSERT_EQ(result.faces, shape.faces);
		for (std::size_t i = 0; i < shape.vertices.size(); ++i)
			EXPECT_EQ(result.vertices[i], std::ldexp(Real(1), power) * shape.vertices[i]);
	}
}

TEST(ShapeConstruction, rigidMotionMovesTheVertices)
{
	std::mt19937_64 random(22);
	for (int i = 0; i < 20; ++i) {
		const HalfSpaces set         = tangentPlanes(40, Vector3(1, 2, 3), random);
		const Matrix3    rotation    = someRotation(random);
		const Vector3    translation = 10 * someDirection(random);
		const Polyhedron before = polyhedron(set), after = polyhedron(moved(set, rotation, translation));
		ASSERT_EQ(before.vertices.size(), after.vertices.size());
		EXPECT_EQ(before.planeOfFace, after.planeOfFace);
		EXPECT_EQ(facesByCorners(before), facesByCorners(after));
		for (const Vector3& vertex : before.vertices) {
			Real nearest = 1;
			for (const Vector3& other : after.vertices)
				nearest = std::min(nearest, (rotation * vertex + translation - other).norm());
			EXPECT_LT(nearest, 1e-10);
		}
	}
}

TEST(ShapeConstruction, aSmallCubeFarOutIsStillACube)
{
	const HalfSpaces cube  = moved(box(5e-4, 5e-4, 5e-4), Matrix3::Identity(), Vector3(1e6, -1e6, 1e6));
	const Polyhedron shape = polyhedron(cube);
	EXPECT_EQ(shape.vertices.size(), 8u);
	EXPECT_EQ(facesByCorners(shape), (std::map<int, int> { { 4, 6 } }));
	EXPECT_NEAR(volumeFromVertex(shape) / 1e-9, 1, 1e-6); // offsets of 1e6 are rounded to 1e-10
	std::mt19937_64 random(23);
	for (int i = 0; i < 20; ++i) {
		const HalfSpaces set = moved(regularSolid(20, 1e-3), someRotation(random), 1e6 * someDirection(random));
		EXPECT_EQ(polyhedron(set).vertices.size(), 12u);
	}
}

TEST(ShapeConstruction, redundantPlanesOwnNoFace)
{
	std::mt19937_64 random(24);
	for (int i = 0; i < 20; ++i) {
		HalfSpaces                             set = tangentPlanes(30, Vector3(1, 1, 1), random);
		const std::size_t                      own = set.size();
		std::uniform_real_distribution<double> looser(1, 3);
		const Real                             reach = extentOf(polyhedron(set));
		for (int k = 0; k < 30; ++k)
			add(set, someDirection(random), reach * looser(random));
		const HalfSpaces kept = withoutRedundant(set);
		ASSERT_EQ(kept.size(), own);
		for (std::size_t k = 0; k < own; ++k) {
			EXPECT_EQ(kept.normals[k], set.normals[k]);
			EXPECT_EQ(kept.offsets[k], set.offsets[k]);
		}
	}
}

// ---- two dimensions ---------------------------------------------------------------------------------------------------

TEST(ShapeConstruction, polygonsBecomePrisms)
{
	for (Real length : lengths)
		for (Real thickness : { 1e-9, 1., 1e4 })
			for (int sides : { 3, 4, 7, 200 }) {
				const HalfSpaces set
				        = moved(regularPolygon(sides, length), Matrix3::Identity(), Vector3(length, 2 * length, 0));
				const Polyhedron shape = polyhedron(set, thickness);
				ASSERT_EQ(int(shape.vertices.size()), 2 * sides);
				ASSERT_EQ(int(shape.faces.size()), sides + 2);
				expectSound(shape, set);
				for (const Vector3& vertex : shape.vertices)
					EXPECT_EQ(std::abs(vertex.z()), thickness / 2);
				for (int f = 0; f < sides; ++f) {
					EXPECT_EQ(shape.planeOfFace[f], f);
					EXPECT_EQ(shape.faces[f].size(), 4u);
				}
				EXPECT_EQ(shape.planeOfFace[sides], -1);
				EXPECT_EQ(shape.planeOfFace[sides + 1], -1);
				EXPECT_EQ(int(shape.faces[sides].size()), sides);
				EXPECT_EQ(withoutRedundant(set).dimension, 2);
				EXPECT_EQ(int(withoutRedundant(set).size()), sides);
			}
}

// ---- refusals ---------------------------------------------------------------------------------------------------------

TEST(ShapeConstruction, emptySetsAreRefused)
{
	for (Real length : lengths) {
		HalfSpaces set = box(length, length, length);
		add(set, Vector3(1, 1, 1).normalized(), -2 * length);
		EXPECT_TRUE(says(polyhedronSays(set), "offsets: the half-spaces have no common point"));
		set = moved(box(length, -1e-9 * length, length), Matrix3::Identity(), Vector3(length, length, length));
		EXPECT_TRUE(says(polyhedronSays(set), "offsets: the half-spaces have no common point"));
	}
	HalfSpaces open; // neither bounded nor feasible: the missing point is reported first
	add(open, Vector3::UnitX(), 0);
	add(open, -Vector3::UnitX(), -1);
	add(open, Vector3::UnitY(), 0);
	add(open, Vector3::UnitZ(), 0);
	EXPECT_TRUE(says(polyhedronSays(open), "offsets: the half-spaces have no common point"));
	HalfSpaces polygon = regularPolygon(5, 1);
	add(polygon, Vector3::UnitX(), -2);
	EXPECT_TRUE(says(polyhedronSays(polygon), "offsets: the half-spaces have no common point"));
}

TEST(ShapeConstruction, flatSetsAreRefused)
{
	std::mt19937_64 random(25);
	for (Real length : lengths)
		for (Real half : { 0., 1e-16, -1e-16, 1e-13 })
			for (int turn = 0; turn < 5; ++turn) {
				HalfSpaces set = box(length, length, half * length);
				if (turn > 0) set = moved(set, someRotation(random), length * someDirection(random));
				EXPECT_TRUE(says(polyhedronSays(set), "offsets: the set is flat")) << half << ": " << polyhedronSays(set);
			}
	EXPECT_TRUE(says(polyhedronSays(box(1, 1e-13, 1e-13)), "offsets: the set is flat"));
	EXPECT_TRUE(says(polyhedronSays(box(0, 0, 0)), "offsets: the set is flat")); // a point
	EXPECT_EQ(polyhedronSays(box(1, 1, 1e-11)), "");
	HalfSpaces segment = regularPolygon(4, 1);
	segment.offsets[0] = segment.offsets[2] = 0;
	EXPECT_TRUE(says(polyhedronSays(segment), "offsets: the set is flat"));
}

TEST(ShapeConstruction, unboundedSetsAreRefusedWithADirection)
{
	for (Real length : lengths) {
		HalfSpaces set = box(length, length, length);
		set.normals.pop_back();
		set.offsets.pop_back(); // no upper z plane
		EXPECT_TRUE(says(polyhedronSays(set),
		        "normals: the set is unbounded (it extends without end along (0, 0, 1)); add planes that close it"))
		        << polyhedronSays(set);
	}
	std::mt19937_64 random(26);
	for (int i = 0; i < 50; ++i) { // a tube, its walls parallel to the axis but for rounding
		HalfSpaces prism     = regularPolygon(6, 1);
		prism.dimension      = 3;
		const HalfSpaces set = moved(prism, someRotation(random), 10 * someDirection(random));
		EXPECT_TRUE(says(polyhedronSays(set), "normals: the set is unbounded")) << polyhedronSays(set);
	}
	HalfSpaces octant; // all planes through one point
	for (int k = 0; k < 3; ++k)
		add(octant, Vector3::Unit(k), 0);
	add(octant, Vector3(1, 1, 1).normalized(), 0);
	EXPECT_TRUE(says(polyhedronSays(octant), "normals: the set is unbounded"));
	HalfSpaces slab;
	for (Real offset : { 1, 2 })
		for (int side : { -1, 1 })
			add(slab, Vector3(side, 0, 0), offset);
	EXPECT_TRUE(says(polyhedronSays(slab), "normals: the set is unbounded"));
	HalfSpaces halfSpace;
	for (Real offset : { 1, 2, 3, 4 })
		add(halfSpace, Vector3(1, 0, 0), offset);
	EXPECT_TRUE(says(polyhedronSays(halfSpace), "normals: the set is unbounded"));
	HalfSpaces strip = regularPolygon(4, 1);
	strip.normals.pop_back();
	strip.offsets.pop_back();
	EXPECT_TRUE(says(polyhedronSays(strip), "normals: the set is unbounded (it extends without end along (0, -1, 0))"));
}

TEST(ShapeConstruction, badNumbersAreRefusedHereToo)
{
	HalfSpaces set = box(1, 1, 1);
	set.offsets[2] = std::numeric_limits<Real>::quiet_NaN();
	EXPECT_TRUE(says(polyhedronSays(set), "offsets: entry 2"));
	set = box(1, 1, 1);
	set.normals[2].setZero();
	EXPECT_TRUE(says(polyhedronSays(set), "normals: entry 2"));
	for (Real thickness : { Real(0), Real(-1), std::numeric_limits<Real>::quiet_NaN(), std::numeric_limits<Real>::infinity() }) {
		EXPECT_EQ(polyhedronSays(regularPolygon(4, 1), thickness),
		        "thickness: it must be positive and finite; give the body's length along z");
		EXPECT_EQ(polyhedronSays(box(1, 1, 1), thickness), ""); // not used in 3-D
	}
}

// Found by fuzzing: a denormal offset ended the process by a signal from GMP; volumes and moments overflowed to infinity and NaN.
TEST(ShapeConstruction, lengthsNobodyHasAreRefused)
{
	for (Real tiny : { std::numeric_limits<Real>::denorm_min(), Real(1e-300), Real(1e-60) }) {
		EXPECT_TRUE(says(polyhedronSays(box(tiny, tiny, tiny)), "offsets: the body is smaller than 1e-50"));
		EXPECT_TRUE(says(polyhedronSays(regularPolygon(4, tiny)), "offsets: the body is smaller than 1e-50"));
		EXPECT_TRUE(says(polyhedronSays(regularPolygon(4, 1), tiny), "thickness: it must lie between"));
	}
	for (Real huge : { Real(1e60), Real(1e200), std::numeric_limits<Real>::max() }) {
		EXPECT_TRUE(says(polyhedronSays(box(1, huge, 1)), "offsets: entry 2"));
		EXPECT_TRUE(says(polyhedronSays(regularPolygon(4, 1), huge), "thickness: it must lie between"));
	}
	for (Real size : { Real(1e-49), Real(1e49) }) {
		const MassProperties mass = massProperties(polyhedron(box(size, size, size)));
		EXPECT_NEAR(mass.volume / (8 * size * size * size), 1, 1e-14);
		EXPECT_TRUE(mass.inertia.allFinite() && mass.inertia(0, 0) > 0);
	}
}

} // namespace
