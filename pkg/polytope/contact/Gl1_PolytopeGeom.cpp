// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef YADE_OPENGL

#include "contact/Gl1_PolytopeGeom.hpp"

#include <core/Omega.hpp>
#include <core/Scene.hpp>
#include <lib/opengl/OpenGLWrapper.hpp>

namespace yade {

POLYTOPE_CLASSES((Gl1_PolytopeGeom));

void Gl1_PolytopeGeom::go(
        const shared_ptr<IGeom>& geom, const shared_ptr<Interaction>& contact, const shared_ptr<Body>&, const shared_ptr<Body>&, bool)
{
	constexpr double pointSize = 7, lineWidth = 2; // pixels
	const Vector3r   colour(0.85, 0.1, 0.1);
	const auto&      found = static_cast<const PolytopeGeom&>(*geom);
	if (!contact->isReal()) return;
	const Vector3r point = scene->isPeriodic ? scene->cell->wrapShearedPt(found.contactPoint) : found.contactPoint;
	const Real     size  = math::min(found.refR1, found.refR2);

	glPushAttrib(GL_ENABLE_BIT | GL_CURRENT_BIT | GL_LIGHTING_BIT | GL_LINE_BIT | GL_POINT_BIT | GL_DEPTH_BUFFER_BIT);
	glDisable(GL_LIGHTING);
	glDisable(GL_DEPTH_TEST);
	glLineWidth(lineWidth);
	glPointSize(pointSize);
	glColor3v(colour);
	if (!Omega::instance().isRunning()) { // a step may give it other memory
		glBegin(GL_LINE_LOOP);
		for (const Vector3r& corner : found.cornersOfOutline())
			glVertex3v(Vector3r(point + corner - found.contactPoint));
		glEnd();
	}
	glBegin(GL_LINES);
	glVertex3v(point);
	glVertex3v(Vector3r(point + size * found.normal));
	glEnd();
	glBegin(GL_POINTS);
	glVertex3v(point);
	glEnd();
	glPopAttrib();
}

} // namespace yade

#endif // YADE_OPENGL
