// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact/OverlapFootprint.hpp"
#include "contact/SectionArea.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>

using namespace polytope;

namespace {

/// Half-spaces of a box between these corners, turned about the origin.
std::vector<Plane> box(const Vector3& low, const Vector3& high, const Matrix3& rotation, int dimension)
{
	std::vector<Plane> planes;
	for (int k = 0; k < dimension; ++k) {
		planes.push_back({ rotation.col(k), high[k] });
		planes.push_back({ -rotation.col(k), -low[k] });
	}
	return planes;
}

const Vector3 low(-0.3, 0.1, -0.2), high(0.9, 0.8, 0.4);

Matrix3 turnedInSpace() { return Eigen::AngleAxis<Real>(Real(0.7), Vector3(1, -2, 3).normalized()).toRotationMatrix(); }
Matrix3 turnedInPlane() { return Eigen::AngleAxis<Real>(Real(0.7), Vector3::UnitZ()).toRotationMatrix(); }

/// ∫ r rᵀ dA of the box' face across its axis z, from the origin of its frame.
Matrix3 secondOfFace()
{
	const Vector3 side = high - low, middle = (high + low) / 2;
	Matrix3       second = Matrix3::Zero();
	for (int i = 0; i < 2; ++i)
		for (int j = 0; j < 2; ++j)
			second(i, j) = side.x() * side.y() * (middle[i] * middle[j] + (i == j ? side[i] * side[i] / 12 : 0));
	return second;
}

} // namespace

TEST(OverlapFootprint, OfABoxIsItsFace)
{
	for (const Matrix3& turn : { Matrix3(Matrix3::Identity()), turnedInSpace() }) {
		const OverlapFootprint seen = overlapFootprint(box(low, high, turn, 3), turn.col(2), 2, 3);
		EXPECT_NEAR(seen.area, 1.2 * 0.7, 1e-14);
		EXPECT_LT((seen.second - turn * secondOfFace() * turn.transpose()).norm(), 1e-14) << seen.second;
		const OverlapFootprint behind = overlapFootprint(box(low, high, turn, 3), -turn.col(2), 2, 3);
		EXPECT_LT((behind.second - seen.second).norm(), 1e-14);
	}
}

// The tetrahedron is a corner cut off the positive octant, seen along the diagonal: a triangle with its corners on the axes.
TEST(OverlapFootprint, OfATetrahedronIsATriangle)
{
	const Real         side = Real(0.6);
	std::vector<Plane> planes { { Vector3(1, 1, 1).normalized(), side / std::sqrt(Real(3)) } };
	for (int k = 0; k < 3; ++k)
		planes.push_back({ -Vector3::Unit(k), 0 });
	const Vector3          along = Vector3(1, 1, 1).normalized();
	const OverlapFootprint seen  = overlapFootprint(planes, along, 1, 3);
	const Real             area  = std::sqrt(Real(3)) / 2 * side * side;
	EXPECT_NEAR(seen.area, area, 1e-14);
	Matrix3 corners = Matrix3::Zero(); // about the middle of the triangle, ∫ r rᵀ = A/12 Σ v vᵀ
	for (int k = 0; k < 3; ++k) {
		const Vector3 corner = side * (Vector3::Unit(k) - Vector3::Constant(Real(1) / 3));
		corners += area / 12 * corner * corner.transpose();
	}
	EXPECT_LT((seen.second - corners).norm(), 1e-14) << seen.second;
}

TEST(OverlapFootprint, InTwoDimensionsIsALength)
{
	const Matrix3          turn = turnedInPlane();
	const OverlapFootprint seen = overlapFootprint(box(low, high, turn, 2), turn.col(1), 2, 2);
	EXPECT_NEAR(seen.area, 1.2, 1e-14);
	const Real third = (std::pow(Real(0.9), 3) + std::pow(Real(0.3), 3)) / 3;
	EXPECT_LT((seen.second - third * turn.col(0) * turn.col(0).transpose()).norm(), 1e-14) << seen.second;
}

// A plane beside another one cuts, however small the bodies are: what counts as rounding grows and falls with their size.
TEST(OverlapFootprint, KnowsPlanesApartAtAnySize)
{
	for (const Real size : { 1e-6, 1., 1e6 }) {
		std::vector<Plane> planes = box(size * low, size * high, Matrix3::Identity(), 2);
		planes.push_back({ Vector3::UnitX(), size * Real(0.8995) });
		EXPECT_NEAR(overlapFootprint(planes, Vector3::UnitY(), 2 * size, 2).area / size, 1.1995, 1e-12) << size;
	}
}

TEST(OverlapFootprint, OfNothingIsNothing)
{
	for (int dimension : { 2, 3 }) {
		std::vector<Plane> planes = box(low, high, Matrix3::Identity(), dimension);
		planes.push_back({ Vector3::UnitX(), -1 });
		EXPECT_EQ(overlapFootprint(planes, Vector3::UnitY(), 2, dimension).area, 0);
	}
}

TEST(SectionArea, OfABoxInBothDimensions)
{
	EXPECT_NEAR(sectionArea(box(low, high, turnedInSpace(), 3), turnedInSpace().col(2), 2, 3), 1.2 * 0.7, 1e-14);
	EXPECT_NEAR(sectionArea(box(low, high, turnedInSpace(), 3), turnedInSpace().col(0), 2, 3), 0.7 * 0.6, 1e-14);
	// a line through the origin along y meets nothing but y = 0.1 … 0.8, one along x nothing at all
	EXPECT_NEAR(sectionArea(box(low, high, turnedInPlane(), 2), turnedInPlane().col(0), 2, 2), 0.7, 1e-14);
	EXPECT_EQ(sectionArea(box(low, high, turnedInPlane(), 2), turnedInPlane().col(1), 2, 2), 0);
	// what lies beyond the half width does not count
	EXPECT_NEAR(sectionArea({}, Vector3::UnitX(), Real(0.25), 2), 0.5, 1e-14);
}
