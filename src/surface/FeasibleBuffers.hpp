// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "program/PairPlanes.hpp"
#include "surface/KeptVertices.hpp"

/// Memory for one feasible set (FeasibleSet.hpp) and for the sums over it (FeasibleSums.hpp), which the caller has: nothing here allocates.
namespace polytope {

/// A piece of the surface (FeasiblePieces.hpp) in a list: bytes i, j, first vertex, number of triangles, and the other two vertices of each.
struct FeasiblePiece {
	int                 i, j; ///< i: of the first of FeasibleBuffers::Owner
	int                 first, triangles;
	const std::uint8_t* ends; ///< of the triangles

	static constexpr int header = 4;

	POLYTOPE_INLINE explicit FeasiblePiece(const std::uint8_t* at)
	        : i(at[0]), j(at[1]), first(at[2]), triangles(at[3]), ends(at + header)
	{
	}
	/// Where the next one is.
	const std::uint8_t* end() const { return ends + 2 * triangles; }
};

template <class R> struct FeasibleBuffers {
	static constexpr int mostPlanes = tolerance::feasiblePlanes, mostVertices = tolerance::feasibleVertices;
	// four edges meet in a vertex, three faces in an edge, and there are as many faces as vertices and cells together
	static constexpr int mostPieces = mostVertices + mostPlanes, mostTriangles = 3 * 2 * mostVertices;
	static constexpr int outlineRows = 7;

	/// Whose a plane is: of body 1, of both where planes of both coincide, of body 2, of none that of no pressure. In this order the first of
	/// two is on body 1's side of a piece between them.
	enum Owner : std::uint8_t { Body1, Both, Body2, NoBody };

	int planes, vertices;

	// of the planes that are tight somewhere, in any order
	R*    plane; ///< a, d; zero: the plane of no pressure
	int   rowOf[mostPlanes];
	Owner owner[mostPlanes];

	R*            point; ///< of the vertices: x, y, z, s
	std::uint8_t  tight[mostVertices][4];
	std::uint64_t mask[mostVertices];    ///< a bit for each tight plane
	std::uint64_t dropped[mostVertices]; ///< bits of those that are not tight along one of the vertex' edges

	// pieces of its surface, one after another (FeasiblePieces.hpp); also those that its energy needs
	const std::uint8_t* pieces;
	int                 bytesOfPieces;
	bool                piecesOfEnergy;
	std::uint8_t        roomForPieces[FeasiblePiece::header * mostPieces + 2 * mostTriangles];

	// of all planes of the pair
	R*   split; ///< offsets with which no more than four planes meet
	R*   slack;
	int* localOf; ///< number among the tight ones, or −1

	R* outline; ///< outlineRows for each plane

	/// Whether an edge joins two vertices: they have three planes in common.
	bool areJoined(int v, int w) const
	{
		const std::uint64_t own = mask[v] & ~mask[w];
		return own != 0 && (own & (own - 1)) == 0;
	}

	static int numbersNeeded(int total)
	{
		return (4 + 4) * mostPlanes + 4 * mostVertices + 2 * (total + padWidth) + outlineRows * mostPlanes;
	}
	static int indicesNeeded(int total) { return total + padWidth; }

	/// Lays the buffers into memory of numbersNeeded() and indicesNeeded(), whatever is in it.
	FeasibleBuffers(int total, R* numbers, int* indices)
	{
		plane = take(numbers, 4 * mostPlanes);
		for (R*& row : component_)
			row = take(numbers, mostPlanes);
		point   = take(numbers, 4 * mostVertices);
		split   = take(numbers, total + padWidth);
		slack   = take(numbers, total + padWidth);
		outline = take(numbers, outlineRows * mostPlanes);
		localOf = indices;
	}

	/// The tight planes, copied.
	POLYTOPE_INLINE PairPlanes<R, 3> tightPlanes() const
	{
		for (int k = 0; k < planes; ++k)
			for (int m = 0; m < 4; ++m)
				component_[m][k] = plane[4 * k + m];
		return { { component_[0], component_[1], component_[2] }, component_[3], nullptr, nullptr, planes, planes };
	}

private:
	static R* take(R*& memory, int count)
	{
		R* const own = memory;
		memory += count;
		return own;
	}

	R* component_[4];
};

} // namespace polytope
