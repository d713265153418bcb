// SPDX-License-Identifier: GPL-2.0-or-later
#include "joint/JointOfParts.hpp"

#include "bond/BondOfParts.hpp"
#include "contact/PolytopeGeom.hpp"
#include "host/InteractionLoops.hpp"
#include "joint/RockJointPhys.hpp"

#include <src/numbers/PlaneAxes.hpp>
#include <src/shear/ContactOutline.hpp>

namespace yade {
namespace {

	/// A contact with its geometry alone; null where the parts are apart, unless `force` asks for one all the same.
	shared_ptr<Interaction> contactOf(
	        Scene& scene, const shared_ptr<Body>& part1, const shared_ptr<Body>& part2, const PolytopeGeom& whole, bool force)
	{
		const auto* const loop = findInLoops(scene, [](InteractionLoop& first) { return &first; });
		if (!loop) return nullptr;
		bool       swap    = false;
		const auto functor = loop->geomDispatcher->getFunctor2D(part1->shape, part2->shape, swap);
		if (!functor || swap) return nullptr; // the order is that of the whole
		functor->scene  = &scene;
		auto       made = boost::make_shared<Interaction>(part1->id, part2->id);
		const auto find = [&] {
			return functor->go(part1->shape, part2->shape, *part1->state, *part2->state, Vector3r::Zero(), force, made)
			        && dynamic_cast<PolytopeGeom*>(made->geom.get());
		};
		if (!find()) return nullptr;
		auto& geom = static_cast<PolytopeGeom&>(*made->geom);
		if (whole.closure.get() || whole.widened.get()) { // by which the contact depends on the joint
			geom.closure = whole.closure;
			geom.widened = whole.widened;
			if (!find()) return nullptr;
		}
		geom.stiffnessRule      = whole.stiffnessRule;
		geom.needsArea          = true;
		made->functorCache.geom = functor;
		return made;
	}

	/// Shear springs of a part of the bed: displaced as those of the whole at the same place, which has turned about the normal, too. When they joined is
	/// forgotten: with one layer the parts have the least energy that holds the force and the moment of the whole.
	void takeShear(RockJointPhys& phys, const RockJointPhys& whole, const PolytopeGeom& geom)
	{
		const Vector3r& n        = geom.normal;
		const auto      flat     = [&](const Vector3r& x) { return Vector3r(x - n.dot(x) * n); };
		Vector3r        centroid = geom.contactPoint;
		Real            gyration = 0;
		if (geom.outline.count() >= 3) {
			const polytope::OutlineMoments moments = polytope::momentsOf(geom.outline.corners(), geom.outline.count());
			gyration                               = moments.gyrationSquared();
			centroid += polytope::PlaneAxes(n).inSpace(moments.centroid);
		}
		const Real     turned = whole.twistingStiffness > 0
		            ? Real((whole.twistingViscous - whole.twistingMoment) / whole.twistingStiffness)
		            : Real(0);
		const Vector3r mean
		        = whole.ks > 0 ? Vector3r((whole.shearViscous - whole.shearForce) / whole.ks) : Vector3r(Vector3r::Zero());
		const Vector3r more    = turned * n.cross(centroid - whole.shearPoint);
		phys.shearForce        = -phys.ks * flat(mean + more);
		phys.shearPoint        = centroid;
		phys.twistingStiffness = phys.ks * gyration;
		phys.twistingMoment    = -phys.twistingStiffness * turned;
		phys.shearLayers.clear();
	}

	/// Acts as a part of the bond of the whole.
	void takeBond(RockJointPhys& phys, PolytopeGeom& geom, const shared_ptr<PolytopeBond>& bond, const Body& part1, const Body& part2)
	{
		phys.bond        = bond;
		phys.contactArea = bond->area;
		phys.setStiffnesses(1);
		geom.normal       = bond->follow(*part1.state, *part2.state, Vector3r::Zero()).mean * Vector3r::UnitX();
		geom.contactPoint = bond->point;
		phys.takeForce(bond->force, bond->point, geom.normal);
	}

	/// What energies are counted from in the next step.
	void beginEnergies(RockJointPhys& phys, const PolytopeGeom& geom, const Body& part1, const Body& part2)
	{
		LastStepOfJoint& last = phys.lastStep.make();
		last.arm1             = geom.contactPoint - part1.state->pos;
		last.arm2             = geom.contactPoint - part2.state->pos;
		last.moment           = phys.undampedMoment(geom);
		last.stored           = phys.presentNormalEnergy(geom) + phys.shearEnergy();
	}

	/// Puts a contact in the place of the pair that the collider has made, whose bodies may be in the other order. False if that pair is a real contact.
	bool takePlace(Scene& scene, const shared_ptr<Interaction>& made)
	{
		const shared_ptr<Interaction> pair = scene.interactions->find(made->getId1(), made->getId2());
		if (pair && pair->isReal()) return false;
		if (pair) scene.interactions->erase(pair->getId1(), pair->getId2(), pair->linIx);
		return scene.interactions->insert(made);
	}

} // namespace

bool continueBetween(Scene& scene, const Interaction& whole, const Body& whole1, const Body& whole2, const shared_ptr<Body>& part1,
        const shared_ptr<Body>& part2)
{
	const auto& wholeGeom = static_cast<const PolytopeGeom&>(*whole.geom);
	const auto& wholePhys = static_cast<const RockJointPhys&>(*whole.phys);
	const auto  made      = contactOf(
                scene, part1, part2, wholeGeom, /*force*/ !(wholeGeom.touches() && wholeGeom.penetrationDepth > 0) || wholePhys.bond);
	if (!made) return false;
	auto& geom = static_cast<PolytopeGeom&>(*made->geom);
	if (!(geom.normal.dot(wholeGeom.normal) > 0)) return false; // another side of the parts

	auto phys         = boost::make_shared<RockJointPhys>(wholePhys);
	phys->normalForce = phys->normalViscous = phys->shearViscous = phys->rockingMoment = Vector3r::Zero();
	phys->twistingViscous = phys->dampedStiffness = 0;
	phys->followsBond                             = false;
	phys->bond.reset();
	phys->lastStep.clear();
	const auto bond = wholePhys.bond ? bondOfParts(*wholePhys.bond, whole1, whole2, *part1, *part2, *scene.bodies) : nullptr;
	if (bond) takeBond(*phys, geom, bond, *part1, *part2);
	else {
		if (wholePhys.bond && !geom.touches()) return false;
		// of an open joint as much as it had
		phys->contactArea = geom.touches() ? geom.contactArea : math::min(geom.contactArea, wholePhys.contactArea);
		if (!(phys->contactArea > 0)) return false;
		phys->setStiffnesses(geom.share);
		takeShear(*phys, wholePhys, geom);
		if (geom.touches()) phys->normalForce = phys->normalSpring(geom.penetrationDepth) * geom.normal;
		if (phys->laws.get()) phys->stiffen(geom.penetrationDepth);
	}
	if (wholePhys.lastStep.get()) beginEnergies(*phys, geom, *part1, *part2);
	made->phys         = phys;
	made->iterMadeReal = whole.iterMadeReal;
	return takePlace(scene, made);
}

} // namespace yade
