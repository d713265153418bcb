// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "numbers/Real.hpp"

/// Force and moment of a bond between two rigid bodies from where they are, not from how they came there: no drift.
///
/// Two frames, q₁ fixed in body 1 and q₂ in body 2, coincide while the bond is unstrained; their origins are x₁ and x₂. The mean frame
/// Q = q₁ p with p² = q₁⁻¹ q₂ lies half way between them. With p = (c, v) in scalar and vector part (α: angle between the frames, |v| = sin α/4)
///
///     d = Qᵀ (x₂ − x₁),     θ = 4 v,     V = ½ d·K d + ½ θ·B θ,     K, B diagonal in Q.                                    (1)
///
/// θ is the rotation vector up to α³/96. The force f = K d on body 2 and −f on body 1 act at one point, half way between x₁ and x₂, with the
/// moments M and −M. Their power is that of the bodies, f·(ḋ + …) + M·w with w = ω₂ − ω₁ (in Q). It equals −dV/dt for every motion if
///
///     M = (g − v (v·g))/(4 c),     g = 4 B θ + 2 (d × f) × v,                                                              (2)
///
/// from v̇ = (w − v (v·w))/(4 c) and (ω₁ + ω₂)/2 = Ω + 2 v × v̇, Ω the angular velocity of Q. So the bond has an energy exactly, also at large
/// displacements and rotations (α < 2π), and keeps linear and angular momentum.
///
/// Axis 0 of the frame is the bond's normal from body 1 to body 2, axes 1 and 2 are principal axes of its area. SI units.
namespace polytope {

/// Relative position of the bodies at a bond.
struct BondMotion {
	Quaternion mean;         ///< Q: from the bond's axes to the world's
	Quaternion half;         ///< p
	Vector3    displacement; ///< d of (1) [m]; d[0] > 0: opening
	Vector3    rotation;     ///< θ of (1) [rad]
};

/// \param q1,q2 the frames, unit quaternions
/// \param between x₂ − x₁, world axes
inline BondMotion bondMotion(const Quaternion& q1, const Quaternion& q2, const Vector3& between)
{
	Quaternion relative = q1.conjugate() * q2;
	if (relative.w() < 0) relative.coeffs() = -relative.coeffs();
	BondMotion motion;
	motion.half         = Quaternion(1 + relative.w(), relative.x(), relative.y(), relative.z()).normalized();
	motion.mean         = (q1 * motion.half).normalized();
	motion.displacement = motion.mean.conjugate() * between;
	motion.rotation     = 4 * motion.half.vec();
	return motion;
}

/// Force and moment on body 2, world axes; energy stored.
struct BondForce {
	Vector3 force, moment;
	Real    energy;
};

/// \param f,m derivatives of V by d and θ [N, N m]
inline BondForce bondForce(const BondMotion& motion, const Vector3& f, const Vector3& m, Real energy)
{
	const Vector3 &d = motion.displacement, v = motion.half.vec();
	const Vector3  g      = 4 * m + 2 * d.cross(f).cross(v);
	const Vector3  moment = (g - v * v.dot(g)) / (4 * motion.half.w());
	// f and M are derivatives of V by the motion of body 2: the forces on it are their negatives
	return { motion.mean * Vector3(-f), motion.mean * Vector3(-moment), energy };
}

/// \param linear diagonal of K [N/m]
/// \param angular diagonal of B [N m/rad]
inline BondForce bondForce(const BondMotion& motion, const Vector3& linear, const Vector3& angular)
{
	const Vector3 &d = motion.displacement, f = linear.cwiseProduct(d), m = angular.cwiseProduct(motion.rotation);
	return bondForce(motion, f, m, (d.dot(f) + motion.rotation.dot(m)) / 2);
}

} // namespace polytope
