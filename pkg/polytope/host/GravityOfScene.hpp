// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/Scene.hpp>
#include <pkg/dem/NewtonIntegrator.hpp>

namespace yade {

/// Acceleration that the scene gives to bodies which move freely: each NewtonIntegrator that is not dead adds its own gravity.
inline Vector3r gravityOf(const Scene& scene)
{
	Vector3r gravity = Vector3r::Zero();
	for (const auto& engine : scene.engines)
		if (const auto* integrator = dynamic_cast<const NewtonIntegrator*>(engine.get()))
			if (!integrator->dead) gravity += integrator->gravity;
	return gravity;
}

} // namespace yade
