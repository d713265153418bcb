// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact/SectionArea.hpp"

#include "contact/ContactSection.hpp"
#include "contact/PlanesInRows.hpp"

namespace polytope {
namespace {

	template <int D> Real areaOf(const std::vector<Plane>& list, const Vector3& normal, Real halfWidth)
	{
		static thread_local std::vector<Real> rows, buffer;
		rows.resize((D + 1) * list.size());
		buffer.resize(std::size_t(sectionNumbers(int(list.size()))));
		const PairPlanes<Real, D> planes    = planesInRows<D>(list, rows.data());
		const Real                origin[D] = {};
		Real                      n[D];
		for (int k = 0; k < D; ++k)
			n[k] = normal[k];
		return clipPlane<Real>(planes, origin, n, halfWidth, buffer.data()).area;
	}

} // namespace

Real sectionArea(const std::vector<Plane>& planes, const Vector3& normal, Real halfWidth, int dimension)
{
	return dimension == 2 ? areaOf<2>(planes, normal, halfWidth) : areaOf<3>(planes, normal, halfWidth);
}

} // namespace polytope
