// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact/OverlapFootprint.hpp"

#include "contact/OverlapPolygon.hpp"
#include "contact/OverlapPolyhedron.hpp"
#include "contact/PlanesInRows.hpp"
#include "numbers/PlaneAxes.hpp"

namespace polytope {
namespace {

	template <int D> OverlapFootprint footprintOf(const std::vector<Plane>& list, const Vector3& direction, Real halfWidth)
	{
		static thread_local ContactWorkspace workspace;
		const PairPlanes<Real, D>            planes    = planesInRows<D>(list, workspace.rows(D + 1, int(list.size())));
		const Real                           origin[D] = {};
		Real                                 n[D];
		for (int k = 0; k < D; ++k)
			n[k] = direction[k];
		const Footprint<Real> seen = Overlap<Real, D, 1>(planes, origin, halfWidth, workspace).footprint(origin, n);
		if constexpr (D == 3) return { seen.area, PlaneAxes(direction).inSpace(seen.second) };
		const Rotation<Real, 2> axes = axesAround<Real, 2>(n);
		const Vector3           along(axes.m[0][0], axes.m[0][1], 0);
		return { seen.area, seen.second[0] * along * along.transpose() };
	}

} // namespace

OverlapFootprint overlapFootprint(const std::vector<Plane>& planes, const Vector3& direction, Real halfWidth, int dimension)
{
	return dimension == 2 ? footprintOf<2>(planes, direction, halfWidth) : footprintOf<3>(planes, direction, halfWidth);
}

} // namespace polytope
