// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "contact/PlacePlanes.hpp"
#include "contact/WarmStart.hpp"
#include "program/BasisSolver.hpp"

/// The basis that the linear program starts from, and the frame that its planes are placed in: those of the last step's contact; where
/// these cannot be used the last step's basis, or that of an inscribed ball, in a frame given by that basis' dual direction and point.
namespace polytope {

enum class StartBasis {
	LastContact, ///< the last step's, in that contact's frame, which both bodies have carried along
	OwnBall,     ///< of the smaller body's inscribed ball, in that body's own frame
	Aimed,       ///< the last step's or a ball's: frame turned to its dual direction, origin at its point
	AimedFar,    ///< as Aimed, but with the origin on the way to a point far outside the bodies, where every plane would lose digits
	Unsolved,    ///< as Aimed, but the basis is singular to rounding in that frame
	None,        ///< no basis could be solved
	Separating,  ///< its weights separate the bodies: no plane has been placed
	NoPose,      ///< positions or rotations that are not finite
};

/// Solves the basis given by codes (PairMemory::basis) in the frame; false if it cannot be used. `dual`: its dual direction.
template <class R, int D, int W>
POLYTOPE_INLINE bool startFrom(
        const PlacedPair& in, const ContactFrame<R, D>& f, const std::array<int, 4>& codes, LpBasis<R, D>& basis, R* dual)
{
	R          normals[D + 1][D];
	const auto plane = [&](int k, R* a, R& d) POLYTOPE_INLINE_LAMBDA {
		framePlane<R, D>(in, f, bodyOfCode(codes[k]), planeOfCode(codes[k]), a, d);
		for (int j = 0; j < D; ++j)
			normals[k][j] = a[j];
	};
	if (!solveBasis<R, D, W>(plane, basis)) return false;
	for (int j = 0; j < D; ++j) {
		dual[j] = 0;
		for (int k = 0; k <= D; ++k)
			dual[j] += R(bodyOfCode(codes[k]) == 0) * basis.weight[k] * normals[k][j];
	}
	return true;
}

/// Basis of the smaller body's inscribed ball, as the shape has solved it, in that body's frame. False where that is not the smaller ball,
/// or where the shape has no solved basis.
template <class R, int D>
POLYTOPE_INLINE bool startFromOwnBall(const PlacedPair& in, const ContactFrame<R, D>& f, PairMemory& memory, LpBasis<R, D>& basis)
{
	const LpBasis<R, D>* const ball = in.shape[f.home]->template inscribedBall<D>();
	if (!ball || !(in.shape[f.home]->inscribedRadius() <= in.shape[1 - f.home]->inscribedRadius())) return false;
	basis = *ball;
	for (int k = 0; k <= D; ++k)
		memory.basis[k] = planeCode(f.home, ball->plane[k]);
	return true;
}

/// A start basis of either body, the smaller ball's first, solved in the frame: the other one, where turning a basis of nearly parallel planes
/// has made it singular. False if both are.
template <class R, int D, int W>
POLYTOPE_INLINE bool startFromBall(const PlacedPair& in, const ContactFrame<R, D>& f, PairMemory& memory, LpBasis<R, D>& basis, R* dual)
{
	int ball = in.shape[1]->inscribedRadius() < in.shape[0]->inscribedRadius() ? 1 : 0;
	for (int attempt = 0; attempt < 2; ++attempt, ball = 1 - ball) {
		if (!(in.shape[ball]->inscribedRadius() < R(padOffset))) continue;
		for (int k = 0; k <= D; ++k)
			memory.basis[k] = planeCode(ball, in.shape[ball]->inscribedBasis()[k]);
		if (startFrom<R, D, W>(in, f, memory.basis, basis, dual)) return true;
	}
	for (int k = 0; k < D; ++k)
		basis.point[k] = dual[k] = 0;
	basis.infeasibility = -R(padOffset);
	return false;
}

/// Sets frame, planes and basis.
template <class R, int D, int W> POLYTOPE_INLINE StartBasis startBasis(const PairQuery<R, D>& q)
{
	const PlacedPair&   in     = q.in;
	PairMemory&         memory = q.memory;
	ContactFrame<R, D>& f      = q.frame;
	PairPlanes<R, D>&   planes = q.planes;
	LpBasis<R, D>&      basis  = q.basis;
	const bool          known  = q.settings.warmStart && memory.hasBasis;
	setCentres<R, D>(in, f);
	if (known && memory.hasPoint && followContact<R, D, W>(in, f, memory.point, memory.dualDirection)) {
		placePair<R, D, W>(in, f, planes);
		recallBasis<R, D>(planes, memory, basis);
		if (solveBasis<R, D, W>(planes, basis) && dualFeasible<R, D>(basis)) return StartBasis::LastContact;
	}
	if (!finitePose<R, D>(in)) return StartBasis::NoPose; // planes that are not finite separate nothing

	homeFrame<R, D, W>(in, f);
	R          dual[D];
	const bool last = known && startFrom<R, D, W>(in, f, memory.basis, basis, dual) && dualFeasible<R, D>(basis);
	if (!last) memory.hasPoint = false;
	if (!last && startFromOwnBall<R, D>(in, f, memory, basis)) {
		placePairAtHome<R, D, W>(in, f, planes);
		recallBasis<R, D>(planes, memory, basis);
		return StartBasis::OwnBall;
	}
	const bool some = last || startFromBall<R, D, W>(in, f, memory, basis, dual);
	if (some && lowerBound<R, D>(basis, q.limits.reach) > q.limits.dismissAbove) return StartBasis::Separating;

	const R away = maxOf<R>(1, norm<R, D>(basis.point) / f.size);
	R       origin[D];
	for (int k = 0; k < D; ++k)
		origin[k] = basis.point[k] / away;
	const Rotation<R, D> turn = aim<R, D, W>(f, dual, origin);
	placePair<R, D, W>(in, f, planes);
	recallBasis<R, D>(planes, memory, basis);
	if (!some) return StartBasis::None;
	if (!moveBasis<R, D, W>(planes, turn, origin, -R(tolerance::thin) * f.size, basis)) return StartBasis::Unsolved;
	return away > 1 ? StartBasis::AimedFar : StartBasis::Aimed;
}

} // namespace polytope
