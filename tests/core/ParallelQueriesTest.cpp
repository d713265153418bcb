// SPDX-License-Identifier: GPL-2.0-or-later
//
// Several threads over the same shapes, each with its own workspace, each pair with its own memory: the same bits as one
// thread. `./run sanitize` runs this under ThreadSanitizer.
#include "PairSamples.hpp"
#include "centre/IpoptCentre.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cstring>
#include <thread>

using namespace polytope;
using namespace polytope::samples;

namespace {

constexpr int steps = 12;

std::vector<Pair> scene(int count)
{
	std::mt19937_64   random(106);
	Shapes            shapes = randomShapes(12, random, 3, Real(-0.3));
	const Shapes      flat   = randomShapes(6, random, 2, Real(-0.3));
	std::vector<Pair> pairs;
	for (int k = 0; k < count; ++k)
		pairs.push_back(randomPair(k % 4 == 3 ? flat : shapes, random));
	return pairs;
}

/// All numbers of an answer.
std::vector<Real> numbers(const ContactResult& r)
{
	std::vector<Real> all { Real(int(r.status)), Real(r.inContact), Real(r.hasGeometry), Real(r.dismissed), Real(r.simplexPivots),
		Real(r.newtonIterations), Real(r.ipoptIterations), r.infeasibility, r.depth, r.area, r.energy, r.turningArm, r.decrement };
	for (const Vector3* v : { &r.point, &r.normal, &r.dualDirection, &r.sectionCentroid })
		all.insert(all.end(), v->data(), v->data() + 3);
	all.insert(all.end(), r.weights.begin(), r.weights.end());
	all.insert(all.end(), r.basis.begin(), r.basis.end());
	return all;
}

using History = std::vector<std::vector<Real>>; ///< pair after pair, the numbers of all its steps

/// The bodies of every pair drift; pairs are distributed one by one, so which thread computes which pair is random.
History run(const std::vector<Pair>& pairs, const ContactSettings& settings, int threads)
{
	History                 history(pairs.size());
	std::vector<PairMemory> memories(pairs.size());
	std::vector<Pair>       now = pairs;
	for (int step = 0; step < steps; ++step) {
		std::atomic<std::size_t> next { 0 };
		const auto               work = [&] {
                        ContactWorkspace workspace;
                        ContactResult    result;
                        for (std::size_t i = next++; i < now.size(); i = next++) {
                                Pair& pair = now[i];
                                contactQuery(pair.placed(), settings, memories[i], workspace, result);
                                const std::vector<Real> own = numbers(result);
                                history[i].insert(history[i].end(), own.begin(), own.end());
                                pair.centre2 *= 1 - Real(1e-3) * Real(1 + i % 5);
                        }
		};
		std::vector<std::thread> team;
		for (int k = 1; k < threads; ++k)
			team.emplace_back(work);
		work();
		for (std::thread& one : team)
			one.join();
	}
	return history;
}

void expectSameBits(const History& one, const History& other)
{
	ASSERT_EQ(one.size(), other.size());
	for (std::size_t i = 0; i < one.size(); ++i) {
		ASSERT_EQ(one[i].size(), other[i].size());
		for (std::size_t k = 0; k < one[i].size(); ++k)
			ASSERT_EQ(std::memcmp(&one[i][k], &other[i][k], sizeof(Real)), 0)
			        << "pair " << i << " number " << k << ": " << one[i][k] << ", " << other[i][k];
	}
}

long contacts(const History& history)
{
	long count = 0;
	for (const auto& pair : history)
		for (std::size_t k = 1; k < pair.size(); k += pair.size() / steps)
			count += pair[k] == 1;
	return count;
}

void expectSameForAllThreads(const ContactSettings& settings, int pairs)
{
	const std::vector<Pair> all = scene(pairs);
	const History           one = run(all, settings, 1);
	EXPECT_GT(contacts(one), pairs * steps / 3);
	for (int threads : { 2, 5 })
		expectSameBits(one, run(all, settings, threads));
}

TEST(ParallelQueries, PaperModel)
{
	ContactSettings settings;
	settings.section = settings.geometryAcrossGap = true;
	expectSameForAllThreads(settings, 200);
}

TEST(ParallelQueries, SpringModel)
{
	ContactSettings settings;
	settings.contactModel = ContactModel::Spring;
	settings.outline      = true;
	expectSameForAllThreads(settings, 200);
}

TEST(ParallelQueries, CentroidOfTheOverlap)
{
	ContactSettings settings;
	settings.contactPoint = ContactPoint::Centroid;
	expectSameForAllThreads(settings, 80);
}

TEST(ParallelQueries, Ipopt)
{
	if (!ipoptVersion()) GTEST_SKIP() << "built without Ipopt";
	ContactSettings settings;
	settings.solver = CentreSolver::Ipopt;
	expectSameForAllThreads(settings, 12);
}

TEST(ParallelQueries, SharedShapesAreMadeOnce)
{
	const auto               make = [](int k) { return ConvexShape::shared(cuboid(1, 1 + Real(k % 3), 2), Real(0.1)); };
	std::vector<std::thread> team;
	std::vector<Shapes>      made(4);
	for (Shapes& own : made)
		team.emplace_back([&own, &make] {
			for (int k = 0; k < 9; ++k)
				own.push_back(make(k));
		});
	for (std::thread& one : team)
		one.join();
	for (const Shapes& own : made)
		for (int k = 0; k < 9; ++k)
			EXPECT_EQ(own[std::size_t(k)], made[0][std::size_t(k % 3)]);
}

} // namespace
