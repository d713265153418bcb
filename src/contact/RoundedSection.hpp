// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "numbers/PlaneAxes.hpp"
#include "shape/HalfSpaces.hpp"

#include <vector>

/// Plane sections of a body with a margin (a ball around each point of its core), and what half-spaces leave of them: on which of several
/// pieces of a support it presses.
namespace polytope {

/// Corners (u, v) along the axes of a plane from a point of it, convex, counter-clockwise about its normal.
using PlanePolygon = std::vector<Vector2>;

/// Polygon around the section by the plane through `at`: sectionDirections lines of the plane that touch it, and those along the sides of
/// the core. So it depends on the body's pose without jumps. Empty where the plane misses the body.
///
/// A line touches it where the body's support point along w = cos α d + sin α n lies in the plane (d: out of the line, n: the plane's
/// normal): its height rises with α, which is found by halving, and, within one vertex of the core, from sin α.
PlanePolygon roundedSection(
        const std::vector<Vector3>& core, const Real& margin, const Vector3& normal, const PlaneAxes& axes, const Vector3& at);

/// What lies in a half-space.
void clipByPlane(PlanePolygon& polygon, const Plane& plane, const PlaneAxes& axes, const Vector3& at);

} // namespace polytope
