// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact/PolytopeGeom.hpp"

#include <src/contact/Preconditions.hpp>

/// The attributes of Ig2_Polytope_Polytope_PolytopeGeom that have a range, checked when they are set.
namespace yade {

namespace {

	[[noreturn]] void refuse(const std::string& message) { throw std::invalid_argument(message); }

	/// What the attribute's name stands for. `names`: as the message lists them.
	template <class Value>
	Value meaning(const char* attribute, const std::string& name, const std::string& names,
	        std::initializer_list<std::pair<const char*, Value>> all)
	{
		for (const auto& [one, value] : all)
			if (name == one) return value;
		refuse(std::string(attribute) + ": must be " + names + ", not '" + name + "'");
	}

} // namespace

polytope::ContactSettings Ig2_Polytope_Polytope_PolytopeGeom::checkedSettings() const
{
	using namespace polytope;
	ContactSettings result;
	if (contactModel == "paper") refuse("contactModel: 'paper' is 'boon2012' now, with the normal and the depth that the paper has");
	if (contactModel == "conservative") refuse("contactModel: 'conservative' is 'surface' now, the default, which conserves energy");
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
	if (!fault.empty()) refuse(fault);
	return result;
}

void Ig2_Polytope_Polytope_PolytopeGeom::postLoad(Ig2_Polytope_Polytope_PolytopeGeom&)
{
	checked_.check(std::tie(contactModel, contactPoint, solver, tolerance, newtonTolerance), [&] {
		settings_    = checkedSettings();
		byStiffness_ = contactModel == "surface";
	});
}

} // namespace yade
