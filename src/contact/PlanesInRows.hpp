// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "program/PairPlanes.hpp"
#include "shape/HalfSpaces.hpp"

#include <vector>

namespace polytope {

/// The planes of a list in D + 1 rows of `storage`, each as long as the list: without slacks, rates and padding.
template <int D> PairPlanes<Real, D> planesInRows(const std::vector<Plane>& list, Real* storage)
{
	const int           count = int(list.size());
	PairPlanes<Real, D> planes;
	for (int k = 0; k < D; ++k)
		planes.normal[k] = storage + k * count;
	planes.offset = storage + D * count;
	planes.slack = planes.rate = nullptr;
	planes.first = planes.total = count;
	for (int i = 0; i < count; ++i) {
		for (int k = 0; k < D; ++k)
			planes.normal[k][i] = list[i].normal[k];
		planes.offset[i] = list[i].offset;
	}
	return planes;
}

} // namespace polytope
