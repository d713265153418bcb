// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "program/PairPlanes.hpp"

/// Distance from the contact point to a body's surface along a direction (Boon et al. 2012, section 2.5, who bracket it
/// numerically): for planes the closed form  exit = min over a·n > 0 of (d − a·x)/(a·n).
/// The penetration depth is exit₁(+n) + exit₂(−n).
namespace polytope {

/// Needs planes.slack at the point (innerPotentialGradient leaves it). `direction` is ±1 times the unit vector n.
template <class R, int D, int W> POLYTOPE_INLINE R exitDistance(const PairPlanes<R, D>& planes, int body, const R* n, R direction)
{
	using V = typename Lanes<R, W>::Type;
	V N[D];
	for (int k = 0; k < D; ++k)
		N[k] = broadcast<R, W>(direction * n[k]);
	const V zero = broadcast<R, W>(0), far = broadcast<R, W>(R(padOffset));
	V       nearest = far;
	for (int i = planes.begin(body); i < planes.end(body); i += W) {
		V rate = load<R, W>(planes.normal[0] + i) * N[0];
		for (int k = 1; k < D; ++k)
			rate += load<R, W>(planes.normal[k] + i) * N[k];
		const V distance = load<R, W>(planes.slack + i) / rate;
		nearest          = minOf(nearest, V(rate > zero ? distance : far));
	}
	return horizontalMin<R, W>(nearest);
}

/// Of a body grown by `grown` (a length by which all its planes were moved out): distance along the direction from the point to the
/// original position of the plane through which the direction leaves the grown body; negative if that plane lies behind the point.
/// Across a gap the grown body decides which plane counts: a point slightly outside a plane nearly parallel to n is far from it along n.
template <class R, int D> POLYTOPE_INLINE R exitOfGrown(const PairPlanes<R, D>& planes, int body, const R* n, R direction, R grown)
{
	R nearest = R(padOffset), exit = R(padOffset);
	for (int i = planes.begin(body); i < planes.end(body); ++i) {
		R rate = 0;
		for (int k = 0; k < D; ++k)
			rate += planes.normal[k][i] * direction * n[k];
		if (!(rate > 0) || !(planes.slack[i] < nearest * rate)) continue;
		nearest = planes.slack[i] / rate;
		exit    = (planes.slack[i] - grown) / rate;
	}
	return exit;
}

} // namespace polytope
