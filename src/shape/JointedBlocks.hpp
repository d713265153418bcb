// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "shape/Block.hpp"

/// A convex region cut into blocks by joints that run through all of it (Boon, Houlsby & Utili 2015, "A new rock slicing method
/// based on linear programming", Computers and Geotechnics 65:12-29).
///
/// Departure: the paper finds by linear programs which blocks a joint crosses, and which planes are redundant. Here blocks store their
/// corners. A joint finds the blocks that it crosses by the tree of the cuts made before it, each with its box, and
/// changes only those: the work is proportional to the number of cuts made, one per block.
namespace polytope {

struct JointedBlocks {
	std::vector<Plane> planes;    ///< the region's, then two for each joint, facing each other
	std::vector<Block> blocks;    ///< of cuts made later, those below the joint stand before those above it
	std::vector<bool>  cutting;   ///< joint → whether it has cut a block
	std::size_t        uncut = 0; ///< cuts not made: they would have left a piece that holds no ball of radius `smallest`
	std::size_t        boxes = 0; ///< visited in the tree, for all joints together
};

/// Joints cut one after the other. A joint that passes no farther inside a block than construction::touching follows a face or a
/// corner and does not cut. About the region's middle numbers should be small: give it about its centroid. Refuses what polyhedron()
/// refuses of the region.
JointedBlocks cutByJoints(const HalfSpaces& region, const std::vector<Plane>& joints, const Real& smallest);

} // namespace polytope
