// SPDX-License-Identifier: GPL-2.0-or-later
#include "RockJoint.hpp"

#include <lib/high-precision/Constants.hpp>
#include <core/Scene.hpp>

#include "PolytopeGeom.hpp"

namespace yade {

YADE_PLUGIN((RockJointMat)(RockJointPhys)(Ip2_RockJointMat_RockJointMat_RockJointPhys)(Law2_PolytopeGeom_RockJointPhys_MohrCoulomb));

// ---------------------------------------------------------------------------------------------------- material

RockJointMat::Values RockJointMat::values() const
{
	return { { normalStiffness, shearStiffness, frictionAngle, cohesion, tensileStrength, residualFrictionAngle, dilationAngle, dilationLimit } };
}

void RockJointMat::setValues(const Values& v)
{
	normalStiffness       = v[0];
	shearStiffness        = v[1];
	frictionAngle         = v[2];
	cohesion              = v[3];
	tensileStrength       = v[4];
	residualFrictionAngle = v[5];
	dilationAngle         = v[6];
	dilationLimit         = v[7];
}

void RockJointMat::postLoad(RockJointMat&)
{
	const auto require = [&](bool good, const char* name, Real value, const char* rule) {
		if (good) return;
		setValues(good_);
		std::ostringstream message;
		message << name << ": must be " << rule << ", got " << value;
		throw std::invalid_argument(message.str());
	};
	const char* const angleRule = "an angle in radians, at least 0 and below pi/2 (use radians(degrees))";
	const auto        positive  = [](Real v) { return v > 0 && math::isfinite(v); };
	const auto        strength  = [](Real v) { return v >= 0 && math::isfinite(v); };
	const auto        angle     = [](Real v) { return v >= 0 && v < Mathr::HALF_PI; };
	require(positive(normalStiffness), "normalStiffness", normalStiffness, "positive and finite [Pa/m, or N/m for each contact]");
	require(positive(shearStiffness), "shearStiffness", shearStiffness, "positive and finite [Pa/m, or N/m for each contact]");
	require(angle(frictionAngle), "frictionAngle", frictionAngle, angleRule);
	require(strength(cohesion), "cohesion", cohesion, "at least 0 and finite [Pa]");
	require(strength(tensileStrength), "tensileStrength", tensileStrength, "at least 0 and finite [Pa]");
	require(angle(residualFrictionAngle) || residualFrictionAngle == -1,
	        "residualFrictionAngle",
	        residualFrictionAngle,
	        "-1 (the same as frictionAngle) or an angle in radians, at least 0 and below pi/2");
	require(angle(dilationAngle), "dilationAngle", dilationAngle, angleRule);
	require(dilationLimit >= 0, "dilationLimit", dilationLimit, "at least 0 [m] (infinity: no limit)");
	good_ = values();
}

// ---------------------------------------------------------------------------------------------------- physics

void RockJointPhys::fail()
{
	intact = false;
	if (tangensOfResidualFrictionAngle >= 0) tangensOfFrictionAngle = tangensOfResidualFrictionAngle;
}

Real RockJointPhys::shearStrength(Real normal) const
{
	const Real strength = normal * tangensOfFrictionAngle + (intact ? cohesion * contactArea : Real(0));
	return strength > 0 ? strength : Real(0);
}

Real RockJointPhys::storedEnergy(Real normal, const Vector3r& shear) const
{
	Real energy = 0;
	if (kn > 0) energy += normal * normal / kn;
	if (ks > 0) energy += shear.squaredNorm() / ks;
	return energy / 2;
}

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
		const Real r1 = spheres->refR1 > 0 ? spheres->refR1 : spheres->refR2, r2 = spheres->refR2 > 0 ? spheres->refR2 : spheres->refR1;
		return Mathr::PI * math::pow(math::min(r1, r2), 2);
	}

} // namespace

void Ip2_RockJointMat_RockJointMat_RockJointPhys::go(
        const shared_ptr<Material>& material1, const shared_ptr<Material>& material2, const shared_ptr<Interaction>& contact)
{
	if (contact->phys) return;
	const auto& m1 = static_cast<const RockJointMat&>(*material1);
	const auto& m2 = static_cast<const RockJointMat&>(*material2);
	const auto  of = [&](const shared_ptr<MatchMaker>& rule, Real v1, Real v2, Real otherwise) { return rule ? (*rule)(m1.id, m2.id, v1, v2) : otherwise; };

	const Real normal = of(kn, m1.normalStiffness, m2.normalStiffness, seriesStiffness(m1.normalStiffness, m2.normalStiffness));
	const Real shear  = of(ks, m1.shearStiffness, m2.shearStiffness, seriesStiffness(m1.shearStiffness, m2.shearStiffness));

	auto phys                    = shared_ptr<RockJointPhys>(new RockJointPhys);
	phys->tangensOfFrictionAngle = math::tan(of(frictAngle, m1.frictionAngle, m2.frictionAngle, math::min(m1.frictionAngle, m2.frictionAngle)));
	if (m1.residualFrictionAngle >= 0 || m2.residualFrictionAngle >= 0)
		phys->tangensOfResidualFrictionAngle = math::tan(math::min(residualAngle(m1), residualAngle(m2)));
	phys->cohesion               = math::min(m1.cohesion, m2.cohesion);
	phys->tensileStrength        = math::min(m1.tensileStrength, m2.tensileStrength);
	phys->tangensOfDilationAngle = math::tan(math::min(m1.dilationAngle, m2.dilationAngle));
	phys->dilationLimit          = math::min(m1.dilationLimit, m2.dilationLimit);
	if (phys->hasPeak()) {
		phys->intact = intactUntilStep < 0 || scene->iter <= intactUntilStep;
		if (!phys->intact) phys->fail();
	}

	if (auto* geom = dynamic_cast<PolytopeGeom*>(contact->geom.get())) {
		geom->needsArea   = stiffnessPerArea || phys->cohesion > 0 || phys->tensileStrength > 0;
		phys->contactArea = geom->contactArea; // a new contact's geometry has it already
		if (stiffnessPerArea) {
			phys->normalStiffness = normal;
			phys->shearStiffness  = shear;
		}
	} else
		phys->contactArea = nominalArea(contact->geom.get());
	phys->kn      = stiffnessPerArea ? normal * phys->contactArea : normal;
	phys->ks      = stiffnessPerArea ? shear * phys->contactArea : shear;
	contact->phys = phys;
}

// ---------------------------------------------------------------------------------------------------- law

namespace {

	Real inverseMass(const Body* body, Scene* scene)
	{
		if (body->isClumpMember()) body = Body::byId(body->clumpId, scene).get();
		return body->isDynamic() && body->state->mass > 0 ? 1 / body->state->mass : Real(0);
	}

	/// Critical damping times `fraction` for a spring between two bodies; 0 if neither can move.
	Real damper(Real fraction, Real stiffness, const Body* body1, const Body* body2, Scene* scene)
	{
		const Real inverse = inverseMass(body1, scene) + inverseMass(body2, scene);
		return inverse > 0 ? 2 * fraction * math::sqrt(stiffness / inverse) : Real(0);
	}

	/// Carries a tangent vector along with the contact: Eq. 18 and the twist, without their second-order change of length.
	void turnWithContact(const ScGeom& geom, Vector3r& tangent)
	{
		const Real before = tangent.squaredNorm();
		if (before == 0) return;
		geom.rotate(tangent);
		tangent -= geom.normal.dot(tangent) * geom.normal;
		const Real after = tangent.squaredNorm();
		if (after > 0) tangent *= math::sqrt(before / after);
	}

	/// Largest t ≤ 1 with |force + t·added| ≤ limit, for |force| ≤ limit.
	Real fractionWithin(Real limit, const Vector3r& force, const Vector3r& added)
	{
		if ((force + added).squaredNorm() <= limit * limit) return 1;
		const Real a = added.squaredNorm(), b = force.dot(added), c = limit * limit - force.squaredNorm();
		if (!(a > 0 && c > 0)) return 0;
		const Real root = math::sqrt(b * b + a * c);
		return b > 0 ? c / (b + root) : (root - b) / a;
	}

} // namespace

/// Both bodies as the contact sees them in this step.
struct Law2_PolytopeGeom_RockJointPhys_MohrCoulomb::Pair {
	const Body*  body1;
	const Body*  body2;
	Body::id_t   id1, id2;
	const State& state1;
	const State& state2;
	Vector3r     shift2   = Vector3r::Zero();
	Vector3r     velocity = Vector3r::Zero(); ///< of body 2 relative to body 1 at the contact point
	Vector3r     centreVelocity = Vector3r::Zero(); ///< the same of the centres
	Vector3r     arm1, arm2;                  ///< from the centres to the contact point
	bool         isNew; ///< made in this step

	Pair(Interaction& contact, const PolytopeGeom& geom, Scene* scene)
	        : body1(Body::byId(contact.getId1(), scene).get())
	        , body2(Body::byId(contact.getId2(), scene).get())
	        , id1(contact.getId1())
	        , id2(contact.getId2())
	        , state1(*body1->state)
	        , state2(*body2->state)
	        , isNew(contact.isFresh(scene))
	{
		centreVelocity = state2.vel - state1.vel;
		if (scene->isPeriodic) {
			shift2 = scene->cell->intrShiftPos(contact.cellDist);
			centreVelocity += scene->cell->intrShiftVel(contact.cellDist);
		}
		arm1     = geom.contactPoint - state1.pos;
		arm2     = geom.contactPoint - state2.pos - shift2;
		velocity = centreVelocity + state2.angVel.cross(arm2) - state1.angVel.cross(arm1);
	}
};

/// What a step did with energy beyond storing it [J].
struct Law2_PolytopeGeom_RockJointPhys_MohrCoulomb::StepWork {
	Real plastic = 0, normalDamping = 0, shearDamping = 0, rockingDamping = 0;
	bool fractured = false;
};

bool Law2_PolytopeGeom_RockJointPhys_MohrCoulomb::go(shared_ptr<IGeom>& igeom, shared_ptr<IPhys>& iphys, Interaction* contact)
{
	auto&      geom = static_cast<PolytopeGeom&>(*igeom);
	auto&      phys = static_cast<RockJointPhys&>(*iphys);
	const Pair pair(*contact, geom, scene);

	if (geom.contactArea > 0) phys.contactArea = geom.contactArea;
	if (phys.normalStiffness > 0) phys.kn = phys.normalStiffness * phys.contactArea;
	if (phys.shearStiffness > 0) phys.ks = phys.shearStiffness * phys.contactArea;

	// what is carried over from the last step
	const Vector3r lastForce         = phys.normalForce + phys.shearForce;
	const Vector3r lastShearViscous  = phys.shearViscous;
	const Vector3r lastMoment        = phys.rockingMoment;
	const Real     lastNormalViscous = phys.normalViscous.dot(geom.normal);
	const Real     lastElastic       = phys.normalForce.dot(geom.normal) - lastNormalViscous;
	Vector3r       shear             = phys.shearForce - phys.shearViscous;
	turnWithContact(geom, shear);
	const Vector3r lastShear = shear;
	turnWithContact(geom, phys.slip);
	const Real lastDilation = phys.dilation;
	if (phys.tangensOfDilationAngle > 0) phys.dilation = math::min(phys.tangensOfDilationAngle * phys.slip.norm(), phys.dilationLimit);

	// normal force
	const Real elasticNormal = phys.kn * (geom.penetrationDepth + phys.dilation);
	if (elasticNormal < 0 && !(phys.intact && -elasticNormal <= phys.tensileStrength * phys.contactArea)) return open(pair, geom, phys);
	Real normalViscous = 0;
	if (normalDamping > 0) {
		normalViscous           = -damper(normalDamping, phys.kn, pair.body1, pair.body2, scene) * geom.normal.dot(pair.velocity);
		const bool takesTension = phys.intact && phys.tensileStrength > 0;
		if (!takesTension && elasticNormal + normalViscous < 0) normalViscous = -elasticNormal;
	}
	const Real normal = elasticNormal + normalViscous;

	// shear force
	StepWork work;
	shear -= phys.ks * geom.shearIncrement();
	Real strength  = phys.shearStrength(normal);
	phys.isSliding = shear.squaredNorm() > strength * strength;
	if (phys.isSliding && phys.intact) {
		phys.fail();
		if (elasticNormal < 0) return open(pair, geom, phys);
		strength       = phys.shearStrength(normal);
		phys.isSliding = shear.squaredNorm() > strength * strength;
	}
	Vector3r shearViscous = Vector3r::Zero();
	if (phys.isSliding) {
		const Vector3r excess = (1 - strength / shear.norm()) * shear;
		shear -= excess;
		if (phys.ks > 0) {
			phys.slip -= excess / phys.ks;
			work.plastic = (lastShear + shear).dot(excess) / (2 * phys.ks);
		}
	} else if (shearDamping > 0) {
		const Vector3r sliding = pair.velocity - geom.normal.dot(pair.velocity) * geom.normal;
		shearViscous           = -damper(shearDamping, phys.ks, pair.body1, pair.body2, scene) * sliding;
		shearViscous *= fractionWithin(strength, shear, shearViscous);
	}

	phys.normalViscous = normalViscous * geom.normal;
	phys.normalForce   = normal * geom.normal;
	phys.shearViscous  = shearViscous;
	phys.shearForce    = shear + shearViscous;

	const Vector3r force = phys.normalForce + phys.shearForce;
	if (!math::isfinite(force.squaredNorm())) {
		phys.normalForce = phys.shearForce = phys.normalViscous = phys.shearViscous = phys.rockingMoment = phys.slip = Vector3r::Zero();
		nonFinite_ += 1;
		return true;
	}
	applyForceAtContactPoint(-force, geom.contactPoint, pair.id1, pair.state1.pos, pair.id2, pair.state2.pos + pair.shift2);

	if (rockingDamping > 0 || lastMoment != Vector3r::Zero()) {
		phys.rockingMoment = rockingDamper(pair, geom, phys, normal);
		addTorque(pair.id1, -phys.rockingMoment, scene);
		addTorque(pair.id2, phys.rockingMoment, scene);
	}

	phys.lastStored = scene->trackEnergy ? phys.lastStored : Real(-1);
	if (scene->trackEnergy) {
		work.plastic -= (lastElastic + elasticNormal) / 2 * (phys.dilation - lastDilation);
		work.normalDamping = -(lastNormalViscous + normalViscous) / 2 * geom.normal.dot(pair.velocity) * scene->dt;
		work.rockingDamping = -(lastMoment + phys.rockingMoment).dot(pair.state2.angVel - pair.state1.angVel) / 2 * scene->dt;
		work.shearDamping  = -(lastShearViscous + shearViscous).dot(geom.shearIncrement()) / 2;
		book(pair, phys, lastForce, work, phys.storedEnergy(elasticNormal, shear));
	}
	return true;
}

/// Moment on body 2 of dampers spread over the contact area.
Vector3r Law2_PolytopeGeom_RockJointPhys_MohrCoulomb::rockingDamper(
        const Pair& pair, PolytopeGeom& geom, const RockJointPhys& phys, Real normal) const
{
	if (rockingDamping > 0) geom.needsArea = true;
	Real        gyrationSquared = phys.contactArea / 12;
	const auto* polygon         = dynamic_cast<const Polytope*>(pair.body1->shape.get());
	if (polygon && polygon->dimension == 2) {
		const auto* other  = static_cast<const Polytope*>(pair.body2->shape.get());
		gyrationSquared    = math::pow(phys.contactArea / math::min(polygon->thickness, other->thickness), 2) / 12;
	}
	Vector3r rocking = pair.state2.angVel - pair.state1.angVel;
	rocking -= geom.normal.dot(rocking) * geom.normal;
	const Real limit  = math::sqrt(3 * gyrationSquared) * math::max(normal, Real(0));
	Vector3r   moment = -damper(rockingDamping, phys.kn, pair.body1, pair.body2, scene) * gyrationSquared * rocking;
	const Real size   = moment.norm();
	if (size > limit) moment *= limit / size;
	return moment;
}

/// The joint is open: no force. False ends the contact.
bool Law2_PolytopeGeom_RockJointPhys_MohrCoulomb::open(const Pair& pair, const PolytopeGeom& geom, RockJointPhys& phys)
{
	StepWork work;
	work.fractured           = phys.intact;
	const Vector3r lastForce = phys.normalForce + phys.shearForce;
	if (phys.intact) phys.fail();
	phys.normalForce = phys.shearForce = phys.normalViscous = phys.shearViscous = phys.rockingMoment = Vector3r::Zero();
	phys.isSliding   = false;
	if (scene->trackEnergy) book(pair, phys, lastForce, work, 0);
	else
		phys.lastStored = -1;
	return phys.hasPeak() && -geom.penetrationDepth < math::min(geom.refR1, geom.refR2);
}

/// Energy of the step from the last positions to these, with the mean of the forces at both ends.
void Law2_PolytopeGeom_RockJointPhys_MohrCoulomb::book(const Pair& pair, RockJointPhys& phys, const Vector3r& lastForce, const StepWork& work, Real stored)
{
	// EnergyTracker makes names without locking out its other users: all of ours at once, before any is used
	if (!energiesNamed_) {
#pragma omp critical(polytopeEnergyNames)
		if (!energiesNamed_) {
			const char* const names[energyCount] = { "elastPotential", "plastDissip", "normDampDissip", "shearDampDissip", "fractureDissip", "nonconservative" };
			for (int k = 0; k < energyCount; ++k)
				scene->energy->findId(names[k], energyIds_[k], /*reset in each step*/ k == elastic);
			energiesNamed_ = true;
		}
	}
	const Vector3r force = phys.normalForce + phys.shearForce;
	const Real     given = scene->dt / 2
	        * ((lastForce + force).dot(pair.centreVelocity) + (phys.lastArm2.cross(lastForce) + pair.arm2.cross(force)).dot(pair.state2.angVel)
	           - (phys.lastArm1.cross(lastForce) + pair.arm1.cross(force)).dot(pair.state1.angVel));
	// a contact that was there before tracking was switched on has no last step to compare with
	const bool known = phys.lastStored >= 0 || pair.isNew;
	const Real rest  = known ? -given - (stored - math::max(phys.lastStored, Real(0))) - work.plastic - work.normalDamping - work.shearDamping : Real(0);

	const auto add = [&](Energy kind, Real value) { scene->energy->add(value, "", energyIds_[kind], kind == elastic); };
	add(elastic, stored);
	add(plastic, work.plastic);
	add(normalDamper, work.normalDamping + work.rockingDamping);
	add(shearDamper, work.shearDamping);
	add(work.fractured ? fracture : nonconservative, rest);
	phys.lastArm1   = pair.arm1;
	phys.lastArm2   = pair.arm2;
	phys.lastStored = stored;
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
	const auto require = [&](const char* name, Real value) {
		if (value >= 0 && math::isfinite(value)) return;
		normalDamping  = good_[0];
		shearDamping   = good_[1];
		rockingDamping = good_[2];
		std::ostringstream message;
		message << name << ": must be a fraction of critical damping, at least 0 and finite, got " << value;
		throw std::invalid_argument(message.str());
	};
	require("normalDamping", normalDamping);
	require("shearDamping", shearDamping);
	require("rockingDamping", rockingDamping);
	good_ = { { normalDamping, shearDamping, rockingDamping } };
}

} // namespace yade
