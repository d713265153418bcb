// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "shape/ConvexShape.hpp"

#include <vector>

/// Contact of two cores with margins (a ball around each point of a core): where, and how strongly, they press on each other.
///
/// The nearest points of two cores that nearly lie on each other jump from corner to corner with the slightest tilt, so a force there would
/// never let a body come to rest. So the energy is that of a spring k whose closure D is a mean over the faces and edges that nearly touch,
/// as that of the contact model *spring* (SurfaceContact.hpp):
///
///     U = ½ k D²,    D = δ − Σ w (δ − Dᵢ),    Dᵢ = ∫ h³ dA/∫ h² dA,
///
/// δ the overlap at the nearest points (both margins less the distance of the cores), h that at each place of a pair of features: two faces
/// over the area that they have in common, seen along the normal; an edge (or a segment) over its part beside a face; two edges over their
/// part beside each other. Two features that are parallel have D = δ, and the force acts in their middle; from a tilt on by which they part
/// elsewhere Dᵢ is ¾ δ about an edge and ⅗ δ about a corner, and the force acts there. The weight w of a pair falls from 1, where its
/// features are parallel, to 0 at the angle tolerance::parallelFeatures; edges have what faces leave. Beyond that D = δ: a corner, or two
/// edges that cross, press with k δ at the nearest points.
///
/// Force and line of action are the gradient of U, to the order of that angle, so that a body that rocks without dampers keeps its energy;
/// but for the moment about the normal of two edges that are nearly parallel, which is left out.
namespace polytope {

/// Corners of a face, counter-clockwise about its outward normal.
using FaceCorners = std::vector<Vector3>;

/// Half-spaces, or, where there is no shape, the segment from the origin along `way` (zero: a point). World axes.
struct CoreInPlace {
	const ConvexShape* shape;
	Vector3            origin;
	Matrix3            rotation;
	Vector3            way;
	/// The face that is touched, in the pieces of a support which it goes on over: that of the core itself first (it may be empty). Null: it
	/// is the core's alone.
	const std::vector<FaceCorners>* pieces = nullptr;
};

struct SpreadContact {
	Real    closure; ///< D [m]
	Real    slope;   ///< ∂D/∂δ: the force is k D times this [-]
	Vector3 point;   ///< of the force's line of action, as high as the nearest point
	/// Where they touch, along axesAround(normal) from the point. Of two faces (of pieces: the first) the corners (u, v) of the part that
	/// overlaps, convex, counter-clockwise; of an edge beside a face or another edge its two ends there; of a corner none.
	std::vector<Vector2> outline;
};

/// \param normal  unit, from core 1 to core 2: the shortest way between them
/// \param nearest point of core 1 where that begins
/// \param deepest δ, above 0 [m]
SpreadContact spreadContact(
        const CoreInPlace& core1, const CoreInPlace& core2, const Vector3& normal, const Vector3& nearest, const Real& deepest);

} // namespace polytope
