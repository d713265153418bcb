// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "shape/MassProperties.hpp"

/// Sum of a polyhedron and a ball (sphero-polyhedron): the polyhedron, slabs on its faces, sectors of cylinders along its edges, and at its
/// vertices sectors of the ball, which together are the whole ball (Steiner's formula). Polyhedra alone, no prisms of polygons.
namespace polytope {

/// Exact. \param radius of the ball, in the unit of the vertices, at least 0
POLYTOPE_API MassProperties roundedMass(const Polyhedron& core, const Real& radius);

/// A surface for drawing: corners lie on the solid's surface, so all else is a little inside. Faces of the solid come first and keep their
/// `planeOfFace`; those of edges and vertices have −1.
/// \param angle by which neighbouring faces of an edge or a vertex turn at most [rad]
POLYTOPE_API Polyhedron roundedSurface(const Polyhedron& core, const Real& radius, const Real& angle = Real(0.4));

} // namespace polytope
