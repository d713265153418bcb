// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact/ContactSection.hpp"
#include "PlaneRows.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace polytope;
using namespace polytope::samples;

namespace {

struct Cut {
	Real    area;
	Vector3 centroid;
};

template <int D> Cut cut(const HalfSpaces& set1, const HalfSpaces& set2, const Vector3& origin, const Vector3& normal, Real halfWidth = 10)
{
	PlaneRows<Real, D> rows(set1, set2);
	std::vector<Real>  buffer(std::size_t(sectionNumbers(rows.planes.total)));
	const auto         section = clipPlane(rows.planes, origin.data(), normal.data(), halfWidth, buffer.data());
	return { section.area, vectorOf(section.centroid, D) };
}

/// The polygon by its corners: all points where the cutting plane meets two of the others and none is violated, in order
/// of their angle.
Cut cornersInOrder(const HalfSpaces& set1, const HalfSpaces& set2, const Vector3& origin, const Vector3& normal)
{
	using Long3 = Eigen::Matrix<long double, 3, 1>;
	std::vector<Long3>       normals;
	std::vector<long double> offsets;
	for (const HalfSpaces* set : { &set1, &set2 })
		for (std::size_t i = 0; i < set->size(); ++i) {
			normals.push_back(set->normals[i].cast<long double>());
			offsets.push_back(set->offsets[i] - normals.back().dot(origin.cast<long double>()));
		}
	const Long3        n = normal.cast<long double>().normalized(), u = n.unitOrthogonal(), v = n.cross(u);
	std::vector<Long3> corners; // (u, v, angle)
	Long3              middle = Long3::Zero();
	for (std::size_t i = 0; i < normals.size(); ++i)
		for (std::size_t j = 0; j < i; ++j) {
			const long double a = normals[i].dot(u), b = normals[i].dot(v), c = normals[j].dot(u), d = normals[j].dot(v),
			                  det = a * d - b * c;
			if (std::abs(det) < 1e-12L) continue;
			const Long3 corner((offsets[i] * d - b * offsets[j]) / det, (a * offsets[j] - offsets[i] * c) / det, 0);
			bool        inside = true;
			for (std::size_t k = 0; k < normals.size(); ++k)
				inside = inside && normals[k].dot(u) * corner[0] + normals[k].dot(v) * corner[1] <= offsets[k] + 1e-15L;
			if (inside) corners.push_back(corner), middle += corner;
		}
	if (corners.size() < 3) return { 0, origin };
	middle /= corners.size();
	for (Long3& corner : corners)
		corner[2] = std::atan2(corner[1] - middle[1], corner[0] - middle[0]);
	std::sort(corners.begin(), corners.end(), [](const Long3& p, const Long3& q) { return p[2] < q[2]; });
	long double area = 0, first[2] = { 0, 0 };
	for (std::size_t k = 0; k < corners.size(); ++k) {
		const Long3       p = corners[k] - middle, q = corners[(k + 1) % corners.size()] - middle;
		const long double twice = p[0] * q[1] - p[1] * q[0];
		area += twice / 2;
		for (int c = 0; c < 2; ++c)
			first[c] += twice * (p[c] + q[c]) / 6;
	}
	const Long3 centroid = (middle[0] + first[0] / area) * u + (middle[1] + first[1] / area) * v;
	return { Real(area), origin + centroid.cast<Real>() };
}

// Corners that have all become one: no area, and no division by it.
TEST(ContactSection, OfAPointIsThePoint)
{
	const Real              corners[] = { 2, 3, 2, 3, 2, 3 }, origin[] = { 1, 1, 1 }, normal[] = { 0, 0, 1 };
	const Rotation<Real, 3> axes    = axesAround<Real, 3>(normal);
	const Section<Real, 3>  section = polygonSection<Real>(corners, 3, origin, axes);
	EXPECT_EQ(section.area, 0);
	for (int k = 0; k < 3; ++k)
		EXPECT_NEAR(section.centroid[k], origin[k] + 2 * axes.m[0][k] + 3 * axes.m[1][k], 1e-15);
}

TEST(ContactSection, RectangleOfTwoOffsetCubes)
{
	Pair pair;
	pair.shape[0] = pair.shape[1] = ConvexShape::shared(cuboid(1, 1, 1), Real(0.1));
	pair.centre2                  = Vector3(Real(0.5), Real(-0.25), Real(1.875));
	ContactSettings settings;
	EXPECT_EQ(query(pair, settings).area, 0) << "not asked for";
	settings.section           = true;
	const ContactResult result = query(pair, settings);
	EXPECT_NEAR(result.area, 1.5 * 1.75, 1e-14);
	EXPECT_LE((result.sectionCentroid - Vector3(0.25, -0.125, 0.9375)).norm(), 1e-14);
	std::mt19937_64 random(3);
	for (int trial = 0; trial < 50; ++trial) {
		const Matrix3       rotation = randomRotation(random);
		const ContactResult there    = query(turned(pair, rotation), settings);
		EXPECT_NEAR(there.area, 1.5 * 1.75, 1e-13);
		EXPECT_LE((there.sectionCentroid - rotation * Vector3(0.25, -0.125, 0.9375)).norm(), 1e-13);
	}
}

TEST(ContactSection, CubeCutAcrossItsDiagonal)
{
	const Vector3 diagonal = Vector3::Ones().normalized();
	// through the centre: a regular hexagon of side √2
	const Cut hexagon = cut<3>(cuboid(1, 1, 1), cuboid(2, 2, 2), Vector3::Zero(), diagonal);
	EXPECT_NEAR(hexagon.area, 3 * std::sqrt(Real(3)), 1e-14);
	EXPECT_LE(hexagon.centroid.norm(), 1e-15);
	// near the corner: a triangle of side √½, whatever point of the plane is its origin
	const Cut triangle = cut<3>(cuboid(2, 2, 2), cuboid(1, 1, 1), Vector3(1, Real(0.5), 1), diagonal);
	EXPECT_NEAR(triangle.area, std::sqrt(Real(3)) / 8, 1e-15);
	EXPECT_LE((triangle.centroid - Vector3::Constant(Real(2.5) / 3)).norm(), 1e-14);
	// past the corner: nothing
	EXPECT_EQ(cut<3>(cuboid(1, 1, 1), cuboid(1, 1, 1), Vector3(1, 1, Real(1.5)), diagonal).area, 0);
}

TEST(ContactSection, RandomPolygonsAgreeWithTheirCorners)
{
	std::mt19937_64 random(4);
	int             cuts = 0;
	for (int trial = 0; trial < 400; ++trial) {
		const int        planes = 4 + int(random() % 20);
		const HalfSpaces set1 = randomPlanes(planes, random), own = randomPlanes(8, random);
		const Vector3 centre2 = randomDirection(random), normal = randomDirection(random), origin = uniform(random, 0, 1) * normal;
		const HalfSpaces set2    = moved(own, Matrix3::Identity(), centre2);
		const Cut        clipped = cut<3>(set1, set2, origin, normal), expected = cornersInOrder(set1, set2, origin, normal);
		EXPECT_NEAR(clipped.area, expected.area, 1e-13);
		if (expected.area < 1e-3) continue;
		++cuts;
		EXPECT_LE((clipped.centroid - expected.centroid).norm(), 1e-12);
	}
	EXPECT_GT(cuts, 200);
}

TEST(ContactSection, ChordOfTwoRectangles)
{
	const Cut chord = cut<2>(rectangle(1, Real(0.5)), rectangle(Real(0.75), 2), Vector3(Real(0.25), Real(0.125), 0), Vector3(0, 1, 0));
	EXPECT_EQ(chord.area, 1.5);
	EXPECT_EQ(chord.centroid, Vector3(0, 0.125, 0));
	// 45° across a corner: from (1, ¼) to (¾, ½)
	const Cut across = cut<2>(rectangle(1, Real(0.5)), rectangle(2, 2), Vector3(1, Real(0.25), 0), Vector3(1, 1, 0).normalized());
	EXPECT_NEAR(across.area, std::sqrt(Real(0.125)), 1e-15);
	EXPECT_LE((across.centroid - Vector3(0.875, 0.375, 0)).norm(), 1e-15);
	EXPECT_EQ(cut<2>(rectangle(1, Real(0.5)), rectangle(2, 2), Vector3(2, 1, 0), Vector3(1, 1, 0).normalized()).area, 0);
}

TEST(ContactSection, InTwoDimensionsTheAreaIsLengthTimesTheSmallerThickness)
{
	Pair pair;
	pair.shape[0] = ConvexShape::shared(rectangle(1, 1), Real(0.1), Real(0.5));
	pair.shape[1] = ConvexShape::shared(rectangle(2, 1), Real(0.1), Real(3));
	pair.centre2  = Vector3(Real(1.5), Real(1.875), 0);
	ContactSettings settings;
	settings.section           = true;
	const ContactResult result = query(pair, settings);
	EXPECT_NEAR(result.area, 1.5 * 0.5, 1e-15);
	EXPECT_LE((result.sectionCentroid - Vector3(0.25, 0.9375, 0)).norm(), 1e-15);
}

} // namespace
