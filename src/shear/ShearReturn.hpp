// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "shear/ShearStrength.hpp"

/// Elastic bed and strength together: what is left of a load that is beyond the limit surface, and the slip by which the rest is lost.
namespace polytope {

/// Stiffness of the bed for motions of a point, (s₁, s₂, φ): k in each direction at the area's centroid, `offset` from the point, and k ρ²
/// about the normal there, ρ² the mean square of the distance from the centroid.
Matrix3 bedStiffness(Real stiffness, Real gyrationSquared, const Vector2& offset);

/// Brings a load (force, and moment about the strength's centre) back to the limit surface, and returns the slip; zero where the load is within it.
///
/// The slip is the minimum of the convex D(x) − load·x + ½ x·K x, D of ShearStrength.hpp: there resistance(x) = load − K x, which is the
/// load that stays (backward Euler for perfect plasticity with an associated flow, Simo & Hughes 1998, "Computational inelasticity",
/// chapter 3). It always lies on the limit surface, also where the iteration ends early.
///
/// \param likely a motion from which the search begins, of any length: it makes the answer cheaper and changes it by rounding alone. Zero if
/// there is none. Afterwards the one at which the search has ended, for the next step: the slip, or what comes nearest to one in a face that holds.
Vector3 returnToStrength(const ShearStrength& strength, const Matrix3& stiffness, Vector3& load, Vector3& likely);

} // namespace polytope
