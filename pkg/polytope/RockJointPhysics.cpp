// SPDX-License-Identifier: GPL-2.0-or-later
#include "RockJointPhysics.hpp"

#include <core/Scene.hpp>
#include <lib/high-precision/Constants.hpp>

#include "PolytopeGeom.hpp"

namespace yade {

YADE_PLUGIN((Ip2_RockJointMat_RockJointMat_RockJointPhys));

namespace {

	/// Joint stiffness of two materials, each giving half of the compliance.
	Real seriesStiffness(Real k1, Real k2) { return k1 == k2 ? k1 : 2 * k1 * k2 / (k1 + k2); }

	Real residualAngle(const RockJointMat& material)
	{
		return material.residualFrictionAngle < 0 ? material.frictionAngle : material.residualFrictionAngle;
	}

	/// Area of a contact that has no contact section.
	Real nominalArea(const IGeom* geom)
	{
		const auto* spheres = dynamic_cast<const GenericSpheresContact*>(geom);
		if (!spheres) return 1;
		const Real r1 = spheres->refR1 > 0 ? spheres->refR1 : spheres->refR2,
		           r2 = spheres->refR2 > 0 ? spheres->refR2 : spheres->refR1;
		return Mathr::PI * math::pow(math::min(r1, r2), 2);
	}

	/// A joint that goes on where a bond has failed: without peak strength, without force at the overlap where the bond had none, and with the
	/// bond's shear force, as far as its own strength goes (the law takes the rest away).
	void takeOver(RockJointPhys& phys, const BondRemains& bond, const Interaction& contact, const Scene& scene)
	{
		phys.fail();
		phys.restOverlap = bond.overlap;
		if (!bond.inLastStep) return;
		const Vector3r normal = static_cast<const PolytopeGeom&>(*contact.geom).normal;
		phys.normalForce      = normal.dot(bond.force) * normal;
		phys.shearForce       = bond.force - phys.normalForce;
		phys.shearPoint       = bond.point;
		phys.followsBond      = true;
		if (!scene.trackEnergy) return;
		LastStepOfJoint& last = phys.lastStep.make();
		last.arm1             = bond.point - (*scene.bodies)[contact.getId1()]->state->pos;
		last.arm2             = bond.point - (*scene.bodies)[contact.getId2()]->state->pos;
		if (scene.isPeriodic) last.arm2 -= scene.cell->intrShiftPos(contact.cellDist);
		last.stored = bond.energy;
	}

} // namespace

StiffnessRule Ip2_RockJointMat_RockJointMat_RockJointPhys::stiffnessRule(const Material& material1, const Material& material2) const
{
	if (!dynamic_cast<const RockJointMat*>(&material1) || !dynamic_cast<const RockJointMat*>(&material2)) return StiffnessRule::Unknown;
	return stiffnessPerArea ? StiffnessRule::PerArea : StiffnessRule::PerContact;
}

void Ip2_RockJointMat_RockJointMat_RockJointPhys::go(
        const shared_ptr<Material>& material1, const shared_ptr<Material>& material2, const shared_ptr<Interaction>& contact)
{
	if (contact->phys) return;
	const auto& m1 = static_cast<const RockJointMat&>(*material1);
	const auto& m2 = static_cast<const RockJointMat&>(*material2);
	const auto  of = [&](const shared_ptr<MatchMaker>& rule, Real v1, Real v2, Real otherwise) {
                return rule ? (*rule)(m1.id, m2.id, v1, v2) : otherwise;
	};

	const Real normal = of(kn, m1.normalStiffness, m2.normalStiffness, seriesStiffness(m1.normalStiffness, m2.normalStiffness));
	const Real shear  = of(ks, m1.shearStiffness, m2.shearStiffness, seriesStiffness(m1.shearStiffness, m2.shearStiffness));

	auto phys = boost::make_shared<RockJointPhys>(); // with its counts in one piece of memory
	phys->tangensOfFrictionAngle
	        = math::tan(of(frictAngle, m1.frictionAngle, m2.frictionAngle, math::min(m1.frictionAngle, m2.frictionAngle)));
	if (m1.residualFrictionAngle >= 0 || m2.residualFrictionAngle >= 0)
		phys->tangensOfResidualFrictionAngle = math::tan(math::min(residualAngle(m1), residualAngle(m2)));
	phys->cohesion               = math::min(m1.cohesion, m2.cohesion);
	phys->residualCohesion       = math::min(math::min(m1.residualCohesion, m2.residualCohesion), phys->cohesion);
	phys->tensileStrength        = math::min(m1.tensileStrength, m2.tensileStrength);
	phys->tangensOfDilationAngle = math::tan(math::min(m1.dilationAngle, m2.dilationAngle));
	phys->dilationLimit          = math::min(m1.dilationLimit, m2.dilationLimit);
	if (phys->hasPeak()) {
		phys->intact = intactUntilStep < 0 || scene->iter <= intactUntilStep;
		if (!phys->intact) phys->fail();
	}

	if (auto* geom = dynamic_cast<PolytopeGeom*>(contact->geom.get())) {
		geom->stiffnessRule = std::int8_t(stiffnessPerArea ? StiffnessRule::PerArea : StiffnessRule::PerContact);
		geom->needsArea     = true;              // shear acts over it
		phys->contactArea   = geom->contactArea; // a new contact's geometry has it already
		(stiffnessPerArea ? phys->normalStiffness : phys->normalStiffnessPerContact) = normal;
		(stiffnessPerArea ? phys->shearStiffness : phys->shearStiffnessPerContact)   = shear;
		phys->setStiffnesses(geom->share);
		const KnowsBonds* const bonds = bonds_.in(*scene);
		BondRemains             remains;
		if (bonds && bonds->left(contact->getId1(), contact->getId2(), remains)) takeOver(*phys, remains, *contact, *scene);
	} else {
		phys->contactArea = nominalArea(contact->geom.get());
		phys->kn          = stiffnessPerArea ? normal * phys->contactArea : normal;
		phys->ks          = stiffnessPerArea ? shear * phys->contactArea : shear;
	}
	contact->phys = phys;
}

} // namespace yade
