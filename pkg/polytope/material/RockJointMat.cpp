// SPDX-License-Identifier: GPL-2.0-or-later
#include "material/RockJointMat.hpp"

#include <core/Scene.hpp>
#include <lib/high-precision/Constants.hpp>

namespace yade {

POLYTOPE_CLASSES((RockJointMat));

namespace {

	/// Puts Boost's own message, which lists C++ types, into words.
	template <class Law> shared_ptr<Law> lawOf(const boost::python::object& given, const char* name, const char* rule)
	{
		const boost::python::extract<shared_ptr<Law>> law(given);
		const auto                                    type
		        = [&] { return std::string(boost::python::extract<std::string>(given.attr("__class__").attr("__name__"))); };
		if (!law.check()) throw std::invalid_argument(std::string(name) + ": must be " + rule + ", got " + type());
		return law();
	}

	shared_ptr<JointClosure> closureOf(const boost::python::object& given)
	{
		return lawOf<JointClosure>(
		        given, "closure", "a normal law, HyperbolicClosure or PowerClosure, or None for a linear spring");
	}

	shared_ptr<JointStrength> strengthOf(const boost::python::object& given)
	{
		return lawOf<JointStrength>(
		        given, "strength", "a shear law, BartonBandisStrength or ContinuouslyYieldingStrength, or None for Mohr-Coulomb");
	}

} // namespace

RockJointMat::Checked::References RockJointMat::checkedOnes()
{
	return std::tie(normalStiffness, shearStiffness, frictionAngle, cohesion, tensileStrength, residualFrictionAngle, dilationAngle,
	        dilationLimit, residualCohesion, residualTensileStrength, reduction, closure, strength);
}

void RockJointMat::postLoad(RockJointMat&)
{
	checked_.check(checkedOnes(), [&] {
		refuseValues();
		refuseForLaws();
		refuseResidualsAbovePeak();
	});
}

void RockJointMat::setClosure(const boost::python::object& given)
{
	closure = closureOf(given);
	postLoad(*this);
}

void RockJointMat::setStrength(const boost::python::object& given)
{
	strength = strengthOf(given);
	postLoad(*this);
}

void RockJointMat::pyHandleCustomCtorArgs(boost::python::tuple&, boost::python::dict& keywords)
{
	if (keywords.has_key("closure")) closureOf(keywords["closure"]);
	if (keywords.has_key("strength")) strengthOf(keywords["strength"]);
}

void RockJointMat::refuseValues() const
{
	const char* const angleRule = "an angle in radians, at least 0 and below pi/2 (use radians(degrees))";
	const char* const pressure  = "at least 0 and finite [Pa]";
	const auto        positive  = [](Real v) { return v > 0 && math::isfinite(v); };
	const auto        bears     = [](Real v) { return v >= 0 && math::isfinite(v); };
	// in wider precisions, too, Python's pi/2 is a double, and below the true one
	const auto angle = [](Real v) { return v >= 0 && v < double(Mathr::HALF_PI); };
	requireValue(positive(density), "density", density, "positive and finite [kg/m3]");
	requireValue(positive(normalStiffness), "normalStiffness", normalStiffness, "positive and finite [Pa/m, or N/m for each contact]");
	requireValue(positive(shearStiffness), "shearStiffness", shearStiffness, "positive and finite [Pa/m, or N/m for each contact]");
	requireValue(angle(frictionAngle), "frictionAngle", frictionAngle, angleRule);
	requireValue(bears(cohesion), "cohesion", cohesion, pressure);
	requireValue(bears(residualCohesion), "residualCohesion", residualCohesion, pressure);
	requireValue(bears(residualTensileStrength), "residualTensileStrength", residualTensileStrength, pressure);
	requireValue(bears(tensileStrength), "tensileStrength", tensileStrength, pressure);
	requireValue(angle(residualFrictionAngle) || residualFrictionAngle == -1, "residualFrictionAngle", residualFrictionAngle,
	        "-1 (the same as frictionAngle) or an angle in radians, at least 0 and below pi/2");
	requireValue(angle(dilationAngle), "dilationAngle", dilationAngle, angleRule);
	requireValue(positive(reduction), "reduction", reduction, "positive and finite (what tan φ of the shear law is divided by)");
	requireValue(dilationLimit >= 0, "dilationLimit", dilationLimit, "at least 0 [m] (infinity: no limit)");
}

void RockJointMat::refuseResidualsAbovePeak() const
{
	requireValue(residualCohesion <= cohesion, "residualCohesion", residualCohesion,
	        "at most the cohesion, and where both become smaller this one first");
	requireValue(residualTensileStrength <= tensileStrength, "residualTensileStrength", residualTensileStrength,
	        "at most the tensileStrength, and where both become smaller this one first");
}

void RockJointMat::refuseForLaws() const
{
	const auto refuse = [](const char* name, const std::string& message) { throw std::invalid_argument(name + (": " + message)); };
	if (closure && tensileStrength > 0)
		refuse("tensileStrength", "a joint with a closure of its own has none, for its spring is linear in tension; leave it at 0");
	if (closure) {
		const std::string fault = closure->fault(normalStiffness);
		if (!fault.empty()) refuse("closure", fault);
	}
	if (!strength) {
		if (reduction != 1) refuse("reduction", "belongs to a shear law; give the material one with strength=…, or leave it at 1");
		return;
	}
	const std::pair<const char*, bool> ofMohrCoulomb[] = { { "cohesion", cohesion != 0 }, { "residualCohesion", residualCohesion != 0 },
		{ "tensileStrength", tensileStrength != 0 }, { "residualTensileStrength", residualTensileStrength != 0 },
		{ "residualFrictionAngle", residualFrictionAngle != -1 }, { "dilationAngle", dilationAngle != 0 },
		{ "dilationLimit", dilationLimit < std::numeric_limits<Real>::infinity() } };
	for (const auto& [name, given] : ofMohrCoulomb)
		if (given)
			refuse(name,
			        "belongs to Mohr-Coulomb; leave it at its default beside strength=" + strength->getClassName() + "(…)");
	const auto* yielding = dynamic_cast<const ContinuouslyYieldingStrength*>(strength.get());
	if (yielding && yielding->initialFrictionAngle < frictionAngle)
		refuse("frictionAngle", "must not be above initialFrictionAngle of the ContinuouslyYieldingStrength");
}

std::optional<polytope::ClosureLaw> closureOfJoint(const RockJointMat& side1, const RockJointMat& side2, Real stiffness)
{
	if (!side1.closure || !side2.closure) return std::nullopt;
	const auto law1 = side1.closure->law(stiffness), law2 = side2.closure->law(stiffness);
	if (!law1.isLike(law2)) return std::nullopt;
	return polytope::ClosureLaw::between(law1, law2);
}

StiffnessRule stiffnessRuleOf(const Material& material1, const Material& material2)
{
	const auto *joint1 = dynamic_cast<const RockJointMat*>(&material1), *joint2 = dynamic_cast<const RockJointMat*>(&material2);
	if (!joint1 || !joint2) return StiffnessRule::Unknown;
	return joint1->stiffnessPerArea && joint2->stiffnessPerArea ? StiffnessRule::PerArea : StiffnessRule::PerContact;
}

} // namespace yade
