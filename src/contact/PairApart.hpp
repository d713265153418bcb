// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "contact/ContactTypes.hpp"
#include "shape/ConvexShape.hpp"

namespace polytope {

/// Whether two bodies stay apart while no point of either moves farther than `way` [m]: s* of the linear program is at least that, so their
/// planes can be moved outwards by it and leave no point in common. A negative `way`: whether they overlap by less than that. False also where rounding leaves
/// it open. Placed as in contactQuery().
bool staysApart(const ConvexShape& shape1, const Matrix3& rotation1, const ConvexShape& shape2, const Matrix3& rotation2,
        const Vector3& centre2, Real way, ContactWorkspace& workspace);

} // namespace polytope
