// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact/Ig2_Polytope_Polytope_PolytopeGeom.hpp"

#include <core/Scene.hpp>

#include <src/contact/Preconditions.hpp>
#include <src/shape/CheckedNumbers.hpp>

#include "host/ExactClass.hpp"

namespace yade {

POLYTOPE_CLASSES((Ig2_Polytope_Polytope_PolytopeGeom));

namespace {

	/// What the attribute's name stands for. `names`: as the message lists them.
	template <class Value>
	Value meaning(const char* attribute, const std::string& name, const std::string& names,
	        std::initializer_list<std::pair<const char*, Value>> all)
	{
		for (const auto& [one, value] : all)
			if (name == one) return value;
		polytope::refuse(std::string(attribute) + ": must be " + names + ", not '" + name + "'");
	}

} // namespace

polytope::ContactOptions Ig2_Polytope_Polytope_PolytopeGeom::checkedOptions() const
{
	using namespace polytope;
	ContactOptions result;
	if (contactModel == "paper")
		polytope::refuse("contactModel: 'paper' is 'boon2012' now, with the normal and the depth that the paper has");
	if (contactModel == "conservative")
		polytope::refuse("contactModel: 'conservative' is 'surface' now, the default, which conserves energy");
	result.contactModel = meaning<ContactModel>("contactModel", contactModel, "'surface', 'foundation', 'spring' or 'boon2012'",
	        { { "surface", ContactModel::Foundation }, { "foundation", ContactModel::Foundation }, { "spring", ContactModel::Spring },
	                { "boon2012", ContactModel::Boon2012 } });
	result.contactPoint = meaning<ContactPoint>("contactPoint", contactPoint, "'analyticCentre', 'chebyshevCentre' or 'centroid'",
	        { { "analyticCentre", ContactPoint::AnalyticCentre }, { "chebyshevCentre", ContactPoint::ChebyshevCentre },
	                { "centroid", ContactPoint::Centroid } });
	result.solver       = meaning<CentreSolver>(
                "solver", solver, "'newton' or 'ipopt'", { { "newton", CentreSolver::Newton }, { "ipopt", CentreSolver::Ipopt } });
	if (hasSurface(result.contactModel)) {
		const auto refuseOther = [&](const std::string& attribute, const std::string& value, const std::string& byDefault) {
			if (value != byDefault)
				polytope::refuse(attribute + ": '" + value
				        + "' is an option of contactModel='boon2012' alone, set that first; '" + contactModel
				        + "' goes with " + attribute + "='" + byDefault + "'");
		};
		refuseOther("contactPoint", contactPoint, "analyticCentre");
		refuseOther("solver", solver, "newton");
	}
	result.tolerance        = tolerance;
	result.newtonTolerance  = newtonTolerance;
	const std::string fault = faultOf(result);
	if (!fault.empty()) polytope::refuse(fault);
	return result;
}

void Ig2_Polytope_Polytope_PolytopeGeom::postLoad(Ig2_Polytope_Polytope_PolytopeGeom&)
{
	checked_.check(std::tie(contactModel, contactPoint, solver, tolerance, newtonTolerance), [&] {
		options_     = checkedOptions();
		byStiffness_ = contactModel == "surface";
	});
}

void Ig2_Polytope_Polytope_PolytopeGeom::pyHandleCustomCtorArgs(boost::python::tuple&, boost::python::dict& named)
{
	if (named.has_key("normal"))
		polytope::refuse(
		        "normal: contactModel chooses it now: 'boon2012' has the paper's averaged normal, each other model the direction "
		        "of its force");
	if (named.has_key("barrier"))
		polytope::refuse(
		        "barrier: there is no contact with a barrier any more; contactModel='surface', the default, conserves energy");
}

const Ig2_Polytope_Polytope_PolytopeGeom* Ig2_Polytope_Polytope_PolytopeGeom::of(const Scene& scene)
{
	return firstFunctor<const Ig2_Polytope_Polytope_PolytopeGeom>(scene, &InteractionLoop::geomDispatcher);
}

const Ig2_Polytope_Polytope_PolytopeGeom& Ig2_Polytope_Polytope_PolytopeGeom::orDefault(const Ig2_Polytope_Polytope_PolytopeGeom* found)
{
	static const Ig2_Polytope_Polytope_PolytopeGeom defaults;
	return found ? *found : defaults;
}

polytope::ContactModel Ig2_Polytope_Polytope_PolytopeGeom::modelFor(StiffnessRule rule) const
{
	return byStiffness_ && rule != StiffnessRule::PerArea ? polytope::ContactModel::Spring : options_.contactModel;
}

polytope::FaceForce Ig2_Polytope_Polytope_PolytopeGeom::faceForce(StiffnessRule rule) const
{
	using polytope::FaceForce;
	const polytope::ContactModel model = modelFor(rule);
	return model == polytope::ContactModel::Spring ? FaceForce::Spring : hasSurface(model) ? FaceForce::Pressure : FaceForce::AtCentre;
}

polytope::ContactOptions Ig2_Polytope_Polytope_PolytopeGeom::options(StiffnessRule rule) const
{
	polytope::ContactOptions options = options_;
	options.contactModel             = modelFor(rule);
	options.warmStart                = warmStart;
	options.timed                    = timing;
	options.energy                   = computeEnergy;
	return options;
}

bool Ig2_Polytope_Polytope_PolytopeGeom::go(const shared_ptr<Shape>& shape1, const shared_ptr<Shape>& shape2, const State& state1,
        const State& state2, const Vector3r& shift2, const bool& force, const shared_ptr<Interaction>& c)
{
	const auto *const polytope1 = asClass<Polytope>(shape1.get()), *const polytope2 = asClass<Polytope>(shape2.get());
	if (!polytope1 || !polytope2) return isOfOthers(*c);
	const auto &convex1 = polytope1->convex(), &convex2 = polytope2->convex();
	if (!convex1 || !convex2) return false; // no planes: nothing to touch
	const Body1Frame frame1 { state1.pos, state1.ori.toRotationMatrix() };
	return query(*convex1, frame1, *convex2, state1, state2, shift2, force, c);
}

} // namespace yade
