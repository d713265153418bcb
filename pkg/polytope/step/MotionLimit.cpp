// SPDX-License-Identifier: GPL-2.0-or-later
#include "step/TimeStepLimits.hpp"

#include <pkg/common/Box.hpp>
#include <pkg/common/Facet.hpp>
#include <pkg/common/Sphere.hpp>
#include <pkg/common/Wall.hpp>
#include <pkg/dem/NewtonIntegrator.hpp>

#include <src/timestep/ApproachLimit.hpp>

#include "shape/Polytope.hpp"

namespace yade {
namespace {

	const Real infinite = std::numeric_limits<Real>::infinity();

	/// Radius of the largest ball in a shape; infinite for one that has none.
	Real inscribedRadius(const Shape& shape)
	{
		if (const auto* polytope = dynamic_cast<const Polytope*>(&shape))
			if (polytope->convex()) return polytope->convex()->inscribedRadius();
		if (const auto* sphere = dynamic_cast<const Sphere*>(&shape)) return sphere->radius;
		if (const auto* box = dynamic_cast<const Box*>(&shape)) return box->extents.minCoeff();
		return infinite;
	}

	/// Enlarges the box by a part of the body.
	void addTo(polytope::MovingBox& box, const Body& part)
	{
		const State& state = *part.state;
		const auto   take  = [&](const Vector3r& low, const Vector3r& high) {
                        box.low  = box.low.cwiseMin(low);
                        box.high = box.high.cwiseMax(high);
		};
		const auto corners = [&](const std::vector<Vector3r>& vertices) {
			for (const Vector3r& vertex : vertices) {
				const Vector3r corner = state.pos + state.ori * vertex;
				take(corner, corner);
			}
		};
		if (const auto* wall = dynamic_cast<const Wall*>(part.shape.get())) {
			Vector3r low = Vector3r::Constant(-infinite), high = Vector3r::Constant(infinite);
			low[wall->axis] = high[wall->axis] = state.pos[wall->axis];
			return take(low, high);
		}
		if (const auto* polytope = dynamic_cast<const Polytope*>(part.shape.get()))
			if (polytope->convex()) return corners(polytope->convex()->polyhedron().vertices);
		if (const auto* facet = dynamic_cast<const Facet*>(part.shape.get())) return corners(facet->vertices);
		Vector3r half = Vector3r::Constant(boundingRadius(*part.shape));
		if (const auto* cuboid = dynamic_cast<const Box*>(part.shape.get()))
			half = state.ori.toRotationMatrix().cwiseAbs() * cuboid->extents;
		take(state.pos - half, state.pos + half);
	}

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
			box.radius = math::min(box.radius, inscribedRadius(*part.shape));
			farthest   = math::max(farthest, Real((part.state->pos - state.pos).norm() + boundingRadius(*part.shape)));
			addTo(box, part);
		});
		box.spin = state.angVel.norm() * farthest;
		box.free = isMovedByForces(body);
		box.id   = body.id;
		return box;
	}

	/// By which each body alone may move, whatever the others do.
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

#ifdef YADE_MPI
	bool isDivided(const Scene& scene)
	{
		for (const auto& body : *scene.bodies)
			if (body && body->getIsSubdomain()) return true;
		return false;
	}
#else
	bool isDivided(const Scene&) { return false; }
#endif

} // namespace

TimeStepLimit motionLimit(const Scene& scene, Real fraction, Real below, Real steps)
{
	Vector3r gravity = Vector3r::Zero();
	for (const auto& engine : scene.engines)
		if (const auto* newton = dynamic_cast<const NewtonIntegrator*>(engine.get())) gravity = newton->gravity;

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
	limit.take(math::sqrt(fraction * smallest.radius / gravity.norm()), smallest.id);
	below = math::min(below, limit.step);
	if (!(below < infinite) || scene.isPeriodic || isDivided(scene)) {
		const TimeStepLimit absolute = absoluteLimit(boxes, fraction, smallest);
		limit.take(absolute.step, absolute.body);
	} else if (2 * fastest * below >= fraction * smallest.radius) { // else no two bodies are fast enough
		const Real horizon = below * steps;
		const auto nearest = polytope::approachLimit(std::move(boxes), fraction, horizon, gravity.norm() * horizon, below);
		limit.take(nearest.step, nearest.id);
	}
	return limit;
}

} // namespace yade
