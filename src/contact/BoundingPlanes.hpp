// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "centre/AnalyticCentre.hpp"
#include "contact/ContactTypes.hpp"

/// Planes that bound the overlap of a touching pair, as opposed to those far from it: the candidates for internal faces
/// (ContactSettings::internal).
namespace polytope {

/// Adds a plane, in place of the one with the least leverage if there is no room, unless that is its own.
POLYTOPE_INLINE void keepLargest(int body, int plane, Real slack, Real leverage, BoundingPlanes& out)
{
	int place = out.count[body];
	if (place < BoundingPlanes::most) ++out.count[body];
	else {
		place = 0;
		for (int k = 1; k < BoundingPlanes::most; ++k)
			if (out.leverage[body][k] < out.leverage[body][place]) place = k;
		if (!(leverage > out.leverage[body][place])) return;
	}
	out.plane[body][place]    = plane;
	out.slack[body][place]    = slack;
	out.leverage[body][place] = leverage;
}

/// Finds the planes that bound the overlap, at x inside it: with the Hessian H = Σ a_i a_iᵀ/σ_i² of the analytic centre, plane i has the
/// leverage a_iᵀ H⁻¹ a_i / σ_i² in (0, 1]. The leverages add up to D; a plane that the overlap does not reach has almost zero, and one that
/// cuts off a part of it has at least about 1/(number of planes there).
template <class R, int D, int W> POLYTOPE_INLINE void boundingPlanes(const PairPlanes<R, D>& planes, const R* x, BoundingPlanes& out)
{
	R g[D], h[D][D], lower[D][D], pivot[D];
	out.count[0] = out.count[1] = 0;
	if (!barrierDerivatives<R, D, W>(planes, x, g, h)) return;
	for (int k = D - 1; k >= 0; --k) {
		pivot[k] = h[k][k];
		for (int j = D - 1; j > k; --j) {
			R sum = h[j][k];
			for (int i = D - 1; i > j; --i)
				sum -= lower[k][i] * lower[j][i] * pivot[i];
			lower[k][j] = sum / pivot[j];
			pivot[k] -= lower[k][j] * sum;
		}
		pivot[k] = maxOf<R>(pivot[k], R(tolerance::noise * tolerance::rounding) * h[k][k]);
	}
	for (int body = 0; body < 2; ++body)
		for (int i = planes.begin(body); i < planes.end(body); ++i) {
			R reach = 0, v[D]; // aᵀ H⁻¹ a
			for (int k = D - 1; k >= 0; --k) {
				v[k] = planes.normal[k][i];
				for (int j = D - 1; j > k; --j)
					v[k] -= lower[k][j] * v[j];
				reach += v[k] * v[k] / pivot[k];
			}
			const R slack    = planes.slack[i];
			const R leverage = reach / (slack * slack);
			if (leverage > R(tolerance::nearLeverage)) keepLargest(body, i - planes.begin(body), slack, leverage, out);
		}
}

} // namespace polytope
