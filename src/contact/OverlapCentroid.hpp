// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "contact/ContactSection.hpp"

/// Centroid of the overlap's volume (3-D) or area (2-D): cones from an inner point over each face of the overlap, the
/// face found by clipping its plane with all the others.
namespace polytope {

/// `x`: a point inside; replaced by the centroid. False if the overlap has no measurable volume.
template <class R, int D> POLYTOPE_INLINE bool overlapCentroid(const PairPlanes<R, D>& planes, R* x, R halfWidth, R* buffer)
{
	R volume = 0, moment[D] = {};
	for (int i = 0; i < planes.total; ++i) {
		R a[D], d;
		planes.plane(i, a, d);
		if (d >= R(padOffset) / 2) continue;
		bool repeated = false;
		for (int j = 0; j < i && !repeated; ++j)
			repeated = coincident<R, D>(planes, i, j, halfWidth);
		if (repeated) continue;
		const R height = d - dot<R, D>(a, x);
		R       foot[D];
		for (int k = 0; k < D; ++k)
			foot[k] = x[k] + height * a[k];
		const Section<R, D> face = clipPlane(planes, foot, a, halfWidth, buffer, i);
		const R             cone = face.area * height / D;
		volume += cone;
		for (int k = 0; k < D; ++k)
			moment[k] += cone * (face.centroid[k] - x[k]) * D / (D + 1);
	}
	if (!(volume > 0)) return false;
	for (int k = 0; k < D; ++k)
		x[k] += moment[k] / volume;
	return true;
}

} // namespace polytope
