// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/InteractionLoop.hpp>
#include <core/Scene.hpp>

#include <atomic>

/// Laws that read the area of every contact, whatever its physics. The geometry functor finds them; a law writes nothing into a geometry.
namespace yade {

class UsesContactArea {
public:
	virtual ~UsesContactArea() = default;
	/// At present: an attribute of the law may decide it.
	virtual bool usesContactArea() const = 0;
};

/// Whether a loop of the scene has such a law. The loops are read once a step, by whichever thread comes first.
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
