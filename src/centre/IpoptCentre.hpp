// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "numbers/Real.hpp"

/// Analytic centre the way the paper solves it (Boon et al. 2012, section 2.6, Eqs 19-36): a nonlinear program with one
/// slack variable a plane, scaled, handed to Ipopt (Wächter & Biegler 2006, Math. Program. 106:25-57). Used where
/// Newton on Eq. 10 (AnalyticCentre.hpp) does not converge, and as an independent check of it.
///
/// An optional part of the build: NoIpoptCentre.cpp replaces it where there is no Ipopt.
namespace polytope {

enum class IpoptOutcome { Converged, Failed, NotAvailable };

/// Version of Ipopt, as "3.14.17"; nullptr where the build has none.
const char* ipoptVersion();

/// argmax Σ log(d_i − a_i·x) over `count` planes a_i·x ≤ d_i with component arrays normal[k] and offsets d; neutral planes
/// (see padOffset) are left out. The frame is turned to the contact normal (last axis).
/// `x`: inside, or near it; replaced by the centre if Converged, else left alone (as where there is no inside). Adds to `iterations`.
/// May be called by any number of threads at once. Nothing is thrown or printed. Works in double whatever Real is.
__attribute__((cold)) IpoptOutcome ipoptCentre(
        int dimension, int count, const Real* const* normal, const Real* offset, Real* x, int& iterations);

} // namespace polytope
