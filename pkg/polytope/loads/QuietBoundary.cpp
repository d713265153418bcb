// SPDX-License-Identifier: GPL-2.0-or-later
#include "loads/QuietBoundary.hpp"

#include "host/GravityOfScene.hpp"

namespace yade {

POLYTOPE_CLASSES((QuietBoundary));

namespace {

	/// Acceleration by the forces that act already; zero along what is blocked.
	Vector3r accelerationOf(const Body& body, Scene& scene, const Vector3r& force, const Vector3r& gravity)
	{
		const State& state = *body.state;
		if (!(state.mass > 0)) return Vector3r::Zero();
		Vector3r acceleration = (scene.forces.getForce(body.id) + force) / state.mass + gravity;
		for (int axis = 0; axis < 3; ++axis)
			if (state.blockedDOFs & State::axisDOF(axis)) acceleration[axis] = 0;
		return acceleration;
	}

} // namespace

/// YADE's velocities are those of half a step before. The dashpot has the mean of that and the next one, which its own force changes, too: so it is
/// neither late, which would act as a mass of c A Δt/2 less, nor does it turn a motion round, however strong it is.
void QuietBoundary::action()
{
	refuseWhatCannotBe();
	const Vector3r gravity     = gravityOf(*scene);
	const Vector3r twiceComing = history ? Vector3r(2 * history->at(scene->time)) : Vector3r(Vector3r::Zero());
	scene->forces.sync();
	for (std::size_t k = 0; k < ids.size(); ++k) {
		const Body* const body = Body::byId(ids[k], scene).get();
		if (!body) continue;
		const State&   state = *body->state;
		const Vector3r arm   = state.ori * faces[k];
		const Vector3r velocity
		        = state.vel + state.angVel.cross(arm) + scene->dt / 2 * accelerationOf(*body, *scene, supports[k], gravity);
		const Real     step   = state.mass > 0 ? Real(scene->dt / 2 / state.mass) : Real(0);
		const Vector3r motion = twiceComing - velocity, along = normal.dot(motion) * normal;
		forces_[k] = normalDashpots[k] / (1 + normalDashpots[k] * step) * along
		        + shearDashpots[k] / (1 + shearDashpots[k] * step) * (motion - along);
		arms_[k] = arm;
	}
	for (std::size_t k = 0; k < ids.size(); ++k) { // adding makes the sums above invalid
		if (!Body::byId(ids[k], scene)) continue;
		scene->forces.addForce(ids[k], forces_[k] + supports[k]);
		scene->forces.addTorque(ids[k], arms_[k].cross(forces_[k]));
	}
}

void QuietBoundary::refuseWhatCannotBe()
{
	const std::size_t count = ids.size();
	if (normalDashpots.size() != count || shearDashpots.size() != count || faces.size() != count || supports.size() != count)
		throw std::invalid_argument(
		        "QuietBoundary: normalDashpots, shearDashpots, faces and supports must have a value for each of ids; "
		        "polytope.quietBoundary(…) makes them");
	forces_.assign(count, Vector3r::Zero());
	arms_.assign(count, Vector3r::Zero());
}

} // namespace yade
