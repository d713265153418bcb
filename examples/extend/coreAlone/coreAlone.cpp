// SPDX-License-Identifier: GPL-2.0-or-later
//
// The contact of two sets of vertices, a cube and an octahedron with a vertex 0.05 m deep in the cube's top: the paper's contact [Boon2012], and its force with a
// stiffness of 1e6 N/m.
#include <polytope/contact/ContactQuery.hpp>
#include <polytope/shape/ShapeFactory.hpp>

#include <cstdio>

int main()
{
	using namespace polytope;
	const CentralShape cube = centralHull(
	        { { -1, -1, -1 }, { 1, -1, -1 }, { 1, 1, -1 }, { -1, 1, -1 }, { -1, -1, 1 }, { 1, -1, 1 }, { 1, 1, 1 }, { -1, 1, 1 } }, 3,
	        0, {});
	const CentralShape octahedron = centralHull(
	        { { 1, 0, 1.95 }, { -1, 0, 1.95 }, { 0, 1, 1.95 }, { 0, -1, 1.95 }, { 0, 0, 0.95 }, { 0, 0, 2.95 } }, 3, 0, {});
	const ContactSettings settings;
	PairMemory            memory;    // of this pair, for the next query
	ContactWorkspace      workspace; // of this thread
	ContactResult         contact;
	contactQuery({ *cube.shape, cube.rotation, *octahedron.shape, octahedron.rotation, octahedron.position - cube.position }, settings,
	        memory, workspace, contact);
	const Vector3 point = cube.position + contact.point, force = 1e6 * contact.depth * contact.normal;
	std::printf("s* %.17g\npoint %.17g %.17g %.17g\nnormal %.17g %.17g %.17g\ndepth %.17g\nforce %.17g %.17g %.17g\n",
	        contact.infeasibility, point[0], point[1], point[2], contact.normal[0], contact.normal[1], contact.normal[2], contact.depth,
	        force[0], force[1], force[2]);
}
