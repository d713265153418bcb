// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "numbers/Rotation.hpp"
#include "numbers/Tolerances.hpp"
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

/// For a body grown by `grown` (a length by which all its planes were moved out): distance from the point, in the given direction, to the
/// original position of the plane through which that direction leaves the grown body; negative if that plane lies behind the point. Across
/// a gap the grown body decides which plane
/// counts: a point slightly outside a plane nearly parallel to n is far from it along n.
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

/// Depth along n through the contact point, whose slacks are in the planes (an overlap thinner than the planes' rounding may have its
/// point outside).
template <class R, int D, int W> POLYTOPE_INLINE R chord(const PairPlanes<R, D>& planes, const R* n)
{
	return maxOf<R>(0, exitDistance<R, D, W>(planes, 0, n, 1) + exitDistance<R, D, W>(planes, 1, n, -1));
}

/// Grows both bodies, which are `apart` (s*), until s* is −skin: there a pair across a gap has point, normal and section. Returns by how much [m].
template <class R, int D> POLYTOPE_INLINE R growUntilTouching(PairPlanes<R, D>& planes, R apart, R skin)
{
	const R grown = apart + skin;
	for (int i = 0; i < planes.total; ++i)
		planes.offset[i] += grown;
	return grown;
}

/// Minus the distance between the surfaces along n, for bodies that were grown by `grown` and are `apart` from each other (s*), at the
/// point of the planes' slacks.
template <class R, int D> POLYTOPE_INLINE R depthAcrossGap(const PairPlanes<R, D>& planes, const R* n, R grown, R apart, const R* dual)
{
	// where the normal does not separate the bodies the chord has no meaning; they are at least s*/|n_λ| apart
	const R least = maxOf<R>(apart, 0) / maxOf<R>(norm<R, D>(dual), R(tolerance::direction));
	return minOf<R>(exitOfGrown<R, D>(planes, 0, n, 1, grown) + exitOfGrown<R, D>(planes, 1, n, -1, grown), -least);
}

} // namespace polytope
