// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "cutting/CutTree.hpp"
#include "cutting/FiniteJoint.hpp"

#include <vector>

/// Which blocks of a cut region are one body, since rock goes on from one to the other: a joint ends inside their common face, or, where
/// two regions meet, there is none.
namespace polytope {

struct JointedPlanes {
	const std::vector<Plane>&       planes; ///< the regions', then two for each joint
	std::size_t                     firstJoint;
	const std::vector<FiniteJoint>& joints;
	Real                            extent; ///< radius of all regions
};

/// node → number of the body that all leaves below it belong to, −1 where they belong to several.
/// Two leaves are one body where joints leave more of their common face uncovered than `bridge` times the smaller of both faces. All joints in the
/// plane of a face count.
std::vector<int> bodiesOfNodes(const CutTree& tree, const JointedPlanes& rock, const Real& bridge);

} // namespace polytope
