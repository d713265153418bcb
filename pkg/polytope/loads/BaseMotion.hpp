// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "loads/VelocityHistory.hpp"

#include <pkg/common/KinematicEngines.hpp>

namespace yade {

class BaseMotion : public KinematicEngine {
public:
	virtual ~BaseMotion() = default;

	/// Refuses with std::invalid_argument bodies that are not fixed, and numerical damping while the base moves: before any velocity is set.
	void action() override;
	void apply(const vector<Body::id_t>& bodies) override;

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(BaseMotion, KinematicEngine,
	R"""(Moves fixed bodies as one rigid base with a velocity that is given over time, such as that of an earthquake; *polytope.baseMotion(…)*
makes it. In each step they have the velocity of the middle of the step, with which :yref:`NewtonIntegrator` moves them.

:yref:`NewtonIntegrator.damping` acts on absolute velocities, so that it would hold back what the base carries along: as long as the
history goes on it must be 0.)""",
		((shared_ptr<VelocityHistory>, history, , , "Velocity of the base."))
	);
	// clang-format on

private:
	void refuseWhatCannotBe() const;
};
REGISTER_SERIALIZABLE(BaseMotion);

} // namespace yade
