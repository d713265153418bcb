// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "numbers/Export.hpp"
#include "numbers/Real.hpp"

#include <vector>

namespace polytope {

/// {x : normal·x ≤ offset}, unit outward normal.
struct Plane {
	Vector3 normal;
	Real    offset;
};

/// A set {x : normals[i]·x ≤ offsets[i]}. Unit outward normals once it has passed normalised().
/// For dimension 2 the set lies in the xy plane: every normal has z = 0.
struct HalfSpaces {
	std::vector<Vector3> normals;
	std::vector<Real>    offsets;
	int                  dimension = 3;

	std::size_t size() const { return normals.size(); }
};

/// A set with unit normals. Refuses (std::invalid_argument, naming `normals`, `offsets` or `dimension` and the
/// remedy): lengths that differ, NaN or infinite values, a zero normal, fewer than dimension + 1 planes, in 2-D a
/// normal that leaves the xy plane, a dimension other than 2 or 3.
POLYTOPE_API HalfSpaces normalised(const HalfSpaces& input);

/// The set without planes that repeat another one (same normal and offset to rounding; parallel planes that differ in offset are both kept:
/// the looser is redundant, not duplicate). Order of first appearance kept.
POLYTOPE_API HalfSpaces withoutDuplicates(const HalfSpaces& unit);

/// The set moved by the rigid motion x ↦ rotation·x + translation.
POLYTOPE_API HalfSpaces moved(const HalfSpaces& set, const Matrix3& rotation, const Vector3& translation);

/// Calls visit(axis, sign, half-length) for the six half-spaces of a cuboid about the origin: x, −x, y, −y, z, −z.
template <class Visit> void forPlanesOfCuboid(const Vector3& half, const Visit& visit)
{
	for (int axis = 0; axis < 3; ++axis)
		for (int sign = 1; sign >= -1; sign -= 2)
			visit(axis, sign, half[axis]);
}

/// The six half-spaces of a cuboid about the origin, in the order of forPlanesOfCuboid().
POLYTOPE_API HalfSpaces cuboid(const Vector3& half);

} // namespace polytope
