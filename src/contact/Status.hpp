// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "numbers/Export.hpp"

namespace polytope {

/// How one contact query ended. answered() says which of these are the answer that was asked for; the names are what scripts read.
enum class ContactStatus : int {
	Separated = 0,      ///< s* ≥ −tolerance: no contact
	Contact,            ///< the surface was found, or, boon2012, the centre converged and both inner potentials gave a normal
	NormalFromOneBody,  ///< boon2012: the point lies deeper than cornerRadius in one body, the normal is the other body's gradient
	NormalFromDual,     ///< boon2012: deeper than cornerRadius in both, or the gradients cancel: the normal is the LP's dual direction
	RoundingLimited,    ///< the overlap is so thin that rounding ended Newton's iterations: the centre is as accurate as the planes
	CentreByIpopt,      ///< Newton did not converge to the analytic centre, Ipopt found it
	CentreNotConverged, ///< Ipopt, too, found no analytic centre: the LP's point was used instead
	IpoptNotAvailable,  ///< Newton did not converge (or Ipopt was asked for), this build has no Ipopt: the LP's point was used instead
	LpNotConverged,     ///< the simplex reached its pivot limit: the bound reached so far was used
	NoDirection,        ///< coincident bodies: no separating direction exists; the line of centres or the z axis was used
	Failed,             ///< no finite answer: treated as separated and counted
	SurfaceIncomplete,  ///< foundation, spring: a part of the contact surface was not found; the force is that of the rest
};

constexpr int contactStatusCount = int(ContactStatus::SurfaceIncomplete) + 1;

/// Whether the query found what it was asked for. Where it did not, there is a substitute that a run can go on with (the linear program's
/// point, an arbitrary direction), or, where it failed, none; every count of queries without an answer is a count of these.
constexpr bool answered(ContactStatus status)
{
	switch (status) {
		case ContactStatus::Separated:
		case ContactStatus::Contact:
		case ContactStatus::NormalFromOneBody:
		case ContactStatus::NormalFromDual:
		case ContactStatus::RoundingLimited:
		case ContactStatus::CentreByIpopt: return true;
		default: return false;
	}
}

/// The name scripts see, e.g. "contact".
POLYTOPE_API const char* statusName(ContactStatus status);

} // namespace polytope
