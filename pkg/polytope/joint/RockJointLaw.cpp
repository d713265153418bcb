// SPDX-License-Identifier: GPL-2.0-or-later
#include "joint/RockJointShear.hpp"

#include "host/ExactClass.hpp"
#include "host/Prefetch.hpp"

#include <optional>

namespace yade {

POLYTOPE_CLASSES((Law2_PolytopeGeom_RockJointPhys_MohrCoulomb));

namespace {

	/// Whether the bodies are so far apart that the joint does not remember what it was.
	bool isFarApart(const PolytopeGeom& geom) { return !(-geom.penetrationDepth < math::min(geom.refR1, geom.refR2)); }

	void fetchLayers(const Interaction& contact)
	{
		if (const auto* const phys = exactly<RockJointPhys>(contact.phys.get()))
			prefetch::fetch(phys->shearLayers.get(), sizeof(LayersOfJoint));
	}

} // namespace

bool Law2_PolytopeGeom_RockJointPhys_MohrCoulomb::go(shared_ptr<IGeom>& igeom, shared_ptr<IPhys>& iphys, Interaction* contact)
{
	auto&      geom   = static_cast<PolytopeGeom&>(*igeom);
	auto&      phys   = static_cast<RockJointPhys&>(*iphys);
	const bool goesOn = act(geom, phys, contact);
	geom.widenBy(phys.dilationOfSlip());
	return goesOn;
}

/// Forces of this step; false ends the contact.
bool Law2_PolytopeGeom_RockJointPhys_MohrCoulomb::act(PolytopeGeom& geom, RockJointPhys& phys, Interaction* contact)
{
	if (const Interaction* const next = prefetch::readable(*contact, *scene)) fetchLayers(*next);
	if (damps()) {
		stiffnessSums.begin(*scene);
		for (const Body::id_t id : { contact->getId1(), contact->getId2() })
			stiffnessSums.fetch(id);
	}
	const Pair pair(*contact, geom, scene);

	Vector3r elasticShear = phys.shearForce - phys.shearViscous;
	turnWithContact(geom, elasticShear);
	turnWithContact(geom, phys.slip);
	const Last last(phys, geom.normal);
	phys.followsBond = false;
	if (phys.mayActAsBond() && actsAsBond(*contact, geom, phys, last, elasticShear)) return true;
	Shear shear(pair, phys, elasticShear);

	// an open joint keeps the area it had: a separated pair's is that of grown bodies; a joint made across a gap starts with it
	if (geom.contactArea > 0 && (geom.touches() || phys.contactArea == 0)) phys.contactArea = geom.contactArea;
	if (phys.laws.get()) beginOwnLaws(phys, geom);
	phys.setStiffnesses(geom.share);
	phys.dilation       = phys.dilationOfSlip();
	const Real widening = phys.dilation - last.dilation;
	const Real rising   = widening == 0 ? Real(0) : risingWithSlip(pair, phys, shear, widening);
	shear.adapt(phys);
	shear.move(geom.shearIncrement());

	StepWork work;
	Real     elasticNormal = phys.normalSpring(geom.penetrationDepth);
	if (phys.laws.get()) followOwnLaws(phys, shear, geom.penetrationDepth, elasticNormal);
	if (elasticNormal < 0 && !(unbreakable && phys.intact) && !phys.bearsTension(-elasticNormal)) {
		if (!(phys.residualTensileStrength > 0) || isFarApart(geom)) return open(pair, phys, last, shear);
		work.fractured = phys.presentTensileStrength() > phys.residualTensileStrength;
		work.plastic   = phys.yieldInTension(elasticNormal);
	}
	std::optional<DampedPair> damped;
	if (damps()) damped.emplace(pair, phys, stiffnessSums);
	// what yields is not damped, as what slides is not
	const Real viscous = normalDamping > 0 && work.plastic == 0 ? normalDamper(pair, *damped, phys, elasticNormal, rising) : Real(0);
	const Real normal  = elasticNormal + viscous;

	// a joint pulled straight open has no shear but what rounding of the normal leaves: displacements below the resolution of positions
	const Real shown = Real(polytope::tolerance::rounding) * phys.ks * math::min(geom.refR1, geom.refR2);
	if (normal <= 0 && shear.force().squaredNorm() < shown * shown) shear.vanish();
	if (!limitShear(phys, normal, shear)) return open(pair, phys, last, shear);
	if (phys.laws.get()) endOwnLaws(phys, shear, elasticNormal);
	if (last.wasBond) phys.slip = Vector3r::Zero();
	if (shearDamping > 0 && !phys.isSliding) {
		const Vector3r along = shear.velocity();
		const Real     speed = along.norm();
		shear.damp(phys, normal, damped->damper(shearDamping, phys.ks, speed > 0 ? Vector3r(along / speed) : along),
		        damped->damper(shearDamping, phys.ks, geom.normal, shear.gyrationSquared()));
	}

	phys.normalViscous = viscous * geom.normal;
	phys.normalForce   = normal * geom.normal;
	shear.keep(phys);
	phys.rockingMoment
	        = rockingDamping > 0 ? rockingDamper(pair, *damped, phys, math::max(normal, Real(0))) : Vector3r(Vector3r::Zero());
	if (!apply(pair, phys)) return true;
	if (damped) takePart(pair, *damped, phys);

	if (!scene->trackEnergy) phys.lastStep.clear();
	else {
		const Real ofDamper = (last.normalViscous.dot(geom.normal) + viscous) / 2;
		const Real lifting  = (last.elasticNormal + elasticNormal) / 2 * widening + ofDamper * rising;
		work.fractured      = work.fractured || last.wasBond || last.actedAsBond;
		work.plastic        = last.wasBond ? Real(0) : work.plastic + shear.loss() - lifting;
		work.normalDamping  = ofDamper * rising;
		work.stored         = phys.normalEnergy(geom, elasticNormal) + shear.energy();
		book(pair, phys, last, work);
	}
	return true;
}

/// What of the bodies' parting in this step is the joint's widening and not the opening of its spring: the damper leaves that out, in a joint that slides
/// up its asperities. From the velocity, since the slip that there is depends on how the shear spring's force changes with the damper's own, by which the two
/// would build each other up; and never more than what the bodies part by, so that the damper is only against motion that there is.
Real Law2_PolytopeGeom_RockJointPhys_MohrCoulomb::risingWithSlip(
        const Pair& pair, const RockJointPhys& phys, const Shear& shear, Real widening) const
{
	const Real dt = scene->dt, expected = phys.isSliding ? Real(phys.rising(shear.velocity()) * dt) : widening;
	const Real parting = pair.geom.normal.dot(pair.velocity()) * dt;
	return math::max(math::min(expected, Real(0)), math::min(parting, math::max(expected, Real(0))));
}

/// Brings the trial shear force back to the strength; an intact joint fails there. False if that leaves it open.
bool Law2_PolytopeGeom_RockJointPhys_MohrCoulomb::limitShear(RockJointPhys& phys, Real normal, Shear& shear) const
{
	phys.isSliding = false;
	if (unbreakable) return true;
	if (phys.intact) {
		Shear asIntact(shear);
		phys.isSliding = asIntact.limit(phys, normal);
		if (!phys.isSliding) return true;
		phys.fail();
		if (normal < 0 && !(phys.residualTensileStrength > 0)) return false;
	}
	phys.isSliding = shear.limit(phys, normal);
	if (phys.isSliding) phys.slide(shear.excess());
	return true;
}

/// Applies forces and moments to the bodies; false if they are not finite: then the contact is left out of this step.
bool Law2_PolytopeGeom_RockJointPhys_MohrCoulomb::apply(const Pair& pair, RockJointPhys& phys)
{
	const Vector3r force = phys.normalForce + phys.shearForce, moment = phys.rockingMoment + phys.undampedMoment(pair.geom);
	if (!math::isfinite(force.squaredNorm() + moment.squaredNorm())) {
		phys.normalForce = phys.shearForce = phys.normalViscous = phys.shearViscous = phys.rockingMoment = phys.slip
		        = Vector3r::Zero();
		phys.shearAt(pair.geom.contactPoint);
		phys.dampedStiffness = 0;
		++nonFinite_;
		return false;
	}
	const Body::id_t id1 = pair.contact.getId1(), id2 = pair.contact.getId2();
	// one sum for each body: with two contacts on it the total does not depend on the order, nor on the number of threads
	addForce(id1, -force, scene);
	addForce(id2, force, scene);
	addTorque(id1, -(pair.arm1.cross(force) + moment), scene);
	addTorque(id2, pair.arm2.cross(force) + moment, scene);
	return true;
}

/// The joint is open: no force, and tangential motion counts as slip, as does the spring's elastic displacement. False ends the contact.
bool Law2_PolytopeGeom_RockJointPhys_MohrCoulomb::open(const Pair& pair, RockJointPhys& phys, const Last& last, Shear& shear)
{
	StepWork work;
	work.fractured = phys.intact || last.wasBond || last.actedAsBond || phys.residualTensileStrength > 0;
	phys.slide(shear.trialForce());
	shear.vanish();
	if (phys.intact) phys.fail();
	else if (!last.wasBond) work.plastic = shear.loss();
	phys.normalForce = phys.shearForce = phys.normalViscous = phys.shearViscous = phys.rockingMoment = Vector3r::Zero();
	phys.shearAt(pair.geom.contactPoint);
	phys.isSliding       = false;
	phys.dampedStiffness = 0;
	if (scene->trackEnergy) book(pair, phys, last, work);
	else phys.lastStep.clear();
	return phys.hasHistory() && !isFarApart(pair.geom);
}

Real Law2_PolytopeGeom_RockJointPhys_MohrCoulomb::ratioSlidingContacts() const
{
	long                     sliding = 0, all = 0;
	const shared_ptr<Scene>& current = Omega::instance().getScene();
	for (const auto& contact : *current->interactions) {
		if (!contact->isReal()) continue;
		const auto* phys = dynamic_cast<const RockJointPhys*>(contact->phys.get());
		if (!phys) continue;
		++all;
		sliding += phys->isSliding;
	}
	return all > 0 ? Real(sliding) / all : Real(0);
}

void Law2_PolytopeGeom_RockJointPhys_MohrCoulomb::postLoad(Law2_PolytopeGeom_RockJointPhys_MohrCoulomb&)
{
	const auto fraction = [](const char* name, Real value) {
		requireValue(value >= 0 && math::isfinite(value), name, value, "a fraction of critical damping, at least 0 and finite");
	};
	checked_.check(std::tie(normalDamping, shearDamping, rockingDamping), [&] {
		fraction("normalDamping", normalDamping);
		fraction("shearDamping", shearDamping);
		fraction("rockingDamping", rockingDamping);
	});
}

} // namespace yade
