// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact/OverlapFaces.hpp"

#include "contact/OverlapPolyhedron.hpp"
#include "contact/PlanesInRows.hpp"

namespace polytope {

std::vector<OverlapFace> overlapFaces(const std::vector<Plane>& planes, Real halfWidth)
{
	static thread_local ContactWorkspace workspace;
	const PairPlanes<Real, 3>            rows      = planesInRows<3>(planes, workspace.rows(4, int(planes.size())));
	const Real                           inside[3] = {};
	std::vector<OverlapFace>             faces;
	const bool whole = Overlap<Real, 3, 1>(rows, inside, halfWidth, workspace).forFaces([&](int plane, int count, const auto& corner) {
		faces.push_back({ plane, {} });
		for (int k = 0; k < count; ++k) {
			Real at[3];
			corner(k, at);
			faces.back().corners.emplace_back(at[0], at[1], at[2]);
		}
	});
	if (!whole) faces.clear();
	return faces;
}

} // namespace polytope
