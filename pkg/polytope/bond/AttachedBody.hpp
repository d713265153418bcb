// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/BodyContainer.hpp>

#include <boost/weak_ptr.hpp>

namespace yade {

/// Whether the body with an id is still the one to which something was attached, not another one that has got its number. Not saved: what
/// comes from a file takes those of its numbers.
class AttachedBody {
public:
	bool isStill(Body::id_t id, const BodyContainer& bodies) const
	{
		if (!bodies.exists(id)) return false;
		return own_.empty() || (!own_.owner_before(bodies[id]) && !bodies[id].owner_before(own_));
	}
	bool isKnown() const { return !own_.empty(); }
	/// Takes the body of this number, where none is known yet, or anew.
	void adopt(Body::id_t id, const BodyContainer& bodies, bool anew = false)
	{
		if ((anew || own_.empty()) && bodies.exists(id)) own_ = bodies[id];
	}

private:
	boost::weak_ptr<Body> own_;
};

} // namespace yade
