// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact/SectionArea.hpp"

#include "contact/ContactSection.hpp"

namespace polytope {
namespace {

	template <int D> Section<Real, D> sectionOf(const std::vector<Plane>& list, const Vector3& normal, Real halfWidth)
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
		return clipPlane<Real>(planes, origin, n, halfWidth, buffer.data(), -1);
	}

	template <int D> Matrix3 secondMoment(const std::vector<Plane>& planes, const Vector3& normal, Real halfWidth)
	{
		const Section<Real, D> section = sectionOf<D>(planes, normal, halfWidth);
		Real                   n[D];
		for (int k = 0; k < D; ++k)
			n[k] = normal[k];
		const Rotation<Real, D> axes = axesAround<Real, D>(n);
		Vector3                 u = Vector3::Zero(), v = Vector3::Zero();
		for (int k = 0; k < D; ++k) {
			u[k] = axes.m[0][k];
			v[k] = D == 3 ? axes.m[1][k] : Real(0);
		}
		return section.second[0] * u * u.transpose() + section.second[1] * (u * v.transpose() + v * u.transpose())
		        + section.second[2] * v * v.transpose();
	}

} // namespace

Real sectionArea(const std::vector<Plane>& planes, const Vector3& normal, Real halfWidth, int dimension)
{
	return dimension == 2 ? sectionOf<2>(planes, normal, halfWidth).area : sectionOf<3>(planes, normal, halfWidth).area;
}

Matrix3 sectionSecondMoment(const std::vector<Plane>& planes, const Vector3& normal, Real halfWidth, int dimension)
{
	return dimension == 2 ? secondMoment<2>(planes, normal, halfWidth) : secondMoment<3>(planes, normal, halfWidth);
}

} // namespace polytope
