// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact/MeanDepth.hpp"
#include "PlaneRows.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace polytope;
using namespace polytope::samples;

namespace {

ContactResult meanQuery(const Pair& pair, DepthRule rule = DepthRule::Mean)
{
	ContactSettings settings;
	settings.depthRule = rule;
	return query(pair, settings);
}

/// Force over the stiffness per area: the overlap's volume (2-D: area), along the normal.
Real volumeOf(const ContactResult& result) { return result.depth * result.area; }

/// A body on a floor whose surface is z = 0 (2-D: y = 0), under which it reaches `deep`.
Pair onFloor(const std::shared_ptr<const ConvexShape>& body, const Matrix3& rotation, Real deep)
{
	const int up = body->dimension() - 1;
	Pair      pair;
	pair.shape[0]    = up == 1 ? ConvexShape::shared(rectangle(3, 1), Real(0.1)) : ConvexShape::shared(cuboid(3, 3, 1), Real(0.1));
	pair.shape[1]    = body;
	pair.rotation[1] = rotation;
	Real lowest      = 0;
	for (const Vector3& vertex : body->polyhedron().vertices)
		lowest = std::min(lowest, (rotation * vertex)[up]);
	pair.centre2     = Vector3::Zero();
	pair.centre2[up] = 1 - deep - lowest;
	return pair;
}

Vector3 axis(int k)
{
	Vector3 one = Vector3::Zero();
	one[k]      = 1;
	return one;
}

Matrix3 turned(const Vector3& about, Real angle) { return Eigen::AngleAxis<Real>(angle, about.normalized()).toRotationMatrix(); }

TEST(MeanDepth, CutOutOfABodyOrOutOfABoxTheOverlapIsTheSame)
{
	std::mt19937_64                                 random(31);
	std::vector<std::shared_ptr<const ConvexShape>> shapes { ConvexShape::shared(cuboid(1, 1, 1), Real(0.1)) };
	for (int faces : { 8, 12, 20 }) // of an octahedron and an icosahedron more planes than three meet at a vertex
		shapes.push_back(ConvexShape::shared(regularSolid(faces, 1), Real(0.1)));
	for (int faces : { 5, 20, 100, 250, 400 })
		shapes.push_back(ConvexShape::shared(randomPlanes(faces, random, 3), Real(0.1)));
	for (int trial = 0; trial < 600; ++trial) {
		Pair pair;
		for (auto& shape : pair.shape)
			shape = shapes[random() % shapes.size()];
		for (Matrix3& rotation : pair.rotation)
			rotation = trial % 3 > 0 ? randomRotation(random) : Matrix3::Identity();
		moveTo(pair, trial % 2 > 0 ? randomDirection(random) : axis(trial % 3), -decades(random, -6, 0) * pair.inscribedRadius());
		const ContactResult mean = meanQuery(pair);
		ContactSettings     fromBox;
		fromBox.contactPoint      = ContactPoint::Centroid;
		const ContactResult other = query(pair, fromBox);
		EXPECT_LE((mean.point - other.point).norm(), 1e-9 * pair.size()) << trial;
	}
}

// The nearest plane counts, not the last: the second one here is nearer along its own normal, and further along n.
TEST(MeanDepth, DistanceFromFaceIsToTheNearestPlane)
{
	const Vector3 up = Vector3::UnitZ(), oblique(Real(0.8), 0, Real(0.6));
	for (bool first : { true, false }) {
		const HalfSpaces lower { first ? std::vector<Vector3> { up, oblique } : std::vector<Vector3> { oblique, up },
			first ? std::vector<Real> { 0.1, 0.07 } : std::vector<Real> { 0.07, 0.1 }, 3 };
		const HalfSpaces         upper { { -up, -oblique }, { 0.05, 0.02 }, 3 };
		const PlaneRows<Real, 3> rows(lower, upper);
		const Real               x[] = { 0, 0, 0 }, n[] = { 0, 0, 1 };
		EXPECT_NEAR((distanceFromFace<Real, 3, 1>(rows.planes, x, n)), 0.1, 1e-15);
		EXPECT_NEAR((distanceFromFace<Real, 3, 2>(rows.planes, x, n)), 0.1, 1e-15); // both planes in one vector
	}
}

TEST(MeanDepth, OfTwoFacesIsTheirDistance)
{
	Pair pair;
	pair.shape[0] = pair.shape[1] = ConvexShape::shared(cuboid(1, 1, 1), Real(0.1));
	for (Real overlap : { 1e-3, 1e-6, 1e-9, 1e-12 }) {
		pair.centre2               = Vector3(Real(0.5), Real(-0.25), 2 - overlap);
		const ContactResult result = meanQuery(pair);
		EXPECT_NEAR(result.depth / overlap, 1, 1e-12 + 1e-15 / overlap); // the normal leans by (overlap / 2 ℓ)³
		EXPECT_NEAR(result.area, 1.5 * 1.75, 1e-12);
		EXPECT_NEAR(result.energy / (overlap * overlap / 2), 1, 1e-12 + 1e-15 / overlap);
		EXPECT_LE((result.point - pair.centre2 / 2).norm(), 1e-14 + 1e-16 / overlap) << overlap;
	}
}

TEST(MeanDepth, OfATiltedFaceHasItsForceAtTheCentreOfPressure)
{
	// a cube of side 2 tilted by θ about y: the part of its square cross-section below the floor, a trapezium, or a triangle once it has lifted off
	const auto cube = ConvexShape::shared(cuboid(1, 1, 1), Real(0.1));
	for (Real theta : { 1e-3, 1e-2, 0.2 })
		for (Real part : { 0.3, 1.0, 2.5 }) { // of the depth at which the whole face is under the floor
			const Real deep = part * 2 * std::sin(theta);
			if (deep > 0.5) continue;
			const Pair           pair = onFloor(cube, turned(axis(1), theta), deep);
			std::vector<Vector3> square, below;
			for (const Vector3& corner : { Vector3(-1, 0, -1), Vector3(1, 0, -1), Vector3(1, 0, 1), Vector3(-1, 0, 1) })
				square.push_back(pair.rotation[1] * corner + pair.centre2 - axis(2));
			for (std::size_t k = 0; k < square.size(); ++k) {
				const Vector3 &from = square[k], &to = square[(k + 1) % square.size()];
				if (from[2] < 0) below.push_back(from);
				if ((from[2] < 0) != (to[2] < 0)) below.push_back(from + from[2] / (from[2] - to[2]) * (to - from));
			}
			Real    area   = 0;
			Vector3 moment = Vector3::Zero();
			for (std::size_t k = 1; k + 1 < below.size(); ++k) {
				const Real one = (below[k] - below[0]).cross(below[k + 1] - below[0])[1] / 2;
				area += one;
				moment += one * (below[0] + below[k] + below[k + 1]) / 3;
			}
			const ContactResult result = meanQuery(pair);
			EXPECT_NEAR(volumeOf(result) / std::abs(2 * area), 1, 1e-11) << theta << ' ' << part;
			EXPECT_LE((result.point - axis(2) - moment / area).norm(), 1e-11) << theta << ' ' << part;
		}
}

TEST(MeanDepth, PiecesOfAFloorGiveTogetherWhatTheWholeGives)
{
	std::mt19937_64 random(31);
	for (int trial = 0; trial < 200; ++trial) {
		const auto          body  = ConvexShape::shared(randomPlanes(6 + int(random() % 12), random, 3), Real(0.1));
		const Matrix3       turn  = randomRotation(random, 3);
		const Real          deep  = decades(random, -5, Real(-1.5)) * body->inscribedRadius();
		Pair                whole = onFloor(body, turn, deep);
		const ContactResult one   = meanQuery(whole);
		ASSERT_TRUE(one.inContact);
		// the same floor cut along a plane x = joint through the overlap
		const Real joint  = one.point[0] + Real(0.3) * deep;
		Real       volume = 0;
		Vector3    moment = Vector3::Zero();
		for (int side = 0; side < 2; ++side) {
			const Real low = side == 0 ? Real(-3) : joint, high = side == 0 ? joint : Real(3);
			Pair       piece         = whole;
			piece.shape[0]           = ConvexShape::shared(cuboid((high - low) / 2, 3, 1), Real(0.1));
			const Vector3 away       = Vector3((low + high) / 2, 0, 0);
			piece.centre2            = whole.centre2 - away;
			const ContactResult part = meanQuery(piece);
			if (!part.inContact) continue;
			volume += volumeOf(part);
			moment += volumeOf(part) * (part.point + away);
		}
		EXPECT_NEAR(volume / volumeOf(one), 1, 1e-11 + 1e-14 / deep) << trial;
		EXPECT_LE((moment / volume - one.point).norm(), 1e-11 + 1e-14 / deep) << trial;
	}
}

TEST(MeanDepth, ForceAndMomentAreTheGradientOfTheEnergyOnAFace)
{
	std::mt19937_64 random(32);
	int             measured = 0;
	for (int trial = 0; trial < 200; ++trial) {
		const auto    body   = ConvexShape::shared(randomPlanes(6 + int(random() % 12), random, 3), Real(0.1));
		const Matrix3 turn   = randomRotation(random, 3);
		const Real    deep   = Real(1e-3) * body->inscribedRadius();
		const Pair    pair   = onFloor(body, turn, deep);
		const auto    energy = [&](const Pair& at) {
                        const ContactResult result = meanQuery(at);
                        return result.area * result.energy;
		};
		const ContactResult here  = meanQuery(pair);
		const Vector3       force = volumeOf(here) * here.normal, arm = here.point - pair.centre2;
		const Real          step = Real(1e-4) * deep;
		for (int k = 0; k < 3; ++k) {
			Pair low = pair, high = pair;
			low.centre2 -= step * axis(k);
			high.centre2 += step * axis(k);
			EXPECT_NEAR(-(energy(high) - energy(low)) / (2 * step), force[k], 1e-6 * force.norm()) << trial << ' ' << k;
			Pair       back = pair, forth = pair;
			const Real angle  = step / body->boundingRadius();
			back.rotation[1]  = turned(axis(k), -angle) * turn;
			forth.rotation[1] = turned(axis(k), angle) * turn;
			const Real moment = arm.cross(force)[k];
			EXPECT_NEAR(-(energy(forth) - energy(back)) / (2 * angle), moment, 1e-6 * force.norm() * body->boundingRadius())
			        << trial << ' ' << k;
			++measured;
		}
	}
	EXPECT_EQ(measured, 600);
}

TEST(MeanDepth, IsTheSameWithBodiesExchanged)
{
	std::mt19937_64 random(33);
	for (int trial = 0; trial < 200; ++trial) {
		Pair pair;
		for (auto& shape : pair.shape)
			shape = ConvexShape::shared(randomPlanes(4 + int(random() % 12), random, 3), Real(0.1));
		for (Matrix3& rotation : pair.rotation)
			rotation = randomRotation(random, 3);
		moveTo(pair, randomDirection(random, 3), -decades(random, -4, Real(-1)));
		const ContactResult one = meanQuery(pair), other = meanQuery(swapped(pair));
		ASSERT_TRUE(one.inContact && other.inContact);
		const Real size = std::min(pair.shape[0]->boundingRadius(), pair.shape[1]->boundingRadius());
		EXPECT_NEAR(one.depth / other.depth, 1, 1e-9) << trial;
		EXPECT_NEAR(one.area / other.area, 1, 1e-9) << trial;
		EXPECT_LE((one.point - other.point - pair.centre2).norm(), 1e-10 * size) << trial;
	}
}

TEST(MeanDepth, PerContactIsTheChordAtAVertexAndTheMeanOnAFace)
{
	const auto    cube   = ConvexShape::shared(cuboid(1, 1, 1), Real(0.1));
	const Matrix3 corner = Quaternion::FromTwoVectors(Vector3(1, 1, 1), Vector3(0, 0, -1)).toRotationMatrix();
	for (Real deep : { 1e-2, 1e-4 }) {
		for (const Matrix3& turn : { corner, turned(axis(1), Real(M_PI) / 4) }) { // on a vertex, on an edge
			const Pair pair = onFloor(cube, turn, deep);
			EXPECT_NEAR(meanQuery(pair, DepthRule::MeanOnFaces).depth / meanQuery(pair, DepthRule::Chord).depth, 1, 1e-3)
			        << deep;
		}
		const Pair          flat   = onFloor(cube, turned(axis(1), deep / 4), deep);
		const ContactResult onFace = meanQuery(flat, DepthRule::MeanOnFaces), mean = meanQuery(flat);
		EXPECT_NEAR(onFace.depth / mean.depth, 1, 1e-4);
		EXPECT_LE((onFace.point - mean.point).norm(), 1e-4);
	}
}

TEST(MeanDepth, OfPolygonsIsTheAreaOfTheirOverlap)
{
	const auto square = ConvexShape::shared(rectangle(1, 1), Real(0.1), Real(0.25));
	for (Real deep : { 1e-2, 1e-5 }) {
		// on a corner turned by 45°: a triangle of height `deep` and width 2 `deep`, centroid a third of the height below the floor
		const ContactResult corner = meanQuery(onFloor(square, turned(axis(2), Real(M_PI) / 4), deep));
		const Real          thick  = square->thickness(); // the floor's is 1
		EXPECT_NEAR(volumeOf(corner) / (deep * deep * thick), 1, 1e-12 + 1e-15 / deep);
		EXPECT_NEAR(corner.point[1], 1 - deep / 3, 1e-14);
		EXPECT_NEAR(corner.area / (thick * deep * 2), 1, 1e-12 + 1e-15 / deep);
		EXPECT_NEAR(corner.energy * corner.area / (thick * deep * deep * deep / 3), 1, 1e-11 + 1e-14 / deep);
	}
}

} // namespace
