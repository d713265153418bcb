// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "shape/HalfSpaces.hpp"

#include <vector>

/// Half-spaces ↔ vertices and faces, at any size from 1e-9 m to 1e4 m: no absolute tolerance.
namespace polytope {

/// Vertices and faces of a bounded set with interior.
struct Polyhedron {
	std::vector<Vector3>          vertices;
	std::vector<std::vector<int>> faces;       ///< vertex indices, counter-clockwise seen from outside
	std::vector<int>              planeOfFace; ///< index of the half-space each face lies on; 2-D: the two caps have -1
};

/// Where more planes than three pass through a point, to rounding, they share one vertex; edges down to 1e-9 of the extent
/// are kept where their planes turn by more than 1e-4 (ConstructionTolerances.hpp). Aspect ratios up to 1e11.
///
/// Vertices and faces of a 3-D set, or (dimension 2) of the right prism of the given thickness, z ∈ [−thickness/2, thickness/2].
/// Planes must be unit (see normalised). A redundant plane owns no face. Refuses (std::invalid_argument, naming the
/// argument): empty set, flat set (no interior), unbounded set, non-positive or non-finite thickness.
POLYTOPE_API Polyhedron polyhedron(const HalfSpaces& unit, Real thickness = 1);

/// A polyhedron about an inner point, where its numbers are small wherever it is: vertices · unit + centre are the caller's.
struct LocalPolyhedron {
	Polyhedron shape;
	Vector3    centre;
	Real       unit; ///< a power of two that brings the inradius to between 1 and 2
};

/// Builds the same as polyhedron(), from planes that have passed normalised().
LocalPolyhedron localPolyhedron(const HalfSpaces& unit, const Real& thickness);

/// Puts the vertices of a shape where these planes meet: of a shape whose faces are known, so that equal planes have equal vertices
/// to the last bit however the faces were found. Where the origin is not inside, they stay.
void placeVertices(const HalfSpaces& unit, const Real& thickness, Polyhedron& shape);

/// The planes that own a face in `polyhedron(unit)`: the set without redundant planes.
POLYTOPE_API HalfSpaces withoutRedundant(const HalfSpaces& unit);

/// Convex hull of points as half-spaces, coplanar facets merged into one plane, so a cube has 6. Facets count as coplanar
/// when their corners miss a common plane by at most `coplanar` × extent, wherever the body is, or by the rounding of points in
/// this precision, for which the default 0 stands. (A mesh stored in single precision about its own middle needs about 1e-6.) No point
/// of a merged facet is cut off.
/// dimension 2: points in the xy plane. Refuses (naming `points`): too few, NaN, all in a plane (on a line in 2-D);
/// (naming `coplanar`) a fraction that is negative, not finite or above 0.1.
POLYTOPE_API HalfSpaces hullOf(const std::vector<Vector3>& points, int dimension = 3, Real coplanar = 0);

} // namespace polytope
