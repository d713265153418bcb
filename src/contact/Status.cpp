// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact/Status.hpp"

namespace polytope {

namespace {

	/// Names in the order of ContactStatus.
	constexpr const char* statusNames[]
	        = { "separated", "contact", "normalFromOneBody", "normalFromDual", "roundingLimited", "centreByIpopt", "centreNotConverged",
		          "ipoptNotAvailable", "lpNotConverged", "noDirection", "failed", "surfaceIncomplete" };
	static_assert(sizeof(statusNames) / sizeof(*statusNames) == contactStatusCount, "each status has a name");

} // namespace

const char* statusName(ContactStatus status)
{
	const int k = int(status);
	return k >= 0 && k < contactStatusCount ? statusNames[k] : "unknown";
}

} // namespace polytope
