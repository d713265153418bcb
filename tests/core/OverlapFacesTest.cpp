// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact/OverlapFaces.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace polytope;

namespace {

std::vector<Plane> cubeOf(Real half)
{
	std::vector<Plane> planes;
	forPlanesOfCuboid(Vector3(half, half, half),
	        [&](int axis, int sign, const Real& offset) { planes.push_back({ sign * Vector3::Unit(axis), offset }); });
	return planes;
}

} // namespace

/// Each face has its plane, and its corners lie in it and inside all others; a plane that only repeats another has none.
TEST(OverlapFaces, OfACubeWithoutACorner)
{
	std::vector<Plane> planes = cubeOf(1);
	planes.push_back({ Vector3(1, 1, 1).normalized(), 2 / std::sqrt(Real(3)) });
	planes.push_back(planes[0]);
	planes.push_back({ Vector3(1, 0, 0), 3 });
	const std::vector<OverlapFace> faces = overlapFaces(planes, 4);
	ASSERT_EQ(faces.size(), 7u);
	std::vector<std::size_t> corners;
	for (const OverlapFace& face : faces) {
		ASSERT_GE(face.plane, 0);
		corners.push_back(face.corners.size());
		for (const Vector3& corner : face.corners) {
			EXPECT_NEAR(planes[std::size_t(face.plane)].normal.dot(corner), planes[std::size_t(face.plane)].offset, 1e-15);
			for (const Plane& plane : planes)
				EXPECT_LE(plane.normal.dot(corner), plane.offset + 1e-15);
		}
	}
	std::sort(corners.begin(), corners.end());
	EXPECT_EQ(corners, (std::vector<std::size_t> { 3, 4, 4, 4, 5, 5, 5 }));
}

/// What no plane bounds ends at the box.
TEST(OverlapFaces, OfWhatIsOpen)
{
	std::vector<Plane> planes = cubeOf(1);
	planes.erase(planes.begin());
	const std::vector<OverlapFace> faces = overlapFaces(planes, 4);
	ASSERT_EQ(faces.size(), 6u);
	const auto open = std::find_if(faces.begin(), faces.end(), [](const OverlapFace& face) { return face.plane < 0; });
	ASSERT_NE(open, faces.end());
	for (const Vector3& corner : open->corners)
		EXPECT_EQ(corner[0], 4);
}
