// SPDX-License-Identifier: GPL-2.0-or-later
//
// Inputs on which Newton does not converge to the analytic centre, and a search for more.
#include "ExactLp.hpp"
#include "PrecisePair.hpp"
#include "centre/IpoptCentre.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>

using namespace polytope;
using namespace polytope::samples;

namespace {

// Rectangles with near copies of their planes, the second turned by 1e-14 against the first, overlap 2e-15 of the size. A linear
// program in double alone takes one of two normals that agree to rounding and its point violates the other by more than the
// overlap's thickness: contact was reported where there is none by the tolerance, and Newton had no interior point to start from.
TEST(NewtonGivesUp, NotAtTwinPlanesSinceTheLinearProgramSeesBoth)
{
	HalfSpaces set;
	set.dimension          = 2;
	const double rows[][3] = {
		{ 0x1p+0, 0x0p+0, 0x1p+0 },
		{ -0x1p+0, -0x0p+0, 0x1p+0 },
		{ 0x0p+0, 0x1p+0, 0x1.2e6554ca8f367p-12 },
		{ -0x0p+0, -0x1p+0, 0x1.2e6554ca8f367p-12 },
		{ 0x1.4d34253f5baeap-13, 0x1.ffffff9393d31p-1, 0x1.2e6554df31a9cp-12 },
		{ -0x1.2dcf7dea11565p-49, 0x1p+0, 0x1.2e6554ca8ed39p-12 },
		{ -0x1.f5359246f1924p-46, 0x1p+0, 0x1.2e6554ca8f362p-12 },
	};
	for (const auto& row : rows) {
		set.normals.push_back(Vector3(row[0], row[1], 0));
		set.offsets.push_back(row[2]);
	}
	Pair pair;
	pair.shape[0] = pair.shape[1] = ConvexShape::shared(set, 0x1.e3d554774aec2p-16);
	const double cosine[] = { 0x1.e6b47fe7d3f79p-1, 0x1.e6b47fe7d3fabp-1 }, sine[] = { 0x1.3de1ac96f06bdp-2, 0x1.3de1ac96f0586p-2 };
	for (int body = 0; body < 2; ++body)
		pair.rotation[body] << cosine[body], sine[body], 0, -sine[body], cosine[body], 0, 0, 0, 1;
	pair.centre2 = Vector3(0x1.0cff9c6288125p-11, 0x1.cc88688ec37d9p-12, 0);

	const PrecisePair exact(pair);
	const Real        least = Real(ExactLp<2>(pair).infeasibility);
	for (bool across : { false, true }) {
		ContactSettings settings;
		settings.geometryAcrossGap = across;
		const ContactResult usual  = query(pair, settings);
		EXPECT_EQ(usual.status, ContactStatus::Separated) << statusName(usual.status);
		settings.tolerance         = 0;
		const ContactResult result = query(pair, settings);
		EXPECT_NEAR(result.infeasibility, least, tolerance::rounding);
		ASSERT_TRUE(result.inContact);
		EXPECT_TRUE(result.status == ContactStatus::RoundingLimited || result.status == ContactStatus::Contact)
		        << statusName(result.status);
		EXPECT_LT(exact.violation(precise(result.point)), 0);
	}
}

// A small body that just touches a large one: by default −s* is 45 roundings of the small one's size at the least, but the planes
// are rounded by the large one's; with no tolerance any pair may. In the frame of the centre there may be no inside left, and neither Newton
// nor Ipopt can converge: depths of −3e-16 were reported, with the status that the centre was not reached.
TEST(NewtonGivesUp, NotWhereRoundingLeavesNoInside)
{
	std::mt19937_64 random(905);
	int             contacts = 0, limited = 0, flat = 0;
	for (int trial = 0; trial < 2000; ++trial) {
		const int  D    = 2 + trial % 2;
		const Real size = decades(random, -4, 0);
		Pair       pair;
		pair.shape[0] = ConvexShape::shared(D == 2 ? rectangle(1, Real(0.5)) : cuboid(1, Real(0.5), Real(0.1)), Real(0.05));
		pair.shape[1] = ConvexShape::shared(D == 2 ? rectangle(size, size) : regularSolid(20, size), Real(0.1) * size);
		for (Matrix3& rotation : pair.rotation)
			rotation = randomRotation(random, D);
		const bool usual = trial % 8 > 3;
		moveTo(pair, randomDirection(random, D), -uniform(random, 0, usual ? 60 : 2) * tolerance::rounding * pair.size());
		if (trial % 4 > 1) pair = swapped(pair);
		const PrecisePair exact(pair);
		const Real        rounding = tolerance::rounding * pair.reach();
		for (ContactPoint point : { ContactPoint::AnalyticCentre, ContactPoint::ChebyshevCentre, ContactPoint::Centroid })
			for (CentreSolver solver : { CentreSolver::Newton, CentreSolver::Ipopt }) {
				ContactSettings settings;
				settings.tolerance         = usual ? tolerance::contact : Real(0);
				settings.contactPoint      = point;
				settings.solver            = solver;
				const ContactResult result = query(pair, settings);
				if (!result.inContact) continue;
				++contacts;
				EXPECT_GE(result.depth, 0) << trial;
				EXPECT_LT(result.depth, 300 * rounding) << trial;
				EXPECT_NEAR(result.normal.norm(), 1, 1e-14) << trial;
				EXPECT_LT(exact.violation(precise(result.point)), 16 * rounding) << trial;
				const bool without = solver == CentreSolver::Ipopt && !ipoptVersion();
				EXPECT_TRUE(answered(result.status) || (without && result.status == ContactStatus::IpoptNotAvailable))
				        << trial << ": " << statusName(result.status);
				limited += result.status == ContactStatus::RoundingLimited;
				flat += result.depth == 0;
				if (point != ContactPoint::AnalyticCentre) break;
			}
	}
	EXPECT_GT(limited, 20);
	EXPECT_GT(flat, 5);
	std::cout << contacts << " contacts about as thin as rounding: " << limited << " roundingLimited, " << flat << " of depth 0\n";
}

// POLYTOPE_SEARCH=n in the environment: n pairs, forty queries each while they move by parts of their overlap.
TEST(NewtonGivesUp, Search)
{
	const char* asked    = std::getenv("POLYTOPE_SEARCH");
	const long  pairs    = asked ? std::atol(asked) : 400;
	long        contacts = 0, gaveUp = 0, byIpopt = 0;
	for (long trial = 0; trial < pairs; ++trial) {
		std::mt19937_64 random(900 + trial);
		Pair            pair = nearlyParallelPair(random, 2 + trial % 2);
		PairMemory      memory;
		for (int step = 0; step < 40; ++step) {
			ContactSettings settings;
			settings.geometryAcrossGap = step % 2;
			if (step % 8 == 7) memory = PairMemory();
			const ContactResult result = query(pair, settings, &memory);
			contacts += result.inContact;
			const bool rescue = result.status == ContactStatus::CentreByIpopt;
			// that there is no direction is not the centre's fault
			if (rescue || !(answered(result.status) || result.status == ContactStatus::NoDirection)) {
				++gaveUp;
				byIpopt += rescue;
				std::cout << "pair " << trial << ", step " << step << ": " << statusName(result.status) << ", s* "
				          << result.infeasibility << "\n";
			}
			pair.centre2 += std::abs(result.infeasibility) * decades(random, -4, Real(0.7))
			        * randomDirection(random, pair.dimension());
		}
	}
	std::cout << pairs << " pairs, " << 40 * pairs << " queries, " << contacts << " contacts: Newton did not converge on " << gaveUp
	          << ", Ipopt found " << byIpopt << " of these\n";
	EXPECT_GT(contacts, 10 * pairs);
	EXPECT_EQ(gaveUp, 0);
}

} // namespace
