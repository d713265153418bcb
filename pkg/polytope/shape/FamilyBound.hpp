// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/Dispatching.hpp>

/// Boxes of bodies whose family says how far they reach.
namespace yade {

/// Box of the ball about the body's centre that holds it (ShapeFamily::boundingRadius): no rotation leads out of it. An extension makes a
/// functor for its class of it by YADE_POLYTOPE_BALL_BOUND.
class PolytopeFamilyBound : public BoundFunctor {
public:
	void go(const shared_ptr<Shape>& shape, shared_ptr<Bound>& bound, const Se3r& se3, const Body*) override;
	YADE_CLASS_BASE_DOC(PolytopeFamilyBound, BoundFunctor,
	        "What the functors of extensions have in common that make the :yref:`Aabb` of the ball about a body that holds it.");
};
REGISTER_SERIALIZABLE(PolytopeFamilyBound);

} // namespace yade

/// A functor KLASS for a class of shapes that has a family; at namespace level of yade, and in YADE_PLUGIN.
#define YADE_POLYTOPE_BALL_BOUND(KLASS, SHAPE)                                                                                             \
	class KLASS : public PolytopeFamilyBound {                                                                                         \
	public:                                                                                                                            \
		FUNCTOR1D(SHAPE);                                                                                                          \
		YADE_CLASS_BASE_DOC(KLASS, PolytopeFamilyBound, "Box of the ball about a " #SHAPE " that holds it.");                      \
	};                                                                                                                                 \
	REGISTER_SERIALIZABLE(KLASS)
