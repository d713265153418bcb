// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact/SectionArea.hpp"

#include "contact/ContactSection.hpp"

namespace polytope {
namespace {

	template <int D> Real areaOf(const std::vector<Plane>& list, const Vector3& normal, Real halfWidth)
	{
		const int                             count = int(list.size());
		static thread_local std::vector<Real> rows, buffer;
		rows.resize(std::size_t(D + 1) * count);
		buffer.resize(4 * (std::size_t(count) + 5));
		PairPlanes<Real, D> planes;
		for (int k = 0; k < D; ++k)
			planes.normal[k] = rows.data() + k * count;
		planes.offset = rows.data() + D * count;
		planes.slack = planes.rate = nullptr;
		planes.first = planes.total = count;
		for (int i = 0; i < count; ++i) {
			for (int k = 0; k < D; ++k)
				planes.normal[k][i] = list[i].normal[k];
			planes.offset[i] = list[i].offset;
		}
		const Real origin[D] = {};
		Real       n[D];
		for (int k = 0; k < D; ++k)
			n[k] = normal[k];
		return clipPlane<Real>(planes, origin, n, halfWidth, buffer.data(), -1).area;
	}

} // namespace

Real sectionArea(const std::vector<Plane>& planes, const Vector3& normal, Real halfWidth, int dimension)
{
	return dimension == 2 ? areaOf<2>(planes, normal, halfWidth) : areaOf<3>(planes, normal, halfWidth);
}

} // namespace polytope
