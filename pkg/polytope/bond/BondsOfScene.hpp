// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "host/SpringsOfScene.hpp"

#include <atomic>

/// What contacts have to know about bonds between bodies (PolytopeBonds), without the engine itself.
namespace yade {

/// What a bond that has failed leaves to the ordinary joint of the two bodies.
struct BondRemains {
	Real     overlap    = 0;                ///< of the faces when the bond was made, where it was without force [m]
	bool     inLastStep = false;            ///< whether the bond acted in the last step; then also, as it was there:
	Vector3r force      = Vector3r::Zero(); ///< on the second body [N]
	Vector3r point      = Vector3r::Zero(); ///< where it acted, in the period of the first body [m]
	Real     energy     = 0;                ///< stored in it [J]
};

/// An engine with bonds.
class KnowsBonds : public HasSprings {
public:
	KnowsBonds() { ++changes(); }
	~KnowsBonds() override { ++changes(); }
	KnowsBonds(const KnowsBonds&)            = delete;
	KnowsBonds& operator=(const KnowsBonds&) = delete;
	/// Such engines made and destroyed so far, in all scenes.
	static std::atomic<long>& changes()
	{
		static std::atomic<long> count { 0 };
		return count;
	}
	/// Whether an intact bond joins the bodies: then it acts in place of their contact.
	virtual bool joins(Body::id_t id1, Body::id_t id2) const = 0;
	/// Whether a bond of the bodies has failed; what it leaves.
	virtual bool left(Body::id_t id1, Body::id_t id2, BondRemains& remains) const = 0;
};

/// The scene's engine with bonds, null where it has none that acts.
inline const KnowsBonds* bondsOf(const Scene& scene)
{
	for (const auto& engine : scene.engines)
		if (const auto* bonds = dynamic_cast<const KnowsBonds*>(engine.get()); bonds && !engine->dead) return bonds;
	return nullptr;
}

/// The engine that knows bonds, looked for once a step by whichever thread comes first, and anew when such an engine was made or destroyed: what it returns is never
/// one that is gone.
class BondsInStep {
public:
	const KnowsBonds* in(const Scene& scene)
	{
		const long changes = KnowsBonds::changes().load(std::memory_order_relaxed);
		if (changes == 0) return nullptr; // nobody uses bonds
		if (step_.load(std::memory_order_acquire) != scene.iter || changes_.load(std::memory_order_relaxed) != changes) {
			found_.store(bondsOf(scene), std::memory_order_relaxed);
			changes_.store(changes, std::memory_order_relaxed);
			step_.store(scene.iter, std::memory_order_release);
		}
		return found_.load(std::memory_order_relaxed);
	}

private:
	std::atomic<long>              step_ { -1 }, changes_ { 0 };
	std::atomic<const KnowsBonds*> found_ { nullptr };
};

} // namespace yade
