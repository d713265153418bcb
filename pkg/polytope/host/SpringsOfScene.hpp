// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/Body.hpp>
#include <core/Scene.hpp>

#include <functional>

/// What the time step has to know about forces between bodies that are no contacts: bonds (PolytopeBonds) and bolts (PolytopeBolts).
namespace yade {

/// Springs at one point as one of their two bodies feels them, world axes.
struct SpringsAtPoint {
	Vector3r normal;
	Vector3r point;                           ///< in the period of this body [m]
	Real     normalStiffness, shearStiffness; ///< [N/m]
	Matrix3r rotationStiffness;               ///< moment per rotation [N m/rad]
};

/// An engine with such forces.
class HasSprings {
public:
	virtual ~HasSprings() = default;
	/// Whether any act on the body.
	virtual bool holds(Body::id_t id) const                                                                    = 0;
	virtual void forSpringsOf(const Body& body, const std::function<void(const SpringsAtPoint&)>& visit) const = 0;
	/// Made so far.
	virtual std::size_t made() const = 0;
};

/// The scene's engines with such forces that act.
inline std::vector<const HasSprings*> springsOf(const Scene& scene)
{
	std::vector<const HasSprings*> found;
	for (const auto& engine : scene.engines)
		if (const auto* springs = dynamic_cast<const HasSprings*>(engine.get()); springs && !engine->dead) found.push_back(springs);
	return found;
}

} // namespace yade
