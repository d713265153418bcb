// SPDX-License-Identifier: GPL-2.0-or-later
#include "bond/BondSprings.hpp"

#include <gtest/gtest.h>

#include <random>

using namespace polytope;

namespace {

std::mt19937 random_(7);

Vector3 randomVector(Real size)
{
	std::uniform_real_distribution<Real> number(-size, size);
	return { number(random_), number(random_), number(random_) };
}

Quaternion turned(const Vector3& by)
{
	return Quaternion(Eigen::AngleAxis<Real>(by.norm(), by.norm() > 0 ? by.normalized() : Vector3::UnitX()));
}

/// Two bodies with centres, orientations; the bond's frame is the body's own, its point at the arm in body axes.
struct Pair {
	Vector3    centre[2], arm[2];
	Quaternion turn[2];

	Pair moved(int body, const Vector3& by, const Vector3& rotation) const
	{
		Pair other = *this;
		other.centre[body] += by;
		other.turn[body] = turned(rotation) * turn[body];
		return other;
	}
	Vector3    at(int body) const { return centre[body] + turn[body] * arm[body]; }
	BondMotion motion() const { return bondMotion(turn[0], turn[1], at(1) - at(0)); }
};

const Vector3 linear(3e5, 1e5, 1e5), angular(700, 1100, 400);

} // namespace

TEST(BondSprings, WithoutStrainThereIsNoForce)
{
	const Quaternion turn = turned({ 0.3, -0.4, 2 });
	const BondForce  none = bondForce(bondMotion(turn, turn, Vector3::Zero()), linear, angular);
	EXPECT_EQ(none.force.norm() + none.moment.norm() + none.energy, 0);
}

TEST(BondSprings, SmallMotionsGiveHooke)
{
	const Quaternion turn = turned({ 0.3, -0.4, 2 });
	const Vector3    d(1e-7, -2e-7, 3e-7), rotation(2e-7, 1e-7, -3e-7);
	const BondForce  now = bondForce(bondMotion(turn, turn * turned(rotation), turn * d), linear, angular);
	EXPECT_LT((now.force + turn * Vector3(linear.cwiseProduct(d))).norm(), 1e-6 * now.force.norm());
	EXPECT_LT((now.moment + turn * Vector3(angular.cwiseProduct(rotation))).norm(), 1e-6 * now.moment.norm());
}

TEST(BondSprings, ForceAndMomentAreTheGradientOfTheEnergyAtLargeRotations)
{
	for (int k = 0; k < 50; ++k) {
		Pair pair;
		for (int body = 0; body < 2; ++body) {
			pair.centre[body] = randomVector(1);
			pair.arm[body]    = randomVector(1);
			pair.turn[body]   = turned(randomVector(1.2));
		}
		const BondForce now    = bondForce(pair.motion(), linear, angular);
		const Vector3   middle = (pair.at(0) + pair.at(1)) / 2;
		const Real      step = 1e-6, scale = now.force.norm() + now.moment.norm();
		for (int body = 0; body < 2; ++body) {
			const Real    sign   = body == 1 ? 1 : -1; // the force on body 1 is the opposite
			const Vector3 torque = sign * ((middle - pair.centre[body]).cross(now.force) + now.moment);
			for (int axis = 0; axis < 3; ++axis) {
				const Vector3 way = step * Vector3::Unit(axis), no = Vector3::Zero();
				const auto    energy = [&](const Pair& one) { return bondForce(one.motion(), linear, angular).energy; };
				const Real    alongForce
				        = (energy(pair.moved(body, way, no)) - energy(pair.moved(body, -way, no))) / (2 * step);
				const Real aboutAxis
				        = (energy(pair.moved(body, no, way)) - energy(pair.moved(body, no, -way))) / (2 * step);
				EXPECT_NEAR(alongForce, -sign * now.force[axis], 1e-7 * scale);
				EXPECT_NEAR(aboutAxis, -torque[axis], 1e-7 * scale);
			}
		}
	}
}

TEST(BondSprings, ARotationOfBothBodiesChangesNothing)
{
	const Quaternion q1 = turned({ 0.3, 0.1, 0.2 }), q2 = turned({ -0.2, 0.5, 0.1 }), all = turned({ 1, -2, 0.5 });
	const Vector3    between(0.1, 0.2, -0.3);
	const BondForce  one   = bondForce(bondMotion(q1, q2, between), linear, angular);
	const BondForce  other = bondForce(bondMotion(all * q1, all * q2, all * between), linear, angular);
	EXPECT_NEAR(other.energy, one.energy, 1e-12 * one.energy);
	EXPECT_LT((other.force - all * one.force).norm(), 1e-12 * one.force.norm());
	EXPECT_LT((other.moment - all * one.moment).norm(), 1e-12 * one.moment.norm());
	// nor does the sign of a quaternion
	const BondForce same = bondForce(bondMotion(q1, Quaternion(-q2.w(), -q2.x(), -q2.y(), -q2.z()), between), linear, angular);
	EXPECT_EQ(same.energy, one.energy);
}
