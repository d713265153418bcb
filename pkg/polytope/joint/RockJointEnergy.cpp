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

/// Energy of the step from the last positions to these, with the mean of the forces at both ends: each where it acts, for a point and a normal that move
/// from step to step would else make an error as large as the step.
void Law2_PolytopeGeom_RockJointPhys_MohrCoulomb::book(const Pair& pair, RockJointPhys& phys, const Last& last, StepWork work)
{
	if (!energiesNamed_) nameEnergies();
	const bool            tracked = phys.lastStep.get();
	const LastStepOfJoint before  = tracked ? *phys.lastStep.get() : LastStepOfJoint();
	const Vector3r        force = phys.normalForce + phys.shearForce, moment = phys.undampedMoment(pair.geom),
	               viscousMoment = phys.viscousMoment(pair.geom);
	const auto workOf = [&](const Vector3r& lastForce, const Vector3r& lastMoment, const Vector3r& now, const Vector3r& nowMoment) {
		const auto half = [&](const ForceOfPair& of) {
			return halfStepWork(of, pair.centreVelocity(), pair.state1, pair.state2, scene->dt);
		};
		const Real ofNow = half({ now, nowMoment, pair.arm1, pair.arm2 });
		return tracked ? half({ lastForce, lastMoment, before.arm1, before.arm2 }) + ofNow : ofNow;
	};
	const Real given = workOf(last.force, before.moment, force, moment);
	work.normalDamping -= workOf(last.normalViscous, Vector3r::Zero(), phys.normalViscous, Vector3r::Zero());
	work.shearDamping -= workOf(last.shearViscous, before.viscousMoment, phys.shearViscous, viscousMoment);
	const Real rockingDamping = -(last.rockingMoment + phys.rockingMoment).dot(pair.spin()) / 2 * scene->dt;
	// a contact that was there before tracking was switched on has no last step to compare with
	const bool known = before.stored >= 0 || pair.contact.iterMadeReal == scene->iter;
	Real       rest  = 0;
	if (known)
		rest = -given - (work.stored - math::max(before.stored, Real(0))) - work.plastic - work.normalDamping - work.shearDamping;

	const auto add = [&](Energy kind, Real value) { scene->energy->add(value, "", energyIds_[kind], kind == elastic); };
	add(elastic, work.stored);
	add(plastic, work.plastic);
	add(normalViscosity, work.normalDamping + rockingDamping);
	add(shearViscosity, work.shearDamping);
	add(work.fractured ? fracture : nonconservative, rest);
	phys.lastStep.make() = { pair.arm1, pair.arm2, moment, viscousMoment, work.stored };
}

} // namespace yade
