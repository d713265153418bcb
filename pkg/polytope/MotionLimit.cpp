// SPDX-License-Identifier: GPL-2.0-or-later
#include "TimeStepLimits.hpp"

#include <pkg/common/Box.hpp>
#include <pkg/common/Sphere.hpp>
#include <pkg/dem/NewtonIntegrator.hpp>

#include "Polytope.hpp"

namespace yade {
namespace {

	/// Radius of the largest ball in a shape; infinite for one that has none.
	Real inscribedRadius(const Shape& shape)
	{
		if (const auto* polytope = dynamic_cast<const Polytope*>(&shape))
			if (polytope->convex()) return polytope->convex()->inscribedRadius();
		if (const auto* sphere = dynamic_cast<const Sphere*>(&shape)) return sphere->radius;
		if (const auto* box = dynamic_cast<const Box*>(&shape)) return box->extents.minCoeff();
		return std::numeric_limits<Real>::infinity();
	}

} // namespace

TimeStepLimit motionLimit(const Scene& scene, Real fraction)
{
	Vector3r gravity = Vector3r::Zero();
	for (const auto& engine : scene.engines)
		if (const auto* newton = dynamic_cast<const NewtonIntegrator*>(engine.get())) gravity = newton->gravity;

	TimeStepLimit limit;
	Real          smallest = std::numeric_limits<Real>::infinity(), told = 0;
	Body::id_t    smallestBody = Body::ID_NONE;
	for (const auto& body : *scene.bodies) {
		if (!body || !body->state || body->isClumpMember()) continue;
		const State& state    = *body->state;
		Vector3r     velocity = state.vel;
		if (scene.isPeriodic) velocity = scene.cell->bodyFluctuationVel(state.pos, state.vel, scene.cell->prevVelGrad);
		Real radius = std::numeric_limits<Real>::infinity(), farthest = 0;
		forParts(*body, scene, [&](const Body& part) {
			if (!part.shape || !part.state) return;
			radius   = math::min(radius, inscribedRadius(*part.shape));
			farthest = math::max(farthest, Real((part.state->pos - state.pos).norm() + boundingRadius(*part.shape)));
		});
		const Real speed = velocity.norm() + state.angVel.norm() * farthest;
		if (!math::isfinite(speed)) continue;
		if (!isMovedByForces(*body) || state.blockedDOFs == State::DOF_ALL) {
			told = math::max(told, speed);
			continue;
		}
		limit.take(fraction * radius / speed, body->id);
		if (radius < smallest) {
			smallest     = radius;
			smallestBody = body->id;
		}
	}
	limit.take(fraction * smallest / told, smallestBody);
	limit.take(math::sqrt(fraction * smallest / gravity.norm()), smallestBody);
	return limit;
}

} // namespace yade
