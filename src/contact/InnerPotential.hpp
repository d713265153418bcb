// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "program/PairPlanes.hpp"

/// Gradient of the inner potential particle (Boon et al. 2012, Eqs 13-17): with corner radius r,
///
///     f(x) = Σ ⟨a_i·x − d_i + r⟩² − r²,      ∇f(x) = 2 Σ ⟨a_i·x − d_i + r⟩ a_i,      ⟨u⟩ = max(u, 0).
///
/// Zero where x lies deeper than r inside every face.
namespace polytope {

template <class R, int D, int W>
POLYTOPE_INLINE void innerPotentialGradient(const PairPlanes<R, D>& planes, int body, const R* x, R cornerRadius, R* gradient)
{
	using V = typename Lanes<R, W>::Type;
	V X[D], g[D];
	for (int k = 0; k < D; ++k) {
		X[k] = broadcast<R, W>(x[k]);
		g[k] = broadcast<R, W>(0);
	}
	const V zero = broadcast<R, W>(0), r = broadcast<R, W>(cornerRadius);
	for (int i = planes.begin(body); i < planes.end(body); i += W) {
		V       a[D];
		const V slack = slacksOf<R, D, W>(planes, i, X, a);
		store<R, W>(planes.slack + i, slack);
		const V bracket = maxOf(V(r - slack), zero);
		for (int k = 0; k < D; ++k)
			g[k] += bracket * a[k];
	}
	for (int k = 0; k < D; ++k)
		gradient[k] = 2 * horizontalSum<R, W>(g[k]);
}

} // namespace polytope
