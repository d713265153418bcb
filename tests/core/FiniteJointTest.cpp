// SPDX-License-Identifier: GPL-2.0-or-later
#include "cutting/FiniteJoint.hpp"

#include "ShapeSamples.hpp"
#include "cutting/JointAreas.hpp"
#include "cutting/JointedBlocks.hpp"

using namespace polytope;
using namespace polytope::samples;

namespace {

const Real pi = EIGEN_PI;

/// A disc in the plane z = height.
FiniteJoint disc(const Vector3& centre, Real radius) { return { { Vector3::UnitZ(), centre[2] }, centre, radius, {} }; }

/// A rectangle normal to axis k, as a disc with edges.
FiniteJoint rectangle(int k, const Vector3& centre, Real first, Real second)
{
	const int   i = (k + 1) % 3, j = (k + 2) % 3;
	FiniteJoint joint { { Vector3::Unit(k), centre[k] }, centre, Real(1.001) * sqrt(Real(first * first + second * second)), {} };
	for (int sign : { -1, 1 }) {
		joint.edges.push_back({ sign * Vector3::Unit(i), sign * centre[i] + first });
		joint.edges.push_back({ sign * Vector3::Unit(j), sign * centre[j] + second });
	}
	return joint;
}

Polygon square(Real half, Real height)
{
	return { { -half, -half, height }, { half, -half, height }, { half, half, height }, { -half, half, height } };
}

/// Numbers of bodies' parts, and whether the volumes add up to that of the regions.
std::vector<int> partsOf(const JointedBlocks& rock, Real volume)
{
	std::vector<int> parts;
	Real             sum = 0;
	for (std::size_t b = 0; b < rock.blocks.size(); ++b) {
		parts.resize(std::max(parts.size(), std::size_t(rock.bodies[b]) + 1));
		++parts[std::size_t(rock.bodies[b])];
		sum += rock.blocks[b].volume();
	}
	EXPECT_NEAR(sum / volume, 1, 1e-13);
	return parts;
}

const Cutting clumps { 0, Real(1e-3) };

TEST(FiniteJoint, AreaOfADiscInASquare)
{
	for (Real size : lengths) {
		const Real unit = size * size;
		EXPECT_NEAR(areaWithin(disc({ 0, 0, size }, size / 2), square(size, size)) / unit, pi / 4, 1e-14);
		EXPECT_NEAR(areaWithin(disc({ 0, 0, size }, 2 * size), square(size, size)) / unit, 4, 1e-14);
		EXPECT_NEAR(areaWithin(disc({ size, 0, size }, size / 2), square(size, size)) / unit, pi / 8, 1e-14);
		EXPECT_NEAR(areaWithin(disc({ size, size, size }, size / 2), square(size, size)) / unit, pi / 16, 1e-14);
		// the segment of height r/2: r² (acos(1/2) − √3/4)
		EXPECT_NEAR(areaWithin(disc({ Real(1.25) * size, 0, size }, size / 2), square(size, size)) / unit,
		        (pi / 3 - sqrt(Real(3)) / 4) / 4, 1e-14);
		EXPECT_EQ(areaWithin(disc({ 3 * size, 0, size }, size), square(size, size)), 0);
		// larger than the square's half-length, not than its half-diagonal: four segments are missing
		const Real r       = Real(1.1) * size,
		           segment = r * r * Real(std::acos(double(size / r))) - size * sqrt(Real(r * r - size * size));
		EXPECT_NEAR(areaWithin(disc({ 0, 0, size }, r), square(size, size)) / unit, (pi * r * r - 4 * segment) / unit, 1e-14);
	}
}

TEST(FiniteJoint, PolygonsAndEdges)
{
	EXPECT_NEAR(areaWithin(rectangle(2, { 1, 0, 0 }, 1, Real(0.25)), square(1, 0)), Real(0.5), 1e-14);
	FiniteJoint half = disc(Vector3::Zero(), 1);
	half.edges.push_back({ Vector3::UnitX(), 0 });
	EXPECT_NEAR(areaWithin(half, square(5, 0)), pi / 2, 1e-14);
	Polygon turned = square(5, 0);
	std::reverse(turned.begin(), turned.end());
	EXPECT_NEAR(areaWithin(half, turned), pi / 2, 1e-14);
}

TEST(FiniteJoint, WhatSeveralInOnePlaneLeaveUncovered)
{
	const FiniteJoint left = rectangle(2, { -1, 0, 0 }, 1, 2), right = rectangle(2, { 1, 0, 0 }, 1, 2),
	                  middle = rectangle(2, { 0, 0, 0 }, 1, 2);
	const Vector3 up         = Vector3::UnitZ();
	EXPECT_NEAR(uncovered(square(1, 0), up, { &left }), 2, 1e-14);
	EXPECT_NEAR(uncovered(square(1, 0), up, { &left, &right }), 0, 1e-14);
	EXPECT_NEAR(uncovered(square(2, 0), up, { &left, &middle }), 4, 1e-13);
	EXPECT_NEAR(uncovered(square(2, 0), up, {}), 16, 1e-13);
	FiniteJoint nothing = disc(Vector3::Zero(), 1);
	nothing.edges.push_back({ Vector3::UnitX(), -2 });
	EXPECT_NEAR(uncovered(square(1, 0), up, { &left, &nothing }), 2, 1e-14);
	const FiniteJoint small = disc(Vector3::Zero(), 1), other = disc({ 3, 0, 0 }, Real(0.5));
	EXPECT_NEAR(uncovered(square(5, 0), up, { &small, &other }), 100 - Real(1.25) * pi, Real(1.25) * pi * Real(9e-4));
}

TEST(JointAreas, OfDiscsAndPlanesInRegions)
{
	const Vector3                  diagonal = Vector3::Ones().normalized();
	const std::vector<FiniteJoint> joints { disc({ 0, 0, Real(0.5) }, Real(0.5)), disc({ 1, 0, 0 }, Real(0.5)), disc({ 0, 0, 5 }, 9),
		{ { diagonal, 0 }, Vector3::Zero(), 0, {} } };
	const HalfSpaces               cube = box(1, 1, 1);
	const auto                     one  = areasWithin({ cube }, joints);
	EXPECT_NEAR(one[0], pi / 4, 1e-14);
	EXPECT_NEAR(one[1], pi / 8, 1e-14);
	EXPECT_EQ(one[2], 0);
	EXPECT_NEAR(one[3], 3 * sqrt(Real(3)), 1e-14); // a regular hexagon of edge √2
	const auto two = areasWithin({ cube, moved(cube, Matrix3::Identity(), Vector3(2, 0, 0)) }, joints);
	EXPECT_NEAR(two[1], pi / 4, 1e-14);
}

TEST(RockBridges, ADiscThatEndsInsideDividesNothing)
{
	const auto rock = cutByJoints({ box(2, 2, 2) }, { disc(Vector3(0, 0, Real(0.3)), 1) }, clumps);
	EXPECT_EQ(partsOf(rock, 64), std::vector<int>({ 1 }));
	EXPECT_NEAR(rock.areas[0], pi, 1e-13);
	EXPECT_NEAR(rock.sections[0], 16, 1e-13);
	EXPECT_EQ(partsOf(cutByJoints({ box(2, 2, 2) }, { disc(Vector3(0, 0, Real(0.3)), 1) }, {}), 64).size(), 2u);
	EXPECT_EQ(partsOf(cutByJoints({ box(2, 2, 2) }, { disc(Vector3(0, 0, Real(0.3)), 3) }, clumps), 64).size(), 2u);
}

/// Three squares cut a cube out of a corner of the region; where one of them is too short by a tenth, it stays attached.
TEST(RockBridges, ABlockInACornerIsFreeOnceAllItsJointsAreWhole)
{
	for (bool whole : { true, false }) {
		const Real               reach = whole ? 1 : Real(0.9);
		std::vector<FiniteJoint> joints;
		for (int k = 0; k < 3; ++k)
			joints.push_back(rectangle(k, k == 2 ? Vector3(2 - reach, 2 - reach, 0) : Vector3::Constant(1) - Vector3::Unit(k),
			        k == 2 ? reach : 1, k == 2 ? reach : 1));
		const auto rock  = cutByJoints({ box(2, 2, 2) }, joints, clumps);
		const auto parts = partsOf(rock, 64);
		if (!whole) {
			EXPECT_EQ(parts, std::vector<int>({ 1 }));
			continue;
		}
		ASSERT_EQ(parts.size(), 2u);
		Real volumes[2] = { 0, 0 };
		for (std::size_t b = 0; b < rock.blocks.size(); ++b)
			volumes[rock.bodies[b]] += rock.blocks[b].volume();
		EXPECT_NEAR(std::min(volumes[0], volumes[1]), 8, 1e-12);
	}
}

/// Which blocks are one body does not depend on the order in which joints cut.
TEST(RockBridges, BodiesDoNotDependOnTheOrder)
{
	std::mt19937_64          random(81);
	std::vector<FiniteJoint> joints;
	for (int i = 0; i < 60; ++i) {
		const Vector3 centre = Vector3::NullaryExpr([&] { return std::uniform_real_distribution<double>(-1, 1)(random); });
		const Vector3 normal = (Vector3::Unit(i % 3) + Real(0.1) * someDirection(random)).normalized();
		joints.push_back({ { normal, normal.dot(centre) }, centre, Real(1.6), {} });
	}
	std::vector<Real> sizes[3];
	std::size_t       blocks[3];
	for (int order = 0; order < 3; ++order) {
		const auto rock
		        = cutByJoints({ box(1, 1, 1) }, joints, { 0, Real(1e-9) }); // bridges are measured by faces that the order makes
		sizes[order].assign(partsOf(rock, 8).size(), 0);
		blocks[order] = rock.blocks.size();
		for (std::size_t b = 0; b < blocks[order]; ++b)
			sizes[order][std::size_t(rock.bodies[b])] += rock.blocks[b].volume();
		std::sort(sizes[order].begin(), sizes[order].end());
		std::shuffle(joints.begin(), joints.end(), random);
	}
	EXPECT_GT(sizes[0].size(), 20u);
	EXPECT_NE(blocks[0], blocks[1]);
	for (int order : { 1, 2 }) {
		ASSERT_EQ(sizes[order].size(), sizes[0].size());
		for (std::size_t b = 0; b < sizes[0].size(); ++b)
			EXPECT_NEAR(sizes[order][b], sizes[0][b], 1e-12);
	}
}

TEST(RockBridges, RegionsThatShareAFaceAreOneBodyUnlessAJointRunsThere)
{
	const HalfSpaces lower = box(1, 1, 1);
	const HalfSpaces upper = moved(box(Real(0.5), 1, 1), Matrix3::Identity(), Vector3(0, 0, 2));
	EXPECT_EQ(partsOf(cutByJoints({ lower, upper }, {}, clumps), 12), std::vector<int>({ 2 }));
	EXPECT_EQ(partsOf(cutByJoints({ lower, upper }, {}, {}), 12), std::vector<int>({ 1, 1 }));
	EXPECT_EQ(partsOf(cutByJoints({ lower, upper }, { disc({ 0, 0, 1 }, 3) }, clumps), 12), std::vector<int>({ 1, 1 }));
	EXPECT_EQ(partsOf(cutByJoints({ lower, upper }, { disc({ 0, 0, 1 }, 1) }, clumps), 12), std::vector<int>({ 2 }));
}

TEST(RockBridges, RegionsThatShareAFaceToRounding)
{
	const HalfSpaces lower = box(1, 1, Real(0.1) * 3);
	HalfSpaces       upper = moved(box(1, 1, Real(0.5)), Matrix3::Identity(), Vector3(0, 0, Real(0.8)));
	for (std::size_t i = 0; i < upper.size(); ++i)
		if (upper.normals[i][2] < 0) upper.offsets[i] = -Real(0.3) - Real(1e-15);
	EXPECT_NE(Real(0.1) * 3, Real(0.3) + Real(1e-15));
	EXPECT_EQ(cutByJoints({ lower, upper }, {}, clumps).bodies, std::vector<int>({ 0, 0 }));
	EXPECT_EQ(cutByJoints({ upper, lower }, {}, clumps).bodies, std::vector<int>({ 0, 0 }));
}

/// Two halves of one joint whose planes differ by less than what is cut: together they divide the block.
TEST(RockBridges, JointsThatDifferByTheDigitsOfAFileAreOne)
{
	std::vector<FiniteJoint> joints { rectangle(2, { -1, 0, 0 }, 1, 2), rectangle(2, { 1, 0, 0 }, 1, 2) };
	for (Real angle : { 0., 1e-10, 4e-10, 1e-9, 5e-9, 1e-7, 1e-4 }) {
		joints[1].plane.normal = Vector3(-angle, 0, 1).normalized(); // about the common edge
		EXPECT_EQ(partsOf(cutByJoints({ box(1, 1, 2) }, joints, clumps), 16).size(), 2u) << angle;
	}
}

TEST(RockBridges, RefusesMoreBlocksThanAllowed)
{
	std::vector<FiniteJoint> joints;
	for (int k = 0; k < 3; ++k)
		joints.push_back({ { Vector3::Unit(k), 0 }, Vector3::Zero(), 0, {} });
	EXPECT_EQ(cutByJoints({ box(1, 1, 1) }, joints, { 0, -1, 8 }).blocks.size(), 8u);
	EXPECT_TRUE(says(refusal([&] { cutByJoints({ box(1, 1, 1) }, joints, { 0, -1, 7 }); }), "jointSets: they cut more than 7 blocks"));
}

/// Twenty slabs, each cut by 50 joints, are 1000 trials.
TEST(RockBridges, PersistenceIsTheShareOfBlocksThatAreCut)
{
	std::vector<FiniteJoint> joints;
	for (int k = 1; k < 20; ++k)
		joints.push_back({ { Vector3::UnitZ(), Real(k) / 10 - 1 }, Vector3::Zero(), 0, {} });
	for (int k = 1; k <= 50; ++k)
		joints.push_back({ { Vector3::UnitX(), Real(k) / Real(25.5) - 1 }, Vector3::Zero(), 0, {}, Real(0.3) });
	const auto rock = cutByJoints({ box(1, 1, 1) }, joints, { 0, -1, 100000, 3 });
	EXPECT_NEAR(Real(rock.blocks.size()), 20 + 300, 4 * 14.5); // standard deviation √(1000 · 0.3 · 0.7)
	EXPECT_EQ(cutByJoints({ box(1, 1, 1) }, joints, { 0, -1, 100000, 3 }).blocks.size(), rock.blocks.size());
}

} // namespace
