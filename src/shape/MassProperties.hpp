// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "shape/ShapeConstruction.hpp"

namespace polytope {

/// Volume, centroid and second moments for unit density.
struct MassProperties {
	Real    volume   = 0;
	Vector3 centroid = Vector3::Zero();
	Matrix3 inertia  = Matrix3::Zero(); ///< about the centroid, axes of the vertices, per unit density [m^5]
};

/// Exact for a polyhedron (divergence theorem over the faces' triangles, taken about an inner point so that a shape far
/// from the origin loses no digits; a thin shape is turned to its own directions first). Refuses (naming `shape`) a shape
/// without positive volume. What no tensor in other than its principal axes can hold is a needle's small moment, once it is
/// below rounding of the large ones: turn the planes to the principal axes and compute again.
POLYTOPE_API MassProperties massProperties(const Polyhedron& shape);

/// Principal axes: rotation whose columns are the axes (det = +1), moments ascending unless the tensor is already
/// diagonal to rounding: then identity, so a user's own aligned axes are kept. For dimension 2 the third axis stays z.
struct PrincipalAxes {
	Matrix3 rotation = Matrix3::Identity();
	Vector3 moments  = Vector3::Zero();
};
POLYTOPE_API PrincipalAxes principalAxes(const Matrix3& inertia, int dimension = 3);

} // namespace polytope
