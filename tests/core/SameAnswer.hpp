// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "PrecisePair.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <map>
#include <string>

/// When two answers to one question are the same but for rounding, and how often that cannot be said.
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

	Allowance(const Pair& pair, const PrecisePair& exact, const ContactResult& result)
	{
		roundings          = 32 * tolerance::rounding * pair.reach();
		local              = 2e-9 + roundings / -result.infeasibility;
		const QuadVector x = precise(result.point), n = precise(result.normal);
		normal            = averaged(exact, x);
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

/// Answers to the same questions, in pairs. s*, contact or none, and the point are compared in all; normal and depth but where the status
/// differs, or the normal is the dual's, and how often that may be the test says.
class SameAnswers {
public:
	/// `other` answers for the same pair in the same axes.
	void expect(const PrecisePair& exact, const Allowance& allowed, const ContactResult& result, const ContactResult& other)
	{
		++all_;
		EXPECT_NEAR(other.infeasibility, result.infeasibility, allowed.roundings);
		ASSERT_EQ(other.inContact, result.inContact);
		const Quad moved = exact.localLength(precise(result.point), minus(precise(other.point), precise(result.point)));
		EXPECT_LE(Real(moved), allowed.local);
		EXPECT_TRUE(answered(result.status)) << statusName(result.status);
		if (result.status != other.status) {
			++differ_[std::minmax(result.status, other.status)];
			return;
		}
		if (result.status == ContactStatus::NormalFromDual) { // its direction is not unique
			++fromDual_;
			return;
		}
		// the allowance takes all slacks to change against the normal at once; where it says nothing, of these pairs no normal turned by more
		// than 2e-5, and no depth changed by more than 7e-5 of itself
		const bool open = allowed.normal > 0.1;
		open_ += open;
		EXPECT_LE((other.normal - result.normal).norm(), open ? Real(1e-4) : allowed.normal);
		EXPECT_NEAR(other.depth, result.depth, open ? allowed.roundings + Real(5e-4) * result.depth : allowed.depth);
	}

	/// `different`: largest share of pairs of different statuses, which may be those of a normal at the border of two kinds alone (a gradient, or the
	/// thinnest overlap, ends within what the point moves). Most pairs are compared in normal and depth, too: not deeper than their corner radius.
	void expectFew(Real different) const
	{
		long differing = 0;
		for (const auto& [pair, number] : differ_) {
			differing += number;
			std::cout << number << " × " << statusName(pair.first) << " and " << statusName(pair.second) << "; ";
			EXPECT_TRUE(ofTheNormal(pair.first) && ofTheNormal(pair.second))
			        << number << ' ' << statusName(pair.first) << " and " << statusName(pair.second);
		}
		std::cout << all_ << " pairs of answers: statuses differ in " << differing << ", normal from the dual in " << fromDual_
		          << ", allowance without a bound in " << open_ << "\n";
		EXPECT_GT(all_, 0);
		EXPECT_LE(differing, different * all_);
		EXPECT_LE(fromDual_, Real(0.3) * all_);
	}

private:
	long                                                    all_ = 0, fromDual_ = 0, open_ = 0;
	std::map<std::pair<ContactStatus, ContactStatus>, long> differ_; ///< smaller status first

	static bool ofTheNormal(ContactStatus status)
	{
		return status == ContactStatus::Contact || status == ContactStatus::NormalFromOneBody
		        || status == ContactStatus::NormalFromDual || status == ContactStatus::RoundingLimited;
	}
};

} // namespace polytope::samples
