// SPDX-License-Identifier: GPL-2.0-or-later
//
// Ipopt's centre against Newton's and against 113-bit arithmetic; the status of a build without Ipopt.
#include "centre/IpoptCentre.hpp"
#include "PrecisePair.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <ctime>
#include <iostream>
#include <thread>

using namespace polytope;
using namespace polytope::samples;

namespace {

#define NEEDS_IPOPT()                                                                                                                      \
	if (!ipoptVersion()) GTEST_SKIP() << "this build has no Ipopt"

ContactSettings byIpopt()
{
	ContactSettings settings;
	settings.solver = CentreSolver::Ipopt;
	return settings;
}

/// Largest distances in the overlap's local norm, less what one rounding of the pair's planes moves the centre; solves and
/// their time.
struct Agreement {
	Real fromNewton = 0, fromPrecise = 0;
	int  checked = 0, thin = 0, lpNotConverged = 0, iterations = 0;
	Real microseconds = 0;

	void add(const Pair& pair)
	{
		const ContactResult newton = query(pair);
		lpNotConverged += newton.status == ContactStatus::LpNotConverged; // decided before the centre
		if (!newton.inContact || newton.status == ContactStatus::LpNotConverged) return;
		ASSERT_NE(newton.status, ContactStatus::CentreByIpopt);
		const std::clock_t  started = std::clock();
		const ContactResult ipopt   = query(pair, byIpopt());
		microseconds += 1e6 * Real(std::clock() - started) / CLOCKS_PER_SEC;
		ASSERT_TRUE(ipopt.ipoptSolved);
		ASSERT_NE(ipopt.status, ContactStatus::CentreNotConverged) << "s* " << newton.infeasibility;
		EXPECT_EQ(ipopt.infeasibility, newton.infeasibility);
		const PrecisePair exact(pair);
		QuadVector        centre = precise(ipopt.point);
		ASSERT_TRUE(exact.analyticCentre(centre));
		// each plane of the overlap adds its own rounding
		const Real rounding = 8 * tolerance::rounding * pair.reach() / -newton.infeasibility;
		const auto distance
		        = [&](const QuadVector& a, const QuadVector& b) { return Real(exact.localLength(centre, minus(a, b))) - rounding; };
		fromNewton  = std::max(fromNewton, distance(precise(ipopt.point), precise(newton.point)) - rounding);
		fromPrecise = std::max(fromPrecise, distance(precise(ipopt.point), centre));
		iterations += ipopt.ipoptIterations;
		++checked;
		thin += -newton.infeasibility < 1e-9 * pair.size();
	}

	/// `most`: iterations on average; with wrong derivatives, or systems solved wrongly, Ipopt gets there too, with more.
	void expectWithin(Real allowed, Real most = 8) const
	{
		EXPECT_LE(Real(iterations) / checked, most);
		EXPECT_LE(lpNotConverged, 1);
		EXPECT_LE(fromNewton, allowed);
		EXPECT_LE(fromPrecise, allowed);
		std::cout << checked << " centres, " << thin << " of overlaps below 1e-9 of the size: beyond rounding, "
		          << std::max(fromNewton, Real(0)) << " from Newton's and " << std::max(fromPrecise, Real(0))
		          << " from the precise one in the local norm; " << Real(iterations) / checked << " iterations and "
		          << microseconds / checked << " µs each\n";
	}
};

TEST(IpoptCentre, RandomOverlaps)
{
	NEEDS_IPOPT();
	std::mt19937_64 random(800);
	const Shapes    solid = randomShapes(100, random), flat = randomShapes(60, random, 2);
	for (const Shapes* shapes : { &solid, &flat }) {
		Agreement agreement;
		for (int trial = 0; trial < 1200; ++trial)
			agreement.add(randomPair(*shapes, random));
		agreement.expectWithin(1e-8);
		EXPECT_GT(agreement.checked, 800);
		EXPECT_GT(agreement.thin, 200);
	}
}

TEST(IpoptCentre, NearlyParallelPlanes)
{
	NEEDS_IPOPT();
	std::mt19937_64 random(801);
	for (int dimension = 2; dimension <= 3; ++dimension) {
		Agreement agreement;
		for (int trial = 0; trial < 800; ++trial)
			agreement.add(nearlyParallelPair(random, dimension));
		agreement.expectWithin(1e-8, 6);
		EXPECT_GT(agreement.checked, 500);
	}
}

TEST(IpoptCentre, OverlapsThinAcrossSeveralAxes)
{
	NEEDS_IPOPT();
	std::mt19937_64 random(802);
	Agreement       agreement;
	for (int trial = 0; trial < 600; ++trial)
		agreement.add(thinPair(trial, random));
	agreement.expectWithin(1e-8);
	EXPECT_GT(agreement.checked, 500);
}

TEST(IpoptCentre, NormalAndDepthFollow)
{
	NEEDS_IPOPT();
	std::mt19937_64 random(803);
	for (int trial = 0; trial < 200; ++trial) {
		const Pair          pair   = regularPair(6, 12, Real(0.1), random);
		const ContactResult newton = query(pair), ipopt = query(pair, byIpopt());
		EXPECT_EQ(ipopt.status, newton.status);
		EXPECT_EQ(ipopt.newtonIterations, 0);
		EXPECT_GT(ipopt.ipoptIterations, 0);
		EXPECT_LE((ipopt.normal - newton.normal).norm(), 1e-8);
		EXPECT_NEAR(ipopt.depth, newton.depth, 1e-8);
	}
}

TEST(IpoptCentre, AcrossAGap)
{
	NEEDS_IPOPT();
	std::mt19937_64 random(804);
	ContactSettings settings   = byIpopt();
	settings.geometryAcrossGap = true;
	for (int trial = 0; trial < 100; ++trial) {
		const Pair          pair   = regularPair(8, 4, Real(-0.01), random);
		const ContactResult ipopt  = query(pair, settings);
		settings.solver            = CentreSolver::Newton;
		const ContactResult newton = query(pair, settings);
		settings.solver            = CentreSolver::Ipopt;
		ASSERT_TRUE(ipopt.hasGeometry && !ipopt.inContact);
		EXPECT_LE((ipopt.point - newton.point).norm(), 1e-9);
	}
}

// Each thread has one application, and threads come and go.
TEST(IpoptCentre, ThreadsGiveTheSame)
{
	NEEDS_IPOPT();
	std::mt19937_64   random(805);
	const Shapes      solid = randomShapes(30, random), flat = randomShapes(30, random, 2);
	std::vector<Pair> pairs;
	for (int i = 0; i < 100; ++i)
		pairs.push_back(randomPair(i % 2 ? solid : flat, random));
	const auto solveAll = [&pairs] {
		std::vector<Vector3> points;
		for (const Pair& pair : pairs)
			points.push_back(query(pair, byIpopt()).point);
		return points;
	};
	const std::vector<Vector3> alone = solveAll();
	for (int generation = 0; generation < 3; ++generation) {
		std::vector<std::vector<Vector3>> points(4);
		std::vector<std::thread>          threads;
		for (auto& mine : points)
			threads.emplace_back([&] { mine = solveAll(); });
		for (std::thread& thread : threads)
			thread.join();
		for (const auto& mine : points)
			EXPECT_TRUE(mine == alone);
	}
}

TEST(IpoptCentre, PrintsNothing)
{
	NEEDS_IPOPT();
	testing::internal::CaptureStdout();
	testing::internal::CaptureStderr();
	std::thread([] { // a new application, too
		std::mt19937_64 random(806);
		const Shapes    shapes = randomShapes(30, random);
		for (int trial = 0; trial < 100; ++trial)
			query(randomPair(shapes, random), byIpopt());
		// no interior: fails, also without output
		const Real  normal[3][4] = { { 1, -1, 0, 0 }, { 0, 0, 1, -1 }, { 0, 0, 0, 0 } }, offset[4] = { 1, -2, 1, 1 };
		const Real* rows[3]    = { normal[0], normal[1], normal[2] };
		Real        x[3]       = { 0.5, 0, 0 };
		int         iterations = 0;
		EXPECT_EQ(ipoptCentre(2, 4, rows, offset, x, iterations), IpoptOutcome::Failed);
		EXPECT_EQ(x[0], 0.5);
	})
	        .join();
	EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
	EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(IpoptCentre, WithoutIpoptTheStatusSaysSo)
{
	std::mt19937_64     random(807);
	const Pair          pair   = regularPair(6, 8, Real(0.1), random);
	const ContactResult result = query(pair, byIpopt());
	ASSERT_TRUE(result.inContact && result.hasGeometry);
	if (ipoptVersion()) {
		EXPECT_EQ(result.status, ContactStatus::Contact);
		return;
	}
	EXPECT_EQ(result.status, ContactStatus::IpoptNotAvailable);
	EXPECT_FALSE(result.ipoptSolved);
	// the linear program's point: the centre of a ball that touches the overlap's planes
	EXPECT_NEAR(Real(PrecisePair(pair).violation(precise(result.point))), result.infeasibility, 1e-14);
	EXPECT_NEAR(result.normal.norm(), 1, 1e-14);
	EXPECT_GT(result.depth, 0);
}

} // namespace
