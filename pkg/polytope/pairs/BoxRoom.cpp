// SPDX-License-Identifier: GPL-2.0-or-later
#include "pairs/BoxRoom.hpp"

#include <lib/pyutil/gil.hpp>

#include <src/numbers/Tolerances.hpp>

#include "host/PartsOfBodies.hpp"
#include "shape/Polytope.hpp"
#include "shape/ShapeFamily.hpp"

#include <algorithm>
#include <limits>
#include <omp.h>

namespace yade {

namespace {

	const Body* bodyOf(const Scene& scene, std::size_t id)
	{
		const Body::id_t known = Body::id_t(id); // bodies may have been erased since
		return scene.bodies->exists(known) ? (*scene.bodies)[known].get() : nullptr;
	}

	/// Displacement of the farthest point by the rotation since the box was made (the chord).
	Real turned(const BoxRoom::Reference& reference, const Quaternionr& orientation)
	{
		const Real sine = (orientation.conjugate() * reference.orientation).vec().norm(); // of half the angle
		return sine <= polytope::tolerance::noTurn ? Real(0) : 2 * reference.radius * sine;
	}

	bool hasVelocity(const State& state) { return state.vel != Vector3r::Zero() || state.angVel != Vector3r::Zero(); }

	/// Whether degrees of freedom of a body have been freed or blocked since its box was made, or one that was still is moved. The parts of a
	/// clump are not told that it is freed; in the step after they have its velocity.
	bool hasStarted(const BoxRoom::Reference& reference)
	{
		const State& state = *reference.state;
		if (state.blockedDOFs != reference.blockedDOFs) return true;
		if (!reference.still) return false;
		return hasVelocity(state) || state.pos != reference.position || (reference.radius > 0 && turned(reference, state.ori) > 0);
	}

	/// A body that would leave its largest box by rotation within so many steps gets the box of its circumscribed ball.
	constexpr int fewSteps = 4;

} // namespace

void BoxRoom::makeOne(const Scene& scene, std::size_t id, const Limits& limits)
{
	const Body* const  body      = bodyOf(scene, id);
	Reference&         reference = references_[id];
	const Shape* const shape     = body ? body->shape.get() : nullptr;
	const auto* const  polytope  = dynamic_cast<const Polytope*>(shape);
	const auto         margin    = polytope ? polytope->margin() : std::nullopt;
	if (!polytope || !polytope->convex() || !margin) {
		shared_ptr<State> state = std::move(reference.state);
		reference               = Reference();
		reference.state         = std::move(state); // until takeOne() has the body's present one
		rooms_[id]              = 0;
		if (!shape || familyOf(*shape).isRound(*shape)) return;
		reference.radius      = 1; // any: there is no room
		reference.orientation = body->state->ori;
		return;
	}
	const bool known = bool(reference.convex) && body->bound;
	const long since = known ? scene.iter - body->bound->lastUpdateIter : 0;
	if (known && since == 0 && reference.orientation.coeffs() == body->state->ori.coeffs())
		return; // yade.mpy runs the collider twice in a step
	// in each step; not yet known: as its velocity says
	const Real way = known && since > 0 ? turned(reference, body->state->ori) / since
	                                    : body->state->angVel.norm() * polytope->convex()->boundingRadius() * scene.dt;
	if (reference.convex != polytope->convex()) reference.convex = polytope->convex();
	reference.radius      = polytope->convex()->boundingRadius();
	reference.margin      = *margin;
	reference.orientation = body->state->ori;
	const Real wanted     = way * steps(limits.targetInterv);
	rooms_[id]            = !mayTurn(body)            ? Real(0)
	                   : way * fewSteps > limits.most ? std::numeric_limits<Real>::infinity()
	                                                  : math::max(limits.least, math::min(limits.most, wanted));
}

void BoxRoom::makeForAll(const Scene& scene, const Limits& limits)
{
	references_.resize(scene.bodies->size());
	rooms_.resize(references_.size());
	const long number = long(references_.size());
#pragma omp parallel for schedule(static)
	for (long id = 0; id < number; ++id)
		makeOne(scene, id, limits);
}

void BoxRoom::make(const Scene& scene, const std::vector<Body::id_t>& ids, const Limits& limits)
{
	for (const Body::id_t id : ids)
		makeOne(scene, id, limits);
}

void BoxRoom::takeOne(const Scene& scene, std::size_t id)
{
	const Body* const body      = bodyOf(scene, id);
	Reference&        reference = references_[id];
	if (!body || !body->bound) return letGo(reference.state);
	if (reference.state != body->state) {
		letGo(reference.state);
		reference.state = body->state;
	}
	reference.sweep       = body->bound->sweepLength;
	reference.position    = body->state->pos;
	reference.blockedDOFs = body->state->blockedDOFs;
	reference.fixed       = isFixed(*body, scene);
	reference.still       = reference.fixed && !hasVelocity(*body->state);
}

void BoxRoom::letGo(shared_ptr<State>& state)
{
	if (!state) return;
#pragma omp critical(polytopeStatesOfBodies)
	gone_.push_back(std::move(state));
	state.reset();
}

/// States that scripts have made belong to Python's memory, too, which one thread at a time may change.
void BoxRoom::releaseStates()
{
	if (gone_.empty()) return;
	const gilLock lock;
	gone_.clear();
}

void BoxRoom::takeFromAll(const Scene& scene)
{
	const long number = long(references_.size());
#pragma omp parallel for schedule(static)
	for (long id = 0; id < number; ++id)
		takeOne(scene, id);
	releaseStates();
}

void BoxRoom::take(const Scene& scene, const std::vector<Body::id_t>& ids)
{
	for (const Body::id_t id : ids)
		takeOne(scene, std::size_t(id));
	releaseStates();
}

bool BoxRoom::isOutside(std::size_t id, bool byTranslation) const
{
	const Reference& reference = references_[id];
	if (!reference.state) return false;
	if (byTranslation) {
		const Vector3r moved = reference.state->pos - reference.position;
		// as the integrator measures it; also a position that is no number
		if (!(moved.cwiseAbs().maxCoeff() < reference.sweep) && moved != Vector3r::Zero()) return true;
		if (hasStarted(reference)) return true;
	}
	if (!(reference.radius > 0) || !(rooms_[id] < std::numeric_limits<Real>::infinity())) return false;
	return !(turned(reference, reference.state->ori) <= rooms_[id]); // also an orientation that is no number
}

bool BoxRoom::isFreed(const Scene& scene, std::size_t id) const
{
	const Body* const body = references_[id].fixed ? bodyOf(scene, id) : nullptr;
	return body && !isFixed(*body, scene);
}

bool BoxRoom::hasFreed(const Scene& scene, const std::vector<Body::id_t>& ids) const
{
	return std::any_of(ids.begin(), ids.end(), [&](Body::id_t id) { return isFreed(scene, std::size_t(id)); });
}

bool BoxRoom::hasFreed(const Scene& scene) const
{
	for (std::size_t id = 0; id < references_.size(); ++id)
		if (isFreed(scene, id)) return true;
	return false;
}

std::vector<Body::id_t> BoxRoom::outside(const Scene& scene, bool byTranslation) const
{
	std::vector<std::vector<Body::id_t>> found(std::max(1, omp_get_max_threads()));
	const long                           number = long(std::min(references_.size(), scene.bodies->size()));
#pragma omp parallel for schedule(static)
	for (long id = 0; id < number; ++id)
		if (isOutside(id, byTranslation)) found[omp_get_thread_num()].push_back(Body::id_t(id));
	std::vector<Body::id_t> all;
	for (const auto& ofThread : found)
		all.insert(all.end(), ofThread.begin(), ofThread.end());
	// those that have been erased have no box
	all.erase(std::remove_if(all.begin(), all.end(), [&](Body::id_t id) { return !bodyOf(scene, id); }), all.end());
	return all;
}

} // namespace yade
