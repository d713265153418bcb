// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact/PairApart.hpp"

#include "contact/ContactQuery.hpp"

#include <algorithm>
#include <limits>

namespace polytope {

bool staysApart(const PlacedPair& pair, Real way, ContactWorkspace& workspace)
{
	using std::abs;
	const ConvexShape &shape1 = *pair.shape[0], &shape2 = *pair.shape[1];
	if (!(abs(way) < std::numeric_limits<Real>::infinity())) return false;
	// balls around both bodies, as far apart as the bodies may come nearer
	const Real between = shape1.boundingRadius() + shape2.boundingRadius() + 2 * way;
	if (shape1.dimension() == 3 && pair.centre2->squaredNorm() > between * between) return true;
	ContactSettings settings;
	settings.warmStart    = false;
	settings.programAlone = true;
	// the linear program ends as soon as s* > −tolerance × size is certain
	settings.tolerance = -way / std::min<Real>(shape1.boundingRadius(), shape2.boundingRadius());
	PairMemory    memory;
	ContactResult result;
	contactQuery(pair, settings, memory, workspace, result);
	return !result.inContact && result.status == ContactStatus::Separated;
}

} // namespace polytope
