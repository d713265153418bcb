// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "contact/ContactTypes.hpp"
#include "contact/PlacedPair.hpp"

namespace polytope {

/// Whether two bodies stay apart while no point of either moves farther than `way` [m]: s* of the linear program is at least that, so their
/// planes can be moved outwards by it and leave no point in common. A negative `way`: whether they overlap by less than that. False also
/// where rounding leaves it open.
bool staysApart(const PlacedPair& pair, Real way, ContactWorkspace& workspace);

} // namespace polytope
