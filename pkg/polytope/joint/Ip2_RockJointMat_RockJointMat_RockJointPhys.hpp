// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "bond/BondsOfScene.hpp"
#include "joint/RockJointPhys.hpp"
#include "material/RockJointMat.hpp"
#include "material/StiffnessRules.hpp"

#include <core/Dispatching.hpp>
#include <pkg/common/MatchMaker.hpp>

/// Physics of a contact of two rock joint materials.
namespace yade {

class Ip2_RockJointMat_RockJointMat_RockJointPhys : public IPhysFunctor, public GivesJointStiffness {
public:
	void go(const shared_ptr<Material>& material1, const shared_ptr<Material>& material2,
	        const shared_ptr<Interaction>& contact) override;
	/// Makes the physics from these materials, whatever those of the faces are.
	void          make(const RockJointMat& m1, const RockJointMat& m2, const shared_ptr<Interaction>& contact);
	StiffnessRule stiffnessRule(const Material& material1, const Material& material2) const override;
	FUNCTOR2D(RockJointMat, RockJointMat);
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(Ip2_RockJointMat_RockJointMat_RockJointPhys, IPhysFunctor,
	R"""(Creates a :yref:`RockJointPhys` from two :yref:`RockJointMats<RockJointMat>`. Stiffnesses are those of the joint, so equal materials give
exactly their value; two different ones each contribute half of the joint's compliance, $k=2k_1k_2/(k_1+k_2)$. Of the friction angles, cohesions,
tensile strengths, dilation angles and limits, the smaller ones hold (the residual angle of a material without one is its friction angle). The joint
has a closure or a shear law of its own (:yref:`RockJointMat.closure`, :yref:`RockJointMat.strength`) if both materials have one of the same kind,
else it is a linear spring, and Mohr-Coulomb. Hyperbolas are combined by the mean of the maximum closures, powers of the stress by the means; of
roughness (each scaled to its joint's length), wall strength, friction angles and exponents the smaller ones hold, of peak displacements and reference
stresses the larger ones.

Where faces have materials of their own (:yref:`faceMaterials<Polytope.faceMaterials>`), that of the face which lies closest to the plane of the
contact is the joint's; of two faces that lie on each other both count, like two materials. A contact that ends and is made again is one of the face
that it then lies on. Stiffnesses of faces should not be above those of the bodies' own materials, by which :yref:`PolytopeTimeStepper` chooses the
step before bodies touch.)""",
		((bool, stiffnessPerArea, true, , R"""(False: as if all materials had :yref:`stiffnessPerArea<RockJointMat.stiffnessPerArea>` = False.
With a stiffness per area, contacts whose geometry is not a :yref:`PolytopeGeom` have no contact area: a :yref:`ScGeom` (two spheres) gets
$A=\pi\min(R_1,R_2)^2$ once and for all, anything else 1 m². Their law is YADE's own :yref:`Law2_ScGeom_FrictPhys_CundallStrack`, which takes a
:yref:`RockJointPhys` as any :yref:`FrictPhys` and has to be in the loop besides this plug-in's.)"""))
		((long, intactUntilStep, -1, , "Joints made in steps up to this one are :yref:`intact<RockJointPhys.intact>`, later ones start with "
		        "residual values; -1: all are intact. Set it to *O.iter* when the rock mass is assembled, so that blocks that meet later "
		        "are not bonded."))
		((shared_ptr<MatchMaker>, kn, , , ":yref:`MatchMaker` for the joint's normal stiffness instead of the rule above."))
		((shared_ptr<MatchMaker>, ks, , , ":yref:`MatchMaker` for the joint's shear stiffness instead of the rule above."))
		((shared_ptr<MatchMaker>, frictAngle, , , ":yref:`MatchMaker` for the friction angle [rad] instead of the smaller one."))
	);
	// clang-format on

private:
	BondsInStep bonds_;
};
REGISTER_SERIALIZABLE(Ip2_RockJointMat_RockJointMat_RockJointPhys);

} // namespace yade
