// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "bond/BondsOfScene.hpp"
#include "contact/ContactCounters.hpp"
#include "contact/PolytopeGeom.hpp"
#include "host/ChangeOfBodies.hpp"
#include "host/FoundInStep.hpp"
#include "material/StiffnessRules.hpp"
#include "pairs/CandidateMemory.hpp"
#include "shape/Polytope.hpp"

#include <core/Dispatching.hpp>

#include <array>

namespace yade {

/// Weight of body 1's normal against body 2's, from the stiffnesses of their materials: 0.5 for equal ones.
Real normalWeightOfFirst(const Body* body1, const Body* body2);

class Ig2_Polytope_Polytope_PolytopeGeom;

/// What makes the geometry of contacts with a Polytope. Its settings are those of the scene's one Ig2_Polytope_Polytope_PolytopeGeom.
class PolytopeGeomFunctor : public IGeomFunctor {
public:
	/// The scene's settings for a contact whose stiffness has this unit.
	polytope::ContactSettings settings(StiffnessRule rule) const { return polytope::ContactSettings(options(rule)); }
	boost::python::dict       stats() const;
	void                      resetStats();

	/// Exchanges the bodies: go() has them in the order of the functor's classes.
	bool goReverse(const shared_ptr<Shape>& shape1, const shared_ptr<Shape>& shape2, const State& state1, const State& state2,
	        const Vector3r& shift2, const bool& force, const shared_ptr<Interaction>& c) override;

	/// Refuses settings, which other functors than that of two polytopes do not have.
	void pyHandleCustomCtorArgs(boost::python::tuple& arguments, boost::python::dict& named) override;
	/// Names of the settings.
	static constexpr std::array<const char*, 9>    names { { "contactModel", "contactPoint", "solver", "warmStart", "tolerance",
		   "newtonTolerance", "computeArea", "computeEnergy", "timing" } };
	template <std::size_t k> boost::python::object setting() const { return settingOfScene(names[k]); }
	template <std::size_t k> void                  set(const boost::python::object&) { refuse(names[k]); }

	// clang-format off
#define POLYTOPE_SETTING(k) .add_property(names[k], &PolytopeGeomFunctor::setting<k>, &PolytopeGeomFunctor::set<k>, \
		"That of the scene's :yref:`Ig2_Polytope_Polytope_PolytopeGeom`, where it is set for all contacts.")
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(PolytopeGeomFunctor, IGeomFunctor,
	"What the functors have in common that create or update a :yref:`PolytopeGeom`. Their settings are those of the scene's "
	        ":yref:`Ig2_Polytope_Polytope_PolytopeGeom`, or the defaults where it has none: to be read here, and set there.",
		, /*ctor*/
		, /*py*/
		POLYTOPE_SETTING(0) POLYTOPE_SETTING(1) POLYTOPE_SETTING(2) POLYTOPE_SETTING(3) POLYTOPE_SETTING(4) POLYTOPE_SETTING(5)
		POLYTOPE_SETTING(6) POLYTOPE_SETTING(7) POLYTOPE_SETTING(8)
		.def("stats", &PolytopeGeomFunctor::stats, "Counters since the last *resetStats()*, as a dictionary: *pairs* queried, *contacts*, "
		        "*dismissed* (separated at once by the last basis), *simplexPivots*, *newtonIterations*, *surfacesKept* (contacts "
		        "*foundation* and *spring* whose feasible set has the vertices of the step before), *linear* (those of them taken from the last "
		        "full computation, to first order in the bodies' motion: docs/contact-surface.md), *ipoptSolves* and *ipoptIterations* "
		        "(calls of Ipopt), *rescued* (contacts for which Newton did not converge and Ipopt found the point), *failures* (queries "
		        "without an answer: not one of *contact*, *separated*, *normalFromOneBody*, *normalFromDual*, *roundingLimited*, "
		        "*centreByIpopt*), *fallbacks* (those of them that go on with a substitute: the linear program's point, or for coincident "
		        "bodies an arbitrary direction), *statuses* (count by name of *PolytopeGeom.status*), and with *timing* *timedPairs*, "
		        "*lpSeconds*, *centreSeconds*.")
		.def("resetStats", &PolytopeGeomFunctor::resetStats, "Set all counters to zero.")
	);
#undef POLYTOPE_SETTING
	// clang-format on

protected:
	/// Where body 1's half-spaces stand: its own frame, except for a wall, which is everywhere and not turned.
	struct Body1Frame {
		Vector3r origin;
		Matrix3r rotation;
	};

	// Steps of go().

	/// What the scene's settings choose for a contact whose stiffness has this unit.
	polytope::ContactOptions options(StiffnessRule rule) const;

	/// What is asked about this contact.
	polytope::ContactSettings settings(
	        const polytope::ContactOptions& options, const PolytopeGeom& geom, bool wasReal, bool force) const;

	/// The pair's geometry, made where it has none.
	PolytopeGeom& geometry(const shared_ptr<Interaction>& c);

	/// Two sets of half-spaces: core query, then apply().
	bool query(const polytope::ConvexShape& convex1, const Body1Frame& frame1, const polytope::ConvexShape& convex2,
	        const State& state1, const State& state2, const Vector3r& shift2, const bool& force, const shared_ptr<Interaction>& c);

	/// Whether a pair without a geometry has no need of one. Else the query that makes it starts without memory: what a new contact is
	/// does not depend on what the pair remembers, so it is the same in a scene that was saved and loaded before.
	bool isApart(const polytope::PlacedPair& pair, polytope::ContactWorkspace& workspace, const Interaction& c);

	/// Counts the result and, for a contact, writes it into ScGeom. `origin1`: what result.point is relative to. A failure is a result whose
	/// normal is no unit vector (tolerance::orthogonal), whose point, depth, area, energy or turning arm is not finite or whose area is
	/// negative, and a contact without a geometry.
	bool apply(const polytope::ContactResult& result, const Vector3r& origin1, const State& state1, const State& state2,
	        const Vector3r& shift2, const bool& force, const shared_ptr<Interaction>& c);

	/// The scene's; the defaults where it has no functor of two polytopes.
	const Ig2_Polytope_Polytope_PolytopeGeom& ofScene() const;

	/// Counts a pair that has no answer (a shape that is no solid, a polygon against a polyhedron): its status is *failed*, stats() has it
	/// among *failures*, and a contact keeps its last geometry.
	bool failed(const shared_ptr<Interaction>& c);

	/// Of shapes of other classes than this functor's: a script has exchanged one while YADE kept the functor with the contact. It is made anew, with the
	/// right one. Returns false, as go() does then.
	static bool isOfOthers(Interaction& contact);

	ContactCounters& counters();
	void             count(const polytope::ContactResult& result);

private:
	/// apply() of a result that is sound.
	bool write(const polytope::ContactResult& result, const Vector3r& origin1, const State& state1, const State& state2,
	        const Vector3r& shift2, const bool& force, const shared_ptr<Interaction>& c);

	boost::python::object settingOfScene(const char* name) const;
	/// Says where that setting is set.
	[[noreturn]] void refuse(const std::string& name) const;

	mutable FoundInStep<Ig2_Polytope_Polytope_PolytopeGeom> settings_;
	BondsInStep                                             bonds_;
	ChangeOfBodies                                          changeOfBodies_;
	CandidateMemory                                         candidates_;
	std::vector<ContactCounters>                            counters_ = std::vector<ContactCounters>(omp_get_max_threads());
};
REGISTER_SERIALIZABLE(PolytopeGeomFunctor);

} // namespace yade
