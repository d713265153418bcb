// SPDX-License-Identifier: GPL-2.0-or-later
//
// A polyhedron rounded by a ball (sphero-polyhedron), and its contacts with its like, with Polytope, Sphere, Wall, Box and Facet. All of it follows from the margin: volume,
// inertia, boxes, drawing, contacts. For stiffnesses per contact.
#include <yade-polytope/contact/MarginContact.hpp>

#include <pkg/common/Box.hpp>
#include <pkg/common/Facet.hpp>
#include <pkg/common/Sphere.hpp>
#include <pkg/common/Wall.hpp>

namespace yade {

class RoundedPolytope : public Polytope {
public:
	virtual ~RoundedPolytope() = default;
	std::optional<Real> margin() const override { return radius; }
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR(RoundedPolytope, Polytope, "Sum of a polyhedron (the planes) and a ball.", ((Real, radius, 0, , "of the ball [m]")), createIndex(););
	// clang-format on
	REGISTER_CLASS_INDEX(RoundedPolytope, Polytope);
};
REGISTER_SERIALIZABLE(RoundedPolytope);

YADE_POLYTOPE_MARGIN_PAIR(Ig2_RoundedPolytope_RoundedPolytope_PolytopeGeom, RoundedPolytope, RoundedPolytope);
YADE_POLYTOPE_MARGIN_PAIR(Ig2_Polytope_RoundedPolytope_PolytopeGeom, Polytope, RoundedPolytope);
YADE_POLYTOPE_MARGIN_PAIR(Ig2_Sphere_RoundedPolytope_PolytopeGeom, Sphere, RoundedPolytope);
YADE_POLYTOPE_MARGIN_PAIR(Ig2_Wall_RoundedPolytope_PolytopeGeom, Wall, RoundedPolytope);
YADE_POLYTOPE_MARGIN_PAIR(Ig2_Box_RoundedPolytope_PolytopeGeom, Box, RoundedPolytope);
YADE_POLYTOPE_MARGIN_PAIR(Ig2_Facet_RoundedPolytope_PolytopeGeom, Facet, RoundedPolytope);

YADE_PLUGIN((
        RoundedPolytope)(Ig2_RoundedPolytope_RoundedPolytope_PolytopeGeom)(Ig2_Polytope_RoundedPolytope_PolytopeGeom)(Ig2_Sphere_RoundedPolytope_PolytopeGeom)(Ig2_Wall_RoundedPolytope_PolytopeGeom)(Ig2_Box_RoundedPolytope_PolytopeGeom)(Ig2_Facet_RoundedPolytope_PolytopeGeom));

} // namespace yade
