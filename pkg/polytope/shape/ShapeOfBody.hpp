// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/Body.hpp>

#include <src/shape/PlacedShape.hpp>

#include "shape/Polytope.hpp"

/// The convex shape that a body has, and where it is.
namespace yade {

/// Null for bodies of other shapes.
inline const Polytope* polytopeOf(const Body& body)
{
	const auto* shape = dynamic_cast<const Polytope*>(body.shape.get());
	return shape && shape->convex() ? shape : nullptr;
}

/// The shape for the core, without what scripts see of it.
inline const polytope::ConvexShape* convexShapeOf(const Body& body)
{
	const Polytope* const shape = polytopeOf(body);
	return shape ? shape->convex().get() : nullptr;
}

/// The shape placed as the body stands. `shift`: what is added to its place, by its period or to another origin.
inline polytope::PlacedShape placed(const polytope::ConvexShape& shape, const State& state, const Vector3r& shift = Vector3r::Zero())
{
	return { shape, state.pos + shift, state.ori.toRotationMatrix() };
}

} // namespace yade
