// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "program/BasisSolver.hpp"
#include "surface/SurfaceTolerances.hpp"

/// The planes that can be nearest anywhere in the overlap, by the linear program's optimum (x*, s*) with its weights λ.
///
/// For any x, Σ λ_k σ_k(x) = −s*. In the overlap no slack is negative. So it lies in the simplex of the basis, with a vertex where all but one
/// of its slacks are zero and that one is −s*/λ_k; and, with n = Σ over body 1 of λ_i a_i, in a slab across n, as thick as −s*/|n|, no
/// farther from x* than the smaller body is wide. A plane beyond either is nearest nowhere in it.
namespace polytope {

template <class R, int D, int W> class NearPlanes {
public:
	static int numbersNeeded(int planes) { return (D + 1) * (planes + 2 * padWidth); }
	static int indicesNeeded(int planes) { return planes + 2 * padWidth; }

	/// Copies those of `all` to `numbers`. `basis`: planes of the optimal one; rows of the copies are written to it.
	POLYTOPE_INLINE NearPlanes(const PairPlanes<R, D>& all, LpBasis<R, D>& basis, R size, R* numbers, int* indices)
	        : size_(size), allOf_(indices)
	{
		begin(all, basis);
		const int room = all.total + 2 * padWidth;
		for (int k = 0; k < D; ++k)
			near_.normal[k] = numbers + k * room;
		near_.offset = numbers + D * room;
		near_.slack = near_.rate = nullptr;
		near_.total              = 0;
		for (int body = 0; body < 2; ++body) {
			copy(all, body, basis);
			if (body == 0) near_.first = near_.total;
		}
		for (int k = 0; k <= D; ++k)
			basis.plane[k] = row_[k];
	}

	PairPlanes<R, D>& planes() { return near_; }
	/// Row among all planes of one of these.
	int rowOfAll(int row) const { return allOf_[row]; }

	/// Whether all of body 1's are turned more to n than all of body 2's: then along n the pressure of one body falls and the other's rises, so that the
	/// surface is met once on each line and is connected.
	bool facing() const { return slab_ && along_[0] > along_[1] + R(tolerance::facing); }

private:
	using V = typename Lanes<R, W>::Type;

	POLYTOPE_INLINE void begin(const PairPlanes<R, D>& all, const LpBasis<R, D>& given)
	{
		LpBasis<R, D> basis = given; // of the frame before it was turned
		bounded_            = solveBasis<R, D, W>(all, basis);
		R dual[D] = {}, first = 0, deep = padOffset;
		for (int k = 0; k <= D; ++k) {
			R a[D], d;
			all.plane(given.plane[k], a, d);
			for (int j = 0; j < D; ++j)
				x_[j] = basis.point[j];
			const R weight = basis.weight[k];
			bounded_ = bounded_ && weight > R(tolerance::simplexWeight) && basis.noise[k] < R(tolerance::simplexNoise) * weight;
			if (given.plane[k] >= all.first) continue;
			first += weight;
			for (int j = 0; j < D; ++j)
				dual[j] += weight * a[j];
		}
		deep           = maxOf<R>(-given.infeasibility, 0);
		const R length = norm<R, D>(dual);
		slab_          = length > R(tolerance::simplexWeight);
		for (int j = 0; j < D; ++j)
			n_[j] = slab_ ? dual[j] / length : R(j == D - 1);
		up_   = slab_ ? deep * first / length : 2 * size_;
		down_ = slab_ ? deep * (1 - first) / length : 2 * size_;
		for (int k = 0; k <= D && bounded_; ++k)
			for (int j = 0; j < D; ++j)
				corner_[k][j] = -basis.inverse[j][k] * (deep / basis.weight[k]) * R(tolerance::simplexRoom);
		along_[0] = padOffset;
		along_[1] = -padOffset;
	}

	POLYTOPE_INLINE void copy(const PairPlanes<R, D>& all, int body, const LpBasis<R, D>& basis)
	{
		const V zero = broadcast<R, W>(0);
		for (int i = all.begin(body); i < all.end(body); i += W) {
			V a[D], least = load<R, W>(all.offset + i), along = zero;
			for (int k = 0; k < D; ++k) {
				a[k] = load<R, W>(all.normal[k] + i);
				least -= a[k] * broadcast<R, W>(x_[k]);
				along += a[k] * broadcast<R, W>(n_[k]);
			}
			V across = broadcast<R, W>(1) - along * along;
			// √ from above, without a root: (1 + y)/2
			across          = (broadcast<R, W>(1) + maxOf(across, zero)) * broadcast<R, W>(size_);
			const V bySlab  = least - maxOf(V(along * broadcast<R, W>(up_)), V(-along * broadcast<R, W>(down_))) - across;
			V       farther = bySlab;
			if (bounded_) {
				V bySimplex = broadcast<R, W>(R(padOffset));
				for (int c = 0; c <= D; ++c) {
					V slack = least;
					for (int k = 0; k < D; ++k)
						slack -= a[k] * broadcast<R, W>(corner_[c][k]);
					bySimplex = minOf(bySimplex, slack);
				}
				farther = maxOf(farther, bySimplex);
			}
			const R beyond = R(tolerance::twinPlanes) * size_;
			if (horizontalMin<R, W>(farther) > beyond) continue;
			copyEach(all, i, farther, along, beyond, body, basis);
		}
		while (near_.total % padWidth) {
			for (int k = 0; k < D; ++k)
				near_.normal[k][near_.total] = 0;
			allOf_[near_.total]         = -1;
			near_.offset[near_.total++] = R(padOffset);
		}
	}

	POLYTOPE_INLINE void copyEach(
	        const PairPlanes<R, D>& all, int i, const V& farther, const V& along, R beyond, int body, const LpBasis<R, D>& basis)
	{
		R far[W], turned[W];
		store<R, W>(far, farther);
		store<R, W>(turned, along);
		for (int lane = 0; lane < W; ++lane) {
			const int from = i + lane;
			if (far[lane] > beyond || all.offset[from] >= R(padOffset) / 2) continue;
			const int to = near_.total++;
			allOf_[to]   = from;
			for (int k = 0; k < D; ++k)
				near_.normal[k][to] = all.normal[k][from];
			near_.offset[to] = all.offset[from];
			along_[body]     = body == 0 ? minOf<R>(along_[0], turned[lane]) : maxOf<R>(along_[1], turned[lane]);
			for (int k = 0; k <= D; ++k)
				if (basis.plane[k] == from) row_[k] = to;
		}
	}

	R                size_;
	PairPlanes<R, D> near_;
	int*             allOf_; ///< of each: its row among all
	bool             bounded_ = false, slab_ = false;
	R                x_[D], n_[D], up_ = 0, down_ = 0;
	R                corner_[D + 1][D]; ///< of the simplex, from x*
	R                along_[2];         ///< least a·n of body 1's, largest of body 2's
	int              row_[D + 1] = {};
};

} // namespace polytope
