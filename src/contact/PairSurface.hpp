// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "contact/ContactSection.hpp"
#include "contact/ContactTypes.hpp"
#include "program/LpBasis.hpp"
#include "surface/FeasibleOutline.hpp"
#include "surface/FeasibleSums.hpp"
#include "surface/NearPlanes.hpp"

/// The contact surface of a touching pair, from the optimum of its linear program.
namespace polytope {

/// What the contact surface of a pair is found from, and the surface.
template <class R, int D> struct PairSurface {
	SurfaceSums<R, D>     sums;
	SurfaceOnPiece<R, D>* on = nullptr;        ///< if internal faces are left out
	KeptVertices*         kept;                ///< of the last step, and then of this; or null
	bool                  energy;              ///< whether the energy is asked for
	bool                  outline;             ///< 3-D: whether the outline is
	R                     size;                ///< of a body that the overlap lies in
	PairPlanes<R, D>      nearest;             ///< those of the program that matter
	R*                    spare;               ///< room for a section
	const R*              corner;              ///< of its outline in mainPlane(), x, y, z of each
	int                   corners = 0, stride; ///< 0: not known
	R                     deepest;             ///< largest pressure, −s* of the program
	SurfaceStatus         status;
	SurfaceStiffness<R>*  stiffness      = nullptr; ///< 3-D: if it is asked for, where it is written to
	bool                  differentiated = false;   ///< whether it was

	POLYTOPE_INLINE PairSurface(R size_, bool energy_, bool outline_, KeptVertices* kept_)
	        : kept(kept_), energy(energy_), outline(outline_), size(size_)
	{
	}

	/// Whether a part of the pressure is on this one of several pieces.
	POLYTOPE_INLINE bool isParted() const { return on && on->pressure > 0; }

	/// Part of the solid's contact that is this contact's: all pieces add up to one.
	POLYTOPE_INLINE R share() const { return !on ? R(1) : sums.pressure > 0 ? on->pressure / sums.pressure : R(0); }
};

/// The section of the overlap by the main plane.
template <class R> POLYTOPE_INLINE void outlineOfVertices(const FeasibleBuffers<R>& set, PairSurface<R, 3>& surface)
{
	R normal[3], place[3];
	if (!surface.outline || !mainPlane<R>(surface.sums, normal, place)) return;
	const FeasibleOutline<R> outline(set, normal, place);
	surface.corner  = outline.first();
	surface.stride  = outline.stride();
	surface.corners = outline.count();
}

/// Finds the surface from the vertices of the pair's feasible set, whose tight planes are those of the last step or are found anew. False
/// if they do not say what the surface is.
template <class R, int W, class Spare>
POLYTOPE_INLINE bool surfaceOfVertices(const PairPlanes<R, 3>& all, NearPlanes<R, 3, W>* near, const int* basis, FeasibleBuffers<R>& set,
        const Spare& spare, PairSurface<R, 3>& surface)
{
	KeptVertices* const     kept   = surface.kept;
	const PairPlanes<R, 3>& planes = near ? near->planes() : all;
	FeasibleSet<R, W>       vertices(planes, surface.size, set);
	if (!(near ? vertices.explore(basis, surface.energy) : vertices.recall(*kept, all.first, surface.energy))) return false;
	FeasibleSums<R, W> sums(set, surface.energy, surface.sums);
	if (surface.on) sums.clip(planes, R(tolerance::pieceBox) * surface.size, spare(planes.total), *surface.on);
	surface.sums.kept = !near;
	if (!near) surface.deepest = vertices.largestPressure();
	surface.status  = surface.sums.pieces > 0 ? SurfaceStatus::Found : SurfaceStatus::None;
	surface.nearest = set.tightPlanes();
	if (!surface.on) outlineOfVertices<R>(set, surface);
	if (!near && surface.stiffness && !surface.on) surface.differentiated = sums.differentiate(*surface.stiffness);
	if (!near) vertices.keepPieces(*kept);
	if (near && kept) vertices.keep(*kept, all.first, [near](int row) { return near->rowOfAll(row); });
	return true;
}

/// The contact surface of the planes that matter, with room for a section of all in `spare`. `optimum`: gives the program's, or null where
/// there is none; it is asked only if the kept vertices do not say what the surface is.
template <class R, int D, int W, class Optimum>
POLYTOPE_INLINE void findSurface(
        const PairPlanes<R, D>& planes, const Optimum& optimum, ContactWorkspace& workspace, PairSurface<R, D>& surface)
{
	KeptVertices* const kept = surface.kept;
	const R             size = surface.size;
	using Near               = NearPlanes<R, D, W>;
	using Buffers            = SurfaceBuffers<R, D>;
	using Set                = FeasibleBuffers<R>;
	const int  most = planes.total + 2 * padWidth, own = Near::numbersNeeded(planes.total), ofSet = Set::numbersNeeded(most);
	R* const   numbers = workspace.polygons(own + ofSet + Buffers::numbersNeeded(most) + sectionNumbers(most));
	int* const indices = workspace.indices(Near::indicesNeeded(planes.total) + Set::indicesNeeded(most) + Buffers::indicesNeeded(most));
	R* const   walkNumbers = numbers + own + ofSet;
	int *const setIndices = indices + Near::indicesNeeded(planes.total), *const walkIndices = setIndices + Set::indicesNeeded(most);
	surface.spare = walkNumbers + Buffers::numbersNeeded(most);
	Set        set(most, numbers + own, setIndices);
	const auto spare = [&](int total) { return Buffers(total, walkNumbers, walkIndices); };
	if constexpr (D == 3) {
		if (kept && kept->vertices > 0 && !kept->exchanged
		        && surfaceOfVertices<R, W>(planes, static_cast<Near*>(nullptr), nullptr, set, spare, surface))
			return;
		if (kept) kept->vertices = 0;
	}
	const LpBasis<R, D>* const found = optimum();
	surface.status                   = SurfaceStatus::None;
	if (!found) return;
	surface.deepest     = -found->infeasibility;
	LpBasis<R, D> basis = *found;
	Near          near(planes, basis, size, numbers, indices);
	if constexpr (D == 3) {
		if (surfaceOfVertices<R, W>(planes, &near, basis.plane, set, spare, surface)) return;
	}
	surface.nearest          = near.planes();
	const SurfaceParts parts = surface.energy ? SurfaceParts::Cells : near.facing() ? SurfaceParts::Facing : SurfaceParts::Contact;
	surface.status           = contactSurface<R, D, W>(
                surface.nearest, basis.plane, D + 1, size, surface.deepest, parts, spare(surface.nearest.total), surface.sums, surface.on);
}

} // namespace polytope
