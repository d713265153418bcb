// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "numbers/Four.hpp"
#include "surface/ContactSurface.hpp"
#include "surface/FeasiblePieces.hpp"
#include "surface/FeasiblePolygon.hpp"
#include "surface/SurfaceStiffness.hpp"

/// The sums over a pair's contact surface from the triangles of its pieces (FeasiblePieces.hpp). None of them is negative, in whatever
/// order they come.
///
/// A plane of both bodies belongs to either by half: the sums are the mean of those for the plane as body 1's and as body 2's.
///
/// Volume and level are sums over cones, too, all from the set's first vertex: over each cell (where one plane is tight) in which that
/// vertex does not lie. A cell, seen along s, is a polyhedron, and the sum of the cones from its own first vertex over those of its pieces
/// in which that does not lie. So most pieces take no part. With the slack k of the first vertex, where the pressure is σ, in the cell's
/// plane,
///
///     V = Σ k/4 ∫ dV,     W = Σ k (σ/20 ∫ dV + 1/5 ∫ p dV),     the integrals over the cell.
namespace polytope {

template <class R, int W> class FeasibleSums {
public:
	/// `energy`: also overlap, volume and level.
	POLYTOPE_INLINE FeasibleSums(FeasibleBuffers<R>& buffers, bool energy, SurfaceSums<R, 3>& sums) : buffers_(buffers)
	{
		Between all;
		if (energy) {
			const FeasibleCells<R> cells(buffers);
			forEach([&](const FeasiblePiece& piece) POLYTOPE_INLINE_LAMBDA { add(piece, &cells, all, sums); });
		} else forEach([&](const FeasiblePiece& piece) POLYTOPE_INLINE_LAMBDA { add(piece, nullptr, all, sums); });
		all.give(sums);
	}

	/// What lies on a piece of a larger solid.
	POLYTOPE_APART void clip(const PairPlanes<R, 3>& planes, R box, const SurfaceBuffers<R, 3>& spare, SurfaceOnPiece<R, 3>& on)
	{
		on.reset();
		forEach([&](const FeasiblePiece& own) {
			const R            share = shareBetween(own.i, own.j);
			SurfacePiece<R, 3> piece;
			if (!(share > 0) || !placePiece<R, 3>(planes, buffers_.rowOf[own.i], buffers_.rowOf[own.j], box, piece)) return;
			on.add(piece, FeasiblePolygon<R>(buffers_, own.i, own.j, own.first, piece), spare, share);
		});
	}

	/// False where the derivative is not known.
	POLYTOPE_APART bool differentiate(SurfaceStiffness<R>& stiffness) const
	{
		stiffness.clear();
		forEach([&](const FeasiblePiece& piece) {
			const R share = shareBetween(piece.i, piece.j);
			if (share > 0) stiffness.add(buffers_, piece, share);
		});
		return stiffness.leftOut <= R(tolerance::leftOut) * stiffness.pressure;
	}

private:
	using Four  = polytope::Four<R, W>;
	using Owner = typename FeasibleBuffers<R>::Owner;

	/// SurfaceSums::add() with three components at a time.
	struct Between {
		Four areaVector, centre, mainNormal, mainCentre, force, moment, deeper, deeperTurn;
		R    area = 0, pressure = 0, weight = 0;
		int  pieces = 0;

		POLYTOPE_INLINE Between()
		{
			areaVector = centre = mainNormal = mainCentre = force = moment = deeper = deeperTurn = repeated<Four>(R(0));
		}

		/// n: its unit normal; the integrals as in PieceIntegrals, of the part that is between the bodies; `whole`: ∫ p dS of all of it.
		POLYTOPE_INLINE void add(const Four& n, R ofArea, R p, R whole, R square, const Four& pMoment, const Four& squareMoment)
		{
			const Four once = repeated<Four>(p), all = repeated<Four>(whole), half = repeated<Four>(R(1) / 2);
			area += ofArea;
			pressure += p;
			weight += p * whole;
			areaVector += repeated<Four>(ofArea) * n;
			centre += pMoment;
			mainNormal += once * all * n;
			mainCentre += all * pMoment;
			force += once * n;
			moment += crossProduct(pMoment, n);
			deeper += repeated<Four>(square) * half * n;
			deeperTurn += half * crossProduct(squareMoment, n);
			++pieces;
		}

		POLYTOPE_INLINE void give(SurfaceSums<R, 3>& sums) const
		{
			sums.area     = area;
			sums.pressure = pressure;
			sums.weight   = weight;
			sums.pieces   = pieces;
			give(areaVector, sums.areaVector);
			give(centre, sums.centre);
			give(mainNormal, sums.mainNormal);
			give(mainCentre, sums.mainCentre);
			give(force, sums.force);
			give(moment, sums.moment);
			give(deeper, sums.deeper);
			give(deeperTurn, sums.deeperTurn);
		}

	private:
		static POLYTOPE_INLINE void give(const Four& from, R (&to)[3])
		{
			for (int m = 0; m < 3; ++m)
				to[m] = from[m];
		}
	};

	template <class Use> POLYTOPE_INLINE void forEach(const Use& use) const
	{
		const std::uint8_t* const end = buffers_.pieces + buffers_.bytesOfPieces;
		for (const std::uint8_t* at = buffers_.pieces; at < end;) {
			const FeasiblePiece piece(at);
			use(piece);
			at = piece.end();
		}
	}

	/// How much of a piece of planes i and j is between the bodies: by half where one of them is of both.
	R shareBetween(int i, int j) const
	{
		const Owner one = buffers_.owner[i], other = buffers_.owner[j];
		if (one == other || one == Owner::NoBody || other == Owner::NoBody) return 0;
		return one == Owner::Both || other == Owner::Both ? R(1) / 2 : R(1);
	}

	/// Slack of a plane at a vertex; the plane of no pressure has the slack s.
	POLYTOPE_INLINE R slackAt(int v, int plane) const
	{
		const R *const x = buffers_.point + 4 * v, *const a = buffers_.plane + 4 * plane;
		return buffers_.owner[plane] == Owner::NoBody ? x[3] : a[3] - dot<R, 3>(a, x) - x[3];
	}

	/// Integrals over a piece, twice as large and times the length of its normal. PieceIntegrals.hpp has the sums.
	struct OfPiece {
		R    area = 0, pressure = 0, square = 0;
		Four moment, squareMoment; ///< about the first vertex

		POLYTOPE_INLINE OfPiece() { moment = squareMoment = repeated<Four>(R(0)); }
	};

	/// `cells`: if the energy is asked for.
	POLYTOPE_INLINE void add(const FeasiblePiece& piece, const FeasibleCells<R>* cells, Between& all, SurfaceSums<R, 3>& sums) const
	{
		const R    share  = shareBetween(piece.i, piece.j);
		const Four normal = loadFour<Four>(buffers_.plane + 4 * piece.i) - loadFour<Four>(buffers_.plane + 4 * piece.j),
		           o      = loadFour<Four>(buffers_.point + 4 * piece.first);
		const R p0        = maxOf<R>(o[3], 0);
		OfPiece of;
		for (int t = 0; t < piece.triangles; ++t) {
			const Four from  = loadFour<Four>(buffers_.point + 4 * piece.ends[2 * t]) - o,
			           to    = loadFour<Four>(buffers_.point + 4 * piece.ends[2 * t + 1]) - o;
			const Four along = normal * crossProduct(from, to);
			const R    area = abs(along[0] + along[1] + along[2]), p1 = p0 + from[3], p2 = p0 + to[3], sum = p0 + p1 + p2;
			of.area += area;
			of.pressure += area * sum;
			if (!(share > 0)) continue;
			const R second = sum * sum + p0 * p0 + p1 * p1 + p2 * p2;
			of.square += area * second;
			// from the first vertex on: there it is zero
			const Four way = from + to, mixed = repeated<Four>(p1) * from + repeated<Four>(p2) * to;
			of.moment += repeated<Four>(area) * (repeated<Four>(sum) * way + mixed);
			if (!cells) continue;
			of.squareMoment += repeated<Four>(area)
			        * (repeated<Four>(second) * way + repeated<Four>(2 * sum) * mixed + repeated<Four>(2 * p1 * p1) * from
			                + repeated<Four>(2 * p2 * p2) * to);
		}
		const Four squares = normal * normal;
		const R    length  = squares[0] + squares[1] + squares[2];
		if (!(of.area > 0 && length > 0)) return;
		if (cells) addCones(piece, *cells, of, normal, o, 1 / (6 * length), sums);
		if (!(share > 0)) return;
		const R inverse = 1 / sqrt(length), half = share * inverse / 2, p = of.pressure * half / 3, square = of.square * half / 12;
		all.add(normal * repeated<Four>(inverse), of.area * half, p, p / share, square,
		        repeated<Four>(p) * o + of.moment * repeated<Four>(half / 12),
		        repeated<Four>(square) * o + of.squareMoment * repeated<Four>(half / 60));
	}

	/// The cones over a piece from the first vertices of its cells. `third`: of the piece's true area over that of `of`, over its normal's length.
	POLYTOPE_INLINE void addCones(const FeasiblePiece& piece, const FeasibleCells<R>& cells, const OfPiece& of, const Four& normal,
	        const Four& first, R third, SurfaceSums<R, 3>& sums) const
	{
		for (int side = 0; side < 2; ++side) {
			const int cell = side ? piece.j : piece.i;
			if (!cells.hasCone(cell, side ? piece.i : piece.j)) continue;
			const Four apex = loadFour<Four>(buffers_.point + 4 * cells.firstIn[cell]), along = normal * (apex - first);
			const R    weight = abs(along[0] + along[1] + along[2]) * third, dV = weight * of.area,
			        pdV = (apex[3] * dV + weight * of.pressure) / 4, height = slackAt(0, cell);
			if (buffers_.owner[cell] == Owner::NoBody) sums.overlap += dV;
			sums.volume += height * dV / 4;
			sums.level += height * (buffers_.point[3] * dV / 20 + pdV / 5);
		}
	}

	FeasibleBuffers<R>& buffers_;
};

} // namespace polytope
