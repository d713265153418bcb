// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef YADE_OPENGL

#include "shape/Gl1_Polytope.hpp"

#include <lib/opengl/OpenGLWrapper.hpp>

#include <src/shape/Rings.hpp>

namespace yade {

POLYTOPE_CLASSES((Gl1_Polytope));

bool Gl1_Polytope::wire;
bool Gl1_Polytope::edges;

namespace {

	void drawFaces(const polytope::Polyhedron& solid)
	{
		for (std::size_t face = 0; face < solid.faces.size(); ++face) {
			glBegin(GL_POLYGON);
			glNormal3v(Vector3r(polytope::faceArea(solid, face).normalized()));
			for (int vertex : solid.faces[face])
				glVertex3v(solid.vertices[vertex]);
			glEnd();
		}
	}

	/// Each edge belongs to two faces, which run through it in opposite directions: drawn for one of them.
	void drawEdges(const polytope::Polyhedron& solid)
	{
		glBegin(GL_LINES);
		for (const auto& face : solid.faces) {
			int from = face.back();
			for (int to : face) {
				if (from < to) {
					glVertex3v(solid.vertices[from]);
					glVertex3v(solid.vertices[to]);
				}
				from = to;
			}
		}
		glEnd();
	}

} // namespace

void Gl1_Polytope::go(const shared_ptr<Shape>& shape, const shared_ptr<State>&, bool viewWire, const GLViewInfo&)
{
	constexpr double edgeShade = 0.35; // of the body's colour
	const auto       solid     = static_cast<const Polytope&>(*shape).surface();
	if (!solid) return;
	const bool facesShown = !(wire || viewWire);

	glPushAttrib(GL_ENABLE_BIT | GL_POLYGON_BIT | GL_CURRENT_BIT | GL_LIGHTING_BIT | GL_LINE_BIT);
	if (facesShown) {
		glEnable(GL_LIGHTING);
		glShadeModel(GL_FLAT);
		glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
		glEnable(GL_CULL_FACE); // convex: the far side is never seen
		glCullFace(GL_BACK);
		glEnable(GL_POLYGON_OFFSET_FILL); // behind their edges
		glPolygonOffset(1, 1);
		glColor3v(shape->color);
		drawFaces(*solid);
	}
	if (edges || !facesShown) {
		glDisable(GL_LIGHTING);
		glColor3v(facesShown ? Vector3r(edgeShade * shape->color) : shape->color);
		drawEdges(*solid);
	}
	glPopAttrib();
}

} // namespace yade

#endif // YADE_OPENGL
