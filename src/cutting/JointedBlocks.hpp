// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "cutting/Block.hpp"
#include "cutting/FiniteJoint.hpp"

#include <cstdint>

/// A region cut into blocks by joints (Boon, Houlsby & Utili 2015, "A new rock slicing method based on linear programming", Computers and
/// Geotechnics 65:12-29). A joint cuts the blocks that it reaches into, each along its whole plane.
///
/// Departure: the paper finds by linear programs, with the joint's own bounds among the constraints, which blocks a joint crosses, and which
/// planes are redundant. Here blocks store their corners. A joint finds the blocks that it crosses by the tree of the cuts made before it, each with
/// its box, and changes only those: the work is proportional to the number of cuts made, one per block. The area that a joint has in common
/// with a block says whether it reaches into it.
namespace polytope {

struct Cutting {
	Real smallest = 0;  ///< radius of a ball that each piece has to hold
	Real bridge   = -1; ///< blocks that a joint does not wholly separate belong to one body (RockBridges.hpp); negative: each is a body
	std::size_t   most = std::size_t(-1); ///< blocks: more are refused (std::invalid_argument)
	std::uint64_t seed = 0;               ///< of what persistence leaves to chance
};

struct JointedBlocks {
	std::vector<Plane> planes;         ///< the regions', then two for each joint, facing each other
	std::size_t        firstJoint = 0; ///< plane of the first joint
	std::vector<Block> blocks;         ///< of cuts made later, those below the joint stand before those above it
	std::vector<int>   bodies;         ///< block → the body that it is part of, numbered as they come first
	std::vector<bool>  cutting;        ///< joint → whether it has cut a block
	std::vector<Real>  areas;          ///< joint → its own area inside the blocks that it has cut
	std::vector<Real>  sections;       ///< joint → area of these blocks' sections, which are larger where it ends in them
	std::size_t        uncut = 0;      ///< cuts not made: they would have left a piece that holds no ball of radius `smallest`
	std::size_t        boxes = 0;      ///< visited in the tree, for all joints together
};

/// Convex regions, which must not overlap, cut by joints one after the other. A joint that passes no farther inside a block than
/// construction::touching follows a face or a corner and does not cut, nor does one that covers no more of a block's section. About the
/// regions' middle numbers should be small: give them about it. Refuses what polyhedron() refuses of a region.
JointedBlocks cutByJoints(const std::vector<HalfSpaces>& regions, const std::vector<FiniteJoint>& joints, const Cutting& how);

} // namespace polytope
