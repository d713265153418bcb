// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact/StiffnessShare.hpp"

#include <pkg/dem/HertzMindlin.hpp>
#include <pkg/dem/ViscoelasticPM.hpp>

namespace yade {

namespace {

	/// False for physics without a stiffness that is known here.
	bool multiplyStiffness(IPhys* physics, const Real& factor)
	{
		auto* springs = dynamic_cast<NormShearPhys*>(physics);
		if (!springs) return false;
		springs->kn *= factor;
		springs->ks *= factor;
		if (auto* hertz = dynamic_cast<MindlinPhys*>(springs)) { // from which its law has the others
			hertz->kno *= factor;
			hertz->kso *= factor;
		} else if (auto* viscous = dynamic_cast<ViscElPhys*>(springs)) {
			viscous->cn *= factor;
			viscous->cs *= factor;
		}
		return true;
	}

} // namespace

StiffnessRule stiffnessRuleOfNew(const Scene& scene, const Interaction& contact)
{
	const auto &material1 = (*scene.bodies)[contact.getId1()]->material, &material2 = (*scene.bodies)[contact.getId2()]->material;
	return material1 && material2 ? stiffnessRuleOfNew(scene, *material1, *material2) : StiffnessRule::Unknown;
}

void giveShare(const Real& share, PolytopeGeom& geom, Interaction& contact, polytope::ContactResult& result)
{
	if (share == geom.share) return;
	if (geom.stiffnessRule == int(StiffnessRule::Unknown)) {
		if (!contact.phys) {
			result.depth *= share;
			return;
		}
		if (!multiplyStiffness(contact.phys.get(), share / geom.share)) return;
	}
	geom.share = share;
}

} // namespace yade
