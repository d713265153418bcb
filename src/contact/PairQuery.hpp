// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "contact/ContactFrame.hpp"
#include "contact/ContactTypes.hpp"
#include "program/LpBasis.hpp"
#include "program/PairPlanes.hpp"

/// What the stages of one query share.
namespace polytope {

/// Lengths that the program's answers are judged by [m].
template <class R> struct ProgramLimits {
	R tolerance;    ///< the bodies touch where s* < −tolerance
	R dismissAbove; ///< a lower bound of s* above this ends the linear program
	R reach;        ///< no point of the overlap is farther from any plane (a wall's only plane: than the body is wide)
};

template <class R, int D>
POLYTOPE_INLINE ProgramLimits<R> programLimits(const PlacedPair& in, const ContactSettings& settings, const ContactFrame<R, D>& f)
{
	const R tolerance = settings.tolerance * f.size;
	const R larger    = in.shape[1 - f.home]->boundingRadius();
	return { tolerance, settings.geometryAcrossGap ? R(padOffset) : -tolerance, 2 * (larger < R(padOffset) ? larger : f.size) };
}

/// Which pair is asked about and what is asked, how far its linear program and its contact point are, and where memory and answer go. All
/// are references to variables of contactKernel(), which the compiler keeps in registers as if each stage had been given them one by one; a
/// function that is not inlined takes a copy, so that their addresses do not leave the others.
template <class R, int D> struct PairQuery {
	const PlacedPair&       in;
	const ContactSettings&  settings;
	const ProgramLimits<R>& limits;
	ContactFrame<R, D>&     frame;
	PairPlanes<R, D>&       planes; ///< in the frame; so are basis, x and dual
	LpBasis<R, D>&          basis;
	R*                      x;    ///< the linear program's point, then the contact point
	R*                      dual; ///< n_λ
	PairMemory&             memory;
	ContactWorkspace&       workspace;
	ContactResult&          out;
};

} // namespace polytope
