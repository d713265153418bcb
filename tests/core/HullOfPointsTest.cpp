// SPDX-License-Identifier: GPL-2.0-or-later
#include "ShapeSamples.hpp"

#include <algorithm>
#include <limits>

using namespace polytope;
using namespace polytope::samples;

namespace {

std::vector<Vector3> boxCorners(const Vector3& half)
{
	std::vector<Vector3> points;
	for (int i = 0; i < 8; ++i)
		points.emplace_back(i & 1 ? half.x() : -half.x(), i & 2 ? half.y() : -half.y(), i & 4 ? half.z() : -half.z());
	return points;
}

/// Each plane of `expected` appears once in `planes`.
void expectSamePlanes(const HalfSpaces& planes, const HalfSpaces& expected, Real relative, Real size)
{
	ASSERT_EQ(planes.size(), expected.size());
	for (std::size_t i = 0; i < expected.size(); ++i) {
		int found = 0;
		for (std::size_t k = 0; k < planes.size(); ++k)
			found += (planes.normals[k] - expected.normals[i]).norm() <= relative
			        && std::abs(planes.offsets[k] - expected.offsets[i]) <= relative * size;
		EXPECT_EQ(found, 1) << "plane " << i << " with normal " << expected.normals[i].transpose();
	}
}

std::string hullSays(const std::vector<Vector3>& points, int dimension = 3, Real coplanar = 0)
{
	return refusal([&] { hullOf(points, dimension, coplanar); });
}

TEST(HullOfPoints, aCubeHasSixPlanes)
{
	std::mt19937_64                        random(31);
	std::uniform_real_distribution<double> inside(-1, 1);
	for (Real length : lengths)
		for (int turn = 0; turn < 10; ++turn) {
			std::vector<Vector3> points = boxCorners(Vector3::Constant(length));
			points.push_back(points[3]);
			for (int i = 0; i < 20; ++i) {
				points.push_back(length * Vector3(inside(random), inside(random), inside(random)));
				points.push_back(length * Vector3(inside(random), 1, inside(random))); // on a face
				points.push_back(length * Vector3(inside(random), 1, -1));             // on an edge
			}
			const Matrix3 rotation    = turn == 0 ? Matrix3(Matrix3::Identity()) : someRotation(random);
			const Vector3 translation = turn * length * someDirection(random);
			for (Vector3& p : points)
				p = rotation * p + translation;
			const HalfSpaces cube = moved(box(length, length, length), rotation, translation);
			expectSamePlanes(hullOf(points), cube, 1e-13, (1 + turn) * length);
		}
}

TEST(HullOfPoints, givesBackThePlanesTheVerticesCameFrom)
{
	std::mt19937_64 random(32);
	for (int faces : { 4, 6, 8, 12, 20 })
		for (Real length : lengths) {
			const HalfSpaces set = moved(regularSolid(faces, length), someRotation(random), length * someDirection(random));
			expectSamePlanes(hullOf(polyhedron(set).vertices), set, 1e-13, length);
		}
	// where faces are large enough to define their planes: the directions of a Fibonacci spiral, ruffled
	for (int count : { 30, 100, 200 }) {
		HalfSpaces set;
		for (int i = 0; i < count; ++i) {
			const Real    z = 1 - (2 * i + Real(1)) / count, angle = i * Real(M_PI) * (3 - std::sqrt(Real(5)));
			const Vector3 even(std::sqrt(1 - z * z) * std::cos(angle), std::sqrt(1 - z * z) * std::sin(angle), z);
			add(set, (even + Real(0.3) / std::sqrt(Real(count)) * someDirection(random)).normalized(), 1);
		}
		for (std::size_t i = 0; i < 10; ++i)
			add(set, set.normals[i], 5); // redundant
		const HalfSpaces needed = withoutRedundant(set);
		EXPECT_EQ(int(needed.size()), count);
		expectSamePlanes(hullOf(polyhedron(set).vertices), needed, 1e-12, 1);
	}
}

TEST(HullOfPoints, aSphereMeshGivesItsFacets)
{
	const int rings = 12, sectors = 16;
	for (Real length : lengths) {
		std::vector<Vector3> points;
		for (int i = 0; i <= rings; ++i)
			for (int k = 0; k < sectors; ++k) {
				const Real polar = Real(M_PI) * i / rings, azimuth = 2 * Real(M_PI) * k / sectors;
				points.push_back(length
				        * Vector3(
				                std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth), std::cos(polar)));
			}
		const HalfSpaces planes = hullOf(points);
		EXPECT_EQ(int(planes.size()), rings * sectors);
		const Polyhedron shape = polyhedron(planes);
		EXPECT_EQ(int(shape.vertices.size()), (rings - 1) * sectors + 2);
		EXPECT_EQ(facesByCorners(shape), (std::map<int, int> { { 3, 2 * sectors }, { 4, (rings - 2) * sectors } }));
		expectSound(shape, planes);
	}
}

TEST(HullOfPoints, thinBoxesKeepTheirSixPlanes)
{
	std::mt19937_64 random(33);
	for (Real length : lengths)
		for (const Vector3& half : { Vector3(1, 1, 1e-8), Vector3(1e-8, 1e-8, 1), Vector3(1, 1e-4, 1e-8) })
			for (int turn = 0; turn < 10; ++turn) {
				std::vector<Vector3> points = boxCorners(length * half);
				if (turn > 0) {
					const Matrix3 rotation = someRotation(random);
					for (Vector3& p : points)
						p = rotation * p;
				}
				const HalfSpaces planes = hullOf(points);
				ASSERT_EQ(planes.size(), 6u);
				EXPECT_EQ(polyhedron(planes).vertices.size(), 8u);
			}
}

TEST(HullOfPoints, everyPointIsInside)
{
	std::mt19937_64 random(34);
	for (int i = 0; i < 20; ++i) {
		std::vector<Vector3> points;
		const Vector3        centre = 100 * someDirection(random);
		for (int k = 0; k < 150; ++k)
			points.push_back(centre + Vector3(1, 2, 3).cwiseProduct(someDirection(random)));
		const HalfSpaces planes = hullOf(points);
		EXPECT_EQ(planes.size(), 296u); // points in general position on an ellipsoid: F = 2V − 4
		for (std::size_t k = 0; k < planes.size(); ++k) {
			EXPECT_NEAR(planes.normals[k].norm(), 1, 4e-16);
			for (const Vector3& p : points)
				EXPECT_LE(planes.normals[k].dot(p) - planes.offsets[k], 1e-11);
		}
	}
}

/// Points of a small lattice: many on a face, many on an edge, many twice.
TEST(HullOfPoints, latticePointsThereAndBack)
{
	std::mt19937_64                    random(38);
	std::uniform_int_distribution<int> lattice(-2, 2);
	for (int i = 0; i < 200; ++i) {
		const Matrix3        rotation    = i % 2 ? someRotation(random) : Matrix3(Matrix3::Identity());
		const Vector3        translation = (i % 3) * someDirection(random);
		std::vector<Vector3> points;
		for (int k = 0; k < 8 + i % 30; ++k) {
			const int x = lattice(random), y = lattice(random), z = lattice(random);
			points.push_back(1e-3 * (rotation * Vector3(x, y, z) + translation));
		}
		const HalfSpaces planes = hullOf(points);
		const Polyhedron shape  = polyhedron(planes);
		EXPECT_EQ(shape.faces.size(), planes.size());
		expectSound(shape, planes);
		for (const Vector3& vertex : shape.vertices) {
			Real nearest = 1;
			for (const Vector3& p : points)
				nearest = std::min(nearest, (vertex - p).norm());
			EXPECT_LT(nearest, 1e-15);
		}
		expectSamePlanes(hullOf(shape.vertices), planes, 1e-12, 1e-3);
	}
}

TEST(HullOfPoints, singlePrecisionMeshesMergeWhenAsked)
{
	std::mt19937_64 random(35);
	for (int i = 0; i < 20; ++i) {
		const Matrix3        rotation = someRotation(random);
		std::vector<Vector3> points   = boxCorners(Vector3(1, 2, 3));
		for (Vector3& p : points)
			p = (rotation * p).cast<float>().cast<Real>();
		const HalfSpaces planes = hullOf(points, 3, 1e-6);
		expectSamePlanes(planes, moved(box(1, 2, 3), rotation, Vector3::Zero()), 1e-6, 1);
		EXPECT_GT(hullOf(points).size(), 6u);
		for (std::size_t k = 0; k < planes.size(); ++k)
			for (const Vector3& p : points)
				EXPECT_LE(planes.normals[k].dot(p) - planes.offsets[k], 1e-6);
	}
}

TEST(HullOfPoints, polygons)
{
	std::mt19937_64                        random(36);
	std::uniform_real_distribution<double> along(0, 1);
	for (Real length : lengths)
		for (int sides : { 3, 4, 9 })
			for (int turn = 0; turn < 5; ++turn) {
				const Matrix3    rotation = Eigen::AngleAxis<Real>(turn, Vector3::UnitZ()).toRotationMatrix();
				const HalfSpaces set = moved(regularPolygon(sides, length), rotation, Vector3(turn * length, length, 0));
				std::vector<Vector3> points;
				for (const Vector3& vertex : polyhedron(set).vertices)
					points.emplace_back(vertex.x(), vertex.y(), 0); // each corner twice
				const std::size_t corners = points.size();
				for (int i = 0; i < 10; ++i) {
					const Real t = along(random);
					points.push_back(
					        t * points[std::size_t(i) % corners] + (1 - t) * points[std::size_t(i * 7 + 1) % corners]);
				}
				const HalfSpaces planes = hullOf(points, 2);
				EXPECT_EQ(planes.dimension, 2);
				expectSamePlanes(planes, set, 1e-13, 5 * length);
				for (const Vector3& normal : planes.normals)
					EXPECT_EQ(normal.z(), 0);
			}
}

/// A rock of random points on a sphere, all of whose faces are triangles, with the tolerance of a mesh file.
TEST(HullOfPoints, facetsAreJoinedByTheExtentWhereverTheBodyIs)
{
	const Real      coplanar = 1e-6;
	std::mt19937_64 random(32);
	for (Real length : { Real(0.01), Real(1), Real(100) })
		for (int turn = 0; turn < 5; ++turn) {
			const Matrix3        rotation = someRotation(random);
			std::vector<Vector3> rock, cube = boxCorners(Vector3::Constant(length));
			for (int i = 0; i < 40; ++i)
				rock.push_back(length * someDirection(random));
			for (Vector3& corner : cube)
				corner = rotation * corner;
			const std::size_t faces = hullOf(rock).size();
			EXPECT_EQ(faces, 76u);
			for (Real far : { Real(0), Real(1.4e3), Real(1.4e4), Real(1.4e5), Real(4e6) }) {
				const Vector3        place = far * someDirection(random);
				std::vector<Vector3> there = rock, cubeThere = cube;
				for (Vector3& point : there)
					point += place;
				for (Vector3& corner : cubeThere)
					corner += place;
				EXPECT_EQ(hullOf(there, 3, coplanar).size(), faces) << far << " m from the origin";
				EXPECT_EQ(hullOf(cubeThere, 3, coplanar).size(), 6u) << far << " m from the origin";
			}
		}
}

/// A plate and a needle whose thickness is below the tolerance: their faces are not joined to one.
TEST(HullOfPoints, thinBodiesKeepTheirFacesWhateverTheTolerance)
{
	std::mt19937_64 random(33);
	for (const Real& thickness : { Real(1e-5), Real(1e-7), Real(1e-9) })
		for (const Vector3& half : { Vector3(1, 1, thickness), Vector3(1, thickness, thickness) })
			for (int turn = 0; turn < 5; ++turn) {
				const Matrix3        rotation = turn == 0 ? Matrix3(Matrix3::Identity()) : someRotation(random);
				std::vector<Vector3> points   = boxCorners(half);
				for (Vector3& p : points)
					p = rotation * p;
				EXPECT_EQ(hullOf(points, 3, 1e-6).size(), 6u) << half.transpose();
			}
}

TEST(HullOfPoints, refusesByName)
{
	const Real           nan  = std::numeric_limits<Real>::quiet_NaN();
	std::vector<Vector3> cube = boxCorners(Vector3(1, 1, 1));
	EXPECT_EQ(hullSays({}), "points: 0 cannot span a body in 3-D; give at least 4");
	EXPECT_EQ(hullSays({ cube[0], cube[1], cube[2] }), "points: 3 cannot span a body in 3-D; give at least 4");
	EXPECT_EQ(hullSays({ cube[0], cube[1] }, 2), "points: 2 cannot span a body in 2-D; give at least 3");
	EXPECT_EQ(hullSays(cube, 1), "dimension: 1; give 2 or 3");
	EXPECT_TRUE(says(hullSays(cube, 2), "points: in 2-D they lie in the xy plane; give z = 0"));
	cube[3].y() = nan;
	EXPECT_EQ(hullSays(cube), "points: entry 3 (counted from 0) is not finite; remove NaN and infinite values");
	cube[3].y() = std::numeric_limits<Real>::infinity();
	EXPECT_EQ(hullSays(cube), "points: entry 3 (counted from 0) is not finite; remove NaN and infinite values");
	for (Real coplanar : { Real(-1e-9), nan, Real(0.2) })
		EXPECT_TRUE(says(hullSays(boxCorners(Vector3(1, 1, 1)), 3, coplanar), "coplanar: it must lie between 0 and 0.1"));
}

TEST(HullOfPoints, flatPointsAreRefusedAtEverySize)
{
	std::mt19937_64 random(37);
	for (Real length : lengths)
		for (int turn = 0; turn < 10; ++turn) {
			const Matrix3        rotation    = someRotation(random);
			const Vector3        translation = turn * length * someDirection(random);
			std::vector<Vector3> plane, line, point;
			for (int i = 0; i < 12; ++i) {
				Vector3 inPlane = someDirection(random);
				inPlane.z()     = 0;
				plane.push_back(rotation * (length * inPlane) + translation);
				line.push_back(rotation * (length * Vector3(inPlane.x(), 0, 0)) + translation);
				point.push_back(translation);
			}
			EXPECT_TRUE(says(hullSays(plane), "points: they lie in a plane"));
			EXPECT_TRUE(says(hullSays(line), "points: they lie in a plane"));
			EXPECT_TRUE(says(hullSays(point), "points: they lie in a plane"));
		}
	EXPECT_TRUE(says(hullSays({ Vector3(0, 0, 0), Vector3(1, 1, 0), Vector3(3, 3, 0) }, 2), "points: they lie on a line"));
	EXPECT_TRUE(says(hullSays({ Vector3(1, 0, 0), Vector3(1, 0, 0), Vector3(1, 0, 0) }, 2), "points: they lie on a line"));
}

TEST(HullOfPoints, lengthsNobodyHasAreRefused)
{
	const auto corners = [](Real size) {
		return std::vector<Vector3> { Vector3::Zero(), size * Vector3::UnitX(), size * Vector3::UnitY(), size * Vector3::UnitZ() };
	};
	EXPECT_TRUE(says(hullSays(corners(Real(1e300))), "points: entry 1 (counted from 0) is beyond 1e50"));
	EXPECT_TRUE(says(hullSays(corners(std::numeric_limits<Real>::denorm_min())), "points: they are less than 1e-50 apart"));
	EXPECT_EQ(hullSays(corners(Real(1e49))), "");
	EXPECT_EQ(hullSays(corners(Real(1e-49))), "");
}

} // namespace

// Every second corner of a cube a little further out, the others further in: the four of a face miss their plane by that, whichever of their
// diagonals the hull has taken.
TEST(HullOfPoints, fourCornersAreOneFacetUpToTheirMisfit)
{
	std::mt19937_64 random(36);
	const Real      twist = 1e-4;
	for (int turn = 0; turn < 20; ++turn) {
		const Matrix3        rotation = turn == 0 ? Matrix3(Matrix3::Identity()) : someRotation(random);
		std::vector<Vector3> points   = boxCorners(Vector3::Ones());
		std::shuffle(points.begin(), points.end(), random);
		Real size = 0;
		for (Vector3& p : points) {
			p    = rotation * (p * (1 + twist * p.prod()));
			size = std::max(size, p.norm());
		}
		EXPECT_EQ(hullOf(points, 3, Real(1.1) * twist / size).size(), 6u) << turn;
		EXPECT_GT(hullOf(points, 3, Real(0.9) * twist / size).size(), 6u) << turn;
	}
}
