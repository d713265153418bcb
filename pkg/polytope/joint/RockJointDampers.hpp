// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <lib/base/Math.hpp>

/// Dampers of rock joints, c = 2 ζ √(m k), that add up to one for each body and support.
///
/// A body that lies on N pieces has N contacts, each with a part of the stiffness K. Critical damping of the whole is 2 √(m K); N dampers of
/// 2 √(m k) would be √N of that, for N contacts of stiffness k each √N too much as well, and beyond a certain N they throw the body back within
/// one step. So each contact damps the part of the body's mass that it carries: sᵢ = kᵢ/K, with K that of all contacts of the body along this normal,
/// Σ kⱼ (nⱼ·nᵢ)², and the masses of a pair are s₁ m₁ and s₂ m₂. Then Σ 2 √(sᵢ m kᵢ) = 2 √(m K): what one contact would have. A contact that is alone
/// has s = 1. Since k and K of the last step are taken for s and k of this one beside it, Σ √(sᵢ kᵢ) ≤ √(Σ sᵢ Σ kᵢ) ≤ √K holds in each step, whatever
/// the contacts do. A contact that begins has not been in a sum: its part is that of the area that a body shows in this direction, so a face that
/// comes down on many pieces at once is damped as on one.
///
/// No damper takes more than the motion that there is: with w₁, w₂ the velocity that an impulse of one gives to either body at the contact
/// point, rotation included, c Δt ≤ 1/(w₁/s₁ + w₂/s₂). The parts sum to one, so this holds for all dampers of a body together, too.
namespace yade {

class Body;
class PolytopeGeom;
class RockJointPhys;
class Scene;
class StiffnessSums;

/// Critical damper of a spring of this stiffness, for one over the masses that it damps [N·s/m].
inline Real criticalDamper(const Real& stiffness, const Real& inverseMass) { return 2 * math::sqrt(stiffness / inverseMass); }

/// Mean square of the distance from an axis through the centroid of the area that a rocking damper is spread over: a square of the
/// contact's area, or, of polygons, its length [m²].
Real rockingGyrationSquared(const Body& body1, const Body& body2, const RockJointPhys& phys);

/// 1/(s₁ m₁) + 1/(s₂ m₂) of a contact between two steps, from the newest sums [1/kg]; 0 where neither body can move. The sums are those
/// that the dampers of the next step read, so that what is the time step's limit now is what they do then.
Real inverseDampedMass(const Body& body1, const Body& body2, const Vector3r& normal, const RockJointPhys& phys, const StiffnessSums& sums,
        const Scene& scene);

} // namespace yade
