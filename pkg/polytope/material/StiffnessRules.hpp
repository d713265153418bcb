// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "host/InteractionLoops.hpp"

#include <optional>

/// What a contact's stiffness is multiplied with. The geometry functor asks for it: a new contact has no physics yet that could say so.
namespace yade {

/// What a contact's stiffness is multiplied with, as far as its geometry depends on that.
enum class StiffnessRule : int {
	Unknown = 0, ///< YADE's own physics: as per contact
	PerArea,     ///< area × depth
	PerContact,  ///< depth, shared by pieces of one support
};

/// Stiffnesses of a contact [N/m].
struct ContactStiffness {
	Real normal = 0, shear = 0;
};

/// A functor that makes the physics of joints.
class GivesJointStiffness {
public:
	virtual ~GivesJointStiffness() = default;
	/// The largest stiffnesses that a contact of these materials can have: of this area [m²], between bodies of these sizes [m]
	/// (PolytopeGeom's refR1, refR2). PolytopeTimeStepper takes its step before the first contact from them. None: they are not known; then it
	/// takes elastic bodies of the materials' young, and polytope.check() says so of functors that are not the plug-in's own or YADE's.
	virtual std::optional<ContactStiffness> stiffnesses(
	        const Material& /*material1*/, const Material& /*material2*/, Real /*area*/, Real /*size1*/, Real /*size2*/) const
	{
		return std::nullopt;
	}
	/// The rule at present; Unknown for materials that the functor is not for.
	virtual StiffnessRule stiffnessRule(const Material& material1, const Material& material2) const = 0;
};

/// The rule for the stiffness of a contact of two materials whose physics are made now.
inline StiffnessRule stiffnessRuleOfNew(const Scene& scene, const Material& material1, const Material& material2)
{
	const auto found = findInFunctors<const GivesJointStiffness>(
	        scene, &InteractionLoop::physDispatcher, [&](const GivesJointStiffness& giver) -> std::optional<StiffnessRule> {
		        const StiffnessRule rule = giver.stiffnessRule(material1, material2);
		        return rule != StiffnessRule::Unknown ? std::make_optional(rule) : std::nullopt;
	        });
	return found.value_or(StiffnessRule::Unknown);
}

} // namespace yade
