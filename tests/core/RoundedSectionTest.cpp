// SPDX-License-Identifier: GPL-2.0-or-later
//
// Plane sections of bodies with a margin, and what half-spaces leave of them.
#include "contact/RoundedSection.hpp"

#include "shape/DistanceTolerances.hpp"
#include "shear/ContactOutline.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace polytope;

namespace {

const Vector3 up(0, 0, 1);

std::vector<Vector3> cuboid(Real x, Real y, Real z)
{
	std::vector<Vector3> corners;
	for (int k = 0; k < 8; ++k)
		corners.push_back(Vector3(k & 1 ? x : -x, k & 2 ? y : -y, k & 4 ? z : -z));
	return corners;
}

PlanePolygon section(const std::vector<Vector3>& core, Real margin, const Vector3& at)
{
	return roundedSection(core, margin, up, PlaneAxes(up), at);
}

OutlineMoments moments(const PlanePolygon& polygon) { return momentsOf(polygon.data(), int(polygon.size())); }

/// Area of the polygon whose sides touch a disc.
Real around(Real radius)
{
	const int sides = tolerance::sectionDirections;
	return sides * std::tan(4 * std::atan(Real(1)) / sides) * radius * radius;
}

TEST(RoundedSection, OfABallIsADisc)
{
	const auto found = moments(section({ Vector3(1, 2, 3) }, Real(0.5), Vector3(1.1, 2, 2.6)));
	EXPECT_NEAR(found.area, around(Real(0.3)), 1e-14);
	EXPECT_NEAR((PlaneAxes(up).inSpace(found.centroid) + Vector3(0.1, 0, 0)).norm(), 0, 1e-14);
	EXPECT_TRUE(section({ Vector3(1, 2, 3) }, Real(0.5), Vector3(0, 0, 2.4)).empty());
	EXPECT_TRUE(section({ Vector3(1, 2, 3) }, Real(0.5), Vector3(0, 0, 3.6)).empty());
}

TEST(RoundedSection, NearAFaceIsThatFaceAndARim)
{
	// a rim of √(2 r δ) at the depth δ
	for (const Real depth : { Real(1e-8), Real(1e-3), Real(0.02) }) {
		const Real rim   = std::sqrt(2 * Real(0.1) * depth - depth * depth);
		const auto found = moments(section(cuboid(0.5, 0.3, 0.2), Real(0.1), Vector3(0, 0, -0.3 + depth)));
		EXPECT_NEAR(found.area, 0.6 + 2 * (1.0 + 0.6) * rim + around(rim), 1e-9);
		EXPECT_NEAR(found.centroid.norm(), 0, 1e-9);
	}
}

TEST(RoundedSection, HasTheSidesOfTheCore)
{
	for (const Real turn : { Real(0.1), Real(0.3), Real(0.7) }) {
		auto turned = cuboid(0.5, 0.3, 0.2);
		for (Vector3& corner : turned)
			corner = Vector3(
			        cos(turn) * corner[0] - sin(turn) * corner[1], cos(turn) * corner[1] + sin(turn) * corner[0], corner[2]);
		const Real rim   = std::sqrt(2 * Real(0.1) * Real(1e-3) - Real(1e-6));
		const auto found = moments(section(turned, Real(0.1), Vector3(0, 0, -0.299)));
		// at each corner of the face what the lines leave of a corner of the disc is at most that of a side of 22.5 degrees
		EXPECT_NEAR(found.area, 0.6 + 2 * (1.0 + 0.6) * rim + around(rim), 0.1 * rim * rim);
		EXPECT_NEAR(found.centroid.norm(), 0, 1e-9);
	}
}

/// A body that stands flush along the directions, and one that is turned by a rounding, has the same section.
TEST(RoundedSection, DoesNotJumpWithARounding)
{
	for (const Real turn : { Real(1e-15), Real(-1e-15), Real(1e-9) }) {
		auto turned = cuboid(0.5, 0.3, 0.2);
		for (Vector3& corner : turned)
			corner = Vector3(corner[0] - turn * corner[1], corner[1] + turn * corner[0], corner[2] + turn * corner[0]);
		const auto here  = moments(section(cuboid(0.5, 0.3, 0.2), Real(0.1), Vector3(0, 0, -0.29)));
		const auto there = moments(section(turned, Real(0.1), Vector3(0, 0, -0.29)));
		EXPECT_NEAR(here.area, there.area, 1e-12 + 10 * std::abs(turn));
		EXPECT_NEAR((here.centroid - there.centroid).norm(), 0, 1e-12 + 10 * std::abs(turn));
	}
}

/// A segment along the plane, whose ends are as high as each other: a strip, as long, with a rim.
TEST(RoundedSection, OfASegmentAlongThePlaneIsAStrip)
{
	for (const Vector3& way : { Vector3(2, 0, 0), Vector3(0, -2, 0), Vector3(1.2, 1.6, 0), Vector3(1.2, 1.6, 1e-9) }) {
		const Real rim   = std::sqrt(2 * Real(0.1) * Real(1e-3) - Real(1e-6));
		const auto found = moments(section({ Vector3(0, 0, 0.1), Vector3(0, 0, 0.1) + way }, Real(0.1), Vector3(0, 0, 1e-3)));
		EXPECT_NEAR(found.area, 2 * 2 * rim + around(rim), 0.1 * rim * rim);
		EXPECT_NEAR((PlaneAxes(up).inSpace(found.centroid) - Vector3(way[0], way[1], 0) / 2).norm(), 0, 1e-6);
	}
}

TEST(RoundedSection, ThroughTheMiddleOfASharpBodyIsThatOfTheBody)
{
	const auto found = moments(section(cuboid(0.5, 0.3, 0.2), 0, Vector3::Zero()));
	EXPECT_NEAR(found.area, 0.6, 1e-9);
}

/// Points of the body in the plane lie in it, and some near each of its sides.
TEST(RoundedSection, EachSideTouchesTheBody)
{
	std::mt19937_64                      random(5);
	std::uniform_real_distribution<Real> any(-1, 1);
	for (int trial = 0; trial < 50 && !testing::Test::HasFailure(); ++trial) {
		std::vector<Vector3> core;
		for (int k = 0; k < 6; ++k)
			core.push_back(Vector3(any(random), any(random), any(random)));
		const Real margin = Real(0.05) + std::abs(any(random)) / 5;
		Real       lowest = 1, highest = -1;
		for (const Vector3& point : core) {
			lowest  = std::min(lowest, point[2]);
			highest = std::max(highest, point[2]);
		}
		const Real      level = lowest - margin + (highest - lowest + 2 * margin) * (Real(0.1) + (1 + any(random)) / Real(2.5));
		const Vector3   at(0.3, 0.1, level);
		const PlaneAxes axes(up);
		const auto      found = section(core, margin, at);
		ASSERT_GT(found.size(), 3u);
		std::vector<Real> nearest(found.size(), 10);
		for (int k = 0; k < 20000; ++k) { // a point of the core, and one of the ball about it that is in the plane
			Vector3 inside = Vector3::Zero();
			Real    sum    = 0;
			for (const Vector3& point : core) {
				const Real weight = pow(std::abs(any(random)), Real(8));
				inside += weight * point;
				sum += weight;
			}
			inside /= sum;
			const Real off = level - inside[2];
			if (std::abs(off) > margin) continue;
			const Real    rim = sqrt(margin * margin - off * off), turn = 4 * any(random);
			const Vector3 place = inside + Vector3(rim * cos(turn), rim * sin(turn), off);
			const Vector2 here(axes.u.dot(place - at), axes.v.dot(place - at));
			for (std::size_t side = 0; side < found.size(); ++side) {
				const Vector2 way = found[(side + 1) % found.size()] - found[side];
				if (way.norm() < 1e-9) {
					nearest[side] = 0;
					continue;
				}
				const Real in = cross(way, Vector2(here - found[side])) / way.norm();
				EXPECT_GT(in, -1e-12);
				nearest[side] = std::min(nearest[side], in);
			}
		}
		for (const Real& gap : nearest)
			EXPECT_LT(gap, 0.1);
	}
}

TEST(RoundedSection, ClipsAddUp)
{
	const auto      whole = section(cuboid(0.5, 0.3, 0.2), Real(0.1), Vector3(0.2, 0.1, -0.29));
	const PlaneAxes axes(up);
	const Vector3   at(0.2, 0.1, -0.29), normal = Vector3(1, 2, 0.5).normalized();
	auto            one = whole, other = whole;
	clipByPlane(one, { normal, 0.05 }, axes, at);
	clipByPlane(other, { -normal, -0.05 }, axes, at);
	EXPECT_GT(moments(one).area, 0.1);
	EXPECT_NEAR(moments(one).area + moments(other).area, moments(whole).area, 1e-14);
	clipByPlane(one, { up, -1 }, axes, at);
	EXPECT_TRUE(one.empty());
}

} // namespace
