// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "numbers/Tolerances.hpp"
#include "program/PairPlanes.hpp"

/// Points of the overlap on the line to a point that may be outside.
namespace polytope {

/// Goes from x (inside) towards `target` as far as it stays inside.
template <class R, int D, int W> POLYTOPE_INLINE void moveInside(const PairPlanes<R, D>& planes, R* x, const R* target)
{
	using V = typename Lanes<R, W>::Type;
	V X[D], step[D];
	for (int k = 0; k < D; ++k) {
		X[k]    = broadcast<R, W>(x[k]);
		step[k] = broadcast<R, W>(target[k] - x[k]);
	}
	V largest = broadcast<R, W>(R(tolerance::interiorStep));
	for (int i = 0; i < planes.total; i += W) {
		V rate  = load<R, W>(planes.normal[0] + i) * step[0];
		V slack = load<R, W>(planes.offset + i) - load<R, W>(planes.normal[0] + i) * X[0];
		for (int k = 1; k < D; ++k) {
			const V a = load<R, W>(planes.normal[k] + i);
			rate += a * step[k];
			slack -= a * X[k];
		}
		largest = maxOf(largest, V(rate / slack));
	}
	// largest = 1/t_max where a plane is met before the target
	const R t = R(tolerance::interiorStep) / -horizontalMin<R, W>(-largest);
	if (!(t > 0)) return;
	for (int k = 0; k < D; ++k)
		x[k] += t * (target[k] - x[k]);
}

} // namespace polytope
