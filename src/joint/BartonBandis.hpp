// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "joint/JointTolerances.hpp"
#include "numbers/Real.hpp"

/// Shear strength and dilation of rough joints by Barton's equation, with the roughness that is mobilised at a shear displacement.
///
///     φ(σ, δ) = φᵣ + JRC_mob(δ) log₁₀(JCS/σ),     τ = σ tan φ                                                   (Barton & Choubey 1977)
///
/// JRC_mob/JRC is a function of δ/δ_peak (Barton 1982; Barton, Bandis & Bakhtar 1985, Int. J. Rock Mech. Min. Sci. 22:121-140),
/// with straight lines in between: 0 up to 0.3, then 0.75 at 0.6, 1 at 1, 0.85 at 2, 0.70 at 4, 0.50 at 10, 0.40 at 25, 0 from 100 on. Its negative
/// values before 0.3, where friction is only being mobilised, stand for what the joint's elastic shear stiffness does here.
///
///     dilation angle d = JRC_mob log₁₀(JCS/σ)/M,     M = JRC/(12 log₁₀(JCS/σ)) + 0.7, from 1 to 2                  (1985)
///
/// JRC and JCS of a joint of the length Lₙ in the field follow from JRC₀ and JCS₀ of a sample of the length L₀ (1985):
///
///     JRC = JRC₀ (Lₙ/L₀)^(−0.02 JRC₀),     JCS = JCS₀ (Lₙ/L₀)^(−0.03 JRC₀),     δ_peak = Lₙ/500 (JRC/Lₙ)^0.33   (lengths in metres)
///
/// At σ ≥ JCS roughness gives nothing. φ stays at most tolerance::steepestBarton.
namespace polytope {

/// JRC_mob/JRC at this δ/δ_peak.
Real mobilisedRoughness(Real displacement);

class BartonBandis {
public:
	/// Angles in radians, lengths in metres, JCS in Pa.
	struct Values {
		Real roughness        = 0; ///< JRC₀ [-]
		Real wallStrength     = 1; ///< JCS₀
		Real residualFriction = 0; ///< φᵣ
		Real sampleLength     = 0.1;
		Real jointLength      = 0.1;
	};

	explicit BartonBandis(const Values& values);
	/// Smooth, without friction.
	BartonBandis() : BartonBandis(Values()) { }
	/// Joint of two different sides: of JRC, JCS and φᵣ the lesser, of δ_peak the greater.
	static BartonBandis between(const BartonBandis& one, const BartonBandis& other);

	/// φ at this normal stress [Pa] and shear displacement [m].
	Real frictionAngle(Real stress, Real displacement) const;
	/// d there.
	Real dilationAngle(Real stress, Real displacement) const;

private:
	/// log₁₀(JCS/σ), at least 0.
	Real logarithm(Real stress) const;
	/// JRC_mob log₁₀(JCS/σ) [radians], such that φ is not above the largest.
	Real roughnessAngle(Real stress, Real displacement) const;

	Real roughness_;    ///< JRC of the joint's length
	Real wallStrength_; ///< JCS of the joint's length [Pa]
	Real friction_;     ///< φᵣ
	Real peak_;         ///< δ_peak [m]

	template <class Visit> friend void visitParts(BartonBandis& joint, const Visit& visit)
	{
		visit("roughness", joint.roughness_);
		visit("wallStrength", joint.wallStrength_);
		visit("friction", joint.friction_);
		visit("peak", joint.peak_);
	}
};

} // namespace polytope
