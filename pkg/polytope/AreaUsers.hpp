// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/InteractionLoop.hpp>
#include <core/Scene.hpp>

#include <atomic>

/// What the scene's loops do with the area of a contact. The geometry functor finds it: a law writes nothing into a geometry, and a new
/// contact has no physics yet that could say so.
namespace yade {

/// A law that reads the area of every contact, whatever its physics.
class UsesContactArea {
public:
	virtual ~UsesContactArea() = default;
	/// At present: an attribute of the law may decide it.
	virtual bool usesContactArea() const = 0;
};

/// What a contact's stiffness is multiplied with, as far as its geometry depends on that.
enum class StiffnessRule : int {
	Unknown = 0, ///< YADE's own physics: the depth is the chord
	PerArea,     ///< area × depth
	PerContact,  ///< depth, shared by pieces of one support
};

/// A functor that makes the physics of joints.
class GivesJointStiffness {
public:
	virtual ~GivesJointStiffness() = default;
	/// At present; Unknown for materials that it is not for.
	virtual StiffnessRule stiffnessRule(const Material& material1, const Material& material2) const = 0;
};

/// Of a contact of two materials whose physics are made now.
inline StiffnessRule stiffnessRuleOfNew(const Scene& scene, const Material& material1, const Material& material2)
{
	for (const auto& engine : scene.engines)
		if (const auto* loop = dynamic_cast<const InteractionLoop*>(engine.get()))
			for (const auto& functor : loop->physDispatcher->functors) {
				const auto*         giver = dynamic_cast<const GivesJointStiffness*>(functor.get());
				const StiffnessRule rule  = giver ? giver->stiffnessRule(material1, material2) : StiffnessRule::Unknown;
				if (rule != StiffnessRule::Unknown) return rule;
			}
	return StiffnessRule::Unknown;
}

/// Whether a loop of the scene has a law that reads the area of every contact. The loops are read once a step, by whichever thread
/// comes first.
class AreaUsers {
public:
	bool in(const Scene& scene)
	{
		if (step_.load(std::memory_order_acquire) != scene.iter) {
			found_.store(lookIn(scene), std::memory_order_relaxed);
			step_.store(scene.iter, std::memory_order_release);
		}
		return found_.load(std::memory_order_relaxed);
	}

private:
	static bool lookIn(const Scene& scene)
	{
		for (const auto& engine : scene.engines)
			if (const auto* loop = dynamic_cast<const InteractionLoop*>(engine.get()))
				for (const auto& functor : loop->lawDispatcher->functors)
					if (const auto* law = dynamic_cast<const UsesContactArea*>(functor.get())) {
						if (law->usesContactArea()) return true;
					}
		return false;
	}

	std::atomic<long> step_ { -1 };
	std::atomic<bool> found_ { false };
};

} // namespace yade
