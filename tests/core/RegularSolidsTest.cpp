// SPDX-License-Identifier: GPL-2.0-or-later
#include "shape/RegularSolids.hpp"
#include "shape/ConvexShape.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

using namespace polytope;

namespace {

/// For volume L³, as in the paper's first simulation: radii over L, moment of inertia over m L², counts.
struct Solid {
	int  faces, vertices, corners; // corners: of a face
	Real inradius, circumradius, moment;
};

const Solid solids[] = {
	{ 4, 4, 3, .416342, 1.249025, .208008 },
	{ 6, 8, 4, .5, .866025, .166667 },
	{ 8, 6, 3, .524558, .908560, .165096 },
	{ 12, 20, 5, .564800, .710749, .156257 },
	{ 20, 12, 3, .582711, .733289, .155637 },
};

class RegularSolid : public testing::TestWithParam<Solid> { };

TEST_P(RegularSolid, HasTheKnownProportions)
{
	const Solid       solid = GetParam();
	const ConvexShape shape(regularSolid(solid.faces, solid.circumradius), 0);
	EXPECT_EQ(shape.planeCount(), solid.faces);
	EXPECT_NEAR(shape.mass().volume, 1, 5e-6);
	EXPECT_NEAR(shape.boundingRadius(), solid.circumradius, 1e-14);
	EXPECT_NEAR(shape.inscribedRadius(), solid.inradius, 1e-6);
	EXPECT_LE((shape.mass().inertia - solid.moment * Matrix3::Identity()).cwiseAbs().maxCoeff(), 2e-6);
	EXPECT_LE(shape.mass().centroid.norm(), 1e-15);
	ASSERT_EQ(shape.polyhedron().vertices.size(), std::size_t(solid.vertices));
	for (const Vector3& vertex : shape.polyhedron().vertices)
		EXPECT_NEAR(vertex.norm(), solid.circumradius, 1e-14);
	ASSERT_EQ(shape.polyhedron().faces.size(), std::size_t(solid.faces));
	for (const auto& face : shape.polyhedron().faces)
		EXPECT_EQ(face.size(), std::size_t(solid.corners));
}

TEST_P(RegularSolid, IsTheSameAtEverySize)
{
	const HalfSpaces one = regularSolid(GetParam().faces, 1);
	for (Real size : { 1e-9, 1e4 }) {
		const HalfSpaces other = regularSolid(GetParam().faces, size);
		for (std::size_t i = 0; i < one.size(); ++i) {
			EXPECT_EQ(other.normals[i], one.normals[i]);
			EXPECT_NEAR(other.offsets[i], size * one.offsets[i], 1e-15 * size);
			EXPECT_NEAR(one.normals[i].norm(), 1, 1e-15);
		}
	}
}

INSTANTIATE_TEST_SUITE_P(
        Solids, RegularSolid, testing::ValuesIn(solids), [](const auto& info) { return "Faces" + std::to_string(info.param.faces); });

std::string refusal(int faces, Real circumradius)
{
	try {
		regularSolid(faces, circumradius);
	} catch (const std::invalid_argument& error) {
		return error.what();
	}
	return "";
}

TEST(RegularSolids, RefusesWithTheArgumentsName)
{
	for (int faces : { 0, 3, 5, 7, 10, 24, -6 })
		EXPECT_EQ(refusal(faces, 1).rfind("faces", 0), 0u) << faces;
	for (Real radius : { 0., -1., std::nan(""), HUGE_VAL })
		EXPECT_EQ(refusal(6, radius).rfind("circumradius", 0), 0u) << radius;
}

} // namespace
