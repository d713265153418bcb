// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <pkg/common/ElastMat.hpp>

#include "material/JointLaws.hpp"
#include "material/StiffnessRules.hpp"

#include <optional>

namespace yade {

class RockJointMat : public FrictMat {
public:
	virtual ~RockJointMat() = default;

	/// Refuses values out of range with std::invalid_argument naming the attribute, and restores the last good ones.
	void postLoad(RockJointMat&);

	/// FrictMat's attribute, checked like this class' own.
	Real getFrictionAngle() const { return frictionAngle; }
	void setFrictionAngle(Real angle)
	{
		frictionAngle = angle;
		postLoad(*this);
	}

	/// The setters name the argument if it is a law of the wrong kind; the properties that YADE makes of attributes would not.
	shared_ptr<JointClosure>  getClosure() const { return closure; }
	shared_ptr<JointStrength> getStrength() const { return strength; }
	void                      setClosure(const boost::python::object& given);
	void                      setStrength(const boost::python::object& given);
	void                      pyHandleCustomCtorArgs(boost::python::tuple& arguments, boost::python::dict& keywords) override;

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(RockJointMat, FrictMat,
	R"""(Material of rock blocks, given by the joints between them [Hart1988]_: stiffnesses, Mohr-Coulomb strength and dilation of a joint whose
two sides are of this material. :yref:`Ip2_RockJointMat_RockJointMat_RockJointPhys` says how two different materials combine,
:yref:`Law2_PolytopeGeom_RockJointPhys_MohrCoulomb` what the values do. Values out of range are refused when set. Of the inherited attributes,
:yref:`density<Material.density>` gives the bodies their mass; :yref:`young<ElastMat.young>` and :yref:`poisson<ElastMat.poisson>` are used by YADE's
own functors (:yref:`Ip2_FrictMat_FrictMat_FrictPhys`) alone.)""",
		((Real, normalStiffness, 1e9, Attr::triggerPostLoad, "Normal stiffness $k_n$ of the joint, above 0: [Pa/m] (times the contact area) "
		        "or [N/m] for each contact, see :yref:`stiffnessPerArea<RockJointMat.stiffnessPerArea>`. With the contact model *boon2012* "
		        "contact normals are closer to that of the body with the larger value, see :yref:`PolytopeGeom.normalWeight`."))
		((bool, stiffnessPerArea, true, , "Unit of both stiffnesses. True: [Pa/m], the usual model of rock joints, an elastic foundation: "
		        "the contact's :yref:`kn<NormPhys.kn>` is $k_n A$ with its present area $A$ in each step. False: [N/m] for each contact, "
		        "whatever its area, as suits grains. A joint of two materials in different units has the stiffness of the one that is given "
		        "for each contact, alone."))
		((Real, shearStiffness, 1e9, Attr::triggerPostLoad, "Shear stiffness $k_s$ of the joint, above 0, in the units of "
		        ":yref:`normalStiffness<RockJointMat.normalStiffness>`."))
		((Real, cohesion, 0, Attr::triggerPostLoad, "Cohesion $c$ [Pa], at least 0: shear strength of the intact joint at zero normal force "
		        "over its contact area. When the joint fails in shear or tension, :yref:`residualCohesion<RockJointMat.residualCohesion>` "
		        "takes its place for good."))
		((Real, residualCohesion, 0, Attr::triggerPostLoad, "Cohesion after the joint has failed [Pa], at least 0 and at most "
		        ":yref:`cohesion<RockJointMat.cohesion>`. 0: the joint is brittle, and where a body is held by several joints the first one "
		        "that fails may take the others with it. Equal to *cohesion*: perfectly plastic, as limit equilibrium assumes (Hoek & Bray, "
		        "*Rock Slope Engineering*): all joints bear their full strength at the same time."))
		((Real, tensileStrength, 0, Attr::triggerPostLoad, "Tensile strength [Pa] of the intact joint, at least 0, times the contact area. "
		        "When the joint fails in shear or tension, :yref:`residualTensileStrength<RockJointMat.residualTensileStrength>` takes its "
		        "place for good. A joint with cohesion but no tensile strength fails when it opens."))
		((Real, residualTensileStrength, 0, Attr::triggerPostLoad, "Tensile strength that stays while the joint is pulled open [Pa], at "
		        "least 0 and at most :yref:`tensileStrength<RockJointMat.tensileStrength>`. 0: the joint is brittle. Equal to "
		        "*tensileStrength*: perfectly plastic. With a stiffness per area each fibre of the faces' common area yields for itself, so "
		        "that an intact joint that is bent bears more than its edge; after slip, and with a stiffness per contact, the whole joint "
		        "does. It ends where the gap reaches the inscribed radius of the smaller body."))
		((Real, residualFrictionAngle, -1, Attr::triggerPostLoad, "Friction angle after the joint has failed (first slip, or tension) "
		        "[rad], from 0 to below $\\pi/2$; -1: the same as :yref:`frictionAngle<RockJointMat.frictionAngle>`."))
		((Real, dilationAngle, 0, Attr::triggerPostLoad, "Dilation angle $\\psi$ [rad], from 0 to below $\\pi/2$: a joint that has slipped "
		        "by $u$ in total is wider by $u\\tan\\psi$. Not above the friction angle in any real joint."))
		((Real, dilationLimit, std::numeric_limits<Real>::infinity(), Attr::triggerPostLoad, "Largest widening by dilation [m], at least 0 "
		        "(infinity: none); the height of the joint's asperities."))
		((shared_ptr<JointClosure>, closure, , Attr::triggerPostLoad, "Normal law."))
		((shared_ptr<JointStrength>, strength, , Attr::triggerPostLoad, "Shear law."))
		((Real, reduction, 1, Attr::triggerPostLoad, "What $\\tan\\phi$ of :yref:`strength<RockJointMat.strength>` is divided by [-], above "
		        "0, at each stress and displacement: *polytope.factorOfSafety* sets it. Of Mohr-Coulomb the values themselves are divided."))
		, /*ctor*/ createIndex();
		, /*py*/
		.add_property("frictionAngle", &RockJointMat::getFrictionAngle, &RockJointMat::setFrictionAngle,
		        "Friction angle $\\phi$ of the joint [rad], from 0 to below $\\pi/2$ (in scripts: *radians(degrees)*). Contacts take it "
		        "when they are made; afterwards change :yref:`FrictPhys.tangensOfFrictionAngle` of their physics.")
		.add_property("closure", &RockJointMat::getClosure, &RockJointMat::setClosure, "Normal law of a joint that stiffens as it closes: "
		        ":yref:`HyperbolicClosure` or :yref:`PowerClosure`; None: a linear spring. Needs *tensileStrength* 0.")
		.add_property("strength", &RockJointMat::getStrength, &RockJointMat::setStrength, "Shear law in place of Mohr-Coulomb with "
		        "dilation: :yref:`BartonBandisStrength` or :yref:`ContinuouslyYieldingStrength`, whose residual friction is "
		        ":yref:`frictionAngle<RockJointMat.frictionAngle>`; None: Mohr-Coulomb. Cohesion, tensile strength, dilation and residual "
		        "values belong to Mohr-Coulomb and are refused beside it.")
	);
	// clang-format on
	REGISTER_CLASS_INDEX(RockJointMat, FrictMat);

private:
	using Checked = CheckedAttributes<Real, Real, Real, Real, Real, Real, Real, Real, Real, Real, Real, shared_ptr<JointClosure>,
	        shared_ptr<JointStrength>>;
	Checked::References checkedOnes();
	void                refuseValues() const;
	/// Refuses what does not belong to the laws that the material has.
	void refuseForLaws() const;
	void refuseResidualsAbovePeak() const;

	Checked checked_ { checkedOnes() };
};
REGISTER_SERIALIZABLE(RockJointMat);

/// Closure law of a joint between these sides, which has this normal stiffness [Pa/m or N/m]; none unless both have one of the same kind.
std::optional<polytope::ClosureLaw> closureOfJoint(const RockJointMat& side1, const RockJointMat& side2, Real stiffness);

/// The rule for a joint of two materials: per area where both are; Unknown where one of them is no RockJointMat.
StiffnessRule stiffnessRuleOf(const Material& material1, const Material& material2);

/// Joint stiffness of two materials, each giving half of the compliance.
inline Real stiffnessInSeries(Real k1, Real k2) { return k1 == k2 ? k1 : 2 * k1 * k2 / (k1 + k2); }

} // namespace yade
