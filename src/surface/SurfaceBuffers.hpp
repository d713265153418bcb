// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "numbers/Lanes.hpp"
#include "surface/SurfaceTolerances.hpp"

#include <cstdint>

/// Memory for one contact surface (ContactSurface.hpp), which the caller has: nothing here allocates.
namespace polytope {

template <class R, int D> struct SurfaceBuffers {
	int planes; ///< padded number of planes of both bodies; the number of the plane of no pressure
	int length; ///< of a row: planes, and whole lanes for that of no pressure
	int room;   ///< for vertices of a piece, and for lines
	int pieces; ///< room for pieces, a quarter of the slots

	R*   rate[2];       ///< slack of a plane less the pressure, on the piece: rest + rate·(u, v) [m]
	R*   rest;          ///< at the foot of the origin
	R*   vertex[2][3];  ///< of a piece before and after a cut, vertexRows numbers each
	R*   line[3];       ///< of each line that bounds or bounded a piece: its rates and rest
	R*   cell;          ///< D + 2 numbers for each plane: a point of its cell, the pressure there, whether it has one
	R*   clipped[2][2]; ///< vertices of a piece before and after it is clipped (SurfaceClips.hpp)
	R*   dropped;       ///< offsets of planes that are left out
	int* lineTag;       ///< of each line: its plane
	int* edge[2];       ///< of a piece's vertices before and after a cut: the line of the edge that begins there
	int* twin;          ///< of each plane: the one that stands for it, −1: not looked for yet
	int* meeting;       ///< planes that meet in an edge
	int* queue;         ///< pieces to look at: both planes
	int* slot;          ///< where in the queue a pair of planes is, plus one; 0: free

	/// u, v and the slack of the plane that cuts.
	static constexpr int vertexRows = 3;
	static constexpr int queued     = 2 + tolerance::knownPlanes;

	static int paddedLength(int planes) { return planes + padWidth; }
	static int slots(int planes)
	{
		const int pieces = maxOf<int>(tolerance::piecesAtLeast, tolerance::piecesPerPlane * planes);
		int       count  = 1;
		while (count < 4 * pieces)
			count *= 2;
		return count;
	}
	static int vertexRoom(int planes) { return planes + 8; }
	/// A convex polygon has one vertex more for each half-space; twice that for what rounding makes of it.
	static int clippedRoom(int planes) { return 2 * (vertexRoom(planes) + 32); }
	static int numbersNeeded(int planes)
	{
		return 3 * paddedLength(planes) + (2 * vertexRows + 3) * vertexRoom(planes) + 4 * clippedRoom(planes) + (D + 2) * planes
		        + planes;
	}
	static int indicesNeeded(int planes) { return 4 * vertexRoom(planes) + planes + (queued + 4) * (slots(planes) / 4); }

	/// Lays the buffers into memory of numbersNeeded() and indicesNeeded(), whatever is in it.
	SurfaceBuffers(int total, R* numbers, int* indices)
	        : planes(total), length(paddedLength(total)), room(vertexRoom(total)), pieces(slots(total) / 4)
	{
		for (R*& row : rate)
			row = take(numbers, length);
		rest = take(numbers, length);
		for (int side = 0; side < 2; ++side) {
			for (int k = 0; k < vertexRows; ++k)
				vertex[side][k] = take(numbers, room);
			edge[side] = take(indices, room);
		}
		for (auto& side : clipped)
			for (R*& row : side)
				row = take(numbers, clippedRoom(total));
		for (R*& row : line)
			row = take(numbers, room);
		lineTag = take(indices, room);
		cell    = take(numbers, (D + 2) * planes);
		dropped = take(numbers, planes);
		twin    = take(indices, planes);
		meeting = take(indices, room);
		queue   = take(indices, queued * pieces);
		slot    = take(indices, 4 * pieces);
	}

private:
	template <class T> static T* take(T*& memory, int count)
	{
		T* const own = memory;
		memory += count;
		return own;
	}
};

} // namespace polytope
