// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "contact/PolytopeGeomFunctor.hpp"
#include "shape/ShapeFamily.hpp"

/// Contacts of bodies that are larger than their cores by a ball: of rounded polyhedra and segments with their like, with polytopes,
/// spheres, walls, boxes, facets.
namespace yade {

/// Whether a PolytopeMarginFunctor can meet such a body.
bool hasMarginCore(const Shape& shape);

/// Contact of two bodies of any classes whose families say what their cores and margins are (ShapeFamily::core).
///
/// The bodies overlap along the shortest way between the cores, by both margins less its length; where the cores themselves overlap, body 2
/// is moved out of body 1 along the normal of their contact, and the way back counts as margin. A segment or point in half-spaces is pushed
/// out to the nearest face. Where faces or edges nearly lie on each other, the force acts in the middle of them, and moves from there with
/// a tilt (src/contact/SpreadContact.hpp): so a body comes to rest on its faces. `outline` is then the part of both faces that overlaps,
/// over which a rock joint shears. Half-spaces without any margin have the contact of two polytopes.
///
/// YADE's boxes and facets have no core in their families: half-spaces stand for them (StandIns.hpp), those of a facet with the mesh around
/// it. On several pieces of a rigid support all contacts together are that with their union (MarginOnPieces.hpp).
///
/// For stiffnesses per contact; with a stiffness per area the pair is counted as a failure, and so is one of bodies without a core, of a
/// polygon, or of two segments that cross. An extension makes functors for its classes of it by YADE_POLYTOPE_MARGIN_PAIR.
class PolytopeMarginFunctor : public PolytopeGeomFunctor {
public:
	bool go(const shared_ptr<Shape>& shape1, const shared_ptr<Shape>& shape2, const State& state1, const State& state2,
	        const Vector3r& shift2, const bool& force, const shared_ptr<Interaction>& c) override;
	YADE_CLASS_BASE_DOC(PolytopeMarginFunctor, PolytopeGeomFunctor,
	        "What the functors of extensions have in common that make contacts of bodies with margins: half-spaces and a ball around "
	        "them.");

private:
	std::optional<CoreOfBody> standIn(
	        const Shape& shape, const shared_ptr<Interaction>& contact, int which, const Vector3r& shift2, const CoreOfBody& partner);
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
