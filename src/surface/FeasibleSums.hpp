// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "surface/ContactSurface.hpp"
#include "surface/FeasiblePolygon.hpp"

/// The sums over a pair's contact surface from the vertices and edges of its feasible set.
///
/// A piece of the surface between planes i and j is the set's face in which both are tight, seen along s: a polygon, whose edges are those of the set that
/// have i and j. Each edge makes a triangle with the piece's first vertex, and none of them is negative, in whatever order they come.
namespace polytope {

template <class R> class FeasibleSums {
public:
	/// `energy`: also overlap, volume and level, for which the other faces of the set are needed, too.
	POLYTOPE_INLINE FeasibleSums(FeasibleBuffers<R>& buffers, bool energy, SurfaceSums<R, 3>& sums) : buffers_(buffers), energy_(energy)
	{
		for (int k = 0; k < buffers_.planes * buffers_.planes; ++k)
			pieceOf_[k] = unknown;
		for (int e = 0; e < buffers_.edges; ++e) {
			const int           v = buffers_.edge[e][0], w = buffers_.edge[e][1];
			const std::uint64_t one = buffers_.mask[v] & buffers_.mask[w], two = one & (one - 1);
			const int           i = __builtin_ctzll(one), j = __builtin_ctzll(two), k = __builtin_ctzll(two & (two - 1));
			add(v, w, i, j);
			add(v, w, i, k);
			add(v, w, j, k);
		}
		finish(sums);
	}

	/// What lies on a piece of a larger solid.
	POLYTOPE_APART void clip(const PairPlanes<R, 3>& planes, R box, const SurfaceBuffers<R, 3>& spare, SurfaceOnPiece<R, 3>& on)
	{
		on.reset();
		for (int k = 0; k < pieces_; ++k) {
			const int          i = planes_[k][0], j = planes_[k][1];
			SurfacePiece<R, 3> piece;
			if (!isBetween(i, j) || !placePiece<R, 3>(planes, buffers_.rowOf[i], buffers_.rowOf[j], box, piece)) continue;
			on.add(piece, FeasiblePolygon<R>(buffers_, i, j, firstOf_[k], piece), spare);
		}
	}

private:
	using Four                   = typename Lanes<R, 4>::Type;
	static constexpr int unknown = 255, most = FeasibleBuffers<R>::mostPlanes, rows = FeasibleBuffers<R>::pieceRows;

	/// Of a piece: four numbers each.
	enum Row { Sums = 0, Moment = 4, SquareMoment = 8, Normal = 12 };
	/// Among its sums.
	enum Sum { Area = 0, Pressure, Square };

	/// Of planes of both bodies.
	bool isBetween(int i, int j) const { return buffers_.bodyOf[i] + buffers_.bodyOf[j] == 1; }

	/// The triangle of edge v w in the piece of planes i and j. PieceIntegrals.hpp has the sums.
	POLYTOPE_INLINE void add(int v, int w, int i, int j)
	{
		const bool between = isBetween(i, j);
		if (!between && !energy_) return;
		std::uint8_t& known = pieceOf_[i * buffers_.planes + j];
		if (known == unknown) known = begin(v, i, j);
		const int first = firstOf_[known];
		if (v == first || w == first) return;
		R* const   own  = buffers_.piece + rows * known;
		const Four o    = load<R, 4>(buffers_.point + 4 * first);
		const Four from = load<R, 4>(buffers_.point + 4 * v) - o, to = load<R, 4>(buffers_.point + 4 * w) - o;
		const Four turn = shuffled<R, 1, 2, 0, 3>(from) * shuffled<R, 2, 0, 1, 3>(to)
		        - shuffled<R, 2, 0, 1, 3>(from) * shuffled<R, 1, 2, 0, 3>(to);
		const Four along = load<R, 4>(own + Normal) * turn;
		const R    area = abs(along[0] + along[1] + along[2]), p0 = maxOf<R>(o[3], 0), p1 = p0 + from[3], p2 = p0 + to[3];
		const R    sum = p0 + p1 + p2, second = sum * sum + p0 * p0 + p1 * p1 + p2 * p2;
		const Four sums = four<R>(R(1), sum, second, R(0));
		store<R, 4>(own + Sums, Four(load<R, 4>(own + Sums) + broadcast<R, 4>(area) * sums));
		if (!between) return;
		// from the first vertex on: there it is zero
		const Four way = from + to, mixed = broadcast<R, 4>(p1) * from + broadcast<R, 4>(p2) * to;
		store<R, 4>(own + Moment, Four(load<R, 4>(own + Moment) + broadcast<R, 4>(area) * (broadcast<R, 4>(sum) * way + mixed)));
		if (!energy_) return;
		const Four squares = broadcast<R, 4>(second) * way + broadcast<R, 4>(2 * sum) * mixed + broadcast<R, 4>(2 * p1 * p1) * from
		        + broadcast<R, 4>(2 * p2 * p2) * to;
		store<R, 4>(own + SquareMoment, Four(load<R, 4>(own + SquareMoment) + broadcast<R, 4>(area) * squares));
	}

	POLYTOPE_INLINE std::uint8_t begin(int vertex, int i, int j)
	{
		const int  number  = pieces_++;
		const bool turned  = buffers_.bodyOf[i] > buffers_.bodyOf[j];
		planes_[number][0] = std::uint8_t(turned ? j : i);
		planes_[number][1] = std::uint8_t(turned ? i : j);
		firstOf_[number]   = std::uint8_t(vertex);
		R* const   own     = buffers_.piece + rows * number;
		const Four normal
		        = load<R, 4>(buffers_.plane + 4 * planes_[number][0]) - load<R, 4>(buffers_.plane + 4 * planes_[number][1]);
		const Four zero = normal - normal;
		store<R, 4>(own + Normal, normal);
		store<R, 4>(own + Sums, zero);
		store<R, 4>(own + Moment, zero);
		store<R, 4>(own + SquareMoment, zero);
		return std::uint8_t(number);
	}

	POLYTOPE_INLINE void finish(SurfaceSums<R, 3>& sums)
	{
		CellCones<R, 3> cones(buffers_.cell);
		if (energy_) cones.clear(buffers_.planes);
		for (int k = 0; k < pieces_; ++k) {
			const R *const own = buffers_.piece + rows * k, *const first = buffers_.point + 4 * firstOf_[k];
			const int            i = planes_[k][0], j = planes_[k][1];
			SurfacePiece<R, 3>   piece;
			PieceIntegrals<R, 3> of;
			// the areas are so far twice as large, and times the normal's length
			const R length = norm<R, 3>(own + Normal), inverse = 1 / length, half = inverse / 2;
			of.area          = own[Sums + Area] * half;
			of.p             = own[Sums + Pressure] * half / 3;
			of.square        = own[Sums + Square] * half / 12;
			of.pressureThere = maxOf<R>(first[3], 0);
			if (!(of.area > 0)) continue;
			for (int m = 0; m < 3; ++m) {
				piece.normal[m] = own[Normal + m] * inverse;
				of.any[m]       = first[m];
			}
			if (isBetween(i, j)) {
				for (int m = 0; m < 3; ++m) {
					of.pMoment[m]      = of.p * first[m] + own[Moment + m] * half / 12;
					of.squareMoment[m] = of.square * first[m] + own[SquareMoment + m] * half / 60;
				}
				sums.add(piece, of);
			}
			if (!energy_) continue;
			piece.offset = dot<R, 3>(piece.normal, first);
			cones.add(i, piece, of, sums);
			if (buffers_.bodyOf[j] != FeasibleBuffers<R>::noBody) cones.add(j, piece, of, sums);
		}
	}

	FeasibleBuffers<R>& buffers_;
	bool                energy_;
	int                 pieces_ = 0;
	std::uint8_t        pieceOf_[most * most], planes_[FeasibleBuffers<R>::mostPieces][2], firstOf_[FeasibleBuffers<R>::mostPieces];
};

} // namespace polytope
