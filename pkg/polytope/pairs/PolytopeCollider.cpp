// SPDX-License-Identifier: GPL-2.0-or-later
#include "pairs/PolytopeCollider.hpp"

#include <core/Dispatching.hpp>
#include <core/Scene.hpp>
#include <pkg/common/Sphere.hpp>

#include "host/FindsTimeStep.hpp"
#include "host/PartsOfBodies.hpp"
#include "shape/Polytope.hpp"

#include <limits>

namespace yade {

POLYTOPE_CLASSES((PolytopeCollider));

bool PolytopeCollider::mustRunForAll() const
{
	return !hasSearched_ || !(verletDist > 0) || !newton || scene->interactions->dirty || scene->doSort || doSort
	        || scene->bodies->size() != bodies_;
}

bool PolytopeCollider::isActivated()
{
	if (scene->isPeriodic) return InsertionSortCollider::isActivated() || !room_.outside(*scene, false).empty();
	outside_.clear();
	if (mustRunForAll()) return true;
	fastestBodyMaxDist = newton->maxVelocitySq;
	outside_           = room_.outside(*scene, true);
	return !outside_.empty() || fastestBodyMaxDist >= 1; // which a script may have set
}

template <class Make> void PolytopeCollider::withRooms(const Make& make)
{
	const auto give = [&](const std::vector<Real>* rooms) {
		for (const auto& functor : boundDispatcher->functors)
			if (auto* own = dynamic_cast<Bo1_Polytope_Aabb*>(functor.get())) own->rooms = rooms;
	};
	give(&room_.rooms());
	try {
		make();
	} catch (...) {
		give(nullptr);
		throw;
	}
	give(nullptr);
}

/// A negative verletDist means, as in InsertionSortCollider, that part of the smallest sphere's radius; without spheres it becomes 0.
void PolytopeCollider::findVerletDist()
{
	if (!(verletDist < 0)) return;
	Real smallest = std::numeric_limits<Real>::infinity();
	for (const auto& body : *scene->bodies)
		if (const auto* sphere = body ? dynamic_cast<const Sphere*>(body->shape.get()) : nullptr)
			smallest = math::min(smallest, sphere->radius);
	verletDist = math::isinf(smallest) ? Real(0) : math::abs(verletDist) * smallest;
}

/// Has the integrator measure displacements, as InsertionSortCollider does.
void PolytopeCollider::findNewton()
{
	if (!(verletDist > 0)) return;
	for (const auto& engine : scene->engines)
		if (!newton) newton = YADE_PTR_DYN_CAST<NewtonIntegrator>(engine);
	if (!newton) throw std::runtime_error("PolytopeCollider.verletDist: above 0 it needs a NewtonIntegrator in O.engines");
	newton->updatingDispFactor = updatingDispFactor;
}

BoxRoom::Limits PolytopeCollider::limits() const
{
	const Real most = math::max(verletDist, Real(0));
	return { most, minSweepDistFactor * most, targetInterv };
}

void PolytopeCollider::prepareBoxes()
{
	boundDispatcher->scene              = scene;
	boundDispatcher->sweepDist          = math::max(verletDist, Real(0));
	boundDispatcher->minSweepDistFactor = minSweepDistFactor;
	boundDispatcher->targetInterv       = targetInterv;
	boundDispatcher->updatingDispFactor = updatingDispFactor;
}

void PolytopeCollider::searchAll()
{
	scene->forces.addMaxId(scene->bodies->size());
	findNewton();
	prepareBoxes();
	withRooms([&] { boundDispatcher->action(); });
	room_.takeFromAll(*scene);
	const bool judge = verletDist > 0; // else in each step, and visiting pairs that are apart takes less time than judging them
	pairs_.ofAll(*scene, *this, judge, hasSearched_ && pairs_.areMany(outside_.size()));
	hasSearched_ = true;
	searchedAt_  = scene->iter;
	bodies_      = scene->bodies->size();
	divided_     = isDivided(*scene);

	// as InsertionSortCollider leaves them
	keepListsShort = scene->bodies->useRedirection;
	scene->doSort = doSort = scene->interactions->dirty = false;
	scene->bodies->checkedByCollider                    = true;
	scene->bodies->insertedBodies.clear();
	scene->bodies->erasedBodies.clear();
}

void PolytopeCollider::searchSome()
{
	prepareBoxes();
	boundDispatcher->updateScenePtr();
	const long number = long(outside_.size());
	withRooms([&] {
#pragma omp parallel for schedule(static)
		for (long k = 0; k < number; ++k)
			boundDispatcher->processBody((*scene->bodies)[outside_[k]]);
	});
	room_.take(*scene, outside_);
	pairs_.ofSome(*scene, *this, outside_);
}

/// Bodies that were added or freed since the time step was found: this step has to suit them.
void PolytopeCollider::adaptTimeStep()
{
	// those that have been freed are out of their boxes
	const bool freed = outside_.empty() ? room_.hasFreed(*scene) : room_.hasFreed(*scene, outside_);
	for (const auto& engine : scene->engines) {
		const auto* const stepper = dynamic_cast<const FindsTimeStep*>(engine.get());
		if (!stepper || !stepper->knowsNotAll(*scene, freed)) continue;
		engine->scene = scene;
		engine->action();
	}
}

void PolytopeCollider::action()
{
	adaptTimeStep();
	if (scene->isPeriodic) {
		hasSearched_ = false;
		room_.makeForAll(*scene, limits());
		withRooms([&] { InsertionSortCollider::action(); });
		room_.takeFromAll(*scene);
		return;
	}
	numAction++;
	scene->interactions->iterColliderLastRun = -1; // pairs are deleted here, not by the InteractionLoop
	// from time to time for all: a script may have changed sizes, or what is fixed
	const bool old = scene->iter - searchedAt_ >= BoxRoom::steps(targetInterv);
	if (mustRunForAll() || outside_.empty() || divided_ || old || pairs_.areMany(outside_.size())) {
		findVerletDist();
		room_.makeForAll(*scene, limits());
		searchAll();
	} else {
		room_.make(*scene, outside_, limits());
		searchSome();
	}
	outside_.clear();
}

vector<Body::id_t> PolytopeCollider::probeBoundingVolume(const Bound& bound)
{
	return scene->isPeriodic ? InsertionSortCollider::probeBoundingVolume(bound) : pairs_.overlapping(bound, *scene);
}

} // namespace yade
