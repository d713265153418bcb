// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact/ContactNormal.hpp"
#include "PlaneRows.hpp"

#include <gtest/gtest.h>

using namespace polytope;
using namespace polytope::samples;

// The gradients of both bodies are opposite but for rounding: what is left of their sum is no direction, and the linear program's counts.
TEST(ContactNormal, GradientsThatCancelGiveNoDirection)
{
	const auto                shape    = ConvexShape::shared(cuboid(1, 1, 1), Real(0.1));
	const Matrix3             rotation = Matrix3::Identity();
	const Vector3             centre   = Vector3::UnitZ();
	const PlacedPair          in { *shape, rotation, *shape, rotation, centre };
	ContactFrame<Real, 3>     frame {};
	const ContactSettings     settings;
	const ProgramLimits<Real> limits {};
	LpBasis<Real, 3>          basis;
	PairMemory                memory;
	ContactWorkspace          workspace;
	ContactResult             out;
	Real                      x[] = { 0, 0, 0 }, dual[] = { 0, 1, 0 };
	frame.size = 1;
	for (const Real apart : { 1e-15, 1e-3 }) {
		const HalfSpaces         lower { { Vector3::UnitZ() }, { 0.05 }, 3 }, upper { { Vector3(apart, 0, 1) }, { 0.05 }, 3 };
		PlaneRows<Real, 3>       rows(lower, upper);
		Real                     n[3];
		const PairQuery<Real, 3> query { in, settings, limits, frame, rows.planes, basis, x, dual, memory, workspace, out };
		const ContactStatus      status = averagedNormal<Real, 3, 1>(query, n);
		const bool               cancel = apart < 1e-9;
		EXPECT_EQ(status, cancel ? ContactStatus::NormalFromDual : ContactStatus::Contact) << statusName(status);
		EXPECT_NEAR(n[0], cancel ? 0 : -apart, 1e-9);
		EXPECT_EQ(n[1], cancel ? 1 : 0);
	}
}
