// SPDX-License-Identifier: GPL-2.0-or-later
#include "joint/Ip2_RockJointMat_RockJointMat_RockJointPhys.hpp"

#include <core/Scene.hpp>
#include <lib/high-precision/Constants.hpp>

#include "contact/PolytopeGeom.hpp"
#include "host/PeriodOfPair.hpp"
#include "shape/ShapeOfBody.hpp"

#include <src/bond/BondTolerances.hpp>

namespace yade {

POLYTOPE_CLASSES((Ip2_RockJointMat_RockJointMat_RockJointPhys));

namespace {

	Real residualAngle(const RockJointMat& material)
	{
		return material.residualFrictionAngle < 0 ? material.frictionAngle : material.residualFrictionAngle;
	}

	/// The face of a body that lies closest to the plane of a contact.
	struct FaceOfContact {
		const RockJointMat* material = nullptr; ///< of that face; null where faces have no materials
		Real                cosine   = -1;      ///< of the angle between its normal and that of the contact
	};

	/// \param normal of the contact, out of the body
	FaceOfContact faceOf(const Body& body, const Vector3r& normal, const Scene& scene)
	{
		const Polytope* const shape = polytopeOf(body);
		FaceOfContact         found;
		if (!shape) return found;
		const auto&    normals = shape->convex()->planes().normals;
		const Vector3r turned  = body.state->ori.conjugate() * normal;
		std::size_t    best    = 0;
		for (std::size_t k = 0; k < normals.size(); ++k)
			if (const Real cosine = normals[k].dot(turned); cosine > found.cosine) {
				found.cosine = cosine;
				best         = k;
			}
		if (best >= shape->faceMaterials.size()) return found;
		const int index = shape->faceMaterials[best];
		if (index >= 0 && std::size_t(index) < scene.materials.size())
			found.material = dynamic_cast<const RockJointMat*>(scene.materials[std::size_t(index)].get());
		return found;
	}

	/// Joint materials of the two sides of a contact: those of the faces that it lies on, in place of the bodies' own.
	void takeFaces(const RockJointMat*& m1, const RockJointMat*& m2, const Interaction& contact, const Scene& scene)
	{
		const auto* geom = dynamic_cast<const PolytopeGeom*>(contact.geom.get());
		if (!geom || !scene.bodies->exists(contact.getId1()) || !scene.bodies->exists(contact.getId2())) return;
		const Body &body1 = *(*scene.bodies)[contact.getId1()], &body2 = *(*scene.bodies)[contact.getId2()];
		const auto  facesOf = [](const Body& body) {
                        const auto* shape = dynamic_cast<const Polytope*>(body.shape.get());
                        return shape && !shape->faceMaterials.empty();
		};
		if (!facesOf(body1) && !facesOf(body2)) return;
		const FaceOfContact face1 = faceOf(body1, geom->normal, scene), face2 = faceOf(body2, -geom->normal, scene);
		const RockJointMat *own1 = face1.material ? face1.material : m1, *own2 = face2.material ? face2.material : m2;
		const Real          flush = math::cos(Real(polytope::tolerance::facingOfJoints));
		const bool          both  = face1.cosine > flush && face2.cosine > flush;
		m1                        = both || face1.cosine >= face2.cosine ? own1 : own2;
		m2                        = both || face2.cosine > face1.cosine ? own2 : own1;
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

	/// Closure and shear law of the joint, where both sides have one of the same kind.
	/// \param angle its friction angle [rad]
	void takeLaws(RockJointPhys& phys, const RockJointMat& m1, const RockJointMat& m2, Real normal, Real shear, Real angle)
	{
		if (const auto closure = closureOfJoint(m1, m2, normal)) phys.laws.make().closure = *closure;
		const JointStrength *const s1 = m1.strength.get(), *const s2 = m2.strength.get();
		const auto *const        rough1    = dynamic_cast<const BartonBandisStrength*>(s1),
		                  *const rough2    = dynamic_cast<const BartonBandisStrength*>(s2);
		const auto *const        yielding1 = dynamic_cast<const ContinuouslyYieldingStrength*>(s1),
		                  *const yielding2 = dynamic_cast<const ContinuouslyYieldingStrength*>(s2);
		if (rough1 && rough2) {
			phys.laws.make().shear = int(ShearLaw::BartonBandis);
			phys.laws.make().rough = polytope::BartonBandis::between(rough1->law(angle), rough2->law(angle));
		} else if (yielding1 && yielding2) {
			phys.laws.make().shear    = int(ShearLaw::ContinuouslyYielding);
			phys.laws.make().yielding = polytope::ContinuouslyYielding::between(yielding1->law(angle), yielding2->law(angle));
			phys.laws.make().shearStiffness = shear;
		} else return;
		phys.laws.make().reduction = math::max(m1.reduction, m2.reduction);
	}

	/// A joint that goes on where a bond has failed: without peak strength, without force at the overlap where the bond had none, and with the
	/// bond's shear force, as far as its own strength goes (the law takes the rest away).
	void takeOver(RockJointPhys& phys, const BondRemains& bond, const Interaction& contact, const Scene& scene)
	{
		phys.fail();
		phys.restOverlap = bond.overlap;
		if (!bond.inLastStep) return;
		phys.takeForce(bond.force, bond.point, static_cast<const PolytopeGeom&>(*contact.geom).normal);
		phys.followsBond = true;
		if (!scene.trackEnergy) return;
		LastStepOfJoint& last = phys.lastStep.make();
		last.arm1             = bond.point - (*scene.bodies)[contact.getId1()]->state->pos;
		last.arm2             = bond.point - placeByCells(scene, contact.cellDist, (*scene.bodies)[contact.getId2()]->state->pos);
		last.stored           = bond.energy;
	}

} // namespace

StiffnessRule Ip2_RockJointMat_RockJointMat_RockJointPhys::stiffnessRule(const Material& material1, const Material& material2) const
{
	const StiffnessRule rule = stiffnessRuleOf(material1, material2);
	return rule == StiffnessRule::PerArea && !stiffnessPerArea ? StiffnessRule::PerContact : rule;
}

void Ip2_RockJointMat_RockJointMat_RockJointPhys::go(
        const shared_ptr<Material>& material1, const shared_ptr<Material>& material2, const shared_ptr<Interaction>& contact)
{
	if (contact->phys) return;
	const auto *side1 = static_cast<const RockJointMat*>(material1.get()), *side2 = static_cast<const RockJointMat*>(material2.get());
	takeFaces(side1, side2, *contact, *scene);
	make(*side1, *side2, contact);
}

void Ip2_RockJointMat_RockJointMat_RockJointPhys::make(
        const RockJointMat& m1, const RockJointMat& m2, const shared_ptr<Interaction>& contact)
{
	const auto of = [&](const shared_ptr<MatchMaker>& rule, Real v1, Real v2, Real otherwise) {
		return rule ? (*rule)(m1.id, m2.id, v1, v2) : otherwise;
	};

	const StiffnessRule rule    = stiffnessRule(m1, m2);
	const bool          perArea = rule == StiffnessRule::PerArea;
	// in different units, that of a contact alone
	const bool          differ = stiffnessPerArea && m1.stiffnessPerArea != m2.stiffnessPerArea;
	const RockJointMat &side1 = differ && m1.stiffnessPerArea ? m2 : m1, &side2 = differ && m2.stiffnessPerArea ? m1 : m2;
	const Real          normal
	        = of(kn, side1.normalStiffness, side2.normalStiffness, stiffnessInSeries(side1.normalStiffness, side2.normalStiffness));
	const Real shear
	        = of(ks, side1.shearStiffness, side2.shearStiffness, stiffnessInSeries(side1.shearStiffness, side2.shearStiffness));

	auto       phys              = boost::make_shared<RockJointPhys>(); // with its counts in one piece of memory
	const Real angle             = of(frictAngle, m1.frictionAngle, m2.frictionAngle, math::min(m1.frictionAngle, m2.frictionAngle));
	phys->tangensOfFrictionAngle = math::tan(angle);
	if (m1.residualFrictionAngle >= 0 || m2.residualFrictionAngle >= 0)
		phys->tangensOfResidualFrictionAngle = math::tan(math::min(residualAngle(m1), residualAngle(m2)));
	phys->cohesion                = math::min(m1.cohesion, m2.cohesion);
	phys->residualCohesion        = math::min(math::min(m1.residualCohesion, m2.residualCohesion), phys->cohesion);
	phys->tensileStrength         = math::min(m1.tensileStrength, m2.tensileStrength);
	phys->residualTensileStrength = math::min(math::min(m1.residualTensileStrength, m2.residualTensileStrength), phys->tensileStrength);
	phys->tangensOfDilationAngle  = math::tan(math::min(m1.dilationAngle, m2.dilationAngle));
	phys->dilationLimit           = math::min(m1.dilationLimit, m2.dilationLimit);
	if (phys->hasPeak()) {
		phys->intact = intactUntilStep < 0 || scene->iter <= intactUntilStep;
		if (!phys->intact) phys->fail();
	}

	if (m1.closure || m1.strength) takeLaws(*phys, m1, m2, normal, shear, angle);
	if (auto* geom = dynamic_cast<PolytopeGeom*>(contact->geom.get())) {
		if (phys->laws.get() && !phys->laws.get()->closure.isLinear()) {
			geom->closure.make().law = phys->laws.get()->closure;
			geom->energyPerStiffness = -1; // this step's is that of a linear spring
		} else geom->closure.clear();
		geom->stiffnessRule = std::int8_t(rule);
		geom->needsArea     = true;              // shear acts over it
		phys->contactArea   = geom->contactArea; // a new contact's geometry has it already
		(perArea ? phys->normalStiffness : phys->normalStiffnessPerContact) = normal;
		(perArea ? phys->shearStiffness : phys->shearStiffnessPerContact)   = shear;
		phys->setStiffnesses(geom->share);
		const KnowsBonds* const bonds = bonds_.in(*scene);
		BondRemains             remains;
		if (bonds && bonds->left(contact->getId1(), contact->getId2(), remains)) takeOver(*phys, remains, *contact, *scene);
	} else {
		phys->contactArea = nominalArea(contact->geom.get());
		phys->kn          = perArea ? normal * phys->contactArea : normal;
		phys->ks          = perArea ? shear * phys->contactArea : shear;
	}
	contact->phys = phys;
}

} // namespace yade
