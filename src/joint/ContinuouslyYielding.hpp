// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "numbers/Real.hpp"

/// Shear law of a joint that yields from the first displacement on, and whose asperities wear off (Cundall & Hart 1984, "Analysis of block test no. 1
/// inelastic rock mass behavior: phase 2"; Itasca, UDEC and 3DEC, continuously-yielding joint model):
///
///     Δτ = F k_s Δu,     F = (1 − τ/τₘ)/(1 − r),     τₘ = σ tan φₘ,     k_s = k (σ/σ₀)ᵉ
///     Δuₚ = (1 − F) |Δu|,     Δφₘ = −(φₘ − φ) Δuₚ/R,     dilation angle arctan(|τ|/σ) − φ
///
/// with τ the stress against the motion, R the roughness [m], φ the intrinsic friction angle. r is 0 at first, and τ/τₘ where the motion
/// turned back last, at most tolerance::mostAtReversal: from there F starts at 1 again.
namespace polytope {

class ContinuouslyYielding {
public:
	/// Angles in radians.
	struct Values {
		Real friction          = 0; ///< φ
		Real initialFriction   = 0; ///< φₘ at first
		Real roughness         = 1; ///< R [m]
		Real stiffnessExponent = 0; ///< e
		Real referenceStress   = 1; ///< σ₀ [Pa]
	};

	explicit ContinuouslyYielding(const Values& values) : values_(values), bounding_(values.initialFriction) { }
	/// A joint without friction.
	ContinuouslyYielding() : ContinuouslyYielding(Values()) { }
	/// Joint of two different sides: it has the lesser of the friction angles, roughnesses and exponents, and the greater of the reference stresses.
	static ContinuouslyYielding between(const ContinuouslyYielding& one, const ContinuouslyYielding& other);

	/// φₘ.
	Real frictionAngle() const { return bounding_; }
	/// (σ/σ₀)ᵉ, at least tolerance::softestShear.
	Real stiffness(Real stress) const;
	/// F of a motion in this direction (a unit vector), 0 to 1. `stressRatio`: τ/τₘ against it.
	Real elasticPart(const Vector3& direction, Real stressRatio);
	/// Wears the asperities by this plastic displacement [m].
	void wear(Real slip);
	/// Dilation angle at this τ/σ; at least 0.
	Real dilationAngle(Real ratio) const;
	/// The contact has turned.
	template <class Turn> void turn(const Turn& turn) { turn(direction_); }

private:
	Values  values_;
	Real    bounding_, atReversal_ = 0;
	Vector3 direction_ = Vector3::Zero(); ///< of the last motion

	template <class Visit> friend void visitParts(ContinuouslyYielding& joint, const Visit& visit)
	{
		visit("friction", joint.values_.friction);
		visit("initialFriction", joint.values_.initialFriction);
		visit("roughness", joint.values_.roughness);
		visit("stiffnessExponent", joint.values_.stiffnessExponent);
		visit("referenceStress", joint.values_.referenceStress);
		visit("bounding", joint.bounding_);
		visit("atReversal", joint.atReversal_);
		visit("direction", joint.direction_);
	}
};

} // namespace polytope
