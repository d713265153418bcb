// SPDX-License-Identifier: GPL-2.0-or-later
#include "step/PolytopeTimeStepper.hpp"

#include <pkg/common/PeriodicEngines.hpp>
#include <boost/functional/hash.hpp>

#include "host/SpringsOfScene.hpp"
#include "joint/RockJointLaw.hpp"
#include "pairs/PolytopeCollider.hpp"

#include <src/timestep/TimeStepTolerances.hpp>

namespace yade {

POLYTOPE_CLASSES((PolytopeTimeStepper));

namespace {

	std::size_t springsMade(const Scene& scene)
	{
		std::size_t sum = 0;
		for (const HasSprings* springs : springsOf(scene))
			sum += springs->made();
		return sum;
	}

	/// A number that is another one where other bodies are moved by forces: bodies may be fixed and freed. On several processes always 0:
	/// there bodies come and go, and all take their time step together.
	std::size_t moversOf(const Scene& scene)
	{
		std::size_t number = 0;
		if (isDivided(scene)) return number;
		for (const auto& body : *scene.bodies)
			if (body && isMovedByForces(*body)) boost::hash_combine(number, body->id);
		return number;
	}

	/// In a scene in which nothing can move: the time for which engines wait that may put bodies into it. The collider calls the time stepper
	/// before these move (PolytopeCollider); with another one the step stays as it is.
	TimeStepLimit periodLimit(const Scene& scene)
	{
		TimeStepLimit limit;
		for (const auto& body : *scene.bodies)
			if (body && isMovedByForces(*body)) return limit;
		bool calls = false;
		for (const auto& engine : scene.engines) {
			calls                = calls || (!engine->dead && dynamic_cast<const PolytopeCollider*>(engine.get()));
			const auto* periodic = dynamic_cast<const PeriodicEngine*>(engine.get());
			if (periodic && !engine->dead) limit.take(periodic->virtPeriod, Body::ID_NONE);
		}
		return calls ? limit : TimeStepLimit();
	}

} // namespace

bool PolytopeTimeStepper::isActivated()
{
	if (!active) return false;
	const auto* const law       = dampingLaw(*scene);
	const bool        stiffened = law && law->hasStiffened();
	return stiffened || !last.there || last.bodies != scene->bodies->size() || last.springs != springsMade(*scene)
	        || isErased(limitingBody, *scene) || scene->iter % long(math::max(timeStepUpdateInterval, 1u)) == 0;
}

void PolytopeTimeStepper::computeTimeStep(Scene* ofScene)
{
	const std::size_t movers = moversOf(*ofScene);
	if (!last.there || last.bodies != ofScene->bodies->size() || movers != last.movers || isErased(last.material.body, *ofScene)
	        || ++last.updates >= polytope::tolerance::potentialUpdates) {
		last.material = potential_.limit(*ofScene);
		last.updates  = 0;
	}
	last.there   = true;
	last.bodies  = ofScene->bodies->size();
	last.movers  = movers;
	last.springs = springsMade(*ofScene);

	TimeStepLimit chosen;
	limitedBy.clear();
	const auto consider = [&](const TimeStepLimit& limit, Real fraction, const char* name) {
		const Real step = fraction * limit.step;
		if (!(step < chosen.step)) return;
		chosen.step = step;
		chosen.body = limit.body;
		limitedBy   = name;
	};
	const ContactLimit contacts = contactLimit(*ofScene, last.material.step);
	consider(last.material, timestepSafetyCoefficient, "material");
	consider(contacts, timestepSafetyCoefficient, contacts.rocking ? "rocking" : "contacts");
	consider(yade::motionLimit(*ofScene, motionLimit, math::min(chosen.step, maxDt), timeStepUpdateInterval), 1, "motion");
	consider(closingLimit(*ofScene, math::min(chosen.step, maxDt), timeStepUpdateInterval), 1, "closing");
	if (limitedBy.empty()) consider(periodLimit(*ofScene), polytope::tolerance::periodStep, "period");
	if (!limitedBy.empty() || maxDt < std::numeric_limits<Real>::infinity()) {
		TimeStepLimit most;
		most.step = maxDt;
		consider(most, 1, "maxDt");
	}
	limitingBody = chosen.body;
	if (!limitedBy.empty()) ofScene->dt = chosen.step;
}

void PolytopeTimeStepper::setTimeStepUpdateInterval(long interval)
{
	if (interval < 1 || interval > std::numeric_limits<int>::max())
		throw std::invalid_argument(
		        "timeStepUpdateInterval: must be a number of steps, at least 1, got " + std::to_string(interval));
	timeStepUpdateInterval = (unsigned int)interval;
}

void PolytopeTimeStepper::postLoad(PolytopeTimeStepper&)
{
	checked_.check(std::tie(timestepSafetyCoefficient, motionLimit, maxDt), [&] {
		requireValue(timestepSafetyCoefficient > 0 && timestepSafetyCoefficient <= 2, "timestepSafetyCoefficient",
		        timestepSafetyCoefficient, "above 0 and at most 2, the limit of one body between fixed ones");
		requireValue(motionLimit > 0 && math::isfinite(motionLimit), "motionLimit", motionLimit,
		        "above 0 and finite (a fraction of a body's inscribed radius)");
		requireValue(maxDt > 0, "maxDt", maxDt, "above 0 [s] (infinity: no limit)");
	});
	if (timeStepUpdateInterval < 1) {
		timeStepUpdateInterval = 1;
		setTimeStepUpdateInterval(0);
	}
}

} // namespace yade
