// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "bolt/PolytopeBolt.hpp"

#include <core/GlobalEngine.hpp>

namespace yade {

class PolytopeBolts : public GlobalEngine, public HasSprings {
public:
	void action() override;
	/// Prepares bolts that were loaded.
	void postLoad(PolytopeBolts&);

	/// Makes a bolt with the values of the pattern through the blocks that its line meets; returns its number. Refuses what is out of range with
	/// std::invalid_argument naming it, and changes nothing then.
	long                make(const PolytopeBolt& pattern);
	boost::python::list boltList() const;
	long                actingCount() const;
	/// Number of acting bolts whose bodies are those of the present scene. The engine may be no longer in O.engines, or of another scene.
	long actingInScene() const;
	/// Bolts that were loaded take the bodies of the present scene that have their ids.
	void meetBodies();

	bool        holds(Body::id_t id) const override;
	void        forSpringsOf(const Body& body, const std::function<void(const SpringsAtPoint&)>& visit) const override;
	std::size_t made() const override { return bolts.size(); }

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(PolytopeBolts, GlobalEngine,
	R"""(Forces of all rock bolts and cables on the :yref:`Polytopes<Polytope>` that hold them, after the :yref:`InteractionLoop` and before
:yref:`NewtonIntegrator` (*polytope.bolt(…)* puts it there and makes the bolts; docs/support.md). A bolt has no mass: slip and tension along it are
those of equilibrium for where the blocks are. Forces on blocks come in opposite pairs, so that both momenta are kept to rounding.

With O.trackEnergy: *elastPotential* (stored), *plastDissip* (yield of steel, slip of grout, yield of dowels) and *fractureDissip* (where steel
broke). One engine of this kind a scene.)""",
		((vector<shared_ptr<PolytopeBolt>>, bolts, , (Attr::hidden | Attr::triggerPostLoad), "All bolts"))
		((bool, unbreakable, false, Attr::noSave, "Steel does not yield or break, grout does not slip: for coming to rest under loads that "
		        "begin at once, see *polytope.settle*. Not saved."))
		((long, dropped, 0, Attr::readonly, "Crossings of bolts from block to block that ended because a block was erased."))
		((long, unsolved, 0, Attr::readonly, "Times that no equilibrium along a bolt was found to the last digits; the blocks' forces are "
		        "opposite pairs even so."))
		, /*ctor*/
		, /*py*/
		.add_property("bolts", &PolytopeBolts::boltList, "All bolts (:yref:`PolytopeBolt`), in the order in which they were made.")
		.add_property("actingCount", &PolytopeBolts::actingCount, "Number of bolts that still hold blocks together.")
		.add_property("actingInScene", &PolytopeBolts::actingInScene, "Number of bolts that still hold blocks of the present scene "
		        "together, whether or not this engine is in O.engines.")
		.def("_meetBodies", &PolytopeBolts::meetBodies)
		.def("make", &PolytopeBolts::make, (boost::python::arg("pattern")), "Make a bolt with the values of a *PolytopeBolt*; see "
		        "*polytope.bolt*, which calls it.")
	);
	// clang-format on

private:
	void settle();
	void enter(int index);

	int                           elasticId_ = -1, plasticId_ = -1, fractureId_ = -1;
	std::vector<std::vector<int>> ofBody_; ///< numbers of the bolts that hold each body
};
REGISTER_SERIALIZABLE(PolytopeBolts);

} // namespace yade
