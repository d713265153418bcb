// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "surface/FeasibleBuffers.hpp"

#include <cstring>

/// The pieces of a pair's contact surface, as triangles between vertices of its feasible set.
///
/// A piece between planes i and j is the set's face in which both are tight, seen along s: a polygon, whose edges are those of the set that have i and j.
/// Each edge makes a triangle with the piece's first vertex; the two that end in it make none. Which pieces there are, and between which vertices, follows
/// from the planes that are tight in each vertex: it is kept with these from step to step (KeptVertices.hpp).
namespace polytope {

/// The cells of a set: in each of them one plane is tight.
template <class R> struct FeasibleCells {
	static constexpr int most = FeasibleBuffers<R>::mostPlanes;

	std::uint64_t coned[most];   ///< planes with which its piece, if there is one, has a cone from the cell's first vertex
	std::uint8_t  firstIn[most]; ///< that vertex
	std::uint64_t cells = 0;     ///< those in which the set's first vertex does not lie

	POLYTOPE_INLINE explicit FeasibleCells(const FeasibleBuffers<R>& set)
	{
		std::uint64_t seen = set.mask[0], all = ~std::uint64_t(0) >> (64 - set.planes);
		for (int v = 1; seen != all && v < set.vertices; ++v)
			for (std::uint64_t fresh = set.mask[v] & ~seen; fresh; fresh &= fresh - 1) {
				const int i = __builtin_ctzll(fresh);
				firstIn[i]  = std::uint8_t(v);
				coned[i]    = ~set.mask[v];
				cells |= std::uint64_t(1) << i;
				seen |= std::uint64_t(1) << i;
			}
	}

	/// Whether a cone over the cell's piece with plane j is to be added.
	bool hasCone(int cell, int j) const { return ((cells >> cell) & 1) != 0 && ((coned[cell] >> j) & 1) != 0; }
};

/// Lists the pieces between the bodies, and with `energy` those that have cones, by the planes of the vertices alone.
template <class R> class FeasiblePieces {
public:
	POLYTOPE_INLINE FeasiblePieces(FeasibleBuffers<R>& set, bool energy) : set_(set)
	{
		std::memset(pieceOf_, unknown, std::size_t(set.planes) * most);
		beginPlanes();
		if (energy) beginCells();
		for (int v = 1; v < set.vertices; ++v)
			for (int w = 0; w < v; ++w) {
				if (!set.areJoined(v, w)) continue;
				const std::uint64_t one = set.mask[v] & set.mask[w], two = one & (one - 1);
				const int i = __builtin_ctzll(one), j = __builtin_ctzll(two), k = __builtin_ctzll(two & (two - 1));
				if (isWanted(i, j)) add(v, w, i, j);
				if (isWanted(i, k)) add(v, w, i, k);
				if (isWanted(j, k)) add(v, w, j, k);
			}
		write();
		set.piecesOfEnergy = energy;
	}

private:
	using Owner                  = typename FeasibleBuffers<R>::Owner;
	static constexpr int unknown = 255, most = FeasibleBuffers<R>::mostPlanes, mostPieces = FeasibleBuffers<R>::mostPieces;
	static_assert(mostPieces < unknown);

	static std::uint64_t bit(int plane) { return std::uint64_t(1) << plane; }

	bool isWanted(int i, int j) const { return ((wanted_[i] >> j | wanted_[j] >> i) & 1) != 0; }

	POLYTOPE_INLINE void beginPlanes()
	{
		std::uint64_t of[4] = { 0, 0, 0, 0 };
		for (int i = 0; i < set_.planes; ++i)
			of[set_.owner[i]] |= bit(i);
		const std::uint64_t ofBodies = of[Owner::Body1] | of[Owner::Both] | of[Owner::Body2];
		for (int i = 0; i < set_.planes; ++i) {
			const Owner owner = set_.owner[i];
			wanted_[i]        = owner == Owner::NoBody ? 0 : ofBodies & ~of[owner];
		}
	}

	POLYTOPE_INLINE void beginCells()
	{
		const FeasibleCells<R> cells(set_);
		for (std::uint64_t left = cells.cells; left; left &= left - 1) {
			const int i = __builtin_ctzll(left);
			wanted_[i] |= cells.coned[i];
		}
	}

	POLYTOPE_INLINE void add(int v, int w, int i, int j)
	{
		std::uint8_t& known = pieceOf_[i * most + j];
		if (known == unknown) known = begin(v, i, j);
		std::uint8_t* const own = header_[known];
		if (v == own[2] || w == own[2]) return;
		++own[3];
		std::uint8_t* const triangle = triangle_[triangles_++];
		triangle[0]                  = known;
		triangle[1]                  = std::uint8_t(v);
		triangle[2]                  = std::uint8_t(w);
	}

	/// Number of a new piece.
	POLYTOPE_INLINE std::uint8_t begin(int vertex, int i, int j)
	{
		const bool          turned = set_.owner[i] > set_.owner[j];
		std::uint8_t* const own    = header_[pieces_];
		own[0]                     = std::uint8_t(turned ? j : i);
		own[1]                     = std::uint8_t(turned ? i : j);
		own[2]                     = std::uint8_t(vertex);
		own[3]                     = 0;
		return std::uint8_t(pieces_++);
	}

	/// Puts the triangles behind their pieces.
	POLYTOPE_INLINE void write()
	{
		std::uint8_t* next[mostPieces];
		std::uint8_t* to = set_.roomForPieces;
		for (int k = 0; k < pieces_; ++k) {
			std::memcpy(to, header_[k], FeasiblePiece::header);
			next[k] = to + FeasiblePiece::header;
			to      = next[k] + 2 * header_[k][3];
		}
		set_.pieces        = set_.roomForPieces;
		set_.bytesOfPieces = int(to - set_.pieces);
		for (int t = 0; t < triangles_; ++t) {
			std::uint8_t*& at = next[triangle_[t][0]];
			*at++             = triangle_[t][1];
			*at++             = triangle_[t][2];
		}
	}

	FeasibleBuffers<R>& set_;
	int                 pieces_ = 0, triangles_ = 0;
	std::uint8_t        pieceOf_[most * most], header_[mostPieces][FeasiblePiece::header];
	std::uint8_t        triangle_[FeasibleBuffers<R>::mostTriangles][3]; ///< piece, two vertices
	std::uint64_t       wanted_[most];                                   ///< planes with which it has pieces that take part
};

} // namespace polytope
