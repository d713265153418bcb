// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "shape/HalfSpaces.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

/// The first half of shape construction: whether the set has an interior, and its planes relative to an inner point.
namespace polytope {

/// The planes about an inner point, in a unit that brings the inradius to between 1 and 2. In 2-D two caps are added,
/// and in both dimensions four closing planes at the horizon, so that every set is bounded.
struct LocalPlanes {
	Vector3              centre;
	Real                 unit;
	Real                 distance; ///< of the centre from the origin: offsets carry its rounding
	Real                 inradius;
	std::vector<Vector3> normals;
	std::vector<Real>    slacks;
	std::vector<int>     plane; ///< index among the caller's planes, or one of the two below

	static constexpr int cap = -1, closing = -2;

	void add(const Vector3& normal, const Real& slack, int index)
	{
		normals.push_back(normal);
		slacks.push_back(slack);
		plane.push_back(index);
	}
	void drop(std::size_t i)
	{
		normals.erase(normals.begin() + std::ptrdiff_t(i));
		slacks.erase(slacks.begin() + std::ptrdiff_t(i));
		plane.erase(plane.begin() + std::ptrdiff_t(i));
	}
	bool isClosing(int i) const { return plane[std::size_t(i)] == closing; }
	/// The length that rounding is measured by.
	Real size(const Real& extent) const { return std::max(extent, distance); }
};

/// Refuses (std::invalid_argument naming `offsets` or `normals`) what has no interior point.
LocalPlanes aboutInnerPoint(const HalfSpaces& unit);

/// Refuses a set that is unbounded, naming a direction.
void refuseIfOpen(const HalfSpaces& unit);

/// Refuses the set as flat, or, if it is, as open: relative to the distance at which walls parallel to rounding meet, every
/// width is flat.
[[noreturn]] void refuseFlat(const HalfSpaces& unit);

} // namespace polytope
