// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "cutting/Block.hpp"

/// The cuts made so far, as trees: one for each region.
namespace polytope {

struct CutNode {
	Vector3 middle, half; ///< of the block's box
	int     block = -1;   ///< what was cut, or a leaf's
	int     below = -1;   ///< the part below the cut, −1 of a leaf; the one above follows it. Both stand behind what they were cut from
};

struct CutTree {
	int                  regions = 0; ///< the first nodes are their roots
	std::vector<Block>   blocks;
	std::vector<CutNode> nodes;

	bool         isLeaf(int node) const { return nodes[std::size_t(node)].below < 0; }
	const Block& blockOfNode(int node) const { return blocks[std::size_t(nodes[std::size_t(node)].block)]; }
};

} // namespace polytope
