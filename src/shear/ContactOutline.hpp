// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "numbers/Real.hpp"

/// The outline of a contact: the convex polygon in which it is seen along its normal. In it lies the bed of shear springs and friction of two faces.
///
/// Corners counter-clockwise, in an orthonormal pair of axes of the contact's plane, from the contact point [m].
namespace polytope {

/// a × b.
inline Real cross(const Vector2& a, const Vector2& b) { return a[0] * b[1] - a[1] * b[0]; }

/// A quarter turn to the left, n × a.
inline Vector2 left(const Vector2& a) { return Vector2(-a[1], a[0]); }

/// Area, centroid and moments of second order.
struct OutlineMoments {
	Real    area     = 0;               ///< [m²]
	Vector2 centroid = Vector2::Zero(); ///< [m]
	Real    second[3] { 0, 0, 0 };      ///< ∫ u², ∫ u v, ∫ v² dA about the centroid [m⁴]

	/// Mean square of the distance from the centroid [m²].
	Real gyrationSquared() const { return area > 0 ? (second[0] + second[2]) / area : Real(0); }
};

OutlineMoments momentsOf(const Vector2* corner, int count);

} // namespace polytope
