// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "program/BasisSolver.hpp"
#include "contact/ContactFrame.hpp"
#include "contact/ContactTypes.hpp"

/// The basis that the linear programme starts from where the last step's contact cannot be followed: the last step's, or that
/// of an inscribed ball.
namespace polytope {

/// Solves the basis given by codes (2 × index + body) in the frame; false if it cannot serve.
template <class R, int D>
POLYTOPE_INLINE bool startFrom(
        const PairInput& in, const ContactFrame<R, D>& f, const std::array<int, 4>& codes, LpBasis<R, D>& basis, R* dual)
{
	R          normals[D + 1][D];
	const auto plane = [&](int k, R* a, R& d) POLYTOPE_INLINE_LAMBDA {
		framePlane<R, D>(in, f, codes[k] & 1, codes[k] >> 1, a, d);
		for (int j = 0; j < D; ++j)
			normals[k][j] = a[j];
	};
	if (!solveBasis<R, D>(plane, basis)) return false;
	for (int j = 0; j < D; ++j) {
		dual[j] = 0;
		for (int k = 0; k <= D; ++k)
			dual[j] += R((codes[k] & 1) == 0) * basis.weight[k] * normals[k][j];
	}
	return true;
}

/// The basis of a pair of which nothing is known: the smaller body's inscribed ball, as the shape has solved it, in the smaller
/// body's frame. False where that is not the smaller ball, or has no digits.
template <class R, int D>
POLYTOPE_INLINE bool startFromOwnBall(const PairInput& in, const ContactFrame<R, D>& f, PairMemory& memory, LpBasis<R, D>& basis)
{
	const LpBasis<R, D>* const ball = in.shape[f.home]->template inscribedBall<D>();
	if (!ball || !(in.shape[f.home]->inscribedRadius() <= in.shape[1 - f.home]->inscribedRadius())) return false;
	basis = *ball;
	for (int k = 0; k <= D; ++k)
		memory.basis[k] = 2 * ball->plane[k] + f.home;
	memory.hasBasis = true;
	memory.hasPoint = false;
	return true;
}

/// The same from either body's ball, the smaller one's first: solved in the frame.
template <class R, int D>
POLYTOPE_INLINE void startFromBall(const PairInput& in, const ContactFrame<R, D>& f, PairMemory& memory, LpBasis<R, D>& basis, R* dual)
{
	int ball        = in.shape[1]->inscribedRadius() < in.shape[0]->inscribedRadius() ? 1 : 0;
	memory.hasPoint = memory.hasBasis = false;
	// the other one, where turning a basis of nearly parallel planes has made it singular
	for (int attempt = 0; attempt < 2 && !memory.hasBasis; ++attempt, ball = 1 - ball) {
		if (!(in.shape[ball]->inscribedRadius() < R(padOffset))) continue;
		for (int k = 0; k <= D; ++k)
			memory.basis[k] = 2 * in.shape[ball]->inscribedBasis()[k] + ball;
		memory.hasBasis = startFrom<R, D>(in, f, memory.basis, basis, dual);
	}
	if (!memory.hasBasis) { // or both: then solveWide() finds one
		for (int k = 0; k < D; ++k)
			basis.point[k] = dual[k] = 0;
		basis.infeasibility = -R(padOffset);
	}
}

} // namespace polytope
