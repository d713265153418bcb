// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "shape/ShapeFamily.hpp"

#include <pkg/common/Wall.hpp>

/// YADE's wall as a half-space: it is everywhere, and not turned.
namespace yade {

/// Unit normal out of the wall, on the side given by its sense or, for 0, on that of a body at `way` from the wall.
Vector3r outwardOf(const Wall& wall, const Vector3r& way);

/// The point of a wall at `position` that is nearest to a place.
Vector3r footOn(const Wall& wall, const Vector3r& position, const Vector3r& place);

std::unique_ptr<const ShapeFamily> familyOfWalls();

} // namespace yade
