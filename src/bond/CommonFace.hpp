// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "shape/PlacedShape.hpp"

#include <vector>

/// The area that faces of two bodies have in common, seen along their normal: what a bond between the bodies is made of.
namespace polytope {

/// World axes.
struct CommonFace {
	Vector3              centroid; ///< of the area, half way between the two faces
	Matrix3              axes;     ///< columns: normal from the first body to the second, principal axes of the area; right-handed
	Vector3              normal1, normal2; ///< outward, of the first body's face and of the second's
	Real                 area;             ///< [m²]
	Vector2              second;           ///< ∫ y² dA and ∫ z² dA along axes 1 and 2, from the centroid [m⁴]
	Real                 gap;              ///< between the faces at the centroid; negative: overlap [m]
	std::vector<Vector2> corners;          ///< (y, z) from the centroid, counter-clockwise about the normal
};

/// The largest gap between faces of two bodies that are meant to touch [m].
Real touchingGap(const ConvexShape& first, const ConvexShape& second);

/// The deepest that their faces overlap where they have one in common [m].
Real deepestOverlap(const ConvexShape& first, const ConvexShape& second);

/// All pairs of faces that look at each other within `angle` [rad] and are not farther apart than `gap` (nor overlap by more than a contact does,
/// Tolerances.hpp). Polygons: their edges, over the smaller thickness.
std::vector<CommonFace> commonFaces(const PlacedShape& first, const PlacedShape& second, const Real& gap, const Real& angle);

/// The largest of the areas whose normal makes an angle of a larger cosine than this with a direction; null where there is none.
const CommonFace* largestAlong(const std::vector<CommonFace>& faces, const Vector3& direction, const Real& cosine);

} // namespace polytope
