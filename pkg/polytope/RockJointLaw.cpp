// SPDX-License-Identifier: GPL-2.0-or-later
#include "RockJointLaw.hpp"

#include <core/Scene.hpp>

#include "PolytopeGeom.hpp"
#include "RockJoint.hpp"
#include "ShearSpring.hpp"

namespace yade {

YADE_PLUGIN((Law2_PolytopeGeom_RockJointPhys_MohrCoulomb));

namespace {

	Real inverseMass(const Body* body, Scene* scene)
	{
		if (body->isClumpMember()) body = Body::byId(body->clumpId, scene).get();
		return body->isDynamic() && body->state->mass > 0 ? 1 / body->state->mass : Real(0);
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

	/// Energy of the normal spring; a conservative contact's geometry has the energy whose gradient its force is.
	Real normalEnergy(const PolytopeGeom& geom, const RockJointPhys& phys, Real elastic)
	{
		if (geom.energyPerStiffness >= 0 && geom.penetrationDepth > 0 && phys.dilation == 0)
			return phys.kn * geom.energyPerStiffness;
		return phys.kn > 0 ? elastic * elastic / (2 * phys.kn) : Real(0);
	}

} // namespace

/// Motion of both bodies at the contact in this step.
struct Law2_PolytopeGeom_RockJointPhys_MohrCoulomb::Pair {
	const Interaction&  contact;
	const PolytopeGeom& geom;
	Scene*              scene;
	const Body*         body1;
	const Body*         body2;
	const State&        state1;
	const State&        state2;
	Vector3r            centre2;    ///< of body 2, in the period of body 1
	Vector3r            arm1, arm2; ///< from the centres to the contact point

	Pair(const Interaction& contact_, const PolytopeGeom& geom_, Scene* scene_)
	        : contact(contact_), geom(geom_), scene(scene_), body1(Body::byId(contact.getId1(), scene).get()),
	          body2(Body::byId(contact.getId2(), scene).get()), state1(*body1->state), state2(*body2->state), centre2(state2.pos)
	{
		if (scene->isPeriodic) centre2 += scene->cell->intrShiftPos(contact.cellDist);
		arm1 = geom.contactPoint - state1.pos;
		arm2 = geom.contactPoint - centre2;
	}
	/// Velocity of body 2's centre relative to body 1's.
	Vector3r centreVelocity() const
	{
		Vector3r velocity = state2.vel - state1.vel;
		if (scene->isPeriodic) velocity += scene->cell->intrShiftVel(contact.cellDist);
		return velocity;
	}
	/// The same at the contact point.
	Vector3r velocity() const { return centreVelocity() + state2.angVel.cross(arm2) - state1.angVel.cross(arm1); }
	Vector3r spin() const { return state2.angVel - state1.angVel; }
	/// Critical damping of a spring between the bodies; 0 if neither can move. For a share of the full stiffness, the same
	/// share of its damper: so several pieces damp as one does.
	Real criticalDamping(Real stiffness) const
	{
		const Real inverse = inverseMass(body1, scene) + inverseMass(body2, scene);
		return inverse > 0 ? 2 * math::sqrt(stiffness * geom.share / inverse) : Real(0);
	}
};

/// State at the end of the last step, before this one changes it.
struct Law2_PolytopeGeom_RockJointPhys_MohrCoulomb::Last {
	Vector3r    force, shearViscous, moment;
	ShearSpring shear;
	Real        normalViscous, elasticNormal, dilation;
	bool        wasBond; ///< the forces were those of a bond, which has failed

	Last(const RockJointPhys& phys, const Vector3r& turnedShear, const Vector3r& normal)
	        : force(phys.normalForce + phys.shearForce), shearViscous(phys.shearViscous), moment(phys.rockingMoment),
	          shear { turnedShear, phys.ks }, normalViscous(phys.normalViscous.dot(normal)),
	          elasticNormal(phys.normalForce.dot(normal) - normalViscous), dilation(phys.dilation), wasBond(phys.followsBond)
	{
	}
};

/// What a step did with energy beyond storing it [J].
struct Law2_PolytopeGeom_RockJointPhys_MohrCoulomb::StepWork {
	Real plastic = 0, normalDamping = 0, shearDamping = 0, rockingDamping = 0;
	Real stored    = 0; ///< energy of the springs afterwards
	bool fractured = false;
};

bool Law2_PolytopeGeom_RockJointPhys_MohrCoulomb::go(shared_ptr<IGeom>& igeom, shared_ptr<IPhys>& iphys, Interaction* contact)
{
	auto&      geom = static_cast<PolytopeGeom&>(*igeom);
	auto&      phys = static_cast<RockJointPhys&>(*iphys);
	const Pair pair(*contact, geom, scene);

	Vector3r elasticShear = phys.shearForce - phys.shearViscous;
	turnWithContact(geom, elasticShear);
	turnWithContact(geom, phys.slip);
	const Last last(phys, elasticShear, geom.normal);
	phys.followsBond = false;

	// an open joint keeps the area it had: a separated pair's is that of grown bodies; a joint made across a gap starts with it
	const bool touches = geom.penetrationDepth > 0 && geom.statusCode != int(polytope::ContactStatus::Separated);
	if (geom.contactArea > 0 && (touches || phys.contactArea == 0)) phys.contactArea = geom.contactArea;
	phys.setStiffnesses(geom.share);
	if (phys.tangensOfDilationAngle > 0) phys.dilation = math::min(phys.tangensOfDilationAngle * phys.slip.norm(), phys.dilationLimit);

	const Vector3r trial         = last.shear.forceWith(phys.ks) - phys.ks * geom.shearIncrement();
	const Real     elasticNormal = phys.kn * (geom.penetrationDepth + phys.dilation);
	if (elasticNormal < 0 && !phys.bearsTension(-elasticNormal)) return open(pair, phys, last, trial);
	const Real viscous = normalDamping > 0 ? normalDamper(pair, phys, elasticNormal) : Real(0);
	const Real normal  = elasticNormal + viscous;

	Vector3r shear = trial;
	// a joint pulled straight open has no shear but what rounding of the normal leaves: displacements below the resolution of positions
	const Real shown = Real(polytope::tolerance::rounding) * phys.ks * math::min(geom.refR1, geom.refR2);
	if (normal <= 0 && shear.squaredNorm() < shown * shown) shear = Vector3r::Zero();
	if (!limitShear(phys, normal, shear)) return open(pair, phys, last, trial);
	if (last.wasBond) phys.slip = Vector3r::Zero();
	const Vector3r shearViscous = shearDamping > 0 && !phys.isSliding ? shearDamper(pair, phys, normal, shear) : Vector3r::Zero();

	phys.normalViscous = viscous * geom.normal;
	phys.normalForce   = normal * geom.normal;
	phys.shearViscous  = shearViscous;
	phys.shearForce    = shear + shearViscous;
	if (rockingDamping > 0 || last.moment != Vector3r::Zero()) phys.rockingMoment = rockingDamper(pair, phys, normal);
	if (!apply(pair, phys)) return true;

	if (!scene->trackEnergy) phys.lastStored = -1;
	else {
		StepWork   work;
		const Real lifting  = (last.elasticNormal + elasticNormal) / 2 * (phys.dilation - last.dilation);
		work.fractured      = last.wasBond;
		work.plastic        = last.wasBond ? Real(0) : last.shear.loss(phys.ks, trial, shear) - lifting;
		work.normalDamping  = -(last.normalViscous + viscous) / 2 * geom.normal.dot(pair.velocity()) * scene->dt;
		work.rockingDamping = -(last.moment + phys.rockingMoment).dot(pair.spin()) / 2 * scene->dt;
		work.shearDamping   = -(last.shearViscous + shearViscous).dot(geom.shearIncrement()) / 2;
		work.stored         = phys.storedEnergy(normalEnergy(geom, phys, elasticNormal), shear);
		book(pair, phys, last, work);
	}
	return true;
}

/// Brings the trial shear force back to the strength; an intact joint fails there. False if that leaves it open.
bool Law2_PolytopeGeom_RockJointPhys_MohrCoulomb::limitShear(RockJointPhys& phys, Real normal, Vector3r& shear) const
{
	Real       strength = phys.shearStrength(normal);
	const Real square   = shear.squaredNorm();
	phys.isSliding      = square > strength * strength;
	if (phys.isSliding && phys.intact) {
		phys.fail();
		if (normal < 0) return false;
		strength       = phys.shearStrength(normal);
		phys.isSliding = square > strength * strength;
	}
	if (phys.isSliding) {
		const Vector3r excess = (1 - strength / math::sqrt(square)) * shear;
		shear -= excess;
		phys.slide(excess);
	}
	return true;
}

/// Viscous normal force on body 2, along the normal; is not tensile in a joint without tensile strength.
Real Law2_PolytopeGeom_RockJointPhys_MohrCoulomb::normalDamper(const Pair& pair, const RockJointPhys& phys, Real elastic) const
{
	const Real viscous      = -normalDamping * pair.criticalDamping(phys.kn) * pair.geom.normal.dot(pair.velocity());
	const bool takesTension = phys.intact && phys.tensileStrength > 0;
	return takesTension ? viscous : math::max(viscous, -elastic);
}

/// Viscous shear force on body 2, at most to the strength.
Vector3r Law2_PolytopeGeom_RockJointPhys_MohrCoulomb::shearDamper(
        const Pair& pair, const RockJointPhys& phys, Real normal, const Vector3r& shear) const
{
	const Vector3r velocity = pair.velocity();
	const Vector3r viscous
	        = -shearDamping * pair.criticalDamping(phys.ks) * (velocity - pair.geom.normal.dot(velocity) * pair.geom.normal);
	return fractionWithin(phys.shearStrength(normal), shear, viscous) * viscous;
}

/// Moment on body 2 of dampers spread over the contact area.
Vector3r Law2_PolytopeGeom_RockJointPhys_MohrCoulomb::rockingDamper(const Pair& pair, const RockJointPhys& phys, Real normal) const
{
	Real        gyrationSquared = phys.contactArea / 12;
	const auto* polygon         = dynamic_cast<const Polytope*>(pair.body1->shape.get());
	if (polygon && polygon->dimension == 2) {
		const auto* other = static_cast<const Polytope*>(pair.body2->shape.get()); // polygons meet polygons only
		gyrationSquared   = math::pow(phys.contactArea / math::min(polygon->thickness, other->thickness), 2) / 12;
	}
	const Vector3r rocking = pair.spin() - pair.geom.normal.dot(pair.spin()) * pair.geom.normal;
	const Vector3r moment  = -rockingDamping * pair.criticalDamping(phys.kn) * gyrationSquared * rocking;
	const Real     limit = math::sqrt(3 * gyrationSquared) * math::max(normal, Real(0)), size = moment.norm();
	return size > limit ? Vector3r(limit / size * moment) : moment;
}

/// Applies forces and moments to the bodies; false if they are not finite: then the contact is left out of this step.
bool Law2_PolytopeGeom_RockJointPhys_MohrCoulomb::apply(const Pair& pair, RockJointPhys& phys)
{
	const Vector3r force = phys.normalForce + phys.shearForce;
	if (!math::isfinite(force.squaredNorm() + phys.rockingMoment.squaredNorm())) {
		phys.normalForce = phys.shearForce = phys.normalViscous = phys.shearViscous = phys.rockingMoment = phys.slip
		        = Vector3r::Zero();
		++nonFinite_;
		return false;
	}
	const Body::id_t id1 = pair.contact.getId1(), id2 = pair.contact.getId2();
	// one sum for each body: with two contacts on it the total does not depend on the order, nor on the number of threads
	addForce(id1, -force, scene);
	addForce(id2, force, scene);
	addTorque(id1, -(pair.arm1.cross(force) + phys.rockingMoment), scene);
	addTorque(id2, pair.arm2.cross(force) + phys.rockingMoment, scene);
	return true;
}

/// The joint is open: no force, and tangential motion counts as slip, as does the spring's elastic displacement. False ends the contact.
bool Law2_PolytopeGeom_RockJointPhys_MohrCoulomb::open(const Pair& pair, RockJointPhys& phys, const Last& last, const Vector3r& trial)
{
	StepWork work;
	work.fractured = phys.intact || last.wasBond;
	if (phys.intact) phys.fail();
	else if (!last.wasBond) work.plastic = last.shear.loss(phys.ks, trial, Vector3r::Zero());
	phys.slide(trial);
	phys.normalForce = phys.shearForce = phys.normalViscous = phys.shearViscous = phys.rockingMoment = Vector3r::Zero();
	phys.isSliding                                                                                   = false;
	if (scene->trackEnergy) book(pair, phys, last, work);
	else phys.lastStored = -1;
	return phys.hasHistory() && -pair.geom.penetrationDepth < math::min(pair.geom.refR1, pair.geom.refR2);
}

void Law2_PolytopeGeom_RockJointPhys_MohrCoulomb::nameEnergies()
{
	// EnergyTracker adds names without a lock: all of ours are added at once, before any is used
#pragma omp critical(polytopeEnergyNames)
	if (!energiesNamed_) {
		const char* const names[energyCount]
		        = { "elastPotential", "plastDissip", "normDampDissip", "shearDampDissip", "fractureDissip", "nonconservative" };
		for (int k = 0; k < energyCount; ++k)
			scene->energy->findId(names[k], energyIds_[k], /*reset in each step*/ k == elastic);
		energiesNamed_ = true;
	}
}

/// Energy of the step from the last positions to these, with the mean of the forces at both ends.
void Law2_PolytopeGeom_RockJointPhys_MohrCoulomb::book(const Pair& pair, RockJointPhys& phys, const Last& last, const StepWork& work)
{
	if (!energiesNamed_) nameEnergies();
	const Vector3r force = phys.normalForce + phys.shearForce;
	const Real     given = scene->dt / 2
	        * ((last.force + force).dot(pair.centreVelocity())
	                + (phys.lastArm2.cross(last.force) + pair.arm2.cross(force)).dot(pair.state2.angVel)
	                - (phys.lastArm1.cross(last.force) + pair.arm1.cross(force)).dot(pair.state1.angVel));
	// a contact that was there before tracking was switched on has no last step to compare with
	const bool known = phys.lastStored >= 0 || pair.contact.iterMadeReal == scene->iter;
	Real       rest  = 0;
	if (known)
		rest = -given - (work.stored - math::max(phys.lastStored, Real(0))) - work.plastic - work.normalDamping - work.shearDamping;

	const auto add = [&](Energy kind, Real value) { scene->energy->add(value, "", energyIds_[kind], kind == elastic); };
	add(elastic, work.stored);
	add(plastic, work.plastic);
	add(normalViscosity, work.normalDamping + work.rockingDamping);
	add(shearViscosity, work.shearDamping);
	add(work.fractured ? fracture : nonconservative, rest);
	phys.lastArm1   = pair.arm1;
	phys.lastArm2   = pair.arm2;
	phys.lastStored = work.stored;
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
