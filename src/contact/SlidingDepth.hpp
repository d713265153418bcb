// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "numbers/Lanes.hpp"
#include "numbers/Tolerances.hpp"
#include "shape/ConvexShape.hpp"

namespace polytope {

/// How deep a body may be below a face of a piece and still slide on it: within the thickness of the piece, and not as deep as half the body.
/// Deeper, it comes from another side, or has passed through. `normal`: of the face, in the piece's axes.
POLYTOPE_INLINE Real slidingDepth(const ConvexShape& piece, const ConvexShape& body, const Vector3& normal)
{
	return minOf<Real>(piece.widthAlong(normal), Real(tolerance::deepestSlide) * body.inscribedRadius());
}

} // namespace polytope
