// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "host/CheckedAttributes.hpp"
#include "host/FindsTimeStep.hpp"
#include "step/PotentialContacts.hpp"

#include <core/TimeStepper.hpp>

#include <cstdint>

namespace yade {

/// What the last update of the time step has found. Saved, so that a run which is loaded goes on as if it had not been interrupted.
struct LastTimeStepUpdate {
	bool          there = false;
	TimeStepLimit material;                ///< of the last evaluation of PotentialContacts
	std::uint64_t updates = 0;             ///< since then
	std::uint64_t bodies = 0, springs = 0; ///< that there were
	std::uint64_t movers = 0;              ///< a number that stands for the bodies that could move

	template <class Archive> void serialize(Archive& archive, unsigned int)
	{
		archive& BOOST_SERIALIZATION_NVP(there);
		archive& boost::serialization::make_nvp("step", material.step);
		archive& boost::serialization::make_nvp("body", material.body);
		archive& BOOST_SERIALIZATION_NVP(updates);
		archive& BOOST_SERIALIZATION_NVP(bodies);
		archive& BOOST_SERIALIZATION_NVP(springs);
		archive& BOOST_SERIALIZATION_NVP(movers);
	}
};

class PolytopeTimeStepper : public TimeStepper, public FindsTimeStep {
public:
	/// Active in steps that are multiples of the interval, where a joint has stiffened (JointClosure), in its first step, when bodies, bonds
	/// or bolts were added, and when the one that limits the time step was erased.
	bool isActivated() override;
	void computeTimeStep(Scene* ofScene) override;
	bool knowsNotAll(const Scene& ofScene, bool freed) const override
	{
		return active && !dead && last.there && (freed || last.bodies != ofScene.bodies->size());
	}

	/// Refuses values out of range, naming the attribute, and restores the last good ones.
	void postLoad(PolytopeTimeStepper&);

	/// TimeStepper's attribute, checked like this class' own.
	unsigned int getTimeStepUpdateInterval() const { return timeStepUpdateInterval; }
	void         setTimeStepUpdateInterval(long interval);

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(PolytopeTimeStepper, TimeStepper,
	R"""(Sets and updates *O.dt* for :yref:`Polytopes<Polytope>` (and spheres, walls, boxes and facets among them) from before the first contact
on: put it anywhere into *O.engines*, after the :yref:`InteractionLoop` for example, and do not set *O.dt*. It takes
:yref:`timestepSafetyCoefficient<PolytopeTimeStepper.timestepSafetyCoefficient>` times the smallest of these (docs/time-step.md):

* *contacts*, *rocking*: $\tau$ of all present contacts, bonds (:yref:`PolytopeBonds`) and bolts (:yref:`PolytopeBolts`), normal and shear springs
  with their arms, the dampers of :yref:`Law2_PolytopeGeom_RockJointPhys_MohrCoulomb`, and, which :yref:`GlobalStiffnessTimeStepper` neglects, the
  rocking of faces on each other, of both contact models. $\tau=1/\omega$ without dampers, with the highest frequency $\omega$ that any body has
  between neighbours that stay where they are; one such body is stable up to $2\tau$, any heap up to $\tau$.
* *material*: the same of the one contact that each body may have with any other of the scene, with stiffnesses from the scene's own Ip2 functor
  (:yref:`Ip2_RockJointMat_RockJointMat_RockJointPhys` or :yref:`Ip2_FrictMat_FrictMat_FrictPhys`; of others, from :yref:`young<ElastMat.young>`).
  Evaluated when bodies are added or freed and with each tenth update.

and no more than what *motion* allows: in a step no two bodies that may meet before the next update move against each other by more than
:yref:`motionLimit<PolytopeTimeStepper.motionLimit>` times the smaller one's inscribed radius. What has left the others, or moves along with all that
is near, does not count. (In periodic cells, on several processes and where nothing else limits the step it is the way of each body alone.)

A joint that stiffens as it closes (:yref:`RockJointMat.closure`) limits it by *closing*: in a step it becomes no more than 1.23 times as stiff,
whether its bodies touch or will before the next update. (Not of spheres and facets, and in periodic cells and on several processes only where
they touch.)

In a scene in which nothing can move it takes a hundredth of the smallest *virtPeriod* of O.engines (*period*), if there is a
:yref:`PolytopeCollider`: what such an engine puts into the scene gets its own step before it moves.

Bodies that cannot move limit nothing, blocked degrees of freedom do not count, a clump has the contacts of its members. O.dt stays as it is in a
scene where nothing limits it. Not for MPI, where each process has its own bodies only.)""",
		((Real, timestepSafetyCoefficient, 0.4, Attr::triggerPostLoad, "Fraction of $\\tau$ that is taken [-], above 0, at most 2. Up to 1 "
		        "any heap is stable as long as its contacts do not change; the default leaves a margin for those that appear until the next "
		        "update, and lets slopes of jointed rock come to rest. As *fraction* of *polytope.stableTimeStep*."))
		((Real, motionLimit, 0.1, Attr::triggerPostLoad, "Largest way of two bodies that may meet against each other in a step, over the "
		        "smaller one's inscribed radius [-], above 0."))
		((Real, maxDt, std::numeric_limits<Real>::infinity(), Attr::triggerPostLoad, "Largest time step [s], above 0."))
		((Body::id_t, limitingBody, Body::ID_NONE, Attr::readonly, "Body that limits the time step; -1: none."))
		((string, limitedBy, "", Attr::readonly, "What limits the time step: *material*, *contacts*, *rocking* (of contacts, where it "
		        "contributes more than half of that body's $\\omega^2$), *motion*, *closing*, *period* or *maxDt*; empty: nothing limits it, O.dt is "
		        "not changed."))
		((LastTimeStepUpdate, last, , (Attr::readonly | Attr::hidden), "What the last update has found"))
		, /*ctor*/ timeStepUpdateInterval = 50;
		, /*py*/
		.add_property("timeStepUpdateInterval", &PolytopeTimeStepper::getTimeStepUpdateInterval, &PolytopeTimeStepper::setTimeStepUpdateInterval,
		        "Steps from one update of O.dt to the next, at least 1.")
	);
	// clang-format on

private:
	bool isErased(Body::id_t body, const Scene& ofScene) const { return body != Body::ID_NONE && !ofScene.bodies->exists(body); }

	PotentialContacts                   potential_;
	CheckedAttributes<Real, Real, Real> checked_ { std::tie(timestepSafetyCoefficient, motionLimit, maxDt) };
};
REGISTER_SERIALIZABLE(PolytopeTimeStepper);

} // namespace yade
