// SPDX-License-Identifier: GPL-2.0-or-later
#include "joint/RockJointStep.hpp"

#include "host/HalfStepWork.hpp"

namespace yade {

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
	const LastStepOfJoint before = phys.lastStep.get() ? *phys.lastStep.get() : LastStepOfJoint();
	const Vector3r        force  = phys.normalForce + phys.shearForce;
	const Vector3r        moment = phys.undampedMoment(pair.geom);
	const auto            half
	        = [&](const ForceOfPair& of) { return halfStepWork(of, pair.centreVelocity(), pair.state1, pair.state2, scene->dt); };
	const Real given = half({ last.force, before.moment, before.arm1, before.arm2 }) + half({ force, moment, pair.arm1, pair.arm2 });
	// a contact that was there before tracking was switched on has no last step to compare with
	const bool known = before.stored >= 0 || pair.contact.iterMadeReal == scene->iter;
	Real       rest  = 0;
	if (known)
		rest = -given - (work.stored - math::max(before.stored, Real(0))) - work.plastic - work.normalDamping - work.shearDamping;

	const auto add = [&](Energy kind, Real value) { scene->energy->add(value, "", energyIds_[kind], kind == elastic); };
	add(elastic, work.stored);
	add(plastic, work.plastic);
	add(normalViscosity, work.normalDamping + work.rockingDamping);
	add(shearViscosity, work.shearDamping);
	add(work.fractured ? fracture : nonconservative, rest);
	phys.lastStep.make() = { pair.arm1, pair.arm2, moment, work.stored };
}

} // namespace yade
