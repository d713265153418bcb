// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#ifdef YADE_OPENGL

#include "shape/Polytope.hpp"

#include <pkg/common/GLDrawFunctors.hpp>

namespace yade {

/// Problem: show a polytope in YADE's window. The faces are drawn in the body's frame [m], which YADE has already moved and turned to
/// the body's place; a polygon, which lies in the plane z = 0 of that frame, as a prism from −thickness/2 to thickness/2.
/// Present only where YADE was built with OpenGL.
class Gl1_Polytope : public GlShapeFunctor {
public:
	void go(const shared_ptr<Shape>& shape, const shared_ptr<State>&, bool wire, const GLViewInfo&) override;
	RENDERS(Polytope);
	// clang-format off
	YADE_CLASS_BASE_DOC_STATICATTRS(Gl1_Polytope, GlShapeFunctor,
	"Draws a :yref:`Polytope` in YADE's 3-D view: its faces, flat-shaded, with their edges; a polygon as a prism of its "
	        ":yref:`thickness<Polytope.thickness>`.",
		((bool, wire, false, , "Edges alone, whatever the body's own :yref:`wire<Shape.wire>` says."))
		((bool, edges, true, , "Edges on top of the faces, in a darker shade of the body's colour."))
	);
	// clang-format on
};
REGISTER_SERIALIZABLE(Gl1_Polytope);

} // namespace yade

#endif // YADE_OPENGL
