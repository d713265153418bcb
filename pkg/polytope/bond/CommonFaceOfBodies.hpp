// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "shape/ShapeOfBody.hpp"

#include <src/bond/BondTolerances.hpp>
#include <src/bond/CommonFace.hpp>

#include <optional>

namespace yade {

/// The largest area that faces of two polytopes have in common which look at each other as a joint's do and along a direction; none for other bodies.
/// \param shift  what is added to the place of body 2
/// \param reach  of two shapes: the largest gap between the faces [m]
/// \param cosine of the largest angle between the area's normal and `normal`
inline std::optional<polytope::CommonFace> largestCommonFace(const Body& body1, const Body& body2, const Vector3r& shift,
        const Vector3r& normal, Real (*reach)(const polytope::ConvexShape&, const polytope::ConvexShape&), Real cosine)
{
	const auto *shape1 = convexShapeOf(body1), *shape2 = convexShapeOf(body2);
	if (!shape1 || !shape2) return std::nullopt;
	const auto  faces   = polytope::commonFaces(placed(*shape1, *body1.state), placed(*shape2, *body2.state, shift),
	           reach(*shape1, *shape2), polytope::tolerance::facingOfJoints);
	const auto* largest = polytope::largestAlong(faces, normal, cosine);
	return largest ? std::make_optional(*largest) : std::nullopt;
}

} // namespace yade
