// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact/ContactOptions.hpp"

#include <core/InteractionLoop.hpp>
#include <core/Scene.hpp>

#include <src/contact/Preconditions.hpp>

/// The settings of all contacts of a scene: attributes of its Ig2_Polytope_Polytope_PolytopeGeom, checked when they are set.
namespace yade {

namespace {

	[[noreturn]] void refuseOption(const std::string& message) { throw std::invalid_argument(message); }

	/// What the attribute's name stands for. `names`: as the message lists them.
	template <class Value>
	Value meaning(const char* attribute, const std::string& name, const std::string& names,
	        std::initializer_list<std::pair<const char*, Value>> all)
	{
		for (const auto& [one, value] : all)
			if (name == one) return value;
		refuseOption(std::string(attribute) + ": must be " + names + ", not '" + name + "'");
	}

} // namespace

polytope::ContactOptions Ig2_Polytope_Polytope_PolytopeGeom::checkedOptions() const
{
	using namespace polytope;
	ContactOptions result;
	if (contactModel == "paper")
		refuseOption("contactModel: 'paper' is 'boon2012' now, with the normal and the depth that the paper has");
	if (contactModel == "conservative")
		refuseOption("contactModel: 'conservative' is 'surface' now, the default, which conserves energy");
	result.contactModel = meaning<ContactModel>("contactModel", contactModel, "'surface', 'foundation', 'spring' or 'boon2012'",
	        { { "surface", ContactModel::Foundation }, { "foundation", ContactModel::Foundation }, { "spring", ContactModel::Spring },
	                { "boon2012", ContactModel::Boon2012 } });
	result.contactPoint = meaning<ContactPoint>("contactPoint", contactPoint, "'analyticCentre', 'chebyshevCentre' or 'centroid'",
	        { { "analyticCentre", ContactPoint::AnalyticCentre }, { "chebyshevCentre", ContactPoint::ChebyshevCentre },
	                { "centroid", ContactPoint::Centroid } });
	result.solver       = meaning<CentreSolver>(
                "solver", solver, "'newton' or 'ipopt'", { { "newton", CentreSolver::Newton }, { "ipopt", CentreSolver::Ipopt } });
	result.tolerance        = tolerance;
	result.newtonTolerance  = newtonTolerance;
	const std::string fault = faultOf(result);
	if (!fault.empty()) refuseOption(fault);
	return result;
}

void Ig2_Polytope_Polytope_PolytopeGeom::postLoad(Ig2_Polytope_Polytope_PolytopeGeom&)
{
	checked_.check(std::tie(contactModel, contactPoint, solver, tolerance, newtonTolerance), [&] {
		options_     = checkedOptions();
		byStiffness_ = contactModel == "surface";
	});
}

const Ig2_Polytope_Polytope_PolytopeGeom* Ig2_Polytope_Polytope_PolytopeGeom::of(const Scene& scene)
{
	for (const auto& engine : scene.engines)
		if (const auto* loop = dynamic_cast<const InteractionLoop*>(engine.get()))
			for (const auto& functor : loop->geomDispatcher->functors)
				if (const auto* found = dynamic_cast<const Ig2_Polytope_Polytope_PolytopeGeom*>(functor.get()))
					return found;
	return nullptr;
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

const Ig2_Polytope_Polytope_PolytopeGeom& PolytopeGeomFunctor::ofScene() const
{
	return Ig2_Polytope_Polytope_PolytopeGeom::orDefault(settings_.in(*scene));
}

polytope::ContactSettings PolytopeGeomFunctor::settings(StiffnessRule rule) const
{
	polytope::ContactSettings settings(ofScene().options(rule));
	settings.energy = settings.energy || scene->trackEnergy;
	return settings;
}

void PolytopeGeomFunctor::refuse(const std::string& name) const
{
	refuseOption(name + ": " + getClassName()
	        + " has no settings of its own; set it in the scene's Ig2_Polytope_Polytope_PolytopeGeom, for all contacts");
}

void PolytopeGeomFunctor::pyHandleCustomCtorArgs(boost::python::tuple&, boost::python::dict& named)
{
	for (const char* name : names)
		if (named.has_key(name)) refuse(name);
}

boost::python::object PolytopeGeomFunctor::settingOfScene(const char* name) const
{
	const auto& settings = Ig2_Polytope_Polytope_PolytopeGeom::orDefault(*Omega::instance().getScene());
	return boost::python::object(boost::python::ptr(&settings)).attr(name);
}

} // namespace yade
