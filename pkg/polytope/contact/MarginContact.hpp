// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "contact/PolytopeGeom.hpp"

/// Contacts of bodies that are larger than their cores by a ball: of rounded polyhedra and segments with their like, with polytopes, spheres, walls.
namespace yade {

/// Contact of two bodies of any classes whose families say what their cores and margins are (ShapeFamily::core).
///
/// While the cores are apart, the bodies overlap along the shortest way between them: normal and depth are those of two balls at its ends. Where they overlap, it is the
/// contact of their half-spaces, deeper by both margins; a segment or point is pushed out to the nearest face. Of segments that lie along a face, or along each other, the ball is
/// in the middle of where they do. For stiffnesses per contact: there is no area; with a stiffness per area the pair is counted as a failure, and so is one of bodies without
/// a core, of a polygon, or of two segments that cross. An extension makes functors for its classes of it by YADE_POLYTOPE_MARGIN_PAIR.
class PolytopeMarginFunctor : public PolytopeGeomFunctor {
public:
	bool go(const shared_ptr<Shape>& shape1, const shared_ptr<Shape>& shape2, const State& state1, const State& state2,
	        const Vector3r& shift2, const bool& force, const shared_ptr<Interaction>& c) override;
	YADE_CLASS_BASE_DOC(PolytopeMarginFunctor, PolytopeGeomFunctor,
	        "What the functors of extensions have in common that make contacts of bodies with margins: half-spaces and a ball around "
	        "them.");
};
REGISTER_SERIALIZABLE(PolytopeMarginFunctor);

} // namespace yade

/// A functor KLASS for two classes of shapes that have families, body 1 of the first; at namespace level of yade, and in YADE_PLUGIN.
#define YADE_POLYTOPE_MARGIN_PAIR(KLASS, SHAPE1, SHAPE2)                                                                                   \
	class KLASS : public PolytopeMarginFunctor {                                                                                       \
	public:                                                                                                                            \
		FUNCTOR2D(SHAPE1, SHAPE2);                                                                                                 \
		DEFINE_FUNCTOR_ORDER_2D(SHAPE1, SHAPE2);                                                                                   \
		YADE_CLASS_BASE_DOC(KLASS, PolytopeMarginFunctor, "Contact of " #SHAPE1 " and " #SHAPE2 ".");                              \
	};                                                                                                                                 \
	REGISTER_SERIALIZABLE(KLASS)
