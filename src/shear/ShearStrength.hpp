// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "shear/ContactOutline.hpp"

/// Shear strength that is spread over the outline of a contact, and the limit surface of force and moment that follows from it.
///
/// At each place of the outline friction and cohesion give a strength τ per area, against the direction in which one face slips over the other there.
/// Faces are rigid: slip is a displacement s and a rotation φ about the normal, v(x) = s + φ n × x. The work that it takes is
///
///     D(s, φ) = ∫ τ |s + φ n × x| dA,       force and moment: its gradient,                                                     (1)
///
/// and all pairs of force and moment that τ can balance are the convex set of which D is the support function, the limit surface (Goyal,
/// Ruina, Papadopoulos 1991, "Planar sliding with dry friction", Wear 143:307-352). τ is linear over the outline, as the pressure of an
/// elastic foundation under a rigid face is: it is given by its resultant and the point through which that acts.
///
/// With the centre of rotation c the integrals are sums over edges. An edge at the distance h from c, its points h m + y e from there with
/// y from y₁ to y₂, ρ² = h² + y², gives the triangle between it and c; along a ray from c the direction of slip is constant and τ linear,
/// so what is left are integrals of ρ, 1/ρ, 1/ρ³ times powers of y: no quadrature. Where the outline is narrow beside its distance from c
/// these triangles cancel; lines along it take their place (StrengthIntegrals.hpp).
namespace polytope {

struct SpreadStrength;

/// A bound from below of the mean distance from any place of a strength that is linear and nowhere negative on a convex outline of this area. At its peak
/// it is at the most three times its mean, for the centroid of a convex outline is a third of its width from the edge or more; and of all
/// densities up to that peak the one on a disc is the nearest to a place.
inline Real leastRadiusOnArea(const Real& area)
{
	using std::sqrt;
	return 2 * sqrt(area / Real(3 * EIGEN_PI)) / 3;
}

/// Whether force and moment are safely within the limit surface of a strength with this total whose mean distance from any place is not below `radius`: it
/// is convex, so it holds all between sliding alone and turning alone.
inline bool surelyHolds(const Vector3& load, const Real& total, const Real& radius)
{
	return load.head<2>().norm() * radius + abs(load[2]) <= total * radius;
}

class ShearStrength {
public:
	/// \param total  ∫ τ dA [N], above 0
	/// \param centre where it acts, on the outline's axes; τ below zero is not taken: then it is as linear as may be
	ShearStrength(const Vector2* corner, int count, const OutlineMoments& moments, Real total, const Vector2& centre);

	Real total() const { return total_; }
	/// Centre of the strength, about which moments are taken [m].
	const Vector2& centre() const { return centre_; }
	/// A bound from below of the mean distance of the strength from any place [m], the mean square over the largest or leastRadiusOnArea(): turned on the
	/// spot, the face resists with total × that distance at least.
	Real leastRadius() const { return leastRadius_; }

	/// Force [N] and moment about the centre [N m] by which the face resists a slip (s₁, s₂ [m], φ [rad]) of its centre, and their derivatives.
	Vector3 resistance(const Vector3& slip, Matrix3* slope = nullptr) const;

	/// Whether force and moment are safely within the limit surface.
	bool surelyHolds(const Vector3& load) const { return polytope::surelyHolds(load, total_, leastRadius_); }

private:
	SpreadStrength spread() const;
	Vector2        corner(int k) const { return corner_[k] + shift_; }
	Vector3        byPoints(const Vector3& slip, bool precise, Matrix3* slope) const;
	Real           narrownessFrom(const Vector2& pole) const;

	const Vector2* corner_;
	int            count_;
	Real           total_;
	Vector2        centre_;
	Vector2        axis_;                          ///< the long one of the outline
	Vector2        shift_       = Vector2::Zero(); ///< from the outline's origin to that of x, the strength's centre
	Real           atCentre_    = 0;               ///< τ there [Pa]
	Vector2        gradient_    = Vector2::Zero(); ///< of τ [Pa/m]
	Real           farthest_    = 0;               ///< corner from the centre [m]
	Real           leastRadius_ = 0;               ///< not above the mean distance
	Real           second_[3] { 0, 0, 0 };         ///< ∫ τ u², ∫ τ u v, ∫ τ v² dA / ∫ τ dA about the centre [m²]
};

} // namespace polytope
