// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

namespace yade {

class Scene;

/// An engine that finds the time step (PolytopeTimeStepper), as the collider sees it: it calls the engine before bodies move that the
/// engine has not seen.
class FindsTimeStep {
public:
	virtual ~FindsTimeStep() = default;
	/// Whether bodies were added since it has run, so that they would move with a step that was not made for them. `freed`: that some have
	/// been freed, as is known to who asks.
	virtual bool knowsNotAll(const Scene& ofScene, bool freed) const = 0;
};

} // namespace yade
