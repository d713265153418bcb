// SPDX-License-Identifier: GPL-2.0-or-later
#include "step/TimeStepLimits.hpp"

#include "host/GravityOfScene.hpp"
#include "shape/ShapeFamily.hpp"

namespace yade {
namespace {

	const Real infinite = std::numeric_limits<Real>::infinity();

	/// Time step in which each body alone moves no farther than it may, whatever the others do.
	TimeStepLimit absoluteLimit(const std::vector<polytope::MovingBox>& boxes, Real fraction, const polytope::MovingBox& smallest)
	{
		TimeStepLimit limit;
		Real          told = 0; // by scripts
		for (const auto& box : boxes) {
			const Real speed = box.velocity.norm() + box.spin;
			if (box.free) limit.take(fraction * box.radius / speed, box.id);
			else told = math::max(told, speed);
		}
		limit.take(fraction * smallest.radius / told, smallest.id);
		return limit;
	}

} // namespace

polytope::MovingBox movingBoxOf(const Body& body, const Scene& scene)
{
	const State&        state = *body.state;
	polytope::MovingBox box;
	box.low      = Vector3r::Constant(infinite);
	box.high     = Vector3r::Constant(-infinite);
	box.velocity = state.vel;
	if (scene.isPeriodic) box.velocity = scene.cell->bodyFluctuationVel(state.pos, state.vel, scene.cell->prevVelGrad);
	box.radius    = infinite;
	Real farthest = 0;
	forParts(body, scene, [&](const Body& part) {
		if (!part.shape || !part.state) return;
		const Shape&       shape  = *part.shape;
		const ShapeFamily& family = familyOf(shape);
		box.radius                = math::min(box.radius, family.inscribedRadius(shape));
		farthest                  = math::max(farthest, Real((part.state->pos - state.pos).norm() + family.boundingRadius(shape)));
		family.extend(shape, *part.state, box.low, box.high);
	});
	box.spin = state.angVel.norm() * farthest;
	box.free = isMovedByForces(body);
	box.id   = body.id;
	return box;
}

TimeStepLimit motionLimit(const Scene& scene, Real fraction, Real below, Real steps)
{
	const Real                       gravity = gravityOf(scene).norm();
	std::vector<polytope::MovingBox> boxes;
	polytope::MovingBox              smallest;
	smallest.radius = infinite;
	Real fastest    = 0;
	for (const auto& body : *scene.bodies) {
		if (!body || !body->state || body->isClumpMember()) continue;
		const auto box   = movingBoxOf(*body, scene);
		const Real speed = box.velocity.norm() + box.spin;
		if (!math::isfinite(speed)) continue;
		fastest = math::max(fastest, speed);
		if (box.free && box.radius < smallest.radius) smallest = box;
		boxes.push_back(box);
	}
	TimeStepLimit limit;
	limit.take(math::sqrt(fraction * smallest.radius / gravity), smallest.id);
	below = math::min(below, limit.step);
	if (!(below < infinite) || scene.isPeriodic || isDivided(scene)) {
		const TimeStepLimit absolute = absoluteLimit(boxes, fraction, smallest);
		limit.take(absolute.step, absolute.body);
	} else if (2 * fastest * below >= fraction * smallest.radius) { // else no two bodies are fast enough
		const Real horizon = below * steps;
		const auto nearest = polytope::approachLimit(std::move(boxes), fraction, horizon, gravity * horizon, below);
		limit.take(nearest.step, nearest.id);
	}
	return limit;
}

} // namespace yade
