// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact/Status.hpp"

namespace polytope {

const char* statusName(ContactStatus status)
{
	switch (status) {
		case ContactStatus::Separated: return "separated";
		case ContactStatus::Contact: return "contact";
		case ContactStatus::NormalFromOneBody: return "normalFromOneBody";
		case ContactStatus::NormalFromDual: return "normalFromDual";
		case ContactStatus::RoundingLimited: return "roundingLimited";
		case ContactStatus::CentreByIpopt: return "centreByIpopt";
		case ContactStatus::CentreNotConverged: return "centreNotConverged";
		case ContactStatus::IpoptNotAvailable: return "ipoptNotAvailable";
		case ContactStatus::LpNotConverged: return "lpNotConverged";
		case ContactStatus::NoDirection: return "noDirection";
		case ContactStatus::Failed: return "failed";
		case ContactStatus::SurfaceIncomplete: return "surfaceIncomplete";
	}
	return "unknown";
}

} // namespace polytope
