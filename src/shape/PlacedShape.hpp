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

/// Appends its half-spaces n·x ≤ d, in the world's axes and from that origin.
inline void addPlanesOf(const PlacedShape& body, std::vector<Plane>& planes)
{
	const HalfSpaces& own = body.shape.planes();
	for (std::size_t i = 0; i < own.size(); ++i) {
		const Vector3 normal = body.rotation * own.normals[i];
		planes.push_back({ normal, own.offsets[i] + normal.dot(body.centre) });
	}
}

} // namespace polytope
