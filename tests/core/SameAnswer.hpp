// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "PrecisePair.hpp"

#include <gtest/gtest.h>

#include <cmath>

/// When two answers to one question are the same but for rounding.
namespace polytope::samples {

inline bool finite(const ContactResult& result)
{
	return result.point.allFinite() && result.normal.allFinite() && std::isfinite(result.depth) && std::isfinite(result.infeasibility)
	        && std::isfinite(result.area) && result.sectionCentroid.allFinite() && result.dualDirection.allFinite();
}

/// What two answers to one question may differ by: `roundings` of the pair's planes. The overlap's own size is the unit
/// along each axis, so a thin overlap's point is as uncertain as its thickness.
struct Allowance {
	Real roundings, local, normal, depth;

	Allowance(const Pair& pair, const PrecisePair& exact, const ContactResult& result, NormalSource source = NormalSource::DualWeights)
	{
		roundings          = 32 * tolerance::rounding * pair.reach();
		local              = 2e-9 + roundings / -result.infeasibility;
		const QuadVector x = precise(result.point), n = precise(result.normal);
		if (source == NormalSource::DualWeights) {
			QuadVector balanced;
			const Quad slip = exact.balancedNormal(x, balanced);
			normal          = 1e-14 + (slip > 0 ? Real(slip) * local : Real(2));
		} else normal = averaged(exact, x);
		const Real glance = Real(1 / exact.exit(0, x, n, 1).rate + 1 / exact.exit(1, x, n, -1).rate);
		depth             = (roundings + (local + normal * glance) * result.depth) * glance;
	}

private:
	Real averaged(const PrecisePair& exact, const QuadVector& x) const
	{
		Real    slip = 1e-14;
		Vector3 sum  = Vector3::Zero();
		for (int body = 0; body < 2; ++body) {
			const Vector3 gradient = rounded(exact.innerGradient(body, x));
			if (!(gradient.norm() > 0)) continue;
			slip += Real(exact.normalSlip(body, x, local));
			sum += (body == 0 ? 1 : -1) * gradient.normalized();
		}
		return sum.norm() > 0 ? slip / std::min(Real(1), sum.norm()) : slip; // nearly opposite gradients cancel
	}
};

/// `other` answers for the same pair in the same axes.
inline void expectSame(const PrecisePair& exact, const Allowance& allowed, const ContactResult& result, const ContactResult& other)
{
	EXPECT_NEAR(other.infeasibility, result.infeasibility, allowed.roundings);
	ASSERT_EQ(other.inContact, result.inContact);
	EXPECT_LE(Real(exact.localLength(precise(result.point), minus(precise(other.point), precise(result.point)))), allowed.local);
	// the dual's direction is not unique, and a gradient may end within what the point moves
	if (result.status != other.status || result.status == ContactStatus::NormalFromDual || allowed.normal > 0.1) return;
	EXPECT_LE((other.normal - result.normal).norm(), allowed.normal);
	EXPECT_NEAR(other.depth, result.depth, allowed.depth);
}

} // namespace polytope::samples
