// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "program/PlaneCode.hpp"
#include "surface/SurfaceTolerances.hpp"

#include <array>
#include <cstdint>
#include <limits>

/// Which planes are tight in the vertices of a pair's last feasible set, and the pieces of its surface. From step to step they seldom
/// change: then FeasibleSet::recall() has the contact surface without looking for it.
namespace polytope {

/// Values, no pointers: copied and saved with the interaction. Any value without pieces is safe; pieces are taken as they are, so they are not
/// saved, but made again.
struct KeptVertices {
	static constexpr int mostPlanes = tolerance::feasiblePlanes, mostVertices = tolerance::feasibleVertices, noPressure = 65535,
	                     mostOfBody = 32767,
	                     mostBytes  = std::numeric_limits<std::uint8_t>::max(); // of pieces, as bytesOfPieces can say

	std::uint8_t  planes        = 0; ///< that are tight somewhere
	std::uint8_t  vertices      = 0; ///< 0: nothing is kept
	std::uint8_t  exchanged     = 0; ///< whether the bodies are in the other order than they were then
	std::uint8_t  ofEnergy      = 0; ///< whether the pieces that the energy needs are there, too
	std::uint8_t  bytesOfPieces = 0; ///< 0: the pieces are not known
	std::uint64_t shared        = 0; ///< a bit for each of those planes with which one of the other body coincides

	/// Codes of planes (PlaneCode.hpp), or noPressure.
	std::array<std::uint16_t, mostPlanes> plane;
	/// Places of four planes in that list; the plane of no pressure comes last.
	std::array<std::array<std::uint8_t, 4>, mostVertices> tight;
	/// Pieces of the surface (FeasiblePieces.hpp).
	std::array<std::uint8_t, mostBytes> piece;

	/// Row of a plane among all of a pair, that of no pressure being `total`; −1 if there is none.
	int row(int k, int rowsOfBody1, int total) const
	{
		const int name = plane[std::size_t(k)];
		if (name == noPressure) return total;
		const int own = rowOfCode(name, rowsOfBody1);
		return own < (bodyOfCode(name) ? total : rowsOfBody1) ? own : -1;
	}

	/// Whether these have planes of the body that others have not.
	bool hasOtherPlanesThan(const KeptVertices& others, int body) const
	{
		const auto name      = [](const KeptVertices& of, int k) { return of.plane[std::size_t(k)] ^ of.exchanged; };
		const auto inAnOther = [&](int k) {
			for (int j = 0; j < (others.vertices > 0 ? others.planes : 0); ++j)
				if (name(others, j) == name(*this, k)) return true;
			return false;
		};
		for (int k = 0; k < planes; ++k)
			if (plane[std::size_t(k)] != noPressure && bodyOfCode(name(*this, k)) == body && !inAnOther(k)) return true;
		return false;
	}

	/// The code of a row; −1 if it has none that fits.
	static int name(int row, int rowsOfBody1)
	{
		const int code = codeOfRow(row, rowsOfBody1);
		return planeOfCode(code) < mostOfBody ? code : -1;
	}
};

} // namespace polytope
