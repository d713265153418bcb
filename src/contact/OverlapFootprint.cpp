// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact/OverlapFootprint.hpp"

#include "contact/OverlapVolume.hpp"
#include "contact/PlanesInRows.hpp"

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
		const Footprint<Real>   seen = Overlap<Real, D, 1>(planes, origin, halfWidth, workspace).footprint(origin, n);
		const Rotation<Real, D> axes = axesAround<Real, D>(n);
		Vector3                 u = Vector3::Zero(), v = Vector3::Zero();
		for (int k = 0; k < D; ++k) {
			u[k] = axes.m[0][k];
			v[k] = D == 3 ? axes.m[1][k] : Real(0);
		}
		return { seen.area,
			seen.second[0] * u * u.transpose() + seen.second[1] * (u * v.transpose() + v * u.transpose())
			        + seen.second[2] * v * v.transpose() };
	}

} // namespace

OverlapFootprint overlapFootprint(const std::vector<Plane>& planes, const Vector3& direction, Real halfWidth, int dimension)
{
	return dimension == 2 ? footprintOf<2>(planes, direction, halfWidth) : footprintOf<3>(planes, direction, halfWidth);
}

} // namespace polytope
