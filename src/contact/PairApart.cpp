// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact/PairApart.hpp"

#include "contact/ContactQuery.hpp"

#include <algorithm>
#include <limits>

namespace polytope {

bool staysApart(const ConvexShape& shape1, const Matrix3& rotation1, const ConvexShape& shape2, const Matrix3& rotation2,
        const Vector3& centre2, Real way, ContactWorkspace& workspace)
{
	using std::abs;
	if (!(abs(way) < std::numeric_limits<Real>::infinity())) return false;
	// balls around both bodies, as far apart as the bodies may come nearer
	const Real between = shape1.boundingRadius() + shape2.boundingRadius() + 2 * way;
	if (shape1.dimension() == 3 && centre2.squaredNorm() > between * between) return true;
	ContactSettings settings;
	settings.warmStart    = false;
	settings.programAlone = true;
	// the linear program ends as soon as s* > −tolerance × size is certain
	settings.tolerance = -way / std::min<Real>(shape1.boundingRadius(), shape2.boundingRadius());
	PairMemory    memory;
	ContactResult result;
	contactQuery(shape1, rotation1, shape2, rotation2, centre2, settings, memory, workspace, result);
	return !result.inContact && result.status == ContactStatus::Separated;
}

} // namespace polytope
