// SPDX-License-Identifier: GPL-2.0-or-later
//
// The conservative contact: its force is the gradient of its energy, it acts in overlap alone, and it depends on nothing but the
// poses.
#include "PreciseBarrier.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

using namespace polytope;
using namespace polytope::samples;

namespace {

ContactSettings conservative(Real newtonTolerance = tolerance::newton)
{
	ContactSettings settings;
	settings.contactModel    = ContactModel::Conservative;
	settings.newtonTolerance = newtonTolerance;
	return settings;
}

ContactSettings acrossGap()
{
	ContactSettings settings   = conservative();
	settings.geometryAcrossGap = true;
	return settings;
}

/// s* from −10^high to −10^low of the smaller inscribed radius.
Pair overlappingPair(const Shapes& shapes, std::mt19937_64& random, Real low, Real high)
{
	Pair pair;
	for (int body = 0; body < 2; ++body) {
		pair.shape[body]    = shapes[random() % shapes.size()];
		pair.rotation[body] = randomRotation(random, pair.shape[body]->dimension());
	}
	moveTo(pair, randomDirection(random, pair.dimension()), -decades(random, low, high) * pair.inscribedRadius());
	return pair;
}

Matrix3 smallTurn(std::mt19937_64& random, Real angle, int dimension)
{
	const Vector3 axis = dimension == 2 ? Vector3(0, 0, 1) : randomDirection(random);
	return Eigen::AngleAxis<Real>(uniform(random, -angle, angle), axis).toRotationMatrix();
}

bool usable(ContactStatus status)
{
	return status == ContactStatus::Contact || status == ContactStatus::Separated || status == ContactStatus::RoundingLimited
	        || status == ContactStatus::NoDirection;
}

/// Force on body 2 for unit stiffness.
Vector3 force(const ContactResult& result) { return result.inContact ? Vector3(result.depth * result.normal) : Vector3(Vector3::Zero()); }

/// Rounding of a plane, over μ: the best accuracy that is possible.
Real roundingOverMu(const Pair& pair) { return tolerance::rounding * pair.reach() / (tolerance::barrier * pair.inscribedRadius()); }

class ConservativeContact : public testing::TestWithParam<int> {
protected:
	const int       dimension = GetParam();
	std::mt19937_64 random { 30000u + unsigned(dimension) };
	const Shapes    shapes = randomShapes(90, random, dimension, Real(-1));
};

INSTANTIATE_TEST_SUITE_P(
        Dimensions, ConservativeContact, testing::Values(2, 3), [](const auto& info) { return std::to_string(info.param) + "D"; });

TEST_P(ConservativeContact, ForceAndTorqueAreDifferencesOfTheEnergy)
{
	Real worstEnergy = 0, worstForce = 0, worstTorque = 0;
	int  contacts = 0;
	for (int trial = 0; trial < 250; ++trial) {
		SCOPED_TRACE("trial " + std::to_string(trial));
		const Pair          pair = overlappingPair(shapes, random, -3, Real(-0.3));
		PairMemory          memory;
		const ContactResult result = query(pair, conservative(1e-20), &memory);
		ASSERT_TRUE(usable(result.status)) << statusName(result.status);
		if (!result.inContact) continue;
		++contacts;
		PreciseBarrier here(pair, tolerance::barrier);
		here.x              = precise(result.point);
		here.s              = memory.level;
		const Quad value    = here.value();
		const Quad step     = here.mu * Quad(1e-9);
		const auto energyAt = [&](const QuadVector& move, const QuadVector& axis, const Quad& angle) {
			PreciseBarrier there = here.moved(move, axis, angle);
			const Quad     phi   = there.value();
			return Quad(2 * phi * phi);
		};
		Vector3    forceOn2 = Vector3::Zero(), torqueOn2 = Vector3::Zero();
		const Quad angle = step / Quad(pair.shape[1]->boundingRadius());
		for (int k = 0; k < 3; ++k) {
			QuadVector e {}, none {}, z { 0, 0, 1 };
			e[k] = 1;
			if (k < dimension)
				forceOn2[k] = -Real(
				        (energyAt(along(none, step, e), z, 0) - energyAt(along(none, -step, e), z, 0)) / (2 * step));
			if (dimension == 3 || k == 2)
				torqueOn2[k] = -Real((energyAt(none, e, angle) - energyAt(none, e, -angle)) / (2 * angle));
		}
		const Vector3 f = force(result), torque = (result.point - pair.centre2).cross(f);
		const Real    size = pair.size(), scale = -2 * result.barrierValue, rounding = roundingOverMu(pair);
		ASSERT_LT(value, 0);
		const Real energyError = std::abs(Real(result.energy / Quad(2 * value * value) - 1))
		        * std::min(Real(1), -result.barrierValue / pair.reach());
		const Real forceError = (f - forceOn2).norm() / scale, torqueError = (torque - torqueOn2).norm() / (scale * size);
		worstEnergy = std::max(worstEnergy, energyError);
		worstForce  = std::max(worstForce, forceError / (1 + rounding * 1e13));
		worstTorque = std::max(worstTorque, torqueError / (1 + rounding * 1e13));
		EXPECT_LE(energyError, 1e-15);
		EXPECT_LE(forceError, 1e-12 + 10 * rounding);
		// the point's uncertainty is proportional to its rocking arm
		EXPECT_LE(torqueError, 1e-12 + 10 * rounding * (1 + result.rockingArm / size));
	}
	EXPECT_GT(contacts, 150);
	std::printf("%d-D, %d contacts: worst error of energy %.1e, force %.1e, torque %.1e (slivers' by their planes' rounding over μ)\n",
	        dimension, contacts, worstEnergy, worstForce, worstTorque);
}

TEST_P(ConservativeContact, ValueIsNotBelowTheLinearPrograms)
{
	const int trials = 60000;
	int       apart = 0, overlapping = 0, contacts = 0;
	Real      least = 1e9, leastApart = 1e9;
	for (int trial = 0; trial < trials && !HasFailure(); ++trial) {
		Pair pair;
		for (int body = 0; body < 2; ++body) {
			pair.shape[body]    = shapes[random() % shapes.size()];
			pair.rotation[body] = randomRotation(random, dimension);
		}
		// somewhere about touching
		const Vector3 direction = randomDirection(random, dimension);
		pair.centre2 = uniform(random, 0, 1) * (pair.shape[0]->boundingRadius() + pair.shape[1]->boundingRadius()) * direction;
		const ContactResult result = query(pair, acrossGap());
		ASSERT_TRUE(usable(result.status)) << statusName(result.status);
		const Real over = result.barrierValue - result.infeasibility, mu = tolerance::barrier * pair.inscribedRadius();
		EXPECT_GE(over, -8 * tolerance::rounding * pair.reach());
		(result.infeasibility >= 0 ? apart : overlapping)++;
		contacts += result.inContact;
		(result.infeasibility >= 0 ? leastApart : least) = std::min(result.infeasibility >= 0 ? leastApart : least, over / mu);
		if (result.infeasibility >= 0) {
			EXPECT_FALSE(result.inContact);
			EXPECT_EQ(result.energy, 0);
			EXPECT_LE(result.depth, 0);
		}
	}
	EXPECT_GT(apart, trials / 5);
	EXPECT_GT(overlapping, trials / 5);
	EXPECT_GT(contacts, trials / 6);
	std::printf("%d-D, %d pairs (%d overlap, %d in contact): least (Φ − s*)/μ %.3g overlapping, %.3g apart\n", dimension, trials,
	        overlapping, contacts, least, leastApart);
}

TEST_P(ConservativeContact, WeightsAreADualsAndNoneAboveOneHalf)
{
	for (int trial = 0; trial < 300; ++trial) {
		const Pair          pair = overlappingPair(shapes, random, -3, Real(-0.3));
		PairMemory          memory;
		const ContactResult result = query(pair, conservative(1e-20), &memory);
		if (!result.inContact) continue;
		PreciseBarrier exact(pair, tolerance::barrier);
		exact.x = precise(result.point);
		exact.s = memory.level;
		ASSERT_LT(exact.value(), 0);
		Quad       sum = 0;
		QuadVector balance {}, n {};
		for (int body = 0; body < 2; ++body) {
			const auto weights = exact.weights(body);
			for (std::size_t i = 0; i < weights.size(); ++i) {
				EXPECT_LE(weights[i], Quad(0.5) + Quad(1e-20));
				sum += weights[i];
				balance = along(balance, weights[i], exact.pair.planes[body][i].normal);
			}
			if (body == 0) n = balance;
		}
		EXPECT_LE(abs(sum - 1), Quad(1e-20));
		EXPECT_LE(norm(balance), Quad(1e-20));
		EXPECT_LE((rounded(n) - result.dualDirection).norm(), 1e-12 + 10 * roundingOverMu(pair));
	}
}

TEST_P(ConservativeContact, ExchangingTheBodiesExchangesTheForcesToTheLastBit)
{
	int contacts = 0;
	for (int trial = 0; trial < 6000; ++trial) {
		Pair pair = trial % 3 == 0 ? nearlyParallelPair(random, dimension) : overlappingPair(shapes, random, -3, 0);
		if (trial % 4 == 0) {
			pair.shape[1] = pair.shape[0];
			if (trial % 8 == 0) pair.rotation[1] = pair.rotation[0];
		}
		ContactSettings settings   = trial % 2 ? acrossGap() : conservative();
		settings.section           = true;
		const ContactResult result = query(pair, settings), back = query(swapped(pair), settings);
		ASSERT_EQ(back.status, result.status);
		ASSERT_EQ(back.inContact, result.inContact);
		EXPECT_EQ(back.barrierValue, result.barrierValue);
		EXPECT_EQ(back.depth, result.depth);
		EXPECT_EQ(back.area, result.area);
		if (!result.hasGeometry || result.status == ContactStatus::NoDirection) continue;
		EXPECT_EQ(back.normal, -result.normal);
		EXPECT_LE((back.point + pair.centre2 - result.point).norm(), 4 * tolerance::rounding * pair.reach());
		contacts += result.inContact;
	}
	EXPECT_GT(contacts, 3000);
}

TEST_P(ConservativeContact, RigidMotionAndScaleChangeNothing)
{
	int contacts = 0;
	for (int trial = 0; trial < 2000; ++trial) {
		const Pair          pair   = overlappingPair(shapes, random, -3, 0);
		const ContactResult result = query(pair, conservative(1e-14));
		if (!result.inContact) continue;
		++contacts;
		const Matrix3       rotation = randomRotation(random, dimension);
		const ContactResult there    = query(turned(pair, rotation), conservative(1e-14));
		const Real          loose    = 1e-12 + 100 * roundingOverMu(pair);
		EXPECT_NEAR(there.barrierValue, result.barrierValue, 8 * tolerance::rounding * pair.reach());
		EXPECT_LE((force(there) - rotation * force(result)).norm(),
		        loose * -2 * result.barrierValue + 8 * tolerance::rounding * pair.reach());
		EXPECT_LE((there.point - rotation * result.point).norm(), loose * (pair.size() + result.rockingArm));
		if (trial % 10) continue;
		const Real          factor = std::ldexp(Real(1), trial % 20 ? -30 : 13);
		const ContactResult larger = query(scaled(pair, factor), conservative(1e-14));
		EXPECT_EQ(larger.barrierValue, factor * result.barrierValue);
		EXPECT_EQ(larger.point, factor * result.point);
		EXPECT_EQ(larger.normal, result.normal);
		EXPECT_EQ(larger.depth, factor * result.depth);
		EXPECT_EQ(larger.energy, factor * factor * result.energy);
		EXPECT_EQ(larger.rockingArm, factor * result.rockingArm);
		EXPECT_EQ(larger.newtonIterations, result.newtonIterations);
	}
	EXPECT_GT(contacts, 1000);
}

TEST_P(ConservativeContact, WhatThePairRemembersChangesNothing)
{
	for (Real stride : { 1e-5, 1e-3, 0.3 }) {
		long warmIterations = 0, coldIterations = 0, contacts = 0;
		int  most = 0;
		for (int path = 0; path < 60 && !HasFailure(); ++path) {
			Pair       pair = overlappingPair(shapes, random, -3, -1);
			PairMemory memory;
			query(pair, conservative(), &memory);
			for (int k = 0; k < 40 && !HasFailure(); ++k) {
				pair.centre2 += stride * pair.inscribedRadius() * randomDirection(random, dimension);
				for (Matrix3& rotation : pair.rotation)
					rotation = smallTurn(random, stride, dimension) * rotation;
				const ContactResult warm = query(pair, conservative(), &memory), cold = query(pair, conservative());
				ASSERT_TRUE(usable(warm.status) && usable(cold.status));
				if (std::abs(cold.barrierValue) > 1e-13 * pair.reach()) {
					ASSERT_EQ(warm.inContact, cold.inContact);
				}
				if (!cold.inContact || !warm.inContact) continue;
				++contacts;
				warmIterations += warm.newtonIterations;
				coldIterations += cold.newtonIterations;
				most             = std::max(most, warm.newtonIterations);
				const Real loose = 1e-8 + 100 * roundingOverMu(pair);
				EXPECT_NEAR(warm.barrierValue, cold.barrierValue,
				        1e-9 * tolerance::barrier * pair.inscribedRadius() + 8 * tolerance::rounding * pair.reach());
				EXPECT_LE((force(warm) - force(cold)).norm(),
				        loose * -2 * cold.barrierValue + 8 * tolerance::rounding * pair.reach());
				EXPECT_LE((warm.point - cold.point).norm(), loose * (pair.size() + cold.rockingArm));
			}
		}
		EXPECT_GT(contacts, 800);
		EXPECT_LT(warmIterations, stride < 0.1 ? coldIterations : 2 * coldIterations);
		std::printf("%d-D, steps of %.0e of the inscribed radius, %ld contacts: %.2f iterations warm (at most %d), %.2f cold\n",
		        dimension, double(stride), contacts, double(warmIterations) / contacts, most, double(coldIterations) / contacts);
	}
}

TEST_P(ConservativeContact, AnyBasisPointAndLevelAreAGoodEnoughStart)
{
	for (int trial = 0; trial < 3000 && !HasFailure(); ++trial) {
		const Pair pair = overlappingPair(shapes, random, -3, 0);
		PairMemory memory;
		memory.hasBasis = memory.hasPoint = true;
		for (int& code : memory.basis) {
			const int body = int(random() % 2);
			code           = 2 * int(random() % pair.shape[body]->planeCount()) + body;
		}
		for (Vector3& point : memory.point)
			point = decades(random, -3, 3) * pair.size() * randomDirection(random, dimension);
		memory.level             = uniform(random, -1, 1) * decades(random, -6, 3) * pair.size();
		memory.dualDirection     = decades(random, -3, 3) * randomDirection(random, dimension);
		const ContactResult warm = query(pair, conservative(), &memory), cold = query(pair, conservative());
		ASSERT_TRUE(usable(warm.status)) << statusName(warm.status);
		// a positive Φ is no force, and is not computed where the optimum's weights (of one basis or another) show its sign
		EXPECT_NEAR(std::min(warm.barrierValue, Real(0)), std::min(cold.barrierValue, Real(0)),
		        1e-9 * tolerance::barrier * pair.inscribedRadius() + 8 * tolerance::rounding * pair.reach());
	}
}

TEST_P(ConservativeContact, NoPairFails)
{
	// slivers, 4 to 260 planes, nearly parallel ones; from each pair a few moves on
	const int                    trials = 12000, moves = 8;
	std::map<ContactStatus, int> count;
	int                          most = 0, contacts = 0, solved = 0;
	double                       sum  = 0;
	Shapes                       many = randomShapes(60, random, dimension, Real(-3));
	for (int planes : { 120, 200, 260 })
		for (Real aspect : { 1., 0.1, 0.01 }) {
			HalfSpaces set = stretched(randomPlanes(planes, random, dimension),
			        dimension == 3 ? Vector3(1, std::sqrt(aspect), aspect) : Vector3(1, aspect, 1));
			many.push_back(ConvexShape::shared(set, 0));
		}
	for (int trial = 0; trial < trials; ++trial) {
		Pair pair = trial % 5 == 4 ? nearlyParallelPair(random, dimension) : overlappingPair(many, random, -3, 0);
		if (trial % 5 != 4 && trial % 7 == 0) pair.centre2 *= uniform(random, 0, Real(0.5));
		for (int move = 0; move < moves; ++move) {
			const ContactResult result = query(pair, conservative());
			++count[result.status];
			contacts += result.inContact;
			solved += result.newtonIterations > 0;
			sum += result.newtonIterations;
			most = std::max(most, result.newtonIterations);
			pair.centre2 += Real(0.1) * pair.inscribedRadius() * randomDirection(random, dimension);
			pair.rotation[0] = smallTurn(random, Real(0.1), dimension) * pair.rotation[0];
		}
	}
	for (const auto& [status, number] : count) {
		EXPECT_TRUE(usable(status)) << statusName(status) << ": " << number;
		std::printf("%s %d, ", statusName(status), number);
	}
	EXPECT_GT(contacts, trials * moves / 2);
	EXPECT_LT(most, 50);
	EXPECT_LT(sum / solved, 12);
	std::printf("%d-D: Newton iterations from the linear program's point %.2f, at most %d\n", dimension, sum / solved, most);
}

TEST_P(ConservativeContact, IsContinuousAcrossTheGap)
{
	for (int trial = 0; trial < 200; ++trial) {
		Pair          pair      = overlappingPair(shapes, random, -2, -1);
		const Vector3 direction = pair.centre2.normalized();
		const Real    inner     = pair.inscribedRadius();
		// the place where Φ = 0
		Real near = pair.centre2.norm(), far = near + 2 * (pair.shape[0]->boundingRadius() + pair.shape[1]->boundingRadius());
		for (int halving = 0; halving < 60; ++halving) {
			pair.centre2                                             = (near + far) / 2 * direction;
			(query(pair, acrossGap()).barrierValue < 0 ? near : far) = (near + far) / 2;
		}
		const Real steps       = 1e-6;
		pair.centre2           = (near - steps * inner) * direction;
		const ContactResult in = query(pair, acrossGap());
		pair.centre2 += 2 * steps * inner * direction;
		const ContactResult out = query(pair, acrossGap());
		ASSERT_TRUE(in.inContact && in.hasGeometry && out.hasGeometry && !out.inContact);
		EXPECT_EQ(out.status, ContactStatus::Separated);
		EXPECT_GT(in.depth, 0);
		EXPECT_LT(out.depth, 0);
		EXPECT_LE(in.depth - out.depth, 4 * steps * inner * (1 + 1e-3));
		EXPECT_LE((in.normal - out.normal).norm(), 100 * steps / tolerance::barrier);
		EXPECT_LE((in.point - out.point).norm(), 100 * steps / tolerance::barrier * (inner + in.rockingArm));
		EXPECT_EQ(out.energy, 0);
	}
}

TEST_P(ConservativeContact, SlidingOverFacesEdgesAndVerticesItGoesOnSmoothly)
{
	// largest change of force and point from step to step: half as large for steps half as large
	const auto largest = [&](const Pair& pair, const Vector3& from, const Vector3& to, int steps) {
		Pair          here = pair;
		ContactResult last;
		Real          jump = 0;
		for (int k = 0; k <= steps; ++k) {
			here.centre2               = from + Real(k) / steps * (to - from);
			const ContactResult result = query(here, acrossGap());
			if (k > 0)
				jump = std::max(jump,
				        (result.depth * result.normal - last.depth * last.normal).norm()
				                + (result.point - last.point).norm());
			last = result;
		}
		return jump;
	};
	Real worst = 10;
	for (int trial = 0; trial < 12; ++trial) {
		Pair pair;
		for (int body = 0; body < 2; ++body) {
			HalfSpaces set      = dimension == 2 ? rectangle(1, 1) : trial % 2 == body ? cuboid(1, 1, 1) : regularSolid(4, 2);
			pair.shape[body]    = ConvexShape::shared(set, Real(0.1));
			pair.rotation[body] = randomRotation(random, dimension);
		}
		const Vector3 direction = randomDirection(random, dimension), other = randomDirection(random, dimension);
		moveTo(pair, direction, Real(-0.01));
		const Vector3 from = pair.centre2;
		moveTo(pair, (direction + other).normalized(), Real(-0.01));
		const int  steps  = 4000;
		const Real coarse = largest(pair, from, pair.centre2, steps), fine = largest(pair, from, pair.centre2, 2 * steps);
		worst = std::min(worst, coarse / fine);
		EXPECT_GT(coarse / fine, 1.9);
	}
	std::printf("%d-D: steps half as large, jumps smaller by %.3f at the least\n", dimension, double(worst));
}

TEST_P(ConservativeContact, RockingArmIsTheWayOfThePointPerTilt)
{
	int compared = 0;
	for (int trial = 0; trial < 80; ++trial) {
		const Pair          pair = overlappingPair(shapes, random, -2, Real(-0.5));
		PairMemory          memory;
		const ContactResult result = query(pair, conservative(1e-20), &memory);
		// the motion of a sliver's point is below the resolution of 113 bits
		const Real mu = tolerance::barrier * pair.inscribedRadius();
		if (!result.inContact || mu < 1e-5 * pair.size()) continue;
		++compared;
		PreciseBarrier here(pair, tolerance::barrier);
		here.x = precise(result.point);
		here.s = memory.level;
		here.value();
		// both tangents; tilting about one moves the point along both
		const Vector3 n = result.normal;
		Vector3       t[2];
		t[0]               = dimension == 2 ? Vector3(-n.y(), n.x(), 0) : Vector3(n.unitOrthogonal());
		t[1]               = n.cross(t[0]);
		Real       c[2][2] = { { 0, 0 }, { 0, 0 } };
		const Real angle   = 1e-6 * mu / std::max(pair.reach(), result.rockingArm);
		for (int j = 0; j < dimension - 1; ++j) {
			const Vector3    axis = dimension == 2 ? Vector3::UnitZ() : Vector3(t[j].cross(n)); // axis × n = ∓t
			const QuadVector e = precise(axis), arm = minus(precise(pair.centre2), here.x);
			const QuadVector cross
			        = { e[1] * arm[2] - e[2] * arm[1], e[2] * arm[0] - e[0] * arm[2], e[0] * arm[1] - e[1] * arm[0] };
			PreciseBarrier tilted = here.moved(along({}, Quad(angle), cross), e, angle);
			tilted.value();
			for (int i = 0; i < dimension - 1; ++i)
				c[i][j] = Real(dot(precise(t[i]), minus(tilted.x, here.x)) / Quad(angle));
		}
		const Real half = (c[0][0] - c[1][1]) / 2, mixed = (c[0][1] + c[1][0]) / 2, root = std::sqrt(half * half + mixed * mixed);
		const Real arm = dimension == 2
		        ? std::abs(c[0][0])
		        : std::max(std::abs((c[0][0] + c[1][1]) / 2 - root), std::abs((c[0][0] + c[1][1]) / 2 + root));
		EXPECT_NEAR(result.rockingArm, arm, (1e-3 + 100 * roundingOverMu(pair)) * arm);
	}
	EXPECT_GT(compared, 30);
}

TEST(ConservativeContactOf, FaceOnFaceRockingArmIsLengthCubedOverSixtyFourMuSquared)
{
	// derived with the point fixed by the four planes at the small cube's sides; those of the large one weigh 10⁻³ of these
	Pair pair;
	pair.shape[0] = ConvexShape::shared(cuboid(10, 10, 10), Real(0.1));
	pair.shape[1] = ConvexShape::shared(cuboid(1, 1, 1), Real(0.1));
	for (Real barrier : { 1e-3, 1e-4 }) {
		ContactSettings settings   = conservative();
		settings.barrier           = barrier;
		pair.centre2               = Vector3(0, 0, 11 - 2 * barrier);
		const ContactResult result = query(pair, settings);
		ASSERT_TRUE(result.inContact);
		EXPECT_NEAR(result.rockingArm, 8 / (64 * barrier * barrier), (2e-3 + 5 * barrier) * result.rockingArm);
	}
}

TEST(ConservativeContactOf, FaceOnFaceDepthIsTheOverlap)
{
	Pair pair;
	pair.shape[0] = pair.shape[1] = ConvexShape::shared(cuboid(1, 1, 1), Real(0.1));
	ContactSettings settings      = conservative();
	settings.section              = true;
	for (Real overlap : { 1e-3, 1e-2, 0.1 }) {
		pair.centre2               = Vector3(Real(0.5), Real(0.25), 2 - overlap);
		const ContactResult result = query(pair, settings);
		EXPECT_EQ(result.status, ContactStatus::Contact);
		// the planes at the sides take a part of order μ² from it
		const Real mu = tolerance::barrier;
		EXPECT_NEAR(result.depth, overlap, 50 * mu * mu);
		// being nearer to an edge on one side than on the other tilts the force by (μ/distance)²
		EXPECT_LE((result.normal - Vector3::UnitZ()).norm(), 10 * mu * mu);
		EXPECT_LE((result.point - pair.centre2 / 2).norm(), 1e-9);
		// perpendicular to that tilted normal
		EXPECT_NEAR(result.area, Real(1.5) * Real(1.75), 1e-8);
	}
}

TEST(ConservativeContactOf, AWallIsAPlane)
{
	// against a face far larger than the body the answer is the same but for what that block's other planes weigh
	std::mt19937_64 random(31000);
	for (int dimension = 2; dimension <= 3; ++dimension) {
		const auto block = ConvexShape::shared(dimension == 2 ? rectangle(1000, 1000) : cuboid(1000, 1000, 1000), Real(1));
		for (int trial = 0; trial < 200; ++trial) {
			Pair wall;
			wall.shape[0]    = ConvexShape::halfSpace(Vector3::UnitY(), dimension);
			wall.shape[1]    = ConvexShape::shared(dimension == 2 ? rectangle(1, 2) : cuboid(1, 2, 3), Real(0.1));
			wall.rotation[1] = trial % 5 ? randomRotation(random, dimension) : Matrix3(Matrix3::Identity());
			Real lowest      = 0;
			for (const Vector3& v : wall.shape[1]->polyhedron().vertices)
				lowest = std::min(lowest, (wall.rotation[1] * v).y());
			wall.centre2   = Vector3(0, -lowest - decades(random, -2, -1), 0);
			Pair other     = wall;
			other.shape[0] = block;
			other.centre2.y() += 1000;
			const ContactResult result = query(wall, conservative()), same = query(other, conservative());
			ASSERT_TRUE(result.inContact && same.inContact) << statusName(result.status);
			EXPECT_EQ(result.status, ContactStatus::Contact);
			EXPECT_NEAR(result.depth, same.depth, 1e-7);
			EXPECT_LE((result.normal - same.normal).norm(), 1e-6);
			EXPECT_LE((result.point + Vector3(0, 1000, 0) - same.point).norm(),
			        1e-3); // the uncertainty of a point on a face is proportional to its rocking arm
			EXPECT_LE((result.normal - Vector3::UnitY()).norm(), 1e-6);
			EXPECT_EQ(query(swapped(wall), conservative()).depth, result.depth);
		}
	}
}

TEST(ConservativeContactOf, DeepOverlapAndCoincidentBodiesHaveAnEnergyAndNextToNoForceAtItsTop)
{
	std::mt19937_64 random(31001);
	for (int faces : { 4, 6, 8, 12, 20 }) {
		Pair pair;
		pair.shape[0] = pair.shape[1] = ConvexShape::shared(regularSolid(faces, 1), Real(0.1));
		pair.rotation[0] = pair.rotation[1] = randomRotation(random);
		const Real          inner           = pair.inscribedRadius();
		const ContactResult top             = query(pair, conservative());
		EXPECT_TRUE(top.inContact);
		EXPECT_EQ(top.status, ContactStatus::NoDirection);
		EXPECT_GT(top.depth, 0); // bodies in equilibrium separate
		EXPECT_LE(top.depth, 4 * inner * tolerance::direction);
		EXPECT_NEAR(top.normal.norm(), 1, 1e-15);
		// Φ lies above s* = −inner by 2μ (Σ √λ − √2) at most, Σ √λ ≤ √(number of planes)
		const Real most = inner - 2 * tolerance::barrier * inner * (std::sqrt(Real(2 * faces)) - std::sqrt(Real(2)));
		EXPECT_LT(top.energy, 2 * inner * inner);
		EXPECT_GE(top.energy, 2 * most * most * (1 - 1e-12));
		pair.centre2             = 1e-4 * randomDirection(random);
		const ContactResult near = query(pair, conservative());
		EXPECT_EQ(near.status, ContactStatus::Contact);
		EXPECT_GT(near.depth, 0);
		EXPECT_LT(near.depth, 0.2 * inner);
		EXPECT_LT(near.energy, top.energy);
	}
}

TEST(ConservativeContactOf, ThePaperModelsSettingsAreNotRead)
{
	std::mt19937_64 random(31003);
	for (int trial = 0; trial < 200; ++trial) {
		const Pair      pair     = regularPair(6, 8, decades(random, -3, -1), random);
		ContactSettings settings = conservative();
		settings.tolerance       = 0.3;
		settings.contactPoint    = ContactPoint::ChebyshevCentre;
		settings.normalWeight[0] = 0;
		const auto result = query(pair, conservative()), other = query(pair, settings);
		EXPECT_EQ(other.inContact, result.inContact);
		EXPECT_EQ(other.depth, result.depth);
		EXPECT_EQ(other.normal, result.normal);
		EXPECT_EQ(other.point, result.point);
	}
}

TEST(ConservativeContactOf, ABarrierThatIsNoLengthIsAFailureAndNoException)
{
	std::mt19937_64 random(31002);
	const Pair      pair = regularPair(6, 8, Real(0.1), random);
	for (Real barrier : { Real(0), Real(-1), std::numeric_limits<Real>::quiet_NaN(), std::numeric_limits<Real>::infinity() }) {
		ContactSettings settings = conservative();
		settings.barrier         = barrier;
		const auto result        = query(pair, settings);
		EXPECT_EQ(result.status, ContactStatus::Failed);
		EXPECT_FALSE(result.inContact || result.hasGeometry);
	}
}

TEST(ConservativeContactOf, CornersActAsIfRoundedByMuAndAsSoftAsTheirWeightsSay)
{
	// With weights λ of the planes that meet, Φ = −|n| overlap + 2μ (Σ √λ − √2): first force at an overlap of
	// 2μ (Σ √λ − √2)/|n|, stiffness (2|n|)².
	const Real half = std::sqrt(Real(0.5)), third = std::sqrt(Real(1) / 3);
	const auto cube        = ConvexShape::shared(cuboid(1, 1, 1), Real(0.1));
	const auto tetrahedron = ConvexShape::shared(regularSolid(4, 3), Real(0.1)); // inscribed radius 1
	const auto upright
	        = [](const Vector3& down) { return Eigen::Quaternion<Real>::FromTwoVectors(down, -Vector3::UnitZ()).toRotationMatrix(); };
	const Matrix3 edgeDown = upright(Vector3(0, -1, -1)), vertexDown = upright(Vector3(-1, -1, -1));
	const Matrix3 turnedEdge
	        = (Eigen::AngleAxis<Real>(Real(M_PI), Vector3::UnitX()) * Eigen::AngleAxis<Real>(Real(M_PI) / 2, Vector3::UnitZ()))
	                  .toRotationMatrix()
	        * edgeDown;
	struct Case {
		const char*                        name;
		std::shared_ptr<const ConvexShape> upper, lower;
		Matrix3                            upperTurn, lowerTurn;
		std::vector<Real>                  weights;
		Real                               n;
	};
	const Real    f = 1 / (1 + 1 / half), v = 1 / (1 + 1 / third);
	const Matrix3 straight = Matrix3::Identity();
	const Matrix3 apexDown = upright(tetrahedron->polyhedron().vertices[0]);
	const Case    cases[]  = {
                { "face on face", cube, cube, straight, straight, { 0.5, 0.5 }, 0.5 },
                { "edge on face", cube, cube, edgeDown, straight, { f, f * half, f * half }, f },
                { "edge on edge", cube, cube, edgeDown, turnedEdge, { 0.25, 0.25, 0.25, 0.25 }, half / 2 },
                { "vertex on face", cube, cube, vertexDown, straight, { v, v * third, v * third, v * third }, v },
                { "tetrahedron's vertex on face", tetrahedron, cube, apexDown, straight, { 0.25, 0.25, 0.25, 0.25 }, 0.25 },
	};
	const Real mu = 1e-3;
	for (const Case& c : cases) {
		Pair pair;
		pair.shape[0]    = c.lower;
		pair.shape[1]    = c.upper;
		pair.rotation[0] = c.lowerTurn;
		pair.rotation[1] = c.upperTurn;
		Real top = -10, bottom = 10;
		for (const Vector3& vertex : c.lower->polyhedron().vertices)
			top = std::max(top, (c.lowerTurn * vertex).z());
		for (const Vector3& vertex : c.upper->polyhedron().vertices)
			bottom = std::min(bottom, (c.upperTurn * vertex).z());
		ContactSettings settings = acrossGap();
		settings.barrier         = mu;
		const auto at            = [&](Real overlap) {
                        pair.centre2 = Vector3(0, 0, top - bottom - overlap);
                        return query(pair, settings);
		};
		Real low = -mu, high = 10 * mu;
		for (int halving = 0; halving < 50; ++halving)
			((at((low + high) / 2).barrierValue < 0) ? high : low) = (low + high) / 2;
		Real sum = -std::sqrt(Real(2));
		for (Real weight : c.weights)
			sum += std::sqrt(weight);
		const Real          first = high / mu, expected = 2 * sum / c.n;
		const ContactResult in = at(0.01), deeper = at(0.0101);
		const Real          stiffness = (deeper.depth - in.depth) / Real(0.0001);
		std::printf("%s: first force at an overlap of %.3f μ (weights alone %.3f μ), stiffness %.4f k (weights alone %.4f k), "
		            "rocking arm %.3g\n",
		        c.name, double(first), double(expected), double(stiffness), double(4 * c.n * c.n), double(in.rockingArm));
		EXPECT_NEAR(first, expected, 0.12);
		EXPECT_NEAR(stiffness, 4 * c.n * c.n, 0.01);
	}
}

// Across a gap the linear program's point lies where both bodies, grown, meet: a sliver's sharp tip, grown by a tenth of its length, may
// reach a million times that far. Warm, with no pivot, the frame stayed at the body: coordinates were rounded by more than μ.
TEST(ConservativeContactOf, SharpSliversAcrossAGapAreReachedWarmAsCold)
{
	std::mt19937_64 random(610);
	int             far = 0, queries = 0;
	for (int trial = 0; trial < 500; ++trial) {
		Pair pair;
		for (int body = 0; body < 2; ++body) {
			HalfSpaces set  = randomPlanes(6 + int(random() % 10), random, 2);
			const Real size = body == 0 ? Real(1) : decades(random, -6, -3);
			set             = stretched(set, Vector3(1, decades(random, -8, body == 0 ? 0 : -6), 1));
			for (Real& offset : set.offsets)
				offset *= size;
			pair.shape[body]    = ConvexShape::shared(set, 0);
			pair.rotation[body] = randomRotation(random, 2);
		}
		moveTo(pair, randomDirection(random, 2), uniform(random, Real(0.05), Real(0.5)) * pair.size());
		if (trial % 2) pair = swapped(pair);
		PairMemory memory;
		for (int step = 0; step < 4; ++step) {
			const ContactResult result = query(pair, acrossGap(), &memory);
			++queries;
			EXPECT_NE(result.status, ContactStatus::CentreNotConverged) << trial << ", step " << step;
			far += step > 0 && result.simplexPivots == 0
			        && (result.point - (trial % 2 ? Vector3(Vector3::Zero()) : pair.centre2)).norm() > 10 * pair.size();
			pair.centre2 += decades(random, -12, -9) * pair.size() * randomDirection(random, 2);
		}
	}
	EXPECT_GT(far, queries / 10);
}

// μ of thin bodies, at the least barrier, may be less than the rounding of s* across a gap: slacks of about μ had no digits there.
TEST(ConservativeContactOf, ThinPairsApartHaveAGeometryAtTheLeastBarrier)
{
	std::mt19937_64 random(611);
	ContactSettings settings = acrossGap();
	settings.barrier         = tolerance::leastBarrier;
	int apart                = 0;
	for (int trial = 0; trial < 400; ++trial) {
		Pair       pair;
		const Real thin   = decades(random, -10, -6);
		pair.shape[0]     = ConvexShape::shared(cuboid(1, 1, thin), 0);
		pair.shape[1]     = ConvexShape::shared(cuboid(1, thin, thin), 0);
		pair.rotation[0]  = randomRotation(random, 3);
		pair.rotation[1]  = randomRotation(random, 3);
		pair.centre2      = uniform(random, Real(0.5), Real(1.5)) * randomDirection(random, 3);
		const auto result = query(pair, settings);
		if (!(result.infeasibility > Real(1e-3))) continue;
		++apart;
		ASSERT_EQ(result.status, ContactStatus::Separated) << trial;
		EXPECT_TRUE(std::isfinite(double(result.depth)) && result.depth < 0);
		EXPECT_NEAR(result.normal.norm(), 1, 1e-12);
		EXPECT_NEAR(result.barrierValue / result.infeasibility, 1, 1e-9);
	}
	EXPECT_GT(apart, 200);
}

} // namespace
