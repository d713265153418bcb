// SPDX-License-Identifier: GPL-2.0-or-later
//
// What a query needs of its arguments, and that no memory, whatever is in it, does harm.
#include "contact/Preconditions.hpp"
#include "contact/ContactQuery.hpp"

#include "SameAnswer.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>

using namespace polytope;
using namespace polytope::samples;

namespace {

std::shared_ptr<const ConvexShape> cuboid(Real half, int dimension = 3)
{
	HalfSpaces planes;
	planes.dimension = dimension;
	for (int k = 0; k < dimension; ++k)
		for (int sign : { -1, 1 }) {
			planes.normals.push_back(sign * Vector3::Unit(k));
			planes.offsets.push_back(half);
		}
	return ConvexShape::shared(planes, 0);
}

const Matrix3 unturned = Matrix3::Identity();

TEST(Preconditions, NameTheArgument)
{
	const auto            solid = cuboid(1), flat = cuboid(1, 2), wall = ConvexShape::halfSpace(Vector3(0, 0, 1), 3);
	const Vector3         centre(0, 0, 1.9);
	const ContactSettings good;
	const auto fault = [&](const ConvexShape& other, const Matrix3& turn, const Vector3& place, const ContactSettings& settings) {
		return faultOf({ *solid, unturned, other, turn, place }, settings);
	};
	const auto starts = [](const std::string& text, const std::string& start) { return text.substr(0, start.size()) == start; };
	EXPECT_EQ(fault(*solid, unturned, centre, good), "");
	EXPECT_EQ(fault(*wall, unturned, centre, good), "");
	EXPECT_TRUE(starts(fault(*flat, unturned, centre, good), "shape2: a polygon and a polyhedron"));
	EXPECT_TRUE(starts(faultOf({ *wall, unturned, *wall, unturned, centre }, good), "shape2: two half-spaces"));
	for (const Vector3& normal : { Vector3(0, 0, 0), Vector3(0, 0, 2), Vector3(0, 0, std::numeric_limits<Real>::quiet_NaN()) }) {
		const auto slanted = ConvexShape::halfSpace(normal, 3);
		EXPECT_TRUE(starts(fault(*slanted, unturned, centre, good), "shape2: the normal of a half-space must be a unit vector"));
		EXPECT_TRUE(starts(faultOf({ *slanted, unturned, *solid, unturned, centre }, good), "shape1: the normal of a half-space"));
	}
	const Vector3 aslant = Vector3(0, 0.6, 0.8);
	EXPECT_EQ(fault(*ConvexShape::halfSpace(aslant, 3), unturned, centre, good), "");
	EXPECT_TRUE(starts(faultOf({ *flat, unturned, *ConvexShape::halfSpace(aslant, 2), unturned, centre }, good), "shape2: the normal"));
	EXPECT_TRUE(starts(fault(*solid, 2 * unturned, centre, good), "rotation2: must be a rotation matrix"));
	EXPECT_TRUE(starts(fault(*solid, -unturned, centre, good), "rotation2"));
	Matrix3 tilted;
	tilted << 1, 0, 0, 0, 0, -1, 0, 1, 0;
	EXPECT_EQ(fault(*solid, tilted, centre, good), "");
	EXPECT_TRUE(
	        starts(faultOf({ *flat, tilted, *flat, unturned, centre }, good), "rotation1: must be the matrix of a rotation about z"));
	EXPECT_TRUE(starts(fault(*solid, unturned, Vector3(0, std::numeric_limits<Real>::quiet_NaN(), 0), good), "centre2"));
	ContactSettings bad = good;
	bad.contactModel    = ContactModel(3);
	EXPECT_EQ(fault(*solid, unturned, centre, bad), "contactModel: must be one of ContactModel");
	bad              = good;
	bad.contactPoint = ContactPoint(-1);
	EXPECT_EQ(fault(*solid, unturned, centre, bad), "contactPoint: must be one of ContactPoint");
	bad        = good;
	bad.solver = CentreSolver(2);
	EXPECT_EQ(fault(*solid, unturned, centre, bad), "solver: must be one of CentreSolver");
	bad           = good;
	bad.tolerance = std::numeric_limits<Real>::quiet_NaN();
	EXPECT_TRUE(starts(fault(*solid, unturned, centre, bad), "tolerance: must be at least 0 and below 1"));
	bad                 = good;
	bad.newtonTolerance = -1;
	EXPECT_TRUE(starts(fault(*solid, unturned, centre, bad), "newtonTolerance: must lie between "));
	bad                 = good;
	bad.normalWeight[0] = bad.normalWeight[1] = 0;
	EXPECT_TRUE(starts(fault(*solid, unturned, centre, bad), "normalWeight"));
	InternalPlanes internal;
	internal.add(1, 6);
	bad          = good;
	bad.internal = &internal;
	EXPECT_TRUE(starts(fault(*solid, unturned, centre, bad), "settings.internal: shape2 has no plane 6"));
	for (const Plane& plane : { Plane { Vector3(0, 0, 2), 1 }, Plane { Vector3(0, 0, 1), std::numeric_limits<Real>::infinity() } }) {
		InternalPlanes ends;
		ends.add(0, 5);
		ends.addEnd(0, plane);
		bad.internal = &ends;
		EXPECT_TRUE(starts(fault(*solid, unturned, centre, bad),
		        "settings.internal: planes of the solid of shape1 must have unit normals and finite offsets"));
	}
	InternalPlanes without;
	without.radius[1] = 0;
	bad.internal      = &without;
	EXPECT_TRUE(
	        starts(fault(*solid, unturned, centre, bad), "settings.internal: the radius of the overlap about shape2 must be positive"));
	InternalPlanes farther; // as far as infinity
	farther.add(0, 5);
	farther.add(1, 0);
	farther.addEnd(1, { Vector3(0, 1, 0), 1 });
	bad.internal = &farther;
	EXPECT_EQ(fault(*solid, unturned, centre, bad), "");
}

/// What is not the pair's own is not used: the answer is that without memory.
TEST(Preconditions, MemoryOfAnotherPairIsNotUsed)
{
	const auto               one = cuboid(1), other = cuboid(Real(1) / 2);
	const Vector3            centre(0, 0, 1.45);
	const std::array<int, 4> foreign[] = { { { 2000000, 2000001, 2000002, 2000003 } }, { { -20000000, -5, -7, -9 } },
		{ { 0, 1, 2, 12 } }, { { 13, 1, 2, 3 } }, { { std::numeric_limits<int>::max(), std::numeric_limits<int>::min(), 0, 0 } } };
	for (const ContactModel model : { ContactModel::Boon2012, ContactModel::Foundation, ContactModel::Spring })
		for (const auto& basis : foreign) {
			ContactSettings settings;
			settings.contactModel = model;
			ContactWorkspace workspace;
			ContactResult    cold, warm;
			PairMemory       none, memory;
			memory.hasBasis = memory.hasPoint = true;
			memory.basis                      = basis;
			contactQuery({ *one, unturned, *other, unturned, centre }, settings, none, workspace, cold);
			contactQuery({ *one, unturned, *other, unturned, centre }, settings, memory, workspace, warm);
			EXPECT_TRUE(warm.inContact);
			EXPECT_EQ(warm.depth, cold.depth);
			EXPECT_EQ(warm.point, cold.point);
		}
}

/// Matrices that flatten, stretch or mirror, as a quaternion from a script that is no unit quaternion has them: each query ends, with a status.
TEST(Preconditions, AQueryEndsWhateverTheMatrix)
{
	std::mt19937_64 random(1127);
	const Shapes    shapes  = randomShapes(30, random);
	const Real      scale[] = { 0, 0, 1, -1, 1e-9, 1e9, 1e307 };
	for (int trial = 0; trial < 2000 && !HasFailure(); ++trial) {
		SCOPED_TRACE(trial);
		Pair pair = randomPair(shapes, random);
		for (Matrix3& rotation : pair.rotation)
			for (int k = 0; k < 3; ++k)
				rotation.row(k) *= scale[random() % 7];
		ContactSettings settings;
		settings.contactModel      = ContactModel(trial % 3);
		settings.geometryAcrossGap = trial % 2;
		PairMemory memory;
		for (int step = 0; step < 2; ++step) {
			const ContactResult result = query(pair, settings, &memory);
			EXPECT_TRUE(int(result.status) >= 0 && int(result.status) < contactStatusCount);
		}
	}
}

/// Bytes at random, in part those of a true memory, without pieces, as from a file: no crash (also under sanitizers), and the depth of a
/// query without memory.
TEST(Preconditions, AnyMemoryIsSafe)
{
	std::mt19937_64 random(731);
	const Shapes    shapes   = randomShapes(30, random);
	int             contacts = 0;
	for (int trial = 0; trial < 6000 && !HasFailure(); ++trial) {
		SCOPED_TRACE(trial);
		const Pair      pair = randomPair(shapes, random);
		ContactSettings settings;
		settings.contactModel = trial % 2 ? ContactModel::Foundation : ContactModel::Boon2012;
		PairMemory memory;
		query(pair, settings, &memory);
		KeptVertices& kept  = memory.surface;
		const int     bytes = int(random() % 8);
		auto* const   at    = reinterpret_cast<unsigned char*>(&kept);
		for (int k = 0; k < bytes; ++k)
			at[random() % (trial % 3 ? 64 : sizeof kept)] = static_cast<unsigned char>(random());
		kept.bytesOfPieces = 0;
		if (trial % 4 == 0)
			for (int& code : memory.basis)
				code = int(random() % 64) - 8;
		const ContactResult cold = query(pair, settings), warm = query(pair, settings, &memory);
		if (std::abs(cold.infeasibility) < 1e-9 * pair.size()) continue;
		ASSERT_EQ(warm.inContact, cold.inContact);
		if (!cold.inContact || !answered(cold.status) || !answered(warm.status)) continue;
		++contacts;
		EXPECT_NEAR(warm.infeasibility, cold.infeasibility, 64 * tolerance::rounding * pair.reach());
		if (settings.contactModel == ContactModel::Boon2012) continue; // its depth has the centre's tolerance
		EXPECT_NEAR(warm.depth, cold.depth, 1e-6 * cold.depth);
	}
	EXPECT_GT(contacts, 1000);
}

} // namespace
