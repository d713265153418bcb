// SPDX-License-Identifier: GPL-2.0-or-later
#include "bond/CommonFace.hpp"

#include <gtest/gtest.h>

using namespace polytope;

namespace {

HalfSpaces box(const Vector3& half)
{
	HalfSpaces planes;
	for (int k = 0; k < 3; ++k)
		for (int sign = -1; sign <= 1; sign += 2) {
			planes.normals.push_back(sign * Vector3::Unit(k));
			planes.offsets.push_back(half[k]);
		}
	return planes;
}

const ConvexShape plate(box({ 2, 1, 0.5 }), 0), brick(box({ 0.5, 0.4, 0.3 }), 0);

PlacedShape at(const ConvexShape& shape, const Vector3& centre, const Matrix3& rotation = Matrix3::Identity())
{
	return { shape, centre, rotation };
}

} // namespace

TEST(CommonFace, OfABrickOnAPlateIsTheBricksFace)
{
	const auto faces = commonFaces(at(plate, { 0, 0, -0.5 }), at(brick, { 0.2, 0.1, 0.3 }), 0, 0.01);
	ASSERT_EQ(faces.size(), 1u);
	const CommonFace& face = faces[0];
	EXPECT_NEAR(face.area, 0.8, 1e-15);
	EXPECT_NEAR(face.gap, 0, 1e-15);
	EXPECT_LT((face.centroid - Vector3(0.2, 0.1, 0)).norm(), 1e-15);
	EXPECT_LT((face.axes.col(0) - Vector3::UnitZ()).norm(), 1e-15);
	EXPECT_NEAR(face.axes.determinant(), 1, 1e-15);
	// b h³/12 about both axes
	const Real along[2] = { 0.8 * 1. / 12, 0.8 * 0.64 / 12 };
	EXPECT_NEAR(face.second[0] + face.second[1], along[0] + along[1], 1e-15);
	for (int k = 0; k < 2; ++k)
		EXPECT_NEAR(face.second[k], along[std::abs(face.axes.col(1 + k)[0]) > 0.5 ? 0 : 1], 1e-15);
	EXPECT_EQ(face.corners.size(), 4u);
}

TEST(CommonFace, IsCutAtTheEdgeOfTheOtherFace)
{
	// a brick that hangs over the plate's end by half of its length, turned by 45°: a triangle and more is cut away
	const auto faces = commonFaces(at(plate, { 0, 0, -0.5 }), at(brick, { 2, 0, 0.3 }), 0, 0.01);
	ASSERT_EQ(faces.size(), 1u);
	EXPECT_NEAR(faces[0].area, 0.4, 1e-15);
	EXPECT_LT((faces[0].centroid - Vector3(1.75, 0, 0)).norm(), 1e-15);
	const Matrix3 turned = Eigen::AngleAxis<Real>(0.25 * EIGEN_PI, Vector3::UnitZ()).toRotationMatrix();
	const auto    half   = commonFaces(at(plate, { 0, 0, -0.5 }), at(brick, { 2, 0, 0.3 }, turned), 0, 0.01);
	ASSERT_EQ(half.size(), 1u);
	EXPECT_NEAR(half[0].area, 0.4, 1e-14) << "a line through its centre halves a rectangle";
}

TEST(CommonFace, SecondMomentsOfATurnedAreaArePrincipal)
{
	const Matrix3 turned = Eigen::AngleAxis<Real>(0.3, Vector3::UnitZ()).toRotationMatrix();
	const auto    faces  = commonFaces(at(plate, { 0, 0, -0.5 }), at(brick, { 0, 0, 0.3 }, turned), 0, 0.01);
	ASSERT_EQ(faces.size(), 1u);
	Matrix3 tensor = Matrix3::Zero();
	for (int k = 0; k < 2; ++k)
		tensor += faces[0].second[k] * faces[0].axes.col(1 + k) * faces[0].axes.col(1 + k).transpose();
	const Matrix3 own = turned * Vector3(0.8 / 12, 0.8 * 0.64 / 12, 0).asDiagonal() * turned.transpose();
	EXPECT_LT((tensor - own).norm(), 1e-15);
}

TEST(CommonFace, GapOverlapAndAngleDecide)
{
	const auto count = [](Real height, Real gap, Real tilt) {
		const Matrix3 turned = Eigen::AngleAxis<Real>(tilt, Vector3::UnitX()).toRotationMatrix();
		return commonFaces(at(plate, { 0, 0, -0.5 }), at(brick, { 0, 0, 0.3 + height }, turned), gap, 0.01).size();
	};
	EXPECT_EQ(count(1e-3, 1e-4, 0), 0u);
	EXPECT_EQ(count(1e-3, 2e-3, 0), 1u);
	EXPECT_EQ(count(-1e-3, 0, 0), 1u);
	EXPECT_EQ(count(-0.2, 0, 0), 0u) << "deeper than a contact";
	EXPECT_EQ(count(0, 1e-2, 0.009), 1u);
	EXPECT_EQ(count(0, 1e-2, 0.011), 0u);
	EXPECT_EQ(commonFaces(at(plate, { 0, 0, -0.5 }), at(brick, { 2.5, 0, 0.3 }), 0, 0.01).size(), 0u) << "an edge has no area";
}

TEST(CommonFace, OfPolygonsIsTheirEdgeOverTheThickness)
{
	HalfSpaces square;
	square.dimension = 2;
	for (int k = 0; k < 2; ++k)
		for (int sign = -1; sign <= 1; sign += 2) {
			square.normals.push_back(sign * Vector3::Unit(k));
			square.offsets.push_back(0.5);
		}
	const ConvexShape body(square, 0, 0.2);
	const auto        faces = commonFaces(at(body, { 0, 0, 0 }), at(body, { 1, 0.25, 0 }), 0, 0.01);
	ASSERT_EQ(faces.size(), 1u);
	EXPECT_NEAR(faces[0].area, 0.75 * 0.2, 1e-15);
}
