// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <lib/base/Math.hpp>

namespace yade {

class Body;
class Scene;
class Shape;

/// Sizes of two bodies in contact [m], which YADE's physics read as radii of spheres (ScGeom's refR1 and refR2).
///
/// YADE's physics for FrictMat and others take their stiffness from Young's modulus and these radii: 2 E₁R₁E₂R₂/(E₁R₁ + E₂R₂), of
/// Hertz and Mindlin with the root of R₁R₂/(R₁ + R₂). So they have to be properties of the shapes alone: a distance from the centre to the
/// contact point would make a wall soft near the place that it is said to be at, and a plate softer in its middle than at its corners. As YADE does
/// for spheres on walls, boxes and facets, a body that has no size of its own counts as large as the other one, and so does one that cannot
/// move: what it is made of in how many pieces says nothing about how stiff it is.
struct ContactSizes {
	Real first = 0, second = 0;
};

/// A sphere's radius, half the edge of the cube (square) of a polytope's volume (a polygon's area); 0 for a wall, a box or a facet.
Real sizeOf(const Shape& shape);

/// sizeOf() of a body that forces move, or whose clump they move; 0 for one that counts as large as what it touches.
Real sizeIfMoved(const Body& body, const Scene& scene);

ContactSizes contactSizes(const Body& body1, const Body& body2, const Scene& scene);

} // namespace yade
