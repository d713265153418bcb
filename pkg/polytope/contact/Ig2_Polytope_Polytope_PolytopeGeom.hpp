// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "contact/PolytopeGeomFunctor.hpp"
#include "host/CheckedAttributes.hpp"

namespace yade {

/// The functor of two polytopes, whose attributes are the settings of all contacts of its scene.
class Ig2_Polytope_Polytope_PolytopeGeom : public PolytopeGeomFunctor, public Counted<Ig2_Polytope_Polytope_PolytopeGeom> {
public:
	bool go(const shared_ptr<Shape>& shape1, const shared_ptr<Shape>& shape2, const State& state1, const State& state2,
	        const Vector3r& shift2, const bool& force, const shared_ptr<Interaction>& c) override;
	bool goReverse(const shared_ptr<Shape>& shape1, const shared_ptr<Shape>& shape2, const State& state1, const State& state2,
	        const Vector3r& shift2, const bool& force, const shared_ptr<Interaction>& c) override
	{
		return go(shape1, shape2, state1, state2, shift2, force, c); // symmetric: the dispatcher never reverses it
	}

	/// Refuses unknown names and settings out of range, naming the attribute, and restores the last good value.
	void postLoad(Ig2_Polytope_Polytope_PolytopeGeom&);
	/// Refuses settings that were, naming what has taken their place.
	void pyHandleCustomCtorArgs(boost::python::tuple&, boost::python::dict& named) override;

	/// The first of the scene, null where it has none.
	static const Ig2_Polytope_Polytope_PolytopeGeom* of(const Scene& scene);
	static const Ig2_Polytope_Polytope_PolytopeGeom& orDefault(const Ig2_Polytope_Polytope_PolytopeGeom* found);
	static const Ig2_Polytope_Polytope_PolytopeGeom& orDefault(const Scene& scene) { return orDefault(of(scene)); }

	/// The options for a contact whose stiffness has this unit.
	polytope::ContactOptions options(StiffnessRule rule) const;
	/// What the normal force of a contact depends on, whose stiffness has this unit.
	polytope::FaceForce faceForce(StiffnessRule rule) const;

	FUNCTOR2D(Polytope, Polytope);
	DEFINE_FUNCTOR_ORDER_2D(Polytope, Polytope);

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(Ig2_Polytope_Polytope_PolytopeGeom, PolytopeGeomFunctor,
	R"""(Creates or updates a :yref:`PolytopeGeom` for two :yref:`Polytopes<Polytope>` [Boon2012]_. Its attributes are the settings of all
contacts of the scene: functors of other pairs have none of their own. Nothing is thrown or printed in the loop: outcomes are in
:yref:`PolytopeGeom.status` and counted in *stats()*.)""",
		((string, contactModel, "surface", Attr::triggerPostLoad, "*surface*: *foundation* for contacts with a stiffness per area [Pa/m], "
		        "*spring* for those with a stiffness per contact [N/m], YADE's own physics among them. *foundation*, *spring*: one of them "
		        "for all contacts: point, normal, depth and area of a force that is the gradient of an energy, the volume of the linear "
		        "program's feasible set (docs/contact-surface.md). *boon2012*: the paper as printed [Boon2012]_, stiffness times the chord "
		        "through the contact point along the average of the gradients of both bodies' inner potential particles with their "
		        ":yref:`cornerRadius<Polytope.cornerRadius>` (Eqs 13-17), shear at this point; no gradient of an energy, inclined by up to "
		        "45° where an edge lies on a face and at every seam of a floor: to reproduce the paper."))
		((string, contactPoint, "analyticCentre", Attr::triggerPostLoad, "*boon2012*, contact point: *analyticCentre* (of all half-spaces "
		        "of both bodies, Eq. 10 of [Boon2012]_), *chebyshevCentre* (the linear program's own point, of lowest cost; jumps where it "
		        "is not unique) or *centroid* (of the overlap, of highest cost)."))
		((string, solver, "newton", Attr::triggerPostLoad, "*boon2012*, solver of the analytic centre: *newton* (where it does not "
		        "converge, Ipopt is used if the build has it, see *polytope.buildInfo()['ipopt']*) or *ipopt* (section 2.6 of [Boon2012]_, "
		        "for every contact: a hundred to a thousand times slower, independent of the other; takes no warm start and ignores "
		        ":yref:`newtonTolerance<Ig2_Polytope_Polytope_PolytopeGeom.newtonTolerance>`). A ValueError where the build has no Ipopt."))
		((bool, warmStart, true, , "Start each pair from its last step's basis and contact point, and take contacts whose bodies hardly move from "
		        "their last full computation, to first order (docs/contact-surface.md): forces differ by some 1e-5 from those of "
		        "*False*."))
		((Real, tolerance, polytope::tolerance::contact, Attr::triggerPostLoad, "Contact when $s^*<-$ *tolerance* times the smaller body's "
		        "circumradius [-]."))
		((Real, newtonTolerance, polytope::tolerance::newton, Attr::triggerPostLoad, "*boon2012*: the analytic centre is accepted when what "
		        "remains is below this fraction of the overlap's own size (Dikin norm) [-]; from the rounding of the numbers (2.2e-16 in "
		        "double) to 0.1."))
		((bool, computeArea, false, , "*boon2012*: compute :yref:`PolytopeGeom.contactArea` for every contact (for laws that need it this "
		        "is done automatically; the other models always have it)."))
		((bool, computeEnergy, false, , "*foundation*: compute :yref:`PolytopeGeom.energyPerStiffness` in each step, which takes "
		        "about a tenth more time, in the plane more than half; O.trackEnergy and *polytope.mechanicalEnergy* do so by themselves."))
		((bool, timing, false, , "Measure the time of the linear program and of the analytic centre (see *stats()*); costs two readings of "
		        "the clock a pair."))
	);
	// clang-format on

private:
	/// Options from the attributes. Refuses unknown names and numbers out of range with std::invalid_argument naming the attribute.
	polytope::ContactOptions checkedOptions() const;
	/// The contact model for a contact whose stiffness has this unit.
	polytope::ContactModel modelFor(StiffnessRule rule) const;

	polytope::ContactOptions options_     = checkedOptions();
	bool                     byStiffness_ = true; ///< *surface*: *foundation* or *spring*, by the unit of the contact's stiffness
	CheckedAttributes<std::string, std::string, std::string, Real, Real> checked_ { std::tie(
		contactModel, contactPoint, solver, tolerance, newtonTolerance) };
};
REGISTER_SERIALIZABLE(Ig2_Polytope_Polytope_PolytopeGeom);

} // namespace yade
