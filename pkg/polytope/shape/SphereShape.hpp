// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "shape/ShapeFamily.hpp"

#include <pkg/common/Sphere.hpp>

namespace yade {

/// YADE's spheres. They have no faces: pictures draw them as finely as there is room for.
std::unique_ptr<const ShapeFamily> familyOfSpheres();

} // namespace yade
