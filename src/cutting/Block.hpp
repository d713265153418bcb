// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "shape/HalfSpaces.hpp"

#include <cstddef>
#include <vector>

/// A convex block with the planes of its faces, and cutting it in two by a plane: only what the plane passes through changes.
namespace polytope {

/// Corners and faces; faces name their planes by index in a list that all blocks share.
struct Block {
	std::vector<Vector3> corners;
	std::vector<int>     planes; ///< of the faces
	std::vector<int>     ends;   ///< of the faces' parts of `rings`
	std::vector<int>     rings;  ///< corners of each face, counter-clockwise seen from outside

	std::size_t faces() const { return planes.size(); }
	int         begin(std::size_t face) const { return face == 0 ? 0 : ends[face - 1]; }
	int         end(std::size_t face) const { return ends[face]; }
	void        closeFace(int plane)
	{
		planes.push_back(plane);
		ends.push_back(int(rings.size()));
	}

	Vector3 middle() const; ///< mean of the corners
	Real    volume() const;
	/// Whether a ball of this radius fits inside.
	bool holdsBall(const std::vector<Plane>& all, const Real& radius) const;
};

/// The block that these planes bound, by exact construction; `which`: their indices in `all`. Refuses what polyhedron() refuses.
Block blockOf(const std::vector<Plane>& all, const std::vector<int>& which);

/// Both parts of a block that all[cut] passes through (corners farther than `on` from it on both sides): `inner`, where it is fulfilled,
/// with all[cut] as a plane, and the rest with all[cut + 1], which is to be all[cut] turned round. Corners within `on` of the plane are on
/// it: take several roundings of the largest coordinate, so that it decides the same for all faces at a corner. The new corners of both are
/// the same points. Where their surfaces do not close, both are blockOf() their planes; false where one of them is too flat to have an
/// inside.
bool cutBlock(const Block& block, const std::vector<Plane>& all, int cut, const Real& on, Block& inner, Block& outer);

} // namespace polytope
