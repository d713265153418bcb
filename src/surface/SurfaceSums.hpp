// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "surface/PieceIntegrals.hpp"

/// What is summed over the pieces of a contact surface (ContactSurface.hpp). Lengths in the planes' frame [m]; per metre of thickness in 2-D,
/// where each unit has one m less.
namespace polytope {

/// a × b; in 2-D its component along z.
template <class R, int D> POLYTOPE_INLINE void addCross(const R* a, const R* b, R* sum)
{
	if constexpr (D == 2) sum[0] += a[0] * b[1] - a[1] * b[0];
	else
		for (int k = 0; k < 3; ++k) {
			const int l = (k + 1) % 3, m = (k + 2) % 3;
			sum[k] += a[l] * b[m] - a[m] * b[l];
		}
}

template <class R, int D> struct SurfaceSums {
	static constexpr int turns = D == 3 ? 3 : 1;

	// over the contact surface, where the least slacks of both bodies are p; n its unit normal from body 1 to body 2
	R area              = 0;  ///< ∫ dS [m²]
	R areaVector[D]     = {}; ///< ∫ n dS
	R pressure          = 0;  ///< ∫ p dS [m³]
	R centre[D]         = {}; ///< ∫ p x dS [m⁴]
	R force[D]          = {}; ///< ∫ p n dS = −∂V/∂(centre 2) [m³], V the volume below
	R moment[turns]     = {}; ///< ∫ x × p n dS, about the frame's origin [m⁴]
	R deeper[D]         = {}; ///< ∫ ½ p² n dS = −∂W/∂(centre 2) [m⁴]
	R deeperTurn[turns] = {}; ///< ∫ x × ½ p² n dS [m⁵]
	// sums over the pieces, each weighted by the square of its ∫ p dS: for a face on a face, even if they tilt, the piece between the two faces counts
	// almost alone. The mean of n over the whole surface does not have this property: what the edges add makes it normal to the larger face
	R    weight        = 0;  ///< [m⁶]
	R    mainNormal[D] = {}; ///< times n
	R    mainCentre[D] = {}; ///< times the piece's centre of pressure
	int  pieces        = 0;
	bool kept          = false; ///< the vertices are those of the last step (KeptVertices)

	// over all cells, if asked for
	R overlap = 0; ///< ∫ dV over the overlap [m³]
	R volume  = 0; ///< V = ∫ p dV, p the least slack of both bodies [m⁴]
	R level   = 0; ///< W = ∫ ½ p² dV [m⁵]

	/// Sum of the area vectors that ought to close the space of body 1's cells, and body 2's, over the areas.
	R open = 0;

	/// Adds a piece between the bodies.
	POLYTOPE_INLINE void add(const SurfacePiece<R, D>& piece, const PieceIntegrals<R, D>& of)
	{
		const R half        = R(1) / 2;
		R       turn[turns] = {}, deeperOnce[turns] = {};
		area += of.area;
		pressure += of.p;
		weight += of.p * of.p;
		addCross<R, D>(of.pMoment, piece.normal, turn);
		addCross<R, D>(of.squareMoment, piece.normal, deeperOnce);
		for (int k = 0; k < D; ++k) {
			areaVector[k] += of.area * piece.normal[k];
			centre[k] += of.pMoment[k];
			mainNormal[k] += of.p * of.p * piece.normal[k];
			mainCentre[k] += of.p * of.pMoment[k];
			force[k] += of.p * piece.normal[k];
			deeper[k] += half * of.square * piece.normal[k];
		}
		for (int k = 0; k < turns; ++k) {
			moment[k] += turn[k];
			deeperTurn[k] += half * deeperOnce[k];
		}
		++pieces;
	}

	/// The mean of two.
	POLYTOPE_INLINE void average(const SurfaceSums& other)
	{
		const auto mean = [](R& a, R b) { a += (b - a) / 2; };
		mean(area, other.area);
		mean(pressure, other.pressure);
		mean(weight, other.weight);
		mean(overlap, other.overlap);
		mean(volume, other.volume);
		mean(level, other.level);
		for (int k = 0; k < D; ++k) {
			mean(areaVector[k], other.areaVector[k]);
			mean(centre[k], other.centre[k]);
			mean(mainNormal[k], other.mainNormal[k]);
			mean(mainCentre[k], other.mainCentre[k]);
			mean(force[k], other.force[k]);
			mean(deeper[k], other.deeper[k]);
		}
		for (int k = 0; k < turns; ++k) {
			mean(moment[k], other.moment[k]);
			mean(deeperTurn[k], other.deeperTurn[k]);
		}
		open = maxOf<R>(open, other.open);
		pieces += other.pieces;
	}
};

/// The cells as cones over their pieces, from a point of the cell itself, so that no term is negative and none cancels another. With the height H
/// of the cone, p = σ at its apex, and t the part of the way from there to the base,
///
///     ∫ dV = H ∫ t^(D−1) dt A,     ∫ p dV = H ∫∫ (σ (1 − t) + t p) t^(D−1) dt dS,     likewise ∫ p² dV.
template <class R, int D> class CellCones {
public:
	/// `cells`: D + 2 numbers for each plane: a point of its cell, the pressure there, whether it has one.
	explicit CellCones(R* cells) : cells_(cells) { }

	POLYTOPE_INLINE void clear(int planes)
	{
		for (int k = 0; k < planes; ++k)
			cells_[(D + 2) * k + D + 1] = 0;
	}

	/// The cone from cell i's apex; the first piece of a cell gives the apex.
	POLYTOPE_INLINE void add(int i, const SurfacePiece<R, D>& piece, const PieceIntegrals<R, D>& of, SurfaceSums<R, D>& sums) const
	{
		R* const cell = cells_ + (D + 2) * i;
		if (cell[D + 1] == 0) {
			for (int k = 0; k < D; ++k)
				cell[k] = of.any[k];
			cell[D]     = of.pressureThere;
			cell[D + 1] = 1;
			return;
		}
		R height = -piece.offset;
		for (int k = 0; k < D; ++k)
			height += piece.normal[k] * cell[k];
		height       = abs(height);
		const R apex = cell[D];
		sums.overlap += height * of.area / D;
		sums.volume += height * (apex * of.area / (D * (D + 1)) + of.p / (D + 1));
		sums.level += height
		        * (apex * apex * of.area / (D * (D + 1) * (D + 2)) + apex * of.p / ((D + 1) * (D + 2)) + of.square / (2 * (D + 2)));
	}

private:
	R* cells_;
};

} // namespace polytope
