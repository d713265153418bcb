// SPDX-License-Identifier: GPL-2.0-or-later
#include "bonding/PolytopeBonds.hpp"

#include <core/Omega.hpp>
#include <pkg/dem/ScGeom.hpp>

#include "bond/BondOfParts.hpp"
#include "contact/PolytopeGeom.hpp"
#include "host/HalfStepWork.hpp"
#include "host/PeriodOfPair.hpp"
#include "joint/RockJointPhys.hpp"

namespace yade {

POLYTOPE_CLASSES((PolytopeBonds));

namespace {

	/// Numbers of the process that computes a body, and of this process: 0 where YADE is built without MPI.
#ifdef YADE_MPI
	int rankOf(const Body& body) { return body.subdomain; }
	int rankOf(const Scene& scene) { return scene.subdomain; }
#else
	int rankOf(const Body&) { return 0; }
	int rankOf(const Scene&) { return 0; }
#endif

	/// Whether the joint of two bodies has just taken over from their bond, with its force and energy (Ip2_RockJointMat_RockJointMat_RockJointPhys.cpp).
	bool jointHasTakenOver(const PolytopeBond& bond, const Scene& scene)
	{
		const auto& contact = scene.interactions->find(bond.id1, bond.id2);
		return contact && contact->isReal() && contact->iterMadeReal == scene.iter
		        && dynamic_cast<const PolytopeGeom*>(contact->geom.get())
		        && dynamic_cast<const RockJointPhys*>(contact->phys.get());
	}

	/// Work in a bond's last step: at its end there is no force any more.
	Real workOfLastHalf(const PolytopeBond& bond, const Vector3r& force, const Scene& scene)
	{
		const State &  state1 = *(*scene.bodies)[bond.id1]->state, &state2 = *(*scene.bodies)[bond.id2]->state;
		const Vector3r velocity = velocityByCells(scene, bond.cellDist, state2.vel - state1.vel);
		return halfStepWork({ force, bond.moment, bond.arm1, bond.arm2 }, velocity, state1, state2, scene.dt);
	}

} // namespace

PolytopeBonds::Key PolytopeBonds::key(Body::id_t id1, Body::id_t id2)
{
	return (Key(std::uint32_t(math::min(id1, id2))) << 32) | Key(std::uint32_t(math::max(id1, id2)));
}

void PolytopeBonds::action()
{
	if (bonds.empty()) return;
	bookFailed();
	const long count  = long(bonds.size());
	long       absent = 0;
#pragma omp parallel for schedule(static) reduction(+ : absent)
	for (long k = 0; k < count; ++k) {
		PolytopeBond& bond = *bonds[k];
		if (!bond.intact || (divided && !isOurs(bond))) continue;
		if (divided && isAbsent(bond)) ++absent;
		else act(bond);
	}
	missing += absent;
	settle();
}

/// Whether, in a divided scene, a body is this rank's. Two ranks that share a bond find the same force, since they have the same states.
/// Rank 0 has fixed bodies and does not know the others; workers send it the forces on its own.
bool PolytopeBonds::isOurs(const PolytopeBond& bond) const
{
	const auto own = [&](Body::id_t id) { return scene->bodies->exists(id) && rankOf(*(*scene->bodies)[id]) == rankOf(*scene); };
	return rankOf(*scene) == 0 ? own(bond.id1) && own(bond.id2) : own(bond.id1) || own(bond.id2);
}

bool PolytopeBonds::isAbsent(const PolytopeBond& bond) const
{
	return !scene->bodies->exists(bond.id1) || !scene->bodies->exists(bond.id2);
}

/// Force of this step on both bodies, and whether the bond fails in it: then it has acted for the last time.
void PolytopeBonds::act(PolytopeBond& bond) const
{
	if (!divided) { // else bodies of other ranks come and go
		if (!bond.hasItsBodies(*scene->bodies)) {
			bond.erase();
			return;
		}
		bond.adoptBodies(*scene->bodies);
	}
	bond.follow(*(*scene->bodies)[bond.id1]->state, *(*scene->bodies)[bond.id2]->state, placeByCells(*scene, bond.cellDist));
	if (!bond.isFinite()) { // as contacts: left out of this step
		bond.force = bond.moment = Vector3r::Zero();
		bond.energy              = 0;
		return;
	}
	if (const char* strength = unbreakable ? nullptr : bond.exceeded()) bond.failure = strength;
	scene->forces.addForce(bond.id1, -bond.force);
	scene->forces.addForce(bond.id2, bond.force);
	scene->forces.addTorque(bond.id1, -(bond.arm1.cross(bond.force) + bond.moment));
	scene->forces.addTorque(bond.id2, bond.arm2.cross(bond.force) + bond.moment);
}

/// What the threads leave to one: tables of failed bonds, and energies.
void PolytopeBonds::settle()
{
	failed_.clear();
	Real stored = 0;
	for (int k = 0; k < int(bonds.size()); ++k) {
		PolytopeBond& bond = *bonds[k];
		if (!bond.intact) continue;
		stored += bond.energy;
		if (bond.failure.empty()) continue;
		end(k, scene->iter);
		if (bond.failure != "erased") failed_.push_back(k);
	}
	if (scene->trackEnergy) scene->energy->add(stored, "elastPotential", elasticId_, /*reset in each step*/ true);
}

/// A bond acts no more after this step.
void PolytopeBonds::end(int index, long step)
{
	PolytopeBond& bond = *bonds[index];
	bond.intact        = false;
	bond.failedAt      = step;
	const Key pair     = key(bond.id1, bond.id2);
	if (--intactPairs_[pair] <= 0) intactPairs_.erase(pair);
	if (bond.failure == "erased") failedPairs_.erase(pair);
	else failedPairs_[pair] = index;
}

/// Bonds of bodies that are not there any more end.
void PolytopeBonds::endErased(const Scene& where)
{
	for (int k = 0; k < int(bonds.size()); ++k) {
		if (!bonds[k]->intact || bonds[k]->hasItsBodies(*where.bodies)) continue;
		bonds[k]->erase();
		end(k, where.iter);
	}
}

/// Books for the bonds that acted for the last time in the step before what they had stored and have not given to the bodies. Where a joint
/// has taken over, its law accounts for the force.
void PolytopeBonds::bookFailed()
{
	for (int k : failed_) {
		PolytopeBond& bond = *bonds[k];
		if (scene->trackEnergy && bond.hasItsBodies(*scene->bodies)) {
			const bool     followed = jointHasTakenOver(bond, *scene);
			const Vector3r force    = followed ? Vector3r(Vector3r::Zero()) : bond.force;
			const Real     lost     = (followed ? Real(0) : bond.energy) - workOfLastHalf(bond, force, *scene);
			scene->energy->add(lost, "fractureDissip", fractureId_);
		}
		bond.force = bond.moment = Vector3r::Zero();
		bond.energy              = 0;
	}
	failed_.clear();
}

void PolytopeBonds::enter(int index)
{
	const PolytopeBond& bond = *bonds[index];
	if (bond.id1 < 0 || bond.id2 < 0) return;
	const Key pair = key(bond.id1, bond.id2);
	if (bond.intact) ++intactPairs_[pair];
	else if (bond.failure != "erased") {
		failedPairs_[pair] = index;
		if (bond.energy > 0) failed_.push_back(index); // saved in the step in which it failed
	}
	const std::size_t needed = math::max(bond.id1, bond.id2) + 1;
	if (ofBody_.size() < needed) ofBody_.resize(needed);
	ofBody_[bond.id1].push_back(index);
	ofBody_[bond.id2].push_back(index);
}

void PolytopeBonds::rebuild()
{
	failed_.clear();
	intactPairs_.clear();
	failedPairs_.clear();
	ofBody_.clear();
	for (int k = 0; k < int(bonds.size()); ++k)
		enter(k);
}

bool PolytopeBonds::continueBetween(const PolytopeBond& whole, const Body& whole1, const Body& whole2, const Body& part1, const Body& part2)
{
	const auto part = bondOfParts(whole, whole1, whole2, part1, part2, *Omega::instance().getScene()->bodies);
	if (!part) return false;
	if (!part->intact) { // what is left of it is where the joint has no force
		part->force = part->moment = Vector3r::Zero();
		part->energy               = 0;
	}
	bonds.push_back(part);
	enter(int(bonds.size()) - 1);
	return true;
}

void PolytopeBonds::postLoad(PolytopeBonds&) { rebuild(); }

boost::python::list PolytopeBonds::bondList() const
{
	boost::python::list all;
	for (const auto& bond : bonds)
		all.append(bond);
	return all;
}

boost::python::list PolytopeBonds::states() const
{
	// of the first body's rank, or where that is rank 0, which has fixed bodies alone, of the second's
	const auto          decides = [&](Body::id_t id) { return scene->bodies->exists(id) ? rankOf(*(*scene->bodies)[id]) : -1; };
	boost::python::list all;
	for (int k = 0; k < int(bonds.size()); ++k) {
		const PolytopeBond& bond  = *bonds[k];
		const int           first = decides(bond.id1);
		if ((first == 0 ? decides(bond.id2) : first) != rankOf(*scene)) continue;
		all.append(boost::python::make_tuple(k, bond.intact, bond.failure, bond.failedAt, bond.energy, bond.normalStress,
		        bond.edgeStress, bond.shearStress,
		        boost::python::make_tuple(bond.force, bond.moment, bond.point, bond.arm1, bond.arm2)));
	}
	return all;
}

void PolytopeBonds::takeStates(const boost::python::list& states)
{
	using boost::python::extract;
	for (long i = 0; i < boost::python::len(states); ++i) {
		const boost::python::object state = states[i], vectors = state[8];
		PolytopeBond&               bond = *bonds.at(extract<std::size_t>(state[0])());
		bond.intact                      = extract<bool>(state[1]);
		bond.failure                     = extract<std::string>(state[2])();
		bond.failedAt                    = extract<long>(state[3]);
		Real* const     numbers[]        = { &bond.energy, &bond.normalStress, &bond.edgeStress, &bond.shearStress };
		Vector3r* const places[]         = { &bond.force, &bond.moment, &bond.point, &bond.arm1, &bond.arm2 };
		for (int k = 0; k < 4; ++k)
			*numbers[k] = extract<Real>(state[4 + k])();
		for (int k = 0; k < 5; ++k)
			*places[k] = extract<Vector3r>(vectors[k]);
	}
	rebuild();
}

void PolytopeBonds::adoptBodies()
{
	for (const auto& bond : bonds)
		bond->adoptBodies(*scene->bodies, /*anew*/ true);
}

void PolytopeBonds::meetBodies()
{
	if (divided) return; // bodies of other ranks come and go
	for (const auto& bond : bonds)
		bond->adoptBodies(*Omega::instance().getScene()->bodies);
}

long PolytopeBonds::intactCount() const
{
	return std::count_if(bonds.begin(), bonds.end(), [](const auto& bond) { return bond->intact; });
}

long PolytopeBonds::intactInScene() const
{
	const auto& bodies = *Omega::instance().getScene()->bodies;
	return std::count_if(bonds.begin(), bonds.end(),
	        [&](const auto& bond) { return bond->intact && bond->knowsItsBodies() && bond->hasItsBodies(bodies); });
}

bool PolytopeBonds::joins(Body::id_t id1, Body::id_t id2) const { return intactPairs_.count(key(id1, id2)) > 0; }

bool PolytopeBonds::left(Body::id_t id1, Body::id_t id2, BondRemains& remains) const
{
	const auto found = failedPairs_.find(key(id1, id2));
	if (found == failedPairs_.end()) return false;
	const PolytopeBond& bond = *bonds[found->second];
	if (divided ? isAbsent(bond) : !bond.hasItsBodies(*scene->bodies)) return false;
	remains.overlap    = bond.overlap;
	remains.inLastStep = bond.failedAt + 1 == scene->iter;
	if (!remains.inLastStep) return true;
	const bool same = bond.id1 == id1;
	remains.force   = same ? bond.force : Vector3r(-bond.force);
	remains.point   = same ? bond.point : Vector3r(bond.point - placeByCells(*scene, bond.cellDist));
	remains.energy  = bond.energy;
	return true;
}

bool PolytopeBonds::holds(Body::id_t id) const
{
	if (id < 0 || std::size_t(id) >= ofBody_.size()) return false;
	return std::any_of(ofBody_[id].begin(), ofBody_[id].end(), [&](int k) { return bonds[k]->intact; });
}

void PolytopeBonds::forSpringsOf(const Body& body, const std::function<void(const SpringsAtPoint&)>& visit) const
{
	if (!holds(body.id)) return;
	for (int k : ofBody_[body.id]) {
		const PolytopeBond& bond = *bonds[k];
		if (!bond.intact) continue;
		const bool     first  = bond.id1 == body.id;
		const Vector3r linear = bond.linearStiffness();
		const Matrix3r axes   = (body.state->ori * (first ? bond.frame1 : bond.frame2)).toRotationMatrix();
		visit({ axes.col(0), body.state->pos + body.state->ori * (first ? bond.point1 : bond.point2), linear[0], linear[1],
		        bond.rotationStiffness(axes) });
	}
}

} // namespace yade
