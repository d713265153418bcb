// SPDX-License-Identifier: GPL-2.0-or-later
#include "PlaneRows.hpp"
#include "contact/OverlapPolyhedron.hpp"
#include "shape/MassProperties.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace polytope;
using namespace polytope::samples;

namespace {

ContactResult centroidQuery(const Pair& pair)
{
	ContactSettings settings;
	settings.contactPoint = ContactPoint::Centroid;
	return query(pair, settings);
}

TEST(OverlapVolume, BoxOfTwoCubes)
{
	Pair pair;
	pair.shape[0] = pair.shape[1] = ConvexShape::shared(cuboid(1, 1, 1), Real(0.1));
	for (Real overlap : { 1., 1e-3, 1e-9, 1e-12 }) {
		pair.centre2 = Vector3(Real(0.5), Real(-0.25), 2 - overlap);
		// the cones over the thin faces are as wide as the box and known to a rounding of their height
		EXPECT_LE((centroidQuery(pair).point - pair.centre2 / 2).norm(), 1e-14 + 1e-16 / overlap) << overlap;
	}
	// repeated and common planes make no second face
	pair.centre2 = Vector3(0, 0, Real(1.5));
	EXPECT_LE((centroidQuery(pair).point - pair.centre2 / 2).norm(), 1e-14);
}

TEST(OverlapVolume, TetrahedronAtACorner)
{
	// the half-space x + y + z ≥ 2 of a big turned cube cuts the corner (1, 1, 1) off the unit cube
	const Vector3 diagonal = Vector3::Ones().normalized();
	Pair          pair;
	pair.shape[0]    = ConvexShape::shared(cuboid(1, 1, 1), Real(0.1));
	pair.shape[1]    = ConvexShape::shared(cuboid(10, 10, 10), Real(0.1));
	pair.rotation[1] = Quaternion::FromTwoVectors(Vector3::UnitX(), -diagonal).toRotationMatrix();
	pair.centre2     = (10 + 2 / std::sqrt(Real(3))) * diagonal;
	// vertices (1,1,1), (0,1,1), (1,0,1), (1,1,0)
	EXPECT_LE((centroidQuery(pair).point - Vector3::Constant(0.75)).norm(), 1e-13);
	EXPECT_LE((centroidQuery(swapped(pair)).point + pair.centre2 - Vector3::Constant(0.75)).norm(), 1e-13);
}

TEST(OverlapVolume, TriangleOfARectangleTurnedIntoAWall)
{
	// the paper's Appendix A: a rectangle turned by θ whose lowest corner is δ inside a wall; the overlap is a right triangle
	// with legs δ/sin θ and δ/cos θ and its centroid lies δ (1/tan θ − tan θ)/3 along the wall, δ/3 from its face
	Pair pair;
	pair.shape[0] = ConvexShape::shared(rectangle(5, 1), Real(0.1));
	pair.shape[1] = ConvexShape::shared(rectangle(Real(1.5), Real(0.5)), Real(0.1));
	for (Real degrees : { 2., 6.7469, 30., 60. })
		for (Real depth : { 0.03, 1e-5, 1e-9 }) {
			const Real theta       = degrees * Real(M_PI) / 180;
			pair.rotation[1]       = Eigen::AngleAxis<Real>(theta, Vector3::UnitZ()).toRotationMatrix();
			const Vector3 corner   = pair.rotation[1] * Vector3(Real(-1.5), Real(-0.5), 0);
			pair.centre2           = Vector3(0, 1 - depth - corner.y(), 0);
			const Real    aside    = depth * (1 / std::tan(theta) - std::tan(theta)) / 3;
			const Vector3 expected = pair.centre2 + corner + Vector3(aside, depth * 2 / 3, 0);
			EXPECT_LE((centroidQuery(pair).point - expected).norm(), 1e-14 + 1e-15 / std::sin(theta))
			        << degrees << ' ' << depth;
		}
}

template <int D> void expectMassCentre(int trials)
{
	std::mt19937_64 random(9 + D);
	int             measured = 0;
	for (int trial = 0; trial < trials; ++trial) {
		Pair pair;
		for (auto& shape : pair.shape)
			shape = ConvexShape::shared(randomPlanes(4 + int(random() % 20), random, D), Real(0.1));
		for (Matrix3& rotation : pair.rotation)
			rotation = randomRotation(random, D);
		const Vector3 direction = randomDirection(random, D);
		moveTo(pair, direction, -decades(random, -4, Real(-0.5)));
		const ContactResult result = centroidQuery(pair);
		ASSERT_TRUE(result.inContact);
		// the overlap as a body of its own, by the exact construction
		HalfSpaces overlap = worldPlanes(pair, 0);
		for (int i = 0; i < pair.shape[1]->planeCount(); ++i) {
			overlap.normals.push_back(worldPlanes(pair, 1).normals[i]);
			overlap.offsets.push_back(worldPlanes(pair, 1).offsets[i]);
		}
		const MassProperties mass = massProperties(polyhedron(normalised(overlap)));
		EXPECT_LE((result.point - mass.centroid).norm(), 1e-12 + 1e-15 / -result.infeasibility) << trial;
		++measured;
	}
	EXPECT_EQ(measured, trials);
}

TEST(OverlapVolume, RandomOverlapsAgreeWithTheMassCentreInThreeDimensions) { expectMassCentre<3>(200); }

TEST(OverlapVolume, RandomOverlapsAgreeWithTheMassCentreInTwoDimensions) { expectMassCentre<2>(100); }

TEST(OverlapVolume, OverlapWithoutVolumeHasNone)
{
	// both faces of a slab at the same place
	PlaneRows<Real, 3>   rows(cuboid(1, 1, 1), moved(cuboid(1, 1, 1), Matrix3::Identity(), Vector3(0, 0, 2)));
	ContactWorkspace     workspace;
	const Real           x[] = { Real(0.125), Real(0.25), 1 };
	OverlapMass<Real, 3> mass;
	EXPECT_FALSE((Overlap<Real, 3, 1>(rows.planes, x, 4, workspace).mass(x, mass)));
}

} // namespace
