// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "shape/ConvexShape.hpp"

#include <memory>
#include <optional>
#include <vector>

/// The one way to make a body's shape. Input: planes or points in any frame, and options; output: the shape that bodies share and
/// its pose. One construction for a new shape, none for one whose numbers are known from a body that still exists. (Planes that are in
/// the body's frame already, as those of an archive, go to ConvexShape::shared().)
namespace polytope {

struct ShapeOptions {
	Real                thickness     = 1;    ///< of a polygon [m]
	bool                keepRedundant = true; ///< planes that own no face, too; repeated ones go in any case
	std::optional<Real> cornerRadius;         ///< [m]; none: `cornerFraction` of the inscribed ball's radius
	Real                cornerFraction = 0;
	Real                margin         = 0; ///< radius of the ball around a polyhedron, whose frame is that of both (RoundedSolid.hpp)
};

/// x = position + rotation·(x of the body's frame): the centroid and, as columns, the principal axes (MassProperties.hpp).
struct CentralShape {
	std::shared_ptr<const ConvexShape> shape;
	Vector3                            position = Vector3::Zero();
	Matrix3                            rotation = Matrix3::Identity();
};

/// Refuses what normalised(), polyhedron() and ConvexShape refuse. A centroid that differs from the origin by rounding is the
/// origin, and axes that are principal to rounding stay: such planes are taken over unchanged. Thread-safe.
POLYTOPE_API CentralShape centralShape(const HalfSpaces& planes, const ShapeOptions& options);

/// The shape that is the convex hull of points, as hullOf() finds it. Refuses also what hullOf() refuses.
POLYTOPE_API CentralShape centralHull(const std::vector<Vector3>& points, int dimension, const Real& coplanar, const ShapeOptions& options);

} // namespace polytope
