// SPDX-License-Identifier: GPL-2.0-or-later
#include "shape/WaterPressure.hpp"

#include "PairSamples.hpp"

#include <gtest/gtest.h>

using namespace polytope;
using namespace polytope::samples;

namespace {

const Real weight = 9810;

/// The pressure of water that stands at z = 0, in one piece.
PressurePiece table()
{
	PressurePiece piece;
	piece.point    = Vector3::Zero();
	piece.gradient = Vector3(0, 0, -weight);
	piece.value    = 0;
	return piece;
}

/// The pressure of table(), in two pieces that meet in the plane direction·x = at.
std::vector<PressurePiece> halves(const Vector3& direction, Real at)
{
	std::vector<PressurePiece> both(2, table());
	for (int k = 0; k < 2; ++k) {
		both[k].sides[0]  = { k ? Vector3(-direction) : direction, k ? Real(-at) : at };
		both[k].sideCount = 1;
	}
	return both;
}

} // namespace

TEST(WaterPressure, BelowTheTableIsTheBuoyancyWhereverPiecesMeet)
{
	std::mt19937_64 random(5);
	ClippedFace     memory;
	for (int k = 0; k < 50; ++k) {
		const auto        shape = ConvexShape::shared(k % 2 ? cuboid(1, 2, 3) : regularSolid(20, 1), Real(0.1));
		const PlacedShape body { *shape, 3 * randomDirection(random) - Vector3(0, 0, 20), randomRotation(random) };
		const Vector3     direction = randomDirection(random);
		const Real        volume    = shape->mass().volume;
		for (const auto& pieces :
		        { std::vector<PressurePiece> { table() }, halves(direction, direction.dot(body.centre) + Real(0.3)) }) {
			const WaterLoad load = waterLoad(body, pieces, nullptr, memory);
			EXPECT_LT((load.force - Vector3(0, 0, weight * volume)).norm(), 1e-11 * weight * volume);
			EXPECT_LT(load.torque.norm(), 1e-11 * weight * volume);
		}
	}
}

TEST(WaterPressure, AFaceWherePiecesMeetIsPressedOnce)
{
	ClippedFace       memory;
	const auto        shape = ConvexShape::shared(cuboid(1, 2, 3), Real(0.1));
	const PlacedShape body { *shape, Vector3(Real(0.7), 0, -10), Matrix3::Identity() };
	for (int k = 0; k < 3; ++k)
		for (int side = -1; side <= 1; side += 2) {
			const Vector3   direction = Vector3::Unit(k);
			const WaterLoad load      = waterLoad(body, halves(direction, body.centre[k] + side * (k + 1)), nullptr, memory);
			EXPECT_LT((load.force - Vector3(0, 0, 48 * weight)).norm(), 1e-11 * 48 * weight);
		}
}

TEST(WaterPressure, OfWetFacesAlone)
{
	ClippedFace       memory;
	const auto        shape = ConvexShape::shared(cuboid(1, 2, 3), Real(0.1));
	const PlacedShape body { *shape, Vector3(5, 6, -2), Matrix3::Identity() };
	for (int plane = 0; plane < 6; ++plane) {
		const std::vector<int> wet { plane };
		const Vector3          normal = shape->planes().normals[std::size_t(plane)];
		const WaterLoad        load   = waterLoad(body, { table() }, &wet, memory);
		// from z = -5 to 0 above it: on a side the mean pressure is that of 2.5 m, 5/3 m above the lower edge
		const Real force = normal.z() > Real(0.5) ? 0
		        : normal.z() < Real(-0.5)         ? 8 * 5 * weight
		                                          : (abs(normal.x()) > Real(0.5) ? 4 : 2) * 5 * Real(2.5) * weight;
		EXPECT_LT((load.force + force * normal).norm(), 1e-11 * 100 * weight);
		if (abs(normal.z()) > Real(0.5)) continue;
		const Vector3 arm = shape->planes().offsets[std::size_t(plane)] * normal + Vector3(0, 0, Real(-3) + Real(5) / 3);
		EXPECT_LT((load.torque - arm.cross(load.force)).norm(), 1e-11 * 100 * weight);
	}
}
