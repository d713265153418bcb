// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "shape/ConvexShape.hpp"

namespace polytope {

/// A shape where it is: its centre, from the origin that its user states, and the turn of its axes into the world's.
struct PlacedShape {
	const ConvexShape& shape;
	Vector3            centre;
	Matrix3            rotation;
};

} // namespace polytope
