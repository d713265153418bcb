// SPDX-License-Identifier: GPL-2.0-or-later
#include "loads/BaseMotion.hpp"

#include <core/Scene.hpp>
#include <pkg/dem/NewtonIntegrator.hpp>

namespace yade {

POLYTOPE_CLASSES((BaseMotion));

void BaseMotion::action()
{
	refuseWhatCannotBe();
	KinematicEngine::action();
}

void BaseMotion::apply(const vector<Body::id_t>& bodies)
{
	const Vector3r velocity = history->at(scene->time + scene->dt / 2);
	for (const Body::id_t id : bodies)
		if (Body* const body = Body::byId(id, scene).get()) body->state->vel += velocity;
}

void BaseMotion::refuseWhatCannotBe() const
{
	if (!history || history->times.empty())
		throw std::invalid_argument("BaseMotion.history: there is none; polytope.velocityHistory(…) makes one");
	for (const Body::id_t id : ids) {
		const Body* const body = Body::byId(id, scene).get();
		if (body && (body->isClumpMember() || (body->state->blockedDOFs & State::DOF_ALL) != State::DOF_ALL))
			throw std::invalid_argument("BaseMotion.ids: body " + std::to_string(id)
			        + " is not fixed; make it with fixed=True, or set its state.blockedDOFs = 'xyzXYZ'");
	}
	if (!history->goesOn(scene->time)) return;
	for (const auto& engine : scene->engines) {
		const auto* integrator = dynamic_cast<const NewtonIntegrator*>(engine.get());
		if (integrator && !integrator->dead && integrator->damping != 0)
			throw std::invalid_argument(
			        "BaseMotion: NewtonIntegrator.damping acts on absolute velocities, so that it holds back what the base "
			        "carries along; set damping = 0 (joints have dampers of their own, normalDamping and shearDamping of the "
			        "law)");
	}
}

} // namespace yade
