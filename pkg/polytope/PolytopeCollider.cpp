// SPDX-License-Identifier: GPL-2.0-or-later
#include "PolytopeCollider.hpp"

#include <core/Dispatching.hpp>
#include <core/Scene.hpp>

#include <src/numbers/Tolerances.hpp>

#include <limits>

namespace yade {

YADE_PLUGIN((PolytopeCollider));

const Body* PolytopeCollider::bodyOf(std::size_t id) const
{
	const Body::id_t known = Body::id_t(id); // bodies may have been erased since
	return scene->bodies->exists(known) ? (*scene->bodies)[known].get() : nullptr;
}

Real PolytopeCollider::way(const Turn& turn, const Body& body)
{
	const Real sine = (body.state->ori.conjugate() * turn.from).vec().norm(); // of half the angle
	return sine <= polytope::tolerance::noTurn ? Real(0) : 2 * turn.radius * sine;
}

bool PolytopeCollider::turnedOutOfBox() const
{
	for (std::size_t id = 0; id < turns_.size(); ++id) {
		const Turn& turn = turns_[id];
		if (!(rooms_[id] < std::numeric_limits<Real>::infinity()) || !(turn.radius > 0)) continue;
		const Body* body = bodyOf(id);
		if (body && !(way(turn, *body) <= rooms_[id])) return true; // also an orientation that is no number
	}
	return false;
}

void PolytopeCollider::makeRoom()
{
	const Real              most = math::max(verletDist, Real(0)), least = minSweepDistFactor * most;
	const bool              again  = scene->iter == madeAt_; // yade.mpy runs it twice in a step: no body has turned since
	const std::vector<Real> before = again ? rooms_ : std::vector<Real>();
	madeAt_                        = scene->iter;
	turns_.resize(scene->bodies->size());
	rooms_.assign(turns_.size(), 0);
	for (std::size_t id = 0; id < turns_.size(); ++id) {
		const Body* body     = bodyOf(id);
		Turn&       turn     = turns_[id];
		const auto* polytope = body ? dynamic_cast<const Polytope*>(body->shape.get()) : nullptr;
		if (!polytope || !polytope->convex()) {
			turn = Turn();
			continue;
		}
		const bool known = turn.radius > 0;
		if (known && id < before.size() && turn.from.coeffs() == body->state->ori.coeffs()) {
			rooms_[id] = before[id];
			continue;
		}
		turn.radius = polytope->convex()->boundingRadius();
		// twice the last interval's: so it does not run at each step, nor keep boxes enlarged for a rotation that has ended
		const Real wanted = known ? 2 * way(turn, *body) : most;
		turn.from         = body->state->ori;
		if (mayTurn(body)) rooms_[id] = wanted <= most ? math::max(least, wanted) : std::numeric_limits<Real>::infinity();
	}
}

void PolytopeCollider::action()
{
	makeRoom();
	const auto give = [&](const std::vector<Real>* given) {
		for (const auto& functor : boundDispatcher->functors)
			if (auto* own = dynamic_cast<Bo1_Polytope_Aabb*>(functor.get())) own->rooms = given;
	};
	give(&rooms_);
	try {
		InsertionSortCollider::action();
	} catch (...) {
		give(nullptr);
		throw;
	}
	give(nullptr);
}

} // namespace yade
