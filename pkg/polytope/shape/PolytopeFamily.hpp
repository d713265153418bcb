// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "shape/Polytope.hpp"
#include "shape/ShapeFamily.hpp"

namespace yade {

/// Polytopes, and classes derived from Polytope by what they say of themselves.
std::unique_ptr<const ShapeFamily> familyOfPolytopes();

} // namespace yade
