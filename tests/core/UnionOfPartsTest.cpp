// SPDX-License-Identifier: GPL-2.0-or-later
#include "cutting/UnionOfParts.hpp"

#include "ShapeSamples.hpp"

#include <algorithm>
#include <memory>

using namespace polytope;
using namespace polytope::samples;

namespace {

/// Parts with the shapes that they refer to.
struct Parts {
	std::vector<std::shared_ptr<const ConvexShape>> shapes;
	std::vector<UnionPart>                          list;

	void add(const HalfSpaces& planes, const Vector3& centre, const Matrix3& turn, Real density = 1)
	{
		shapes.push_back(ConvexShape::shared(planes, 0));
		list.push_back({ { *shapes.back(), centre, turn }, density });
	}
};

/// Random polyhedra of 30 vertices on a sphere about one point, and boxes through it.
Parts aboutOnePoint(int count, std::mt19937_64& random)
{
	Parts parts;
	for (int k = 0; k < count; ++k) {
		std::vector<Vector3> points;
		for (int i = 0; i < 30; ++i)
			points.push_back(someDirection(random));
		parts.add(k % 2 ? box(3, 0.7, 0.4) : hullOf(points), Vector3::Zero(), someRotation(random));
	}
	return parts;
}

/// Volume that all of these fill together; 0 where they do not overlap.
Real commonVolume(const Parts& parts, unsigned which)
{
	HalfSpaces all;
	for (std::size_t k = 0; k < parts.list.size(); ++k)
		if (which >> k & 1) {
			const HalfSpaces own = moved(parts.shapes[k]->planes(), parts.list[k].shape.rotation, parts.list[k].shape.centre);
			all.normals.insert(all.normals.end(), own.normals.begin(), own.normals.end());
			all.offsets.insert(all.offsets.end(), own.offsets.begin(), own.offsets.end());
		}
	try {
		return massProperties(polyhedron(withoutDuplicates(all))).volume;
	} catch (const std::invalid_argument&) {
		return 0;
	}
}

TEST(UnionOfParts, IsTheSumOverAllSubsets)
{
	std::mt19937_64 random(1);
	const Parts     parts    = aboutOnePoint(7, random);
	Real            expected = 0;
	for (unsigned which = 1; which < 1u << parts.list.size(); ++which) {
		int count = 0;
		for (unsigned rest = which; rest; rest &= rest - 1)
			++count;
		expected += (count % 2 ? 1 : -1) * commonVolume(parts, which);
	}
	EXPECT_NEAR(unionOf(parts.list).volume, expected, 1e-12 * expected);
}

// Axis-parallel boxes: sums over the cells of the grid of all their faces, turned and moved together.
TEST(UnionOfParts, OfBoxesIsTheSumOverTheirGrid)
{
	std::mt19937_64                        random(2);
	std::uniform_real_distribution<double> place(-1, 1), length(0.1, 1);
	const int                              count = 25;
	const Matrix3                          turn  = someRotation(random);
	const Vector3                          shift(3, -2, 1);
	std::vector<Vector3>                   middles, halves;
	std::vector<Real>                      grid[3];
	Parts                                  parts;
	for (int k = 0; k < count; ++k) {
		const double x = place(random), y = place(random), z = place(random), a = length(random), b = length(random),
		             c = length(random);
		middles.push_back(Vector3(x, y, z));
		halves.push_back(Vector3(a, b, c));
		for (int i = 0; i < 3; ++i)
			for (int side = -1; side <= 1; side += 2)
				grid[i].push_back(middles[std::size_t(k)][i] + side * halves[std::size_t(k)][i]);
		parts.add(box(a, b, c), turn * middles.back() + shift, turn, k + 1);
	}
	for (auto& lines : grid)
		std::sort(lines.begin(), lines.end());
	Real    volume = 0, mass = 0;
	Vector3 first  = Vector3::Zero();
	Matrix3 second = Matrix3::Zero();
	for (std::size_t i = 1; i < grid[0].size(); ++i)
		for (std::size_t j = 1; j < grid[1].size(); ++j)
			for (std::size_t k = 1; k < grid[2].size(); ++k) {
				const Vector3 low(grid[0][i - 1], grid[1][j - 1], grid[2][k - 1]), high(grid[0][i], grid[1][j], grid[2][k]),
				        at = (low + high) / 2, edges = high - low;
				for (std::size_t n = 0; n < middles.size(); ++n) {
					if (((at - middles[n]).cwiseAbs() - halves[n]).maxCoeff() > 0) continue;
					const Real v = edges.prod(), m = v * Real(n + 1);
					volume += v;
					mass += m;
					first += m * at;
					second += m * (at * at.transpose() + Matrix3((edges.cwiseProduct(edges) / 12).asDiagonal()));
					break; // the density of the first
				}
			}
	const UnionProperties found  = unionOf(parts.list);
	const Vector3         centre = first / mass;
	second                       = turn * (second - mass * centre * centre.transpose()) * turn.transpose();
	const Matrix3 inertia        = second.trace() * Matrix3::Identity() - second;
	EXPECT_NEAR(found.volume, volume, 1e-12 * volume);
	EXPECT_NEAR(found.mass, mass, 1e-12 * mass);
	EXPECT_LE((found.centre - (turn * centre + shift)).norm(), 1e-12);
	EXPECT_LE((found.inertia - inertia).cwiseAbs().maxCoeff(), 1e-11 * inertia.trace());
}

// 30 parts about one point, half of them with 56 faces: ends, and does not depend on their order.
TEST(UnionOfParts, ManyInOnePlace)
{
	std::mt19937_64       random(3);
	const Parts           parts    = aboutOnePoint(30, random);
	const UnionProperties onward   = unionOf(parts.list);
	const UnionProperties backward = unionOf({ parts.list.rbegin(), parts.list.rend() });
	EXPECT_NEAR(onward.volume, backward.volume, 1e-11 * onward.volume);
	EXPECT_LE((onward.centre - backward.centre).norm(), 1e-11);
	EXPECT_LE((onward.inertia - backward.inertia).cwiseAbs().maxCoeff(), 1e-10 * onward.inertia.trace());
}

// Wedges about an axis, whose faces coincide to rounding, and the same ones again: one prism.
TEST(UnionOfParts, FlushAndRepeatedParts)
{
	Parts     parts;
	const int count = 15;
	for (int k = 0; k < 2 * count; ++k) {
		const Real           from = 2 * Real(M_PI) * k / count, to = 2 * Real(M_PI) * (k + 1) / count;
		std::vector<Vector3> points;
		Vector3              middle = Vector3::Zero();
		for (Real z : { Real(-1), Real(1) }) {
			points.push_back(Vector3(0, 0, z));
			points.push_back(Vector3(std::cos(from), std::sin(from), z));
			points.push_back(Vector3(std::cos(to), std::sin(to), z));
		}
		for (const Vector3& point : points)
			middle += point / 6;
		for (Vector3& point : points)
			point -= middle;
		parts.add(hullOf(points), middle, Matrix3::Identity());
	}
	const Real expected = count * std::sin(2 * Real(M_PI) / count);
	EXPECT_NEAR(unionOf(parts.list).volume, expected, 1e-13 * count * expected);
}

TEST(UnionOfParts, RefusesMorePiecesThanAllowed)
{
	std::mt19937_64 random(3);
	const Parts     parts = aboutOnePoint(10, random);
	try {
		unionOf(parts.list, 100);
		FAIL() << "not refused";
	} catch (const std::invalid_argument& error) {
		EXPECT_EQ(std::string(error.what()).rfind("parts: their union has more than 100 convex pieces; give fewer", 0), 0u)
		        << error.what();
	}
}

} // namespace
