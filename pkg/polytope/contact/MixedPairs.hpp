// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "contact/PolytopeGeomFunctor.hpp"

#include <pkg/common/Box.hpp>
#include <pkg/common/Facet.hpp>
#include <pkg/common/Sphere.hpp>
#include <pkg/common/Wall.hpp>

/// YADE's own shapes against a Polytope: the same PolytopeGeom as between two polytopes.
///
/// Problem: walls, boxes and facets have no half-spaces of their own. Each becomes some for the one query (a wall one, a box six, a facet the
/// five of a prism behind it), and the two are treated as two polytopes; a sphere has a closed form. Body 1 is always YADE's shape, body 2 the
/// polytope, so the normal points from the shape into the polytope. Lengths in m, areas in m²; the half-spaces are in their body's frame,
/// point and normal of the contact in world coordinates.
namespace yade {

// The dispatcher calls with pairs in either order; body 1 is always YADE's shape, body 2 the polytope.
#define POLYTOPE_MIXED_FUNCTOR(KLASS, SHAPE, DOC)                                                                                          \
	class KLASS : public PolytopeGeomFunctor {                                                                                         \
	public:                                                                                                                            \
		bool go(const shared_ptr<Shape>& shape1, const shared_ptr<Shape>& shape2, const State& state1, const State& state2,        \
		        const Vector3r& shift2, const bool& force, const shared_ptr<Interaction>& c) override;                             \
		FUNCTOR2D(SHAPE, Polytope);                                                                                                \
		DEFINE_FUNCTOR_ORDER_2D(SHAPE, Polytope);                                                                                  \
		YADE_CLASS_BASE_DOC(KLASS, PolytopeGeomFunctor, DOC);                                                                      \
	};                                                                                                                                 \
	REGISTER_SERIALIZABLE(KLASS);

POLYTOPE_MIXED_FUNCTOR(Ig2_Wall_Polytope_PolytopeGeom, Wall,
        "Creates or updates a :yref:`PolytopeGeom` for a :yref:`Wall` and a :yref:`Polytope`. The wall is one half-space, on the side "
        "given by "
        ":yref:`Wall.sense` or, for 0, away from the polytope's centre; the contact normal is the wall's against the polytope's as between "
        "two polytopes. Polygons meet walls along x and y; one along z is counted as a failure.")
POLYTOPE_MIXED_FUNCTOR(Ig2_Box_Polytope_PolytopeGeom, Box,
        "Creates or updates a :yref:`PolytopeGeom` for a :yref:`Box` and a :yref:`Polytope`: the box as six half-spaces with the "
        "polytope's corner radius "
        "(or half its smallest extent, if less). A box with a zero extent is no solid: such pairs are counted as failures.")
POLYTOPE_MIXED_FUNCTOR(Ig2_Facet_Polytope_PolytopeGeom, Facet,
        "Creates or updates a :yref:`PolytopeGeom` for a :yref:`Facet` and a :yref:`Polytope`: the facet as the front of a triangular "
        "prism on the side away "
        "from the polytope's centre, as deep as the polytope is wide. Polyhedra only. At an edge that two facets of a mesh have in common "
        "(the same corners, to 1e-5 of the edge) the sides of both prisms are in the plane half-way between them, so that no part of an "
        "overlap "
        "counts twice.")
POLYTOPE_MIXED_FUNCTOR(Ig2_Sphere_Polytope_PolytopeGeom, Sphere,
        "Creates or updates a :yref:`PolytopeGeom` for a :yref:`Sphere` and a :yref:`Polytope`: the normal is along the shortest distance "
        "from the sphere's "
        "centre to the polytope's surface, the depth the radius less this distance, the contact point in the middle of the overlap along "
        "the normal; a polygon is met as the prism of its :yref:`thickness<Polytope.thickness>` "
        "(:yref:`cornerRadius<Polytope.cornerRadius>` has no part in it); the area is that of the sphere's cut by the contact plane. Where "
        "polytopes "
        "meet under the sphere, at a seam, an edge or a corner, each has a :yref:`share<PolytopeGeom.share>` of it and of the stiffness.")

#undef POLYTOPE_MIXED_FUNCTOR

} // namespace yade
