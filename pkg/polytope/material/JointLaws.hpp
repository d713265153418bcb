// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <lib/serialization/Serializable.hpp>

#include <src/joint/BartonBandis.hpp>
#include <src/joint/ClosureLaw.hpp>
#include <src/joint/ContinuouslyYielding.hpp>

#include "host/CheckedAttributes.hpp"

/// Laws that a RockJointMat has in place of a linear spring and of Mohr-Coulomb strength: parameters as scripts see them. What a contact
/// keeps of them is in joint/LawsOfJoint.hpp.
namespace yade {

class JointClosure : public Serializable {
public:
	virtual ~JointClosure() = default;

	/// \param stiffness of the material [Pa/m, or N/m for each contact]
	virtual polytope::ClosureLaw law(Real stiffness) const;
	/// What is wrong with it, that it has none among others; empty if nothing is.
	std::string fault(Real stiffness) const;

	YADE_CLASS_BASE_DOC(JointClosure, Serializable, "Base of the normal laws for :yref:`RockJointMat.closure`.");
};
REGISTER_SERIALIZABLE(JointClosure);

class HyperbolicClosure : public JointClosure {
public:
	virtual ~HyperbolicClosure() = default;

	polytope::ClosureLaw law(Real stiffness) const override;

	/// Refuses values out of range with std::invalid_argument naming the attribute, and restores the last good ones.
	void postLoad(HyperbolicClosure&);

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(HyperbolicClosure, JointClosure,
	R"""(Normal law of a joint that stiffens as it closes, for :yref:`RockJointMat.closure`: $\sigma=k_n\delta/(1-\delta/\delta_m)$, with the
material's :yref:`normalStiffness<RockJointMat.normalStiffness>` as the initial stiffness (Bandis, Lumsden & Barton 1983, Int. J. Rock Mech. Min. Sci.
20:249-268). Reversible; the loops of loading and unloading that they measured are left out. From 99 % of the maximum closure on it is straight.)""",
		((Real, maximumClosure, 1e-4, Attr::triggerPostLoad, "$\\delta_m$ [m], above 0."))
	);
	// clang-format on

private:
	CheckedAttributes<Real> checked_ { std::tie(maximumClosure) };
};
REGISTER_SERIALIZABLE(HyperbolicClosure);

class PowerClosure : public JointClosure {
public:
	virtual ~PowerClosure() = default;

	/// Checks the attributes as HyperbolicClosure::postLoad() does.
	void                 postLoad(PowerClosure&);
	polytope::ClosureLaw law(Real stiffness) const override;

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(PowerClosure, JointClosure,
	R"""(Normal law of a joint whose stiffness goes with a power of the normal stress, for :yref:`RockJointMat.closure`: $k_n(\sigma/\sigma_0)^e$
with the material's :yref:`normalStiffness<RockJointMat.normalStiffness>` as the stiffness at the reference stress $\sigma_0$; that of the
continuously-yielding joint model, $a_n\sigma^e$ (Cundall & Hart 1984; Itasca, UDEC). Reversible.)""",
		((Real, exponent, 0.5, Attr::triggerPostLoad, "$e$ [-], from 0 (linear) to below 1."))
		((Real, referenceStress, 1e6, Attr::triggerPostLoad, "$\\sigma_0$ [Pa], above 0; with a stiffness per contact the reference force "
		        "[N]."))
	);
	// clang-format on

private:
	CheckedAttributes<Real, Real> checked_ { std::tie(exponent, referenceStress) };
};
REGISTER_SERIALIZABLE(PowerClosure);

class JointStrength : public Serializable {
public:
	virtual ~JointStrength() = default;

	YADE_CLASS_BASE_DOC(JointStrength, Serializable, "Base of the shear laws for :yref:`RockJointMat.strength`.");
};
REGISTER_SERIALIZABLE(JointStrength);

class BartonBandisStrength : public JointStrength {
public:
	virtual ~BartonBandisStrength() = default;

	/// Checks the attributes as HyperbolicClosure::postLoad() does.
	void postLoad(BartonBandisStrength&);
	/// \param residualFriction angle [rad]
	polytope::BartonBandis law(Real residualFriction) const;

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(BartonBandisStrength, JointStrength,
	R"""(Shear strength and dilation of a rough joint, for :yref:`RockJointMat.strength`: $\tau=\sigma\tan(\phi_r+JRC_{mob}\log_{10}(JCS/\sigma))$
with the material's :yref:`frictionAngle<RockJointMat.frictionAngle>` as the residual angle $\phi_r$ (Barton & Choubey 1977, Rock Mechanics 10:1-54;
Barton, Bandis & Bakhtar 1985, Int. J. Rock Mech. Min. Sci. 22:121-140). $\sigma$ is the mean normal stress over the contact area; $JRC_{mob}$ follows
the shear displacement, elastic and plastic, since the contact was made, and is largest at the peak displacement (docs/joint-laws.md). The friction
angle stays at most 70°.)""",
		((Real, JRC, 8, Attr::triggerPostLoad, "Joint roughness coefficient of a sample of "
		        ":yref:`sampleLength<BartonBandisStrength.sampleLength>` [-], from 0 to 30."))
		((Real, JCS, 50e6, Attr::triggerPostLoad, "Compressive strength of the joint's walls, of the same sample [Pa], above 0."))
		((Real, sampleLength, 0.1, Attr::triggerPostLoad, "$L_0$ [m], above 0."))
		((Real, jointLength, 0.1, Attr::triggerPostLoad, "$L_n$ [m], above 0: length of the joint in the field, as a rule the spacing of "
		        "the joints that cross it. JRC and JCS are scaled to it, and the peak displacement follows from it."))
	);
	// clang-format on

private:
	CheckedAttributes<Real, Real, Real, Real> checked_ { std::tie(JRC, JCS, sampleLength, jointLength) };
};
REGISTER_SERIALIZABLE(BartonBandisStrength);

class ContinuouslyYieldingStrength : public JointStrength {
public:
	virtual ~ContinuouslyYieldingStrength() = default;

	/// Checks the attributes as HyperbolicClosure::postLoad() does.
	void postLoad(ContinuouslyYieldingStrength&);
	/// \param friction intrinsic angle [rad]
	polytope::ContinuouslyYielding law(Real friction) const;

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(ContinuouslyYieldingStrength, JointStrength,
	R"""(Shear law of a joint that yields from the first displacement on and whose asperities wear off, for :yref:`RockJointMat.strength` (Cundall
& Hart 1984; Itasca, UDEC, continuously-yielding joint model): $\Delta\tau=Fk_s\Delta u$ with $F=(1-\tau/\tau_m)/(1-r)$, $\tau_m=\sigma\tan\phi_m$ and
$r$ the $\tau/\tau_m$ where the motion turned back last, at most 0.75. The angle $\phi_m$ falls from
:yref:`initialFrictionAngle<ContinuouslyYieldingStrength.initialFrictionAngle>` to the material's :yref:`frictionAngle<RockJointMat.frictionAngle>`
$\phi$ by $d\phi_m=-(\phi_m-\phi)/R\,du_p$ with the plastic displacement. The joint dilates by the angle $\arctan(\tau/\sigma)-\phi$. The shear
stiffness is $k_s(\sigma/\sigma_0)^e$ (docs/joint-laws.md).)""",
		((Real, initialFrictionAngle, 0.9, Attr::triggerPostLoad, "$\\phi_m$ of the fresh joint [rad], not below the material's "
		        "frictionAngle and below $\\pi/2$."))
		((Real, roughness, 1e-3, Attr::triggerPostLoad, "$R$ [m], above 0: plastic displacement by which the difference of angles falls to "
		        "1/e."))
		((Real, stiffnessExponent, 0, Attr::triggerPostLoad, "$e$ [-] of the shear stiffness, from 0 to 1."))
		((Real, referenceStress, 1e6, Attr::triggerPostLoad, "$\\sigma_0$ [Pa], above 0: there the shear stiffness is the material's."))
	);
	// clang-format on

private:
	CheckedAttributes<Real, Real, Real, Real> checked_ { std::tie(
		initialFrictionAngle, roughness, stiffnessExponent, referenceStress) };
};
REGISTER_SERIALIZABLE(ContinuouslyYieldingStrength);

} // namespace yade
