// SPDX-License-Identifier: GPL-2.0-or-later
#include "shape/HalfSpaces.hpp"

#include "ShapeSamples.hpp"

#include <limits>

using namespace polytope;
using namespace polytope::samples;

namespace {

const Real nan_     = std::numeric_limits<Real>::quiet_NaN();
const Real infinity = std::numeric_limits<Real>::infinity();

std::string normalisedSays(const HalfSpaces& set)
{
	return refusal([&] { normalised(set); });
}

TEST(HalfSpaces, normalisedGivesUnitNormalsOfTheSamePlanes)
{
	for (Real length : { Real(1e-300), Real(1e-9), Real(0.5), Real(1e4), Real(1e200) }) {
		HalfSpaces set = box(1, 2, 3);
		for (std::size_t i = 0; i < set.size(); ++i) {
			set.normals[i] *= length;
			set.offsets[i] *= length;
		}
		set.normals[1]        = Vector3(3, 4, 12) * length;
		set.offsets[1]        = 26 * length;
		const HalfSpaces unit = normalised(set);
		ASSERT_EQ(unit.size(), 6u);
		for (const Vector3& normal : unit.normals)
			EXPECT_NEAR(normal.norm(), 1, 4e-16);
		EXPECT_NEAR(unit.offsets[1], 2, 2e-15);
		EXPECT_NEAR(unit.normals[1].z(), 12. / 13, 2e-16);
		EXPECT_NEAR(unit.offsets[5], 3, 2e-15);
	}
}

TEST(HalfSpaces, normalisedTwiceChangesNoBit)
{
	std::mt19937_64 random(1);
	for (int i = 0; i < 50; ++i) {
		HalfSpaces set = tangentPlanes(8, Vector3(1, 2, 3), random);
		for (Vector3& normal : set.normals)
			normal *= 3.7;
		const HalfSpaces once = normalised(set), twice = normalised(once);
		for (std::size_t k = 0; k < set.size(); ++k) {
			EXPECT_EQ(once.normals[k], twice.normals[k]);
			EXPECT_EQ(once.offsets[k], twice.offsets[k]);
		}
	}
}

TEST(HalfSpaces, normalisedRefusesByName)
{
	HalfSpaces set = box(1, 1, 1);
	set.offsets.pop_back();
	EXPECT_EQ(normalisedSays(set), "offsets: 5 values for 6 normals; give one offset per normal");

	set           = box(1, 1, 1);
	set.dimension = 4;
	EXPECT_EQ(normalisedSays(set), "dimension: 4; give 2 or 3");

	set = box(1, 1, 1);
	set.normals.resize(3);
	set.offsets.resize(3);
	EXPECT_EQ(normalisedSays(set), "normals: 3 planes cannot bound a body in 3-D; give at least 4");

	HalfSpaces flat = regularPolygon(3, 1);
	flat.normals.pop_back();
	flat.offsets.pop_back();
	EXPECT_EQ(normalisedSays(flat), "normals: 2 planes cannot bound a body in 2-D; give at least 3");
	EXPECT_EQ(normalisedSays(HalfSpaces()), "normals: 0 planes cannot bound a body in 3-D; give at least 4");

	for (Real bad : { nan_, infinity, -infinity }) {
		set                = box(1, 1, 1);
		set.normals[2].y() = bad;
		EXPECT_EQ(normalisedSays(set), "normals: entry 2 (counted from 0) is not finite; remove NaN and infinite values");
		set            = box(1, 1, 1);
		set.offsets[4] = bad;
		EXPECT_EQ(normalisedSays(set), "offsets: entry 4 (counted from 0) is not finite; remove NaN and infinite values");
	}
	set = box(1, 1, 1);
	set.normals[3].setZero();
	EXPECT_TRUE(says(normalisedSays(set), "normals: entry 3 (counted from 0) is zero; give the outward direction"));
	set = box(1, 1, 1);
	set.normals[3] *= 1e-300;
	set.offsets[3] = 1e300;
	EXPECT_TRUE(says(normalisedSays(set), "offsets: entry 3 (counted from 0) divided by the length of its normal overflows"));
}

TEST(HalfSpaces, inTwoDimensionsNormalsStayInThePlane)
{
	HalfSpaces set     = regularPolygon(5, 1);
	set.normals[1].z() = 1e-6;
	EXPECT_EQ(normalisedSays(set), "normals: entry 1 (counted from 0) leaves the xy plane; in 2-D every normal needs z = 0");
	set.normals[1].z() = 1e-15; // a rotation's rounding
	EXPECT_EQ(normalised(set).normals[1].z(), 0);
}

TEST(HalfSpaces, duplicatesAreDroppedInOrder)
{
	for (Real length : lengths) {
		HalfSpaces set = box(length, 2 * length, 3 * length);
		add(set, Vector3(1, 2, 2) / 3, length);
		add(set, Vector3(2, 4, 4) / 6, length * (1 + 2e-16)); // the same, rounded otherwise
		add(set, Vector3::UnitX(), length);                   // entry 1 again
		add(set, Vector3::UnitX(), length * (1 + 1e-9));      // parallel, looser: redundant, not duplicate
		add(set, Vector3(1, 1e-9, 0).normalized(), length);   // turned by 1e-9: another plane
		const HalfSpaces kept = withoutDuplicates(set);
		ASSERT_EQ(kept.size(), 9u);
		EXPECT_EQ(kept.offsets[0], length);
		EXPECT_EQ(kept.normals[0], -Vector3::UnitX());
		EXPECT_EQ(kept.offsets[6], length);
		EXPECT_EQ(kept.offsets[7], length * (1 + 1e-9));
		EXPECT_EQ(withoutDuplicates(kept).size(), 9u);
	}
}

TEST(HalfSpaces, aFarRedundantPlaneDoesNotBlurTheNearOnes)
{
	HalfSpaces set = box(1e-3, 1e-3, 1e-3);
	add(set, Vector3::UnitX(), 1.001e-3);
	add(set, Vector3::UnitY(), 1e12);
	EXPECT_EQ(withoutDuplicates(set).size(), 8u);
}

TEST(HalfSpaces, duplicatesThroughTheOriginAreFound)
{
	HalfSpaces set = pyramid(4, 1, 1);
	add(set, -Vector3::UnitZ(), 1e-17);
	EXPECT_EQ(withoutDuplicates(set).size(), 5u);
	EXPECT_EQ(withoutDuplicates(HalfSpaces()).size(), 0u);
}

TEST(HalfSpaces, movedKeepsThePointsSlacks)
{
	std::mt19937_64 random(2);
	for (int i = 0; i < 100; ++i) {
		const HalfSpaces set         = tangentPlanes(6, Vector3(1, 2, 3), random);
		const Matrix3    rotation    = someRotation(random);
		const Vector3    translation = 10 * someDirection(random), point = someDirection(random);
		const HalfSpaces result = moved(set, rotation, translation);
		ASSERT_EQ(result.size(), set.size());
		for (std::size_t k = 0; k < set.size(); ++k)
			EXPECT_NEAR(result.offsets[k] - result.normals[k].dot(rotation * point + translation),
			        set.offsets[k] - set.normals[k].dot(point), 2e-14);
	}
}

} // namespace
