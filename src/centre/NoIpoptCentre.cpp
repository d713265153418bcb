// SPDX-License-Identifier: GPL-2.0-or-later
//
// IpoptCentre.hpp in a build without Ipopt.
#include "centre/IpoptCentre.hpp"

namespace polytope {

const char* ipoptVersion() { return nullptr; }

IpoptOutcome ipoptCentre(int, int, const Real* const*, const Real*, Real*, int&) { return IpoptOutcome::NotAvailable; }

} // namespace polytope
