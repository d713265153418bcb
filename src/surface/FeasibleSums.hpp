// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "surface/ContactSurface.hpp"
#include "surface/FeasiblePolygon.hpp"
#include "surface/SurfaceStiffness.hpp"

/// The sums over a pair's contact surface from the vertices and edges of its feasible set.
///
/// A piece of the surface between planes i and j is the set's face in which both are tight, seen along s: a polygon, whose edges are those
/// of the set that have i and j. Each edge makes a triangle with the piece's first vertex, and none of them is negative, in whatever order
/// they come.
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

template <class R> class FeasibleSums {
public:
	/// `energy`: also overlap, volume and level.
	POLYTOPE_INLINE FeasibleSums(FeasibleBuffers<R>& buffers, bool energy, SurfaceSums<R, 3>& sums) : buffers_(buffers)
	{
		std::memset(pieceOf_, unknown, std::size_t(buffers_.planes) * most);
		beginPlanes();
		if (energy) beginCells();
		for (int e = 0; e < buffers_.edges; ++e) {
			const int           v = buffers_.edge[e][0], w = buffers_.edge[e][1];
			const std::uint64_t one = buffers_.mask[v] & buffers_.mask[w], two = one & (one - 1);
			const int           i = __builtin_ctzll(one), j = __builtin_ctzll(two), k = __builtin_ctzll(two & (two - 1));
			if (isWanted(i, j)) add(v, w, i, j, energy);
			if (isWanted(i, k)) add(v, w, i, k, energy);
			if (isWanted(j, k)) add(v, w, j, k, energy);
		}
		Between all;
		for (int k = 0; k < pieces_; ++k)
			finish(k, all, sums);
		all.give(sums);
	}

	/// What lies on a piece of a larger solid.
	POLYTOPE_APART void clip(const PairPlanes<R, 3>& planes, R box, const SurfaceBuffers<R, 3>& spare, SurfaceOnPiece<R, 3>& on)
	{
		on.reset();
		for (int k = 0; k < pieces_; ++k) {
			const int          i = planes_[k][0], j = planes_[k][1];
			SurfacePiece<R, 3> piece;
			if (!(share_[k] > 0) || !placePiece<R, 3>(planes, buffers_.rowOf[i], buffers_.rowOf[j], box, piece)) continue;
			on.add(piece, FeasiblePolygon<R>(buffers_, i, j, firstOf_[k], piece), spare, share_[k]);
		}
	}

	/// False where the derivative is not known.
	POLYTOPE_APART bool differentiate(SurfaceStiffness<R>& stiffness) const
	{
		stiffness.clear();
		for (int k = 0; k < pieces_; ++k)
			if (share_[k] > 0) stiffness.add(buffers_, planes_[k][0], planes_[k][1], firstOf_[k], share_[k]);
		return stiffness.leftOut <= R(tolerance::leftOut) * stiffness.pressure;
	}

private:
	using Four                   = typename Lanes<R, 4>::Type;
	using Owner                  = typename FeasibleBuffers<R>::Owner;
	static constexpr int unknown = 255, most = FeasibleBuffers<R>::mostPlanes, rows = FeasibleBuffers<R>::pieceRows;
	static_assert(FeasibleBuffers<R>::mostPieces < unknown);

	/// Where the sums of a piece begin in its row: four numbers for each.
	enum Row { Sums = 0, Moment = 4, SquareMoment = 8, Normal = 12 };
	/// Where each sum is among those of a piece.
	enum Sum { Area = 0, Pressure, Square };

	static std::uint64_t bit(int plane) { return std::uint64_t(1) << plane; }

	/// How much of a piece of planes i and j is between the bodies: by half where one of them is of both.
	R shareBetween(int i, int j) const
	{
		const Owner one = buffers_.owner[i], other = buffers_.owner[j];
		if (one == other || one == Owner::NoBody || other == Owner::NoBody) return 0;
		return one == Owner::Both || other == Owner::Both ? R(1) / 2 : R(1);
	}
	/// Whether a cone from the cell's first vertex over its piece with plane j is to be added.
	bool hasCone(int cell, int j) const { return (coned_[cell] & bit(j)) != 0; }
	bool isWanted(int i, int j) const { return ((wanted_[i] >> j | wanted_[j] >> i) & 1) != 0; }

	/// The pieces between the bodies.
	POLYTOPE_INLINE void beginPlanes()
	{
		std::uint64_t of[4] = { 0, 0, 0, 0 };
		for (int i = 0; i < buffers_.planes; ++i)
			of[buffers_.owner[i]] |= bit(i);
		const std::uint64_t ofBodies = of[Owner::Body1] | of[Owner::Both] | of[Owner::Body2];
		for (int i = 0; i < buffers_.planes; ++i) {
			const Owner owner = buffers_.owner[i];
			wanted_[i]        = owner == Owner::NoBody ? 0 : ofBodies & ~of[owner];
			coned_[i]         = 0;
		}
	}

	/// The pieces that a cell has to be summed over, and the cone to it.
	POLYTOPE_INLINE void beginCells()
	{
		std::uint64_t seen = buffers_.mask[0], all = ~std::uint64_t(0) >> (64 - buffers_.planes);
		for (int v = 1; seen != all && v < buffers_.vertices; ++v)
			for (std::uint64_t fresh = buffers_.mask[v] & ~seen; fresh; fresh &= fresh - 1) {
				const int i = __builtin_ctzll(fresh);
				firstIn_[i] = std::uint8_t(v);
				coned_[i]   = ~buffers_.mask[v];
				wanted_[i] |= coned_[i];
				height_[i] = slackAt(0, i);
				seen |= bit(i);
			}
	}

	/// Slack of a plane at a vertex; the plane of no pressure has the slack s.
	POLYTOPE_INLINE R slackAt(int v, int plane) const
	{
		const R *const x = buffers_.point + 4 * v, *const a = buffers_.plane + 4 * plane;
		return buffers_.owner[plane] == Owner::NoBody ? x[3] : a[3] - dot<R, 3>(a, x) - x[3];
	}

	/// The triangle of edge v w in the piece of planes i and j. PieceIntegrals.hpp has the sums.
	POLYTOPE_INLINE void add(int v, int w, int i, int j, bool energy)
	{
		std::uint8_t& known = pieceOf_[i * most + j];
		if (known == unknown) known = begin(v, i, j);
		const int first = firstOf_[known];
		if (v == first || w == first) return;
		R* const   own  = buffers_.piece + rows * known;
		const Four o    = load<R, 4>(buffers_.point + 4 * first);
		const Four from = load<R, 4>(buffers_.point + 4 * v) - o, to = load<R, 4>(buffers_.point + 4 * w) - o;
		const Four along = load<R, 4>(own + Normal) * crossProduct<R>(from, to);
		const R    area = abs(along[0] + along[1] + along[2]), p0 = maxOf<R>(o[3], 0), p1 = p0 + from[3], p2 = p0 + to[3],
		        sum = p0 + p1 + p2;
		if (!(share_[known] > 0)) {
			own[Sums + Area] += area;
			own[Sums + Pressure] += area * sum;
			return;
		}
		const R    second = sum * sum + p0 * p0 + p1 * p1 + p2 * p2;
		const Four sums   = four<R>(R(1), sum, second, R(0));
		store<R, 4>(own + Sums, Four(load<R, 4>(own + Sums) + broadcast<R, 4>(area) * sums));
		// from the first vertex on: there it is zero
		const Four way = from + to, mixed = broadcast<R, 4>(p1) * from + broadcast<R, 4>(p2) * to;
		store<R, 4>(own + Moment, Four(load<R, 4>(own + Moment) + broadcast<R, 4>(area) * (broadcast<R, 4>(sum) * way + mixed)));
		if (!energy) return;
		const Four squares = broadcast<R, 4>(second) * way + broadcast<R, 4>(2 * sum) * mixed + broadcast<R, 4>(2 * p1 * p1) * from
		        + broadcast<R, 4>(2 * p2 * p2) * to;
		store<R, 4>(own + SquareMoment, Four(load<R, 4>(own + SquareMoment) + broadcast<R, 4>(area) * squares));
	}

	/// Number of a new piece.
	POLYTOPE_INLINE std::uint8_t begin(int vertex, int i, int j)
	{
		const int  number  = pieces_++;
		const bool turned  = buffers_.owner[i] > buffers_.owner[j];
		planes_[number][0] = std::uint8_t(turned ? j : i);
		planes_[number][1] = std::uint8_t(turned ? i : j);
		firstOf_[number]   = std::uint8_t(vertex);
		share_[number]     = shareBetween(i, j);
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

	/// SurfaceSums::add() with three components at a time.
	struct Between {
		Four areaVector, centre, mainNormal, mainCentre, force, moment, deeper, deeperTurn;
		R    area = 0, pressure = 0, weight = 0;
		int  pieces = 0;

		POLYTOPE_INLINE Between()
		{
			areaVector = centre = mainNormal = mainCentre = force = moment = deeper = deeperTurn = broadcast<R, 4>(R(0));
		}

		/// n: its unit normal; the integrals as in PieceIntegrals, of the part that is between the bodies; `whole`: ∫ p dS of all of it.
		POLYTOPE_INLINE void add(const Four& n, R ofArea, R p, R whole, R square, const Four& pMoment, const Four& squareMoment)
		{
			const Four once = broadcast<R, 4>(p), all = broadcast<R, 4>(whole), half = broadcast<R, 4>(R(1) / 2);
			area += ofArea;
			pressure += p;
			weight += p * whole;
			areaVector += broadcast<R, 4>(ofArea) * n;
			centre += pMoment;
			mainNormal += once * all * n;
			mainCentre += all * pMoment;
			force += once * n;
			moment += crossProduct<R>(pMoment, n);
			deeper += broadcast<R, 4>(square) * half * n;
			deeperTurn += half * crossProduct<R>(squareMoment, n);
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

	/// What a piece adds, now that its triangles are there. The areas are so far twice as large, and times the normal's length.
	POLYTOPE_INLINE void finish(int k, Between& all, SurfaceSums<R, 3>& sums) const
	{
		const R *const own = buffers_.piece + rows * k, *const first = buffers_.point + 4 * firstOf_[k];
		const R length = dot<R, 3>(own + Normal, own + Normal);
		if (!(own[Sums + Area] > 0 && length > 0)) return;
		addCones(planes_[k][0], planes_[k][1], own, first, 1 / (6 * length), sums);
		if (!(share_[k] > 0)) return;
		const R inverse = 1 / sqrt(length), half = share_[k] * inverse / 2, p = own[Sums + Pressure] * half / 3,
		        square = own[Sums + Square] * half / 12;
		const Four x   = load<R, 4>(first);
		all.add(load<R, 4>(own + Normal) * broadcast<R, 4>(inverse), own[Sums + Area] * half, p, p / share_[k], square,
		        broadcast<R, 4>(p) * x + load<R, 4>(own + Moment) * broadcast<R, 4>(half / 12),
		        broadcast<R, 4>(square) * x + load<R, 4>(own + SquareMoment) * broadcast<R, 4>(half / 60));
	}

	/// The cones over a piece from the first vertices of its cells. `third`: of the piece's true area over that of `own`, over its normal's length.
	POLYTOPE_INLINE void addCones(int i, int j, const R* own, const R* first, R third, SurfaceSums<R, 3>& sums) const
	{
		for (int side = 0; side < 2; ++side) {
			const int cell = side ? j : i;
			if (!hasCone(cell, side ? i : j)) continue;
			const R* const apex = buffers_.point + 4 * firstIn_[cell];
			R              far  = 0;
			for (int m = 0; m < 3; ++m)
				far += own[Normal + m] * (apex[m] - first[m]);
			const R weight = abs(far) * third, dV = weight * own[Sums + Area],
			        pdV = (apex[3] * dV + weight * own[Sums + Pressure]) / 4, height = height_[cell];
			if (buffers_.owner[cell] == Owner::NoBody) sums.overlap += dV;
			sums.volume += height * dV / 4;
			sums.level += height * (buffers_.point[3] * dV / 20 + pdV / 5);
		}
	}

	FeasibleBuffers<R>& buffers_;
	int                 pieces_ = 0;
	std::uint8_t        pieceOf_[most * most], planes_[FeasibleBuffers<R>::mostPieces][2], firstOf_[FeasibleBuffers<R>::mostPieces];
	R                   share_[FeasibleBuffers<R>::mostPieces]; ///< that is between the bodies
	std::uint64_t       wanted_[most];                          ///< planes with which it has pieces that take part
	std::uint64_t       coned_[most];                           ///< as a cell: planes with which its piece, if there is one, has a cone
	std::uint8_t        firstIn_[most];                         ///< vertex of a cell
	R                   height_[most];                          ///< slack of the first vertex in a cell's plane
};

} // namespace polytope
