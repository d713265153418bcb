// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "shape/HalfSpaces.hpp"

namespace polytope {

/// Half-spaces of the regular polyhedron with 4, 6, 8, 12 or 20 faces and the given circumradius, centred at the origin.
/// Refuses (std::invalid_argument) another number of faces (`faces`) and a circumradius that is not positive and finite
/// (`circumradius`).
HalfSpaces regularSolid(int faces, Real circumradius);

} // namespace polytope
