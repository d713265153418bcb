// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "bond/BondsOfScene.hpp"
#include "bond/PolytopeBond.hpp"

#include <core/GlobalEngine.hpp>

#include <unordered_map>

namespace yade {

class PolytopeBonds : public GlobalEngine, public KnowsBonds {
public:
	void action() override;
	/// Rebuilds the tables from `bonds`.
	void postLoad(PolytopeBonds&);

	/// Bonds the faces of these bodies (all, if none are given) that face each other; returns how many bonds were made. Refuses values out of
	/// range with std::invalid_argument naming them. `gap` below 0: as far as faces count as touching.
	long make(const std::vector<int>& ids, const Real& gap, const Real& angle, const PolytopeBond& pattern);
	/// The bonds that make() would make, without making them: nothing of the scene is changed.
	boost::python::list find(const std::vector<int>& ids, const Real& gap, const Real& angle, const PolytopeBond& pattern) const;
	/// A bond of this engine, failed or not, goes on between parts of its two bodies (bond/BondOfParts.hpp); returns whether the parts have one.
	bool continueBetween(const PolytopeBond& whole, const Body& whole1, const Body& whole2, const Body& part1, const Body& part2);
	long intactCount() const;
	/// Number of intact bonds whose bodies are those of the present scene. The engine may be no longer in O.engines, or of another scene.
	long intactInScene() const;

	boost::python::list bondList() const;

	/// Several processes (py/polytope/mpi): states of the bonds of which this rank decides, and those of another rank, taken over.
	boost::python::list states() const;
	void                takeStates(const boost::python::list& states);
	bool                divided = false; ///< whether the scene is divided: then bonds act of which a body is this rank's
	long                missing = 0;     ///< times that the other body of an intact bond was not here, so that it did not act
	/// The bodies that have the bonds' numbers now are theirs: yade.mpy replaces bodies by copies.
	void adoptBodies();
	/// Bonds that were loaded take the bodies of the present scene that have their ids.
	void meetBodies();

	bool        joins(Body::id_t id1, Body::id_t id2) const override;
	bool        left(Body::id_t id1, Body::id_t id2, BondRemains& remains) const override;
	bool        holds(Body::id_t id) const override;
	void        forSpringsOf(const Body& body, const std::function<void(const SpringsAtPoint&)>& visit) const override;
	std::size_t made() const override { return bonds.size(); }

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(PolytopeBonds, GlobalEngine,
	R"""(Forces and moments of all bonds between :yref:`Polytopes<Polytope>`, after the :yref:`InteractionLoop` and before
:yref:`NewtonIntegrator` (*polytope.bond(…)* puts it there and makes the bonds; docs/bonds.md). While a bond is intact it acts in place of the contact
of its two bodies; when it has failed their ordinary contact goes on. Force and moment follow from where the two bodies are and have an energy; both
momenta are kept to rounding. Bonds fail where $\sigma+\beta\sigma_b>\sigma_t$ with the mean normal stress $\sigma$ (tension positive) and the largest
one by bending $\sigma_b$, or $\tau+\beta\tau_t>c-\sigma\tan\phi$ with the mean shear stress and the largest one by twisting.

With O.trackEnergy: *elastPotential* (stored) and *fractureDissip* (what a failed bond had stored, less what the joint that follows it stores). One
engine of this kind a scene.)""",
		((vector<shared_ptr<PolytopeBond>>, bonds, , (Attr::hidden | Attr::triggerPostLoad), "All bonds, failed ones too"))
		((bool, unbreakable, false, Attr::noSave, "No bond fails: for coming to rest under loads that begin at once, see *polytope.settle*. "
		        "Not saved."))
		, /*ctor*/
		, /*py*/
		.def_readwrite("_divided", &PolytopeBonds::divided)
		.def_readwrite("_missing", &PolytopeBonds::missing)
		.def("_states", &PolytopeBonds::states)
		.def("_takeStates", &PolytopeBonds::takeStates)
		.def("_adoptBodies", &PolytopeBonds::adoptBodies)
		.def("_meetBodies", &PolytopeBonds::meetBodies)
		.def("_continueBetween", &PolytopeBonds::continueBetween)
		.add_property("bonds", &PolytopeBonds::bondList, "All bonds (:yref:`PolytopeBond`), failed ones too, in the order in which they "
		        "were made.")
		.add_property("intactCount", &PolytopeBonds::intactCount, "Number of bonds that are intact.")
		.add_property("intactInScene", &PolytopeBonds::intactInScene, "Number of intact bonds whose bodies are in the present scene, "
		        "whether or not this engine is in O.engines.")
		.def("make", &PolytopeBonds::make,
		        (boost::python::arg("ids"), boost::python::arg("gap"), boost::python::arg("angle"), boost::python::arg("pattern")),
		        "Make bonds between faces of these bodies (empty: all), with the values of a *PolytopeBond*; see *polytope.bond*, which "
		        "calls it.")
		.def("find", &PolytopeBonds::find,
		        (boost::python::arg("ids"), boost::python::arg("gap"), boost::python::arg("angle"), boost::python::arg("pattern")),
		        "The bonds that *make* would make, as a list, without making them: the faces that bodies have in common.")
	);
	// clang-format on

private:
	using Key = std::uint64_t;
	std::vector<shared_ptr<PolytopeBond>> found(
	        const std::vector<int>& ids, const Real& gap, const Real& angle, const PolytopeBond& pattern, const Scene& where) const;
	static Key key(Body::id_t id1, Body::id_t id2);

	bool isOurs(const PolytopeBond& bond) const;
	bool isAbsent(const PolytopeBond& bond) const;
	void act(PolytopeBond& bond) const;
	void settle();
	void end(int index, long step);
	void endErased(const Scene& where);
	void bookFailed();
	void enter(int index);
	void rebuild();

	int                           elasticId_ = -1, fractureId_ = -1;
	std::vector<int>              failed_;      ///< in the last step
	std::unordered_map<Key, int>  intactPairs_; ///< number of intact bonds
	std::unordered_map<Key, int>  failedPairs_; ///< the last bond that failed
	std::vector<std::vector<int>> ofBody_;
};
REGISTER_SERIALIZABLE(PolytopeBonds);

} // namespace yade
