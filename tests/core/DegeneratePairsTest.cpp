// SPDX-License-Identifier: GPL-2.0-or-later
//
// Pairs in which something is not unique, zero or extreme: an answer all the same, and the exact one where there is one.
#include "SameAnswer.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace polytope;
using namespace polytope::samples;

namespace {

std::shared_ptr<const ConvexShape> box(Real x, Real y, Real z, Real cornerRadius = 0.1)
{
	return ConvexShape::shared(cuboid(x, y, z), cornerRadius);
}

Pair pairOf(std::shared_ptr<const ConvexShape> one, std::shared_ptr<const ConvexShape> two, const Vector3& centre2)
{
	Pair pair;
	pair.shape[0] = one;
	pair.shape[1] = two;
	pair.centre2  = centre2;
	return pair;
}

void expectUsable(const ContactResult& result)
{
	EXPECT_TRUE(finite(result));
	EXPECT_TRUE(result.inContact && result.hasGeometry) << statusName(result.status);
	EXPECT_NEAR(result.normal.norm(), 1, 1e-14);
	EXPECT_GT(result.depth, 0);
	EXPECT_TRUE(answered(result.status) || result.status == ContactStatus::NoDirection) << statusName(result.status);
}

TEST(DegeneratePairs, CoincidentBodies)
{
	std::mt19937_64 random(400);
	for (int faces : { 4, 6, 8, 12, 20 })
		for (Real cornerRadius : { 0., 0.1, 0.3 })
			for (int trial = 0; trial < 10; ++trial) {
				const auto          solid  = ConvexShape::shared(regularSolid(faces, 1), cornerRadius);
				const ContactResult result = query(turned(pairOf(solid, solid, Vector3::Zero()), randomRotation(random)));
				expectUsable(result);
				EXPECT_LE(result.point.norm(), 1e-14);
				EXPECT_NEAR(result.infeasibility, -solid->inscribedRadius(), 1e-14);
				EXPECT_TRUE(result.status == ContactStatus::NoDirection || result.status == ContactStatus::NormalFromDual)
				        << statusName(result.status);
			}
}

TEST(DegeneratePairs, OneInsideTheOther)
{
	std::mt19937_64 random(401);
	for (int trial = 0; trial < 200; ++trial) {
		const Real size  = decades(random, -3, 0);
		const auto outer = ConvexShape::shared(regularSolid(12, 10), 1),
		           inner = ConvexShape::shared(regularSolid(20, size), Real(0.1) * size);
		Pair pair        = pairOf(outer, inner, trial % 3 ? 5 * randomDirection(random) : Vector3(Vector3::Zero()));
		for (Matrix3& rotation : pair.rotation)
			rotation = randomRotation(random);
		for (const Pair& order : { pair, swapped(pair) }) {
			const ContactResult result = query(order);
			expectUsable(result);
			EXPECT_NEAR(result.infeasibility, -inner->inscribedRadius(), 1e-14);
		}
	}
}

TEST(DegeneratePairs, StackedBlocksAreExact)
{
	for (int axis = 0; axis < 3; ++axis)
		for (Real side : { -1., 1. })
			for (Real overlap : { 0.125, 0x1p-10, 0x1p-30, 0x1p-40 })
				for (Real aside : { 0., 0.5, 1.5 }) {
					Vector3 centre2            = Vector3::Zero();
					centre2[axis]              = side * (2 - overlap);
					centre2[(axis + 1) % 3]    = aside;
					const ContactResult result = query(pairOf(box(1, 1, 1, 0.125), box(1, 1, 1, 0.125), centre2));
					expectUsable(result);
					EXPECT_NEAR(result.infeasibility, -overlap / 2, 1e-16);
					// sides a length ℓ away turn the normal by (overlap/2ℓ)³ at the most, and the chord is longer by half its square
					const Real turn = std::pow(overlap / 2 / (1 - aside / 2), 3);
					EXPECT_NEAR(result.depth, overlap, 1e-15 + overlap * turn * turn / 2);
					EXPECT_LE((result.normal - side * Vector3::Unit(axis)).norm(), 1e-15 + turn);
					// across the face the centre is as uncertain as rounding is against the overlap
					EXPECT_LE((result.point - centre2 / 2).norm(), 1e-10 + 1e-16 / overlap);
					EXPECT_EQ(result.status, ContactStatus::Contact);
				}
}

TEST(DegeneratePairs, TouchingExactlyIsNoContact)
{
	const auto      cube = box(1, 1, 1);
	std::mt19937_64 random(402);
	for (const Vector3& centre2 :
	        { Vector3(2, 2, 2), Vector3(2, 2, 0), Vector3(2, 2, 0.5), Vector3(0, 0, 2), Vector3(0.5, -0.25, -2), Vector3(-2, 2, -2) }) {
		Pair pair = pairOf(cube, cube, centre2);
		EXPECT_EQ(query(pair).status, ContactStatus::Separated);
		EXPECT_EQ(infeasibility(pair), 0);
		for (int trial = 0; trial < 20; ++trial)
			EXPECT_EQ(query(turned(pair, randomRotation(random))).status, ContactStatus::Separated);
		ContactSettings settings;
		settings.geometryAcrossGap = true;
		const ContactResult result = query(pair, settings);
		EXPECT_TRUE(result.hasGeometry && finite(result));
		EXPECT_LE(result.depth, 0);
		EXPECT_LE((result.point - centre2 / 2).norm(), 1e-5);
	}
	// an edge on a face, a vertex on a face: 45° and 60° leave roundings
	Pair edge        = pairOf(cube, cube, Vector3(0.25, 0, 1 + std::sqrt(Real(2))));
	edge.rotation[1] = Eigen::AngleAxis<Real>(Real(M_PI) / 4, Vector3::UnitX()).toRotationMatrix();
	EXPECT_EQ(query(edge).status, ContactStatus::Separated);
	edge.centre2 *= 1 - 1e-12;
	EXPECT_EQ(query(edge).status, ContactStatus::Contact);
}

TEST(DegeneratePairs, DeeperThanTheCornerRadiusTheDualGivesTheNormal)
{
	ContactSettings settings;
	for (Real overlap : { 0.5, 0.25, 1e-3 })
		for (Real cornerRadius : { 0., overlap / 8, overlap / 4 }) {
			const ContactResult result = query(
			        pairOf(box(1, 1, 1, cornerRadius), box(1, 1, 1, cornerRadius), Vector3(0.125, 0, 2 - overlap)), settings);
			expectUsable(result);
			EXPECT_EQ(result.status, ContactStatus::NormalFromDual);
			EXPECT_LE((result.normal - Vector3::UnitZ()).norm(), 1e-14);
			EXPECT_NEAR(result.depth, overlap, 1e-14);
		}
	// deeper than one body's radius alone
	const ContactResult one = query(pairOf(box(1, 1, 1, 0.5), box(1, 1, 1, 0), Vector3(0.125, 0, 1.75)), settings);
	EXPECT_EQ(one.status, ContactStatus::NormalFromOneBody);
	EXPECT_LE((one.normal - Vector3::UnitZ()).norm(), 1e-14);
	// one body has no gradient, and the one that has a gradient has no weight
	settings.normalWeight[0]       = 0;
	const ContactResult weightless = query(pairOf(box(1, 1, 1, 0.5), box(1, 1, 1, 0), Vector3(0.125, 0, 1.75)), settings);
	expectUsable(weightless);
	EXPECT_LE((weightless.normal - Vector3::UnitZ()).norm(), 1e-14);
}

TEST(DegeneratePairs, GradientsThatCancel)
{
	// a cube's centre on the other's, rounded to the core: each body's gradient is zero by symmetry
	const ContactResult same = query(pairOf(box(1, 1, 1, 1.5), box(1, 1, 1, 1.5), Vector3::Zero()));
	expectUsable(same);
	// the small one protrudes from the big one: opposite gradients do not add up to zero
	const ContactResult through = query(pairOf(box(1, 1, 1, 0.5), box(Real(0.1), Real(0.1), 3, 0), Vector3(Real(0.8), 0, 0)));
	expectUsable(through);
}

TEST(DegeneratePairs, PlatesAndNeedles)
{
	const auto plate = box(1, 1, 0.5e-6, 1e-7), needle = box(1, 0.5e-6, 0.5e-6, 1e-7);
	// face on face
	ContactResult result = query(pairOf(plate, plate, Vector3(0.5, -0.25, 0x1p-20)));
	expectUsable(result);
	EXPECT_NEAR(result.depth, 1e-6 - 0x1p-20, 1e-15);
	EXPECT_LE((result.normal - Vector3::UnitZ()).norm(), 1e-12);
	EXPECT_LE((result.point - Vector3(0.25, -0.125, 0x1p-21)).norm(), 1e-8);
	// edge through edge of two crossed needles
	Pair crossed        = pairOf(needle, needle, Vector3(0.25, -0.125, 0.5e-6));
	crossed.rotation[1] = Eigen::AngleAxis<Real>(Real(M_PI) / 2, Vector3::UnitZ()).toRotationMatrix();
	result              = query(crossed);
	expectUsable(result);
	EXPECT_NEAR(result.depth, 0.5e-6, 1e-15);
	EXPECT_LE((result.point - Vector3(0.25, 0, 0.25e-6)).norm(), 1e-12);
	// a plate that cuts through a block, however turned
	std::mt19937_64 random(403);
	for (int trial = 0; trial < 100; ++trial) {
		Pair pair = pairOf(trial % 2 ? plate : needle, box(1, 1, 1), Real(0.7) * randomDirection(random));
		for (Matrix3& rotation : pair.rotation)
			rotation = randomRotation(random);
		expectUsable(query(pair));
		expectUsable(query(swapped(pair)));
	}
}

TEST(DegeneratePairs, BlocksOfAWallMeetAlongTheirEdges)
{
	// two axes thin at once, and the third long
	std::mt19937_64 random(404);
	for (Real overlap1 : { 1e-3, 1e-8, 1e-12 })
		for (Real overlap2 : { 1e-3, 1e-8, 1e-12 }) {
			const Pair pair = pairOf(box(1, 1, 1), box(1, 1, 1), Vector3(0.5, 2 - overlap1, 2 - overlap2));
			for (int trial = 0; trial < 20; ++trial) {
				const Matrix3       rotation = randomRotation(random);
				const ContactResult result   = query(turned(pair, rotation));
				expectUsable(result);
				EXPECT_LE((rotation.transpose() * result.point - pair.centre2 / 2).norm(),
				        1e-9 + 1e-15 / std::min(overlap1, overlap2));
			}
		}
}

TEST(DegeneratePairs, HalfSpaceAsAWall)
{
	// z ≤ 0, and a cube δ deep in it: along z 1/(−z) + 1/(2 − δ − z) = 1/(z + δ)
	const Real delta = 0.0625;
	const Pair pair  = pairOf(ConvexShape::halfSpace(Vector3::UnitZ(), 3), box(1, 1, 1, 0.5), Vector3(0.25, -0.5, 1 - delta));
	for (bool first : { true, false }) {
		ContactResult result = query(first ? pair : swapped(pair));
		expectUsable(result);
		if (!first) {
			result.point += pair.centre2;
			result.normal = -result.normal;
		}
		EXPECT_NEAR(result.infeasibility, -delta / 2, 1e-15);
		EXPECT_LE((result.normal - Vector3::UnitZ()).norm(), 1e-15);
		EXPECT_NEAR(result.depth, delta, 1e-15);
		const Real z = result.point.z();
		EXPECT_NEAR(1 / (2 - delta - z) - 1 / z - 1 / (z + delta), 0, 1e-7);
		EXPECT_LE((result.point.head<2>() - pair.centre2.head<2>()).norm(), 1e-14);
	}
	EXPECT_EQ(query(movedApart(pair, 2 * delta * Vector3::UnitZ())).status, ContactStatus::Separated);
}

TEST(DegeneratePairs, PosesThatAreNoNumbersAreNoContact)
{
	for (ContactModel model : { ContactModel::Boon2012, ContactModel::Spring })
		for (Real gap : { Real(0.05), Real(-0.05) })
			for (Real none : { std::numeric_limits<Real>::quiet_NaN(), std::numeric_limits<Real>::infinity() })
				for (int spoiled = 0; spoiled < 3; ++spoiled)
					for (bool warm : { false, true }) {
						ContactSettings settings;
						settings.contactModel = model;
						Pair       pair       = pairOf(box(1, 1, 1), box(1, 1, 1), Vector3(0.25, -0.5, 2 + gap));
						PairMemory memory;
						if (warm) query(pair, settings, &memory);
						if (spoiled < 2) pair.rotation[spoiled](2, 1) = none;
						else pair.centre2[1] = none;
						for (int step = 0; step < 2; ++step) {
							const ContactResult result = query(pair, settings, &memory);
							EXPECT_EQ(result.status, ContactStatus::Failed);
							EXPECT_FALSE(result.inContact || result.hasGeometry || memory.hasBasis
							        || memory.hasPoint);
						}
					}
}

} // namespace
