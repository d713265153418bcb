// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#ifdef YADE_OPENGL

#include "contact/PolytopeGeom.hpp"

#include <pkg/common/GLDrawFunctors.hpp>

namespace yade {

/// Problem: show contacts in YADE's window, where they lie inside the bodies: drawn over them. In the world's axes, in a periodic scene in the cell.
/// Present only where YADE was built with OpenGL.
class Gl1_PolytopeGeom : public GlIGeomFunctor {
public:
	void go(const shared_ptr<IGeom>& geom, const shared_ptr<Interaction>& contact, const shared_ptr<Body>&, const shared_ptr<Body>&,
	        bool) override;
	RENDERS(PolytopeGeom);
	// clang-format off
	YADE_CLASS_BASE_DOC(Gl1_PolytopeGeom, GlIGeomFunctor,
	"Draws contacts of a :yref:`Polytope` in YADE's 3-D view, over the bodies, where the box *Interaction geometry* is ticked "
	        "(``yade.qt.Renderer().intrGeom = True``): the contact point, the normal from body 1 to body 2 as long as the smaller body's size, "
	        "and the :yref:`outline<PolytopeGeom.outline>` of the contact area, where it is known and the scene is not running. *Interaction "
	        "physics* (``intrPhys``) draws forces, by :yref:`Gl1_NormPhys`."
	);
	// clang-format on
};
REGISTER_SERIALIZABLE(Gl1_PolytopeGeom);

} // namespace yade

#endif // YADE_OPENGL
