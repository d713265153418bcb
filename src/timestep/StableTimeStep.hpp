// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "numbers/Real.hpp"

#include <Eigen/Eigenvalues>

/// Largest time step of the central difference (leapfrog) scheme for rigid bodies joined by springs and dampers.
///
/// M ẍ + C ẋ + K x = 0 with the damping force taken from the velocity half a step ago is stable as long as
///
///     M − (Δt/2) C − (Δt²/4) K   is positive definite,                                                            (1)
///
/// for one degree of freedom Δt < 2 (√(1 + ζ²) − ζ)/ω. K and C are sums over contacts, and a contact between bodies 1 and 2
/// depends on the difference of their motions at the contact point, so its energy is at most twice the sum of what it would be
/// with either body held fixed:  (u₂ − u₁)ᵀ k (u₂ − u₁) ≤ 2 u₁ᵀ k u₁ + 2 u₂ᵀ k u₂. Hence (1) holds for the whole heap if it
/// holds, with 2 K and 2 C, for each body alone between fixed neighbours: a 6 × 6 problem, whose largest eigenvalues are bounds.
/// With κ and γ the largest eigenvalues of K and C of one body (mass scaled to one)
///
///     τ = 1/(γ/2 + √(γ²/4 + κ)) :   one body between fixed ones is stable up to 2 τ,  any heap up to τ.            (2)
///
/// (2 τ is the root of 1 = Δt γ/2 + Δt² κ/4; that of the heap's 1 = Δt γ + Δt² κ/2 is above τ.) Without dampers τ = 1/ω with ω the body's
/// highest frequency, √κ.
///
/// SI units; vectors in world axes.
namespace polytope {

using Matrix6 = Eigen::Matrix<Real, 6, 6>;
using Vector6 = Eigen::Matrix<Real, 6, 1>;

/// Matrix of v ↦ a × v.
inline Matrix3 crossMatrix(const Vector3& a)
{
	Matrix3 m;
	m << 0, -a[2], a[1], a[2], 0, -a[0], -a[1], a[0], 0;
	return m;
}

/// Mobility (inverse mass and inertia) of a body: both zero for one that cannot move.
struct Mobility {
	Vector3 translation = Vector3::Zero(); ///< 1/√m along each world axis, 0 where blocked
	Matrix3 rotation    = Matrix3::Zero(); ///< S with S Sᵀ the inverse of the inertia tensor, 0 where blocked

	bool moves() const { return translation != Vector3::Zero() || rotation != Matrix3::Zero(); }
};

/// Springs and dampers of one contact.
struct ContactSprings {
	Vector3 normal          = Vector3::Zero();
	Real    normalStiffness = 0, shearStiffness = 0;   ///< [N/m]
	Real    normalDamper = 0, shearDamper = 0;         ///< [N s/m]
	Matrix3 rockingStiffness  = Matrix3::Zero();       ///< moment per tilt, of the moving contact point [N m/rad]
	Matrix3 rockingDamper     = Matrix3::Zero();       ///< [N m s/rad]
	Vector3 shearOffset       = Vector3::Zero();       ///< from the contact point to that of the shear spring, across the normal [m]
	Real    twistingStiffness = 0, twistingDamper = 0; ///< about the normal [N m/rad], [N m s/rad]
};

/// K and C of one body between fixed neighbours, in coordinates in which its mass matrix is the identity.
class BodyStiffness {
public:
	explicit BodyStiffness(const Mobility& mobility) : mobility_(mobility) { }

	/// \param arm from the body's centre to the contact point
	void add(const ContactSprings& springs, const Vector3& arm)
	{
		const Motion  motion = motionAt(arm), sheared = motionAt(arm + springs.shearOffset);
		const Vector6 along = motion.transpose() * springs.normal, out = sheared.transpose() * springs.normal;
		const Matrix6 across = sheared.transpose() * sheared - out * out.transpose();
		const Vector3 twist  = mobility_.rotation.transpose() * springs.normal;
		stiffness_ += springs.shearStiffness * across + springs.normalStiffness * along * along.transpose();
		rocking_ += mobility_.rotation.transpose() * springs.rockingStiffness * mobility_.rotation;
		if (springs.twistingStiffness > 0) rocking_ += springs.twistingStiffness * twist * twist.transpose();
		if (springs.normalDamper > 0 || springs.shearDamper > 0) {
			damping_ += springs.shearDamper * across + springs.normalDamper * along * along.transpose();
			damping_.bottomRightCorner<3, 3>() += springs.twistingDamper * twist * twist.transpose();
			damped_ = true;
		}
		if (springs.rockingDamper != Matrix3::Zero()) {
			damping_.bottomRightCorner<3, 3>() += mobility_.rotation.transpose() * springs.rockingDamper * mobility_.rotation;
			damped_ = true;
		}
	}

	/// κ [1/s²], with rocking or without.
	Real stiffness(bool rocking = true) const
	{
		Matrix6 sum = stiffness_;
		if (rocking) sum.bottomRightCorner<3, 3>() += rocking_;
		return largestEigenvalue(sum);
	}
	/// γ [1/s].
	Real damping() const { return damped_ ? largestEigenvalue(damping_) : Real(0); }

	/// Bounds of κ and γ from above: at most 6^(1/8) = 1.25 times as large, and cheap.
	Real stiffnessAtMost() const
	{
		Matrix6 sum = stiffness_;
		sum.bottomRightCorner<3, 3>() += rocking_;
		return atMost(sum);
	}
	Real dampingAtMost() const { return damped_ ? atMost(damping_) : Real(0); }

private:
	/// λ⁴ is at most the Frobenius norm of the fourth power; scaled by the largest sum of a row's absolute values, which is no less than λ either.
	static Real atMost(const Matrix6& symmetric)
	{
		const Real row = symmetric.cwiseAbs().rowwise().sum().maxCoeff();
		if (!(row > 0)) return row;
		const Matrix6 scaled = symmetric / row, square = scaled * scaled;
		return row * sqrt(sqrt((square * square).norm()));
	}

	static Real largestEigenvalue(const Matrix6& symmetric)
	{
		return Eigen::SelfAdjointEigenSolver<Matrix6>(symmetric, Eigen::EigenvaluesOnly).eigenvalues()[5];
	}

	using Motion = Eigen::Matrix<Real, 3, 6>;

	/// The motion of a point of the body.
	Motion motionAt(const Vector3& arm) const
	{
		Motion motion;
		motion.leftCols<3>()  = mobility_.translation.asDiagonal();
		motion.rightCols<3>() = -crossMatrix(arm) * mobility_.rotation;
		return motion;
	}

	Mobility mobility_;
	Matrix6  stiffness_ = Matrix6::Zero(), damping_ = Matrix6::Zero();
	Matrix3  rocking_ = Matrix3::Zero();
	bool     damped_  = false;
};

/// τ of (2) [s]; infinite without stiffness and damping.
inline Real safeTimeStep(Real stiffness, Real damping)
{
	const Real half = damping / 2;
	return 1 / (half + sqrt(half * half + stiffness));
}

/// Largest eigenvalue of one contact alone at a point of the body, over the larger of its stiffnesses [1/kg]: κ of a contact
/// whose normal is not known is at most this times that.
inline Real reachOf(const Mobility& mobility, const Vector3& arm)
{
	const Matrix3 turning = crossMatrix(arm) * mobility.rotation;
	Matrix3       sum     = turning * turning.transpose();
	sum += mobility.translation.cwiseAbs2().asDiagonal();
	return Eigen::SelfAdjointEigenSolver<Matrix3>(sum, Eigen::EigenvaluesOnly).eigenvalues()[2];
}

/// A bound from above of the reach of all points in a ball about the centre of a part: √reach is a norm of the arm's part of the motion.
inline Real reachOfBall(const Mobility& mobility, const Vector3& centre, Real radius)
{
	const Matrix3 inverse = mobility.rotation * mobility.rotation.transpose();
	const Real    turning = Eigen::SelfAdjointEigenSolver<Matrix3>(inverse, Eigen::EigenvaluesOnly).eigenvalues()[2];
	if (centre == Vector3::Zero()) return reachOf(mobility, centre) + radius * radius * turning;
	const Real root = sqrt(reachOf(mobility, centre)) + radius * sqrt(turning);
	return root * root;
}

} // namespace polytope
