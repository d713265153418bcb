// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef YADE_OPENGL

#include "shape/Gl1_Polytope.hpp"

#include <lib/opengl/OpenGLWrapper.hpp>

namespace yade {

YADE_PLUGIN((Gl1_Polytope));

bool Gl1_Polytope::wire;
bool Gl1_Polytope::edges;

namespace {

	/// Outward normal of a face; the caps of a prism lie on no half-space of the polygon.
	Vector3r faceNormal(const polytope::ConvexShape& convex, std::size_t face)
	{
		const polytope::Polyhedron& solid = convex.polyhedron();
		const int                   plane = solid.planeOfFace[face];
		if (plane >= 0) return convex.planes().normals[plane];
		return solid.vertices[solid.faces[face].front()].z() > 0 ? Vector3r(Vector3r::UnitZ()) : Vector3r(-Vector3r::UnitZ());
	}

	void drawFaces(const polytope::ConvexShape& convex)
	{
		const polytope::Polyhedron& solid = convex.polyhedron();
		for (std::size_t face = 0; face < solid.faces.size(); ++face) {
			glBegin(GL_POLYGON);
			glNormal3v(faceNormal(convex, face));
			for (int vertex : solid.faces[face])
				glVertex3v(solid.vertices[vertex]);
			glEnd();
		}
	}

	/// Each edge belongs to two faces, which run through it in opposite directions: drawn for one of them.
	void drawEdges(const polytope::ConvexShape& convex)
	{
		const polytope::Polyhedron& solid = convex.polyhedron();
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
	const auto&      convex    = static_cast<const Polytope&>(*shape).convex();
	if (!convex) return;
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
		drawFaces(*convex);
	}
	if (edges || !facesShown) {
		glDisable(GL_LIGHTING);
		glColor3v(facesShown ? Vector3r(edgeShade * shape->color) : shape->color);
		drawEdges(*convex);
	}
	glPopAttrib();
}

} // namespace yade

#endif // YADE_OPENGL
