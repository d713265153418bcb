// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "host/FoundInStep.hpp"
#include "host/SpringsOfScene.hpp"

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
class KnowsBonds : public HasSprings, public Counted<KnowsBonds> {
public:
	/// Whether an intact bond joins the bodies: then it acts in place of their contact.
	virtual bool joins(Body::id_t id1, Body::id_t id2) const = 0;
	/// Whether a bond of the bodies has failed; what it leaves.
	virtual bool left(Body::id_t id1, Body::id_t id2, BondRemains& remains) const = 0;
	/// The scene's engine with bonds, null where it has none that acts.
	static const KnowsBonds* of(const Scene& scene)
	{
		for (const auto& engine : scene.engines)
			if (const auto* bonds = dynamic_cast<const KnowsBonds*>(engine.get()); bonds && !engine->dead) return bonds;
		return nullptr;
	}
};

using BondsInStep = FoundInStep<KnowsBonds>;

} // namespace yade
