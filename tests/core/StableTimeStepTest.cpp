// SPDX-License-Identifier: GPL-2.0-or-later
#include "timestep/StableTimeStep.hpp"
#include "PairSamples.hpp"
#include "shape/RegularSolids.hpp"
#include "timestep/RockingStiffness.hpp"

#include <gtest/gtest.h>

using namespace polytope;

namespace {

/// Whether the motion grows without bound with this time step: one degree of freedom, the damper's force from the last half step's
/// velocity.
bool grows(Real stiffness, Real damper, Real step)
{
	Real place = 1, velocity = 0;
	for (int k = 0; k < 20000; ++k) {
		velocity -= step * (stiffness * place + damper * velocity);
		place += step * velocity;
		if (!(abs(place) < 1e6)) return true;
	}
	return false;
}

Mobility cube(Real mass, Real side)
{
	Mobility mobility;
	mobility.translation = Vector3::Constant(1 / sqrt(mass));
	mobility.rotation    = Matrix3::Identity() / sqrt(mass * side * side / 6);
	return mobility;
}

} // namespace

TEST(StableTimeStep, TwiceTauIsTheLimitOfOneDegreeOfFreedom)
{
	for (Real zeta : { 0.0, 0.1, 0.3, 1.0, 2.0 }) {
		const Real stiffness = 7, damper = 2 * zeta * sqrt(stiffness);
		const Real limit = 2 * safeTimeStep(stiffness, damper);
		EXPECT_FALSE(grows(stiffness, damper, 0.999 * limit)) << zeta;
		EXPECT_TRUE(grows(stiffness, damper, 1.001 * limit)) << zeta;
	}
}

/// A chain of bodies, each with a spring and a damper to the next: the highest frequency is nearly √2 that of one between fixed ones.
TEST(StableTimeStep, TauIsSafeForAChain)
{
	const Real stiffness = 3, damper = 0.8;
	const auto chainGrows = [&](Real step) {
		constexpr int n        = 40;
		Real          place[n] = {}, velocity[n] = {};
		for (int k = 0; k < n; ++k)
			place[k] = k % 2 ? 1 : -1;
		for (int t = 0; t < 20000; ++t) {
			Real force[n] = {};
			for (int k = 0; k + 1 < n; ++k) {
				const Real f = stiffness * (place[k + 1] - place[k]) + damper * (velocity[k + 1] - velocity[k]);
				force[k] += f;
				force[k + 1] -= f;
			}
			for (int k = 0; k < n; ++k) {
				velocity[k] += step * force[k];
				place[k] += step * velocity[k];
				if (!(abs(place[k]) < 1e6)) return true;
			}
		}
		return false;
	};
	const Real tau = safeTimeStep(2 * stiffness, 2 * damper); // of one with two neighbours
	EXPECT_FALSE(chainGrows(tau));
	EXPECT_TRUE(chainGrows(2 * tau));
}

TEST(StableTimeStep, ArmsMassesAndSprings)
{
	const Real     mass = 2, side = 0.5;
	ContactSprings springs;
	springs.normal          = Vector3(0, 0, 1);
	springs.normalStiffness = 5;
	springs.shearStiffness  = 3;
	BodyStiffness centre(cube(mass, side));
	centre.add(springs, Vector3::Zero());
	EXPECT_NEAR(double(centre.stiffness()), 5 / mass, 1e-12);

	// the shear spring at the end of an arm turns the body, too: 1/m + arm²/I
	springs.normalStiffness = 0;
	BodyStiffness face(cube(mass, side));
	face.add(springs, Vector3(0, 0, -side / 2));
	EXPECT_NEAR(double(face.stiffness()), 3 * (1 / mass + (side * side / 4) / (mass * side * side / 6)), 1e-12);
	EXPECT_GE(double(face.stiffnessAtMost()), double(face.stiffness()) * (1 - 1e-12));
	EXPECT_LE(double(face.stiffnessAtMost()), double(face.stiffness()) * std::pow(6, 0.125));

	springs.normalStiffness = 3;
	const Vector3 corner    = Vector3::Constant(side / 2);
	BodyStiffness vertex(cube(mass, side));
	vertex.add(springs, corner);
	EXPECT_NEAR(double(vertex.stiffness()), double(3 * reachOf(cube(mass, side), corner)), 1e-12);
	EXPECT_NEAR(
	        double(reachOfBall(cube(mass, side), Vector3::Zero(), corner.norm())), double(reachOf(cube(mass, side), corner)), 1e-12);

	EXPECT_EQ(reachOf(Mobility(), corner), 0);
	EXPECT_FALSE(Mobility().moves());
}

/// The ball lies about another point than the body's centre: its farthest point, straight on, is as far as the bound says.
TEST(StableTimeStep, ReachOfABallBesideTheCentre)
{
	const Real     mass = 2, side = Real(0.5), inertia = mass * side * side / 6, radius = Real(0.3);
	const Vector3  centre(Real(0.2), Real(-0.6), Real(0.9)), along = centre.normalized();
	const Mobility mobility = cube(mass, side);
	const Real     bound    = reachOfBall(mobility, centre, radius);
	const Real     root     = sqrt(1 / mass + centre.squaredNorm() / inertia) + radius / sqrt(inertia);
	EXPECT_NEAR(double(bound), double(root * root), 1e-11);
	for (Real turn = 0; turn < 6; turn += Real(0.5)) {
		const Vector3 aside = Eigen::AngleAxis<Real>(turn, Vector3::UnitX()) * along;
		EXPECT_LE(double(reachOf(mobility, centre + radius * aside)), double(bound));
	}
	EXPECT_GT(double(reachOf(mobility, centre + radius * along)), double(bound) * 0.97);
}

/// A square face: kₙ L²/4, in any turn, on a half-space and on a larger block.
TEST(RockingStiffness, OfASquareFace)
{
	const Real        side = 2, depth = 1e-4;
	const HalfSpaces  planes = regularSolid(6, sqrt(Real(3)) * side / 2);
	const ConvexShape block(planes, 0);
	HalfSpaces        wide = planes;
	for (Real& offset : wide.offsets)
		offset *= 10;
	const ConvexShape large(wide, 0);
	Quaternion        turn(0.3, -0.5, 0.7, 0.2);
	turn.normalize();
	const Matrix3 axes  = turn.toRotationMatrix();
	const Vector3 up    = axes * planes.normals[0];
	const auto    floor = ConvexShape::halfSpace(up, 3);
	const Vector3 above = up * (side / 2 - depth / 2);

	const Matrix3 onHalfSpace = depth * rockingArms({ *floor, up * depth / 2, Matrix3::Identity() }, { block, above, axes }, up, depth);
	const Matrix3 expected    = side * side / 4 * (Matrix3::Identity() - up * up.transpose());
	EXPECT_LT(double((onHalfSpace - expected).norm()), 1e-3 * double(expected.norm()));

	const Vector3 below    = -up * (10 * side / 2 - depth / 2);
	const Matrix3 onLarge  = depth * rockingArms({ large, below, axes }, { block, above, axes }, up, depth);
	const Matrix3 reversed = depth * rockingArms({ block, above, axes }, { large, below, axes }, -up, depth);
	EXPECT_LT(double((onLarge - expected).norm()), 2e-2 * double(expected.norm())); // its sides weigh a hundredth
	// |g| is that of either body at the analytic centre; the middle of the overlap is that but for depth/side
	EXPECT_LT(double((onLarge - reversed).norm()), double(depth / side * expected.norm()));
}

/// Sides lean and the point is beside the middle: |g| [n]× H⁻¹ [n]×ᵀ with H of all three directions, inverted as a whole.
TEST(RockingStiffness, OfLeaningSides)
{
	const ConvexShape solid(regularSolid(4, 1), 0);
	Quaternion        turn(0.4, 0.6, -0.2, 0.5);
	turn.normalize();
	const Matrix3 rotation = turn.toRotationMatrix();
	const Vector3 centre(0.05, -0.1, 0.15), above(0.1, 0, 0.1);
	for (const Vector3& up : { Vector3(0, 0, 1), Vector3(Real(0.8), 0, Real(0.6)), Vector3(1, 0, 0) }) {
		const auto    floor   = ConvexShape::halfSpace(up, 3);
		const Vector3 surface = up * up.dot(above);
		Matrix3       hessian = up * up.transpose() / surface.squaredNorm();
		Vector3       pull    = Vector3::Zero();
		for (int i = 0; i < 4; ++i) {
			const Vector3 normal = rotation * solid.planes().normals[std::size_t(i)];
			const Vector3 scaled = normal / (solid.planes().offsets[std::size_t(i)] + normal.dot(centre));
			hessian += scaled * scaled.transpose();
			pull += scaled;
		}
		const Matrix3 expected = pull.norm() * crossMatrix(up) * hessian.inverse() * crossMatrix(up).transpose();
		const Matrix3 found    = rockingArms({ *floor, surface, Matrix3::Identity() }, { solid, centre, rotation }, up, 1e-3);
		EXPECT_LT(double((found - expected).norm()), 1e-12 * double(expected.norm())) << found << "\n\n" << expected;
	}
}

/// A plate that stands on its edge, however it is turned: across it the section has no width to rounding, and the arms stay those of a line.
TEST(RockingStiffness, OfAnEdge)
{
	const ConvexShape plate(samples::cuboid(1, 1e-9, 0.5), 0);
	const Vector3     up(0, 0, 1), centre(0, 0, 0.4);
	const auto        floor = ConvexShape::halfSpace(up, 3);
	for (Real turn = Real(0.05); turn < 3; turn += Real(0.1)) {
		const Matrix3 rotation = Eigen::AngleAxis<Real>(turn, up).toRotationMatrix();
		const Matrix3 arms     = rockingArms({ *floor, up * 1e-3, Matrix3::Identity() }, { plate, centre, rotation }, up, 1e-12);
		const Real    pull     = 1 / 0.1 - 1 / 0.9; // of its lower and upper faces
		ASSERT_TRUE(arms.allFinite()) << turn;
		const Vector3 values = Eigen::SelfAdjointEigenSolver<Matrix3>(arms, Eigen::EigenvaluesOnly).eigenvalues();
		const Real    most   = pull * plate.boundingRadius() * plate.boundingRadius();
		EXPECT_GT(values[0], -1e-6 * most) << turn;
		EXPECT_LT(values[2], 4 * most) << turn;
	}
}
