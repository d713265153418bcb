// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "contact/ContactSection.hpp"
#include "contact/ContactTypes.hpp"
#include "program/LpBasis.hpp"
#include "surface/ContactSurface.hpp"
#include "surface/NearPlanes.hpp"

/// The contact surface of a touching pair, from the optimum of its linear program.
namespace polytope {

/// Of a pair: what its surface is found from, and the surface.
template <class R, int D> struct PairSurface {
	SurfaceSums<R, D>     sums;
	SurfaceOnPiece<R, D>* on = nullptr; ///< if internal faces are left out
	PairPlanes<R, D>      nearest;      ///< those of the program that matter
	R*                    spare;        ///< room for a section
	R                     deepest;      ///< −s*
	R                     size;         ///< of a body that the overlap lies in
	SurfaceStatus         status;

	/// Part of the solid's contact that is this contact's: all pieces add up to one.
	POLYTOPE_INLINE R share() const { return !on ? R(1) : sums.pressure > 0 ? on->pressure / sums.pressure : R(0); }
};

/// The contact surface of the planes that matter, with room for a section of all in `spare`; energy only if asked for. `kept`: ContactSurface.hpp.
template <class R, int D, int W>
POLYTOPE_INLINE void findSurface(const PairPlanes<R, D>& planes, const LpBasis<R, D>& optimum, R size, bool energy, KeptSurface* kept,
        ContactWorkspace& workspace, PairSurface<R, D>& surface)
{
	using Near     = NearPlanes<R, D, W>;
	using Buffers  = SurfaceBuffers<R, D>;
	const int most = planes.total + 2 * padWidth, own = Near::numbersNeeded(planes.total),
	          ownIndices  = Near::indicesNeeded(planes.total);
	R* const      numbers = workspace.polygons(own + Buffers::numbersNeeded(most) + sectionNumbers(most));
	int* const    indices = workspace.indices(ownIndices + Buffers::indicesNeeded(most));
	LpBasis<R, D> basis   = optimum;
	Near          near(planes, basis, size, numbers, indices);
	surface.nearest = near.planes();
	surface.spare   = numbers + own + Buffers::numbersNeeded(most);
	surface.deepest = -optimum.infeasibility;
	surface.size    = size;
	const Buffers      buffers(surface.nearest.total, numbers + own, indices + ownIndices);
	const SurfaceParts parts = energy ? SurfaceParts::Cells : near.facing() ? SurfaceParts::Facing : SurfaceParts::Contact;
	surface.status           = contactSurface<R, D, W>(
                surface.nearest, basis.plane, D + 1, size, surface.deepest, parts, buffers, surface.sums, kept, near.names(), surface.on);
}

} // namespace polytope
