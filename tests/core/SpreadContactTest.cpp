// SPDX-License-Identifier: GPL-2.0-or-later
//
// Contact of cores with margins: closed forms, and the force as the gradient of its energy.
#include "contact/SpreadContact.hpp"

#include "contact/PairDistance.hpp"
#include "shape/ClosestPoint.hpp"
#include "shape/DistanceTolerances.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <random>

using namespace polytope;

namespace {

std::shared_ptr<const ConvexShape> cuboid(Real x, Real y, Real z)
{
	HalfSpaces planes;
	const Real half[3] = { x, y, z };
	for (int k = 0; k < 3; ++k)
		for (int sign : { -1, 1 }) {
			planes.normals.push_back(sign * Vector3::Unit(k));
			planes.offsets.push_back(half[k]);
		}
	return ConvexShape::shared(planes, 0);
}

Matrix3 turned(const Vector3& by)
{
	const Real angle = by.norm();
	return angle > 0 ? Eigen::AngleAxis<Real>(angle, by / angle).toRotationMatrix() : Matrix3(Matrix3::Identity());
}

const Real margin = 0.1; ///< of each

/// A cuboid, 2a × 2b at its foot, over a floor. Its pose: from that in which it lies on it flush, `depth` deep, turned about the middle of its foot.
struct OnFloor {
	std::shared_ptr<const ConvexShape> floor, block;
	Real                               half[3];

	SpreadContact contact(Real depth, const Vector3& turn, const Vector3& shift, Real* deepest = nullptr) const
	{
		const Matrix3 rotation = turned(turn);
		const Vector3 foot(shift[0], shift[1], shift[2] + 2 * margin - depth), centre = foot + rotation * Vector3(0, 0, half[2]);
		const auto    way  = pairDistance({ *floor, Matrix3::Identity(), *block, rotation, centre });
		const Real    most = 2 * margin - way.distance;
		if (deepest) *deepest = most;
		return spreadContact({ floor.get(), Vector3::Zero(), Matrix3::Identity(), Vector3::Zero() },
		        { block.get(), centre, rotation, Vector3::Zero() }, way.normal, way.point[0], most);
	}
	Real energy(Real depth, const Vector3& turn, const Vector3& shift) const
	{
		const Real closure = contact(depth, turn, shift).closure;
		return closure * closure / 2;
	}
};

OnFloor onHalfSpace(Real a, Real b, Real c) { return { ConvexShape::halfSpace(Vector3(0, 0, 1), 3), cuboid(a, b, c), { a, b, c } }; }

TEST(SpreadContact, OfAFlushFaceActsInItsMiddle)
{
	const auto          pair  = onHalfSpace(0.5, 0.3, 0.2);
	const SpreadContact found = pair.contact(1e-3, Vector3::Zero(), Vector3(3, 4, 0));
	EXPECT_NEAR(found.closure, 1e-3, 1e-15);
	EXPECT_NEAR(found.slope, 1, 1e-12);
	EXPECT_NEAR((found.point - Vector3(3, 4, 0)).norm(), 0, 1e-12);
	ASSERT_EQ(found.outline.size(), 4u);
	for (const Vector2& corner : found.outline)
		EXPECT_NEAR(corner.norm(), sqrt(Real(0.34)), 1e-12);
}

TEST(SpreadContact, OfFacesThatShareAPartActsInTheMiddleOfThat)
{
	const OnFloor       bricks { cuboid(1, 1, 1), cuboid(0.5, 0.5, 0.5), { 0.5, 0.5, 0.5 } };
	const SpreadContact found = bricks.contact(1e-3, Vector3::Zero(), Vector3(0.75, 0, 1));
	EXPECT_NEAR((found.point - Vector3(0.625, 0, 1)).norm(), 0, 1e-12);
	EXPECT_EQ(found.outline.size(), 4u);
}

TEST(SpreadContact, TiltsAsTheSpringOfAFace)
{
	// where all of it touches: D = h + 2 t²/h with t² the mean square of the tilt's rise, so the moment is 4 k ⟨x²⟩ θ
	const Real          a = 0.5, h = 1e-3, tilt = 1e-5;
	const auto          pair  = onHalfSpace(a, 0.3, 0.2);
	const SpreadContact found = pair.contact(h, Vector3(0, tilt, 0), Vector3::Zero());
	const Real          force = found.closure * found.slope;
	EXPECT_NEAR(force * found.point[0] / (4 * a * a / 3 * tilt), 1, 1e-4);
	EXPECT_NEAR(found.point[1], 0, 1e-12);
}

TEST(SpreadContact, BesideAFaceIsThatOfItsEdgeThenOfTheNearestPoint)
{
	const auto pair = onHalfSpace(0.5, 0.3, 0.2);
	for (const Real tilt : { Real(0.004), Real(0.2), Real(0.7) }) {
		Real                deepest;
		const Real          lift  = 0.5 * sin(tilt); // its edge is 1e-4 deep
		const SpreadContact found = pair.contact(Real(1e-4) - lift, Vector3(0, tilt, 0), Vector3::Zero(), &deepest);
		EXPECT_NEAR(deepest, 1e-4, 1e-14);
		const Real part = tilt > Real(tolerance::parallelFeatures) ? Real(1) : Real(0.75);
		EXPECT_NEAR(found.closure / deepest, part, 1e-2);
		EXPECT_NEAR(found.slope, part, 1e-2);
		EXPECT_NEAR(found.point[0], 0.5 * cos(tilt), 1e-3); // the edge
		EXPECT_NEAR(found.point[1], 0, 1e-9);               // its middle
	}
}

/// Force and moment from differences of the energy, over the stiffness.
void expectGradient(const OnFloor& pair, Real depth, const Vector3& turn, const Vector3& shift, Real within)
{
	const SpreadContact found = pair.contact(depth, turn, shift);
	const Real          force = found.closure * found.slope, step = 1e-8;
	const auto          energy = [&](const Vector3& more, const Vector3& moved) {
                // turned in the world about the middle of the foot
                const Eigen::AngleAxis<Real> all(turned(more) * turned(turn));
                return pair.energy(depth, all.angle() * all.axis(), shift + moved);
	};
	const Vector3 from   = found.point - Vector3(shift[0], shift[1], found.point[2]);
	const Vector3 moment = from.cross(Vector3(0, 0, force));
	EXPECT_NEAR((energy(Vector3::Zero(), Vector3(0, 0, -step)) - energy(Vector3::Zero(), Vector3(0, 0, step))) / (2 * step) / force, 1,
	        1e-5);
	for (int k = 0; k < 2; ++k) {
		const Vector3 more = step * Vector3::Unit(k);
		EXPECT_NEAR(
		        (energy(-more, Vector3::Zero()) - energy(more, Vector3::Zero())) / (2 * step) / force, moment[k] / force, within)
		        << "axis " << k;
	}
}

/// Tilts from a thousandth of that at which a side parts to three times the angle beyond which nothing is parallel.
void expectGradients(const OnFloor& pair, Real level)
{
	std::mt19937_64                      random(3);
	std::uniform_real_distribution<Real> any(-1, 1);
	for (int trial = 0; trial < 400 && !testing::Test::HasFailure(); ++trial) {
		const Real    tilt = 2e-6 * pow(Real(10), Real(2.6) * (1 + any(random)));
		const Vector3 turn = tilt * Vector3(any(random), trial % 4 ? any(random) : Real(0), 0);
		SCOPED_TRACE(testing::Message() << trial << " turn " << turn.transpose());
		Real deepest;
		pair.contact(0, turn, Vector3(0.1, 0.2, level), &deepest);
		const Real depth = 5e-3;
		expectGradient(pair, depth - deepest, turn, Vector3(0.1, 0.2, level), 1e-5 + 0.01 * turn.norm());
	}
}

TEST(SpreadContact, ForceIsTheGradientOfTheEnergy)
{
	expectGradients(onHalfSpace(0.5, 0.3, 0.2), 0);
	expectGradients({ cuboid(2, 2, 1), cuboid(0.5, 0.3, 0.2), { 0.5, 0.3, 0.2 } }, 1);
}

/// Two segments with margins: `way` of the second, from (0.25, 0, 0.2 − depth) plus the shift.
SpreadContact ofSegments(const Vector3& way2, const Vector3& shift, Real depth)
{
	const CoreInPlace one { nullptr, Vector3::Zero(), Matrix3::Identity(), Vector3(1, 0, 0) };
	const CoreInPlace other { nullptr, Vector3(Vector3(0.25, 0, 0.2 - depth) + shift), Matrix3::Identity(), way2 };
	const Vector2     along = closestOnSegments(one.origin, one.way, other.origin, other.way);
	const Vector3     from = along[0] * one.way, way = other.origin + along[1] * other.way - from;
	const Real        deepest = 2 * margin - way.norm();
	return spreadContact(one, other, way.normalized(), from, deepest);
}

TEST(SpreadContact, OfParallelSegmentsActsWhereTheyLieBesideEachOther)
{
	const Real          depth = 1e-3;
	const SpreadContact flush = ofSegments(Vector3(2, 0, 0), Vector3::Zero(), depth);
	EXPECT_NEAR(flush.closure, depth, 1e-14);
	EXPECT_NEAR((flush.point - Vector3(0.625, 0, 0)).norm(), 0, 1e-10);
	ASSERT_EQ(flush.outline.size(), 2u); // the ends of that
	EXPECT_NEAR((flush.outline[0] - flush.outline[1]).norm(), 0.75, 1e-9);
	EXPECT_NEAR((flush.outline[0] + flush.outline[1]).norm(), 0, 1e-9);
	// tilted by θ about their middle: of springs along 0.75 m the moment is 4 k L²/12 θ
	const Real          tilt    = 1e-5;
	const SpreadContact leaning = ofSegments(Vector3(2, 0, 2 * tilt), Vector3(0, 0, -0.375 * tilt), depth);
	EXPECT_NEAR(leaning.closure * leaning.slope * (leaning.point[0] - 0.625) / (-4 * 0.75 * 0.75 / 12 * tilt), 1, 1e-3);
	// crossed at a right angle
	const SpreadContact crossed = ofSegments(Vector3(0, 1, 0), Vector3(0, -0.3, 0), depth);
	EXPECT_EQ(crossed.slope, 1);
	EXPECT_TRUE(crossed.outline.empty());
	EXPECT_NEAR((crossed.point - Vector3(0.25, 0, 0)).norm(), 0, 1e-12);
}

TEST(SpreadContact, OfASegmentOnAFaceActsInTheMiddleOfWhatLiesOnIt)
{
	const auto          block = cuboid(0.5, 0.5, 0.5);
	const CoreInPlace   segment { nullptr, Vector3(-0.25, 0.1, 0.5 + 0.1 - 1e-3), Matrix3::Identity(), Vector3(2, 0, 0) };
	const CoreInPlace   core { block.get(), Vector3::Zero(), Matrix3::Identity(), Vector3::Zero() };
	const SpreadContact found = spreadContact(core, segment, Vector3(0, 0, 1), Vector3(0.5, 0.1, 0.5), 1e-3);
	EXPECT_NEAR(found.closure, 1e-3, 1e-15);
	EXPECT_NEAR((found.point - Vector3(0.125, 0.1, 0.5)).norm(), 0, 1e-12);
	ASSERT_EQ(found.outline.size(), 2u);
	EXPECT_NEAR((found.outline[0] - found.outline[1]).norm(), 0.75, 1e-12);
	// the same with the bodies exchanged
	const SpreadContact other = spreadContact(segment, core, Vector3(0, 0, -1), Vector3(0.5, 0.1, 0.599), 1e-3);
	EXPECT_NEAR((other.point - Vector3(0.125, 0.1, 0.599)).norm(), 0, 1e-12);
}

/// A floor, whole or as pieces that lie flush.
TEST(SpreadContact, OnFlushPiecesIsThatOnOne)
{
	const auto                           floor = cuboid(2, 2, 1), left = cuboid(1, 2, 1);
	const auto                           block   = cuboid(0.5, 0.3, 0.2);
	const FaceCorners                    faces[] = { { Vector3(-2, -2, 1), Vector3(0, -2, 1), Vector3(0, 2, 1), Vector3(-2, 2, 1) },
		                   { Vector3(0, -2, 1), Vector3(2, -2, 1), Vector3(2, 2, 1) }, { Vector3(0, -2, 1), Vector3(2, 2, 1), Vector3(0, 2, 1) } };
	const std::vector<FaceCorners>       pieces(std::begin(faces), std::end(faces));
	std::mt19937_64                      random(8);
	std::uniform_real_distribution<Real> any(-1, 1);
	for (int trial = 0; trial < 200; ++trial) {
		const Real          tilt     = 2e-6 * pow(Real(10), Real(2.6) * (1 + any(random)));
		const Vector3       turn     = tilt * Vector3(any(random), any(random), 0) + Vector3(0, 0, any(random));
		const Matrix3       rotation = turned(turn);
		const Vector3       centre(0.1 + any(random) / 3, 0.1, 1 + 2 * margin + 0.2);
		const auto          way = pairDistance({ *floor, Matrix3::Identity(), *block, rotation, centre });
		const CoreInPlace   mover { block.get(), centre, rotation, Vector3::Zero() };
		const Real          depth = 5e-3;
		const SpreadContact whole = spreadContact(
		        { floor.get(), Vector3::Zero(), Matrix3::Identity(), Vector3::Zero() }, mover, way.normal, way.point[0], depth);
		const CoreInPlace parts { left.get(), Vector3(-1, 0, 0), Matrix3::Identity(), Vector3::Zero(), &pieces };
		for (const bool swapped : { false, true }) {
			const SpreadContact found = swapped ? spreadContact(mover, parts, -way.normal, way.point[1], depth)
			                                    : spreadContact(parts, mover, way.normal, way.point[0], depth);
			EXPECT_NEAR(found.closure / whole.closure, 1, 1e-9);
			EXPECT_NEAR(found.slope, whole.slope, 1e-9);
			EXPECT_NEAR((found.point - whole.point).head<2>().norm(), 0, 1e-8) << trial;
		}
	}
}

} // namespace
