// SPDX-License-Identifier: GPL-2.0-or-later
#include "shape/RoundedSolid.hpp"

#include "ShapeSamples.hpp"
#include "shape/ClosestPoint.hpp"
#include "shape/ShapeFactory.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <stdexcept>

using namespace polytope;
using namespace polytope::samples;

namespace {

const Real pi = std::acos(Real(-1));

/// A tetrahedron without any symmetry.
const std::vector<Vector3> corners = { { 0, 0, 0 }, { 1.3, 0.1, 0 }, { 0.2, 0.9, 0.1 }, { 0.4, 0.3, 1.1 } };

TEST(RoundedSolid, VolumeOfABoxIsSteiners)
{
	const Real a = 1, b = 2, c = 3, r = 0.3; // edges
	for (const Real length : lengths) {
		const MassProperties mass = roundedMass(polyhedron(box(length * a / 2, length * b / 2, length * c / 2)), length * r);
		const Real volume = a * b * c + 2 * (a * b + b * c + c * a) * r + pi * (a + b + c) * r * r + Real(4) / 3 * pi * r * r * r;
		EXPECT_NEAR(mass.volume / (volume * length * length * length), 1, 1e-14);
		EXPECT_LT(mass.centroid.norm(), 1e-14 * length);
	}
}

TEST(RoundedSolid, ABallOnALittleCubeIsABall)
{
	const MassProperties mass   = roundedMass(polyhedron(box(1e-6, 1e-6, 1e-6)), 2);
	const Real           volume = Real(4) / 3 * pi * 8;
	EXPECT_NEAR(mass.volume / volume, 1, 1e-5);
	EXPECT_LT((mass.inertia / (Real(0.4) * volume * 4) - Matrix3::Identity()).cwiseAbs().maxCoeff(), 1e-5);
}

TEST(RoundedSolid, NoBallLeavesTheSolid)
{
	const Polyhedron     core = polyhedron(hullOf(corners));
	const MassProperties own = massProperties(core), mass = roundedMass(core, 0);
	EXPECT_EQ(own.volume, mass.volume);
	EXPECT_EQ(own.centroid, mass.centroid);
	EXPECT_EQ(own.inertia, mass.inertia);
	EXPECT_EQ(roundedSurface(core, 0).vertices, core.vertices);
}

TEST(RoundedSolid, AMarginThatIsNoneIsRefusedByItsName)
{
	const Real none = std::numeric_limits<Real>::quiet_NaN();
	for (const Real& radius : { Real(-1), none })
		try {
			ShapeOptions options;
			options.margin = radius;
			centralHull({ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } }, 3, 0, options);
			FAIL() << radius;
		} catch (const std::invalid_argument& error) {
			EXPECT_EQ(std::string(error.what()), "margin: must be at least 0");
		}
}

TEST(RoundedSolid, MassIsTheLimitOfFinerSurfaces)
{
	const Polyhedron     core  = polyhedron(hullOf(corners));
	const MassProperties exact = roundedMass(core, 0.25);
	const auto           error = [&](Real angle) {
                const MassProperties mass = massProperties(roundedSurface(core, 0.25, angle));
                return std::array<Real, 3> { exact.volume - mass.volume, (exact.centroid - mass.centroid).norm(),
                        (exact.inertia - mass.inertia).norm() };
	};
	const auto coarse = error(0.03), fine = error(0.015);
	for (std::size_t k = 0; k < 3; ++k) {
		EXPECT_GT(coarse[k], 0) << k; // the surface is inside
		EXPECT_LT(coarse[k], 2e-4) << k;
		EXPECT_NEAR(coarse[k] / fine[k], 4, 0.6) << k; // of second order
	}
}

TEST(RoundedSolid, TheSurfaceIsClosedAndAsFarFromTheCoreAsTheRadius)
{
	const CentralShape made  = centralHull(corners, 3, 0, {});
	const Polyhedron   shown = roundedSurface(made.shape->polyhedron(), 0.2);
	for (const Vector3& vertex : shown.vertices)
		EXPECT_NEAR(closestPoint(*made.shape, vertex).distance, 0.2, 1e-13);
	std::set<std::pair<int, int>> edges;
	for (const auto& face : shown.faces)
		for (std::size_t k = 0; k < face.size(); ++k)
			EXPECT_TRUE(edges.emplace(face[k], face[(k + 1) % face.size()]).second);
	for (const auto& [from, to] : edges)
		EXPECT_TRUE(edges.count({ to, from }));
	EXPECT_EQ(shown.planeOfFace.size(), shown.faces.size());
	EXPECT_EQ(shown.planeOfFace[3], 3);
	EXPECT_EQ(shown.planeOfFace[4], -1);
}

TEST(RoundedSolid, TheFrameIsThatOfTheSum)
{
	ShapeOptions options;
	options.margin            = 0.4;
	const CentralShape   made = centralHull(corners, 3, 0, options);
	const MassProperties mass = roundedMass(made.shape->polyhedron(), 0.4);
	EXPECT_LT(mass.centroid.norm(), 1e-14);
	EXPECT_LT(Matrix3(mass.inertia - Matrix3(mass.inertia.diagonal().asDiagonal())).norm(), 1e-14 * mass.inertia.norm());
	EXPECT_GT(made.shape->mass().centroid.norm(), 1e-3); // the core's is elsewhere
	EXPECT_NEAR(mass.volume / roundedMass(polyhedron(hullOf(corners)), 0.4).volume, 1, 1e-13);
}

} // namespace
