// SPDX-License-Identifier: GPL-2.0-or-later
#include "centre/AnalyticCentre.hpp"
#include "PlaneRows.hpp"
#include "PrecisePair.hpp"

#include <gtest/gtest.h>

using namespace polytope;
using namespace polytope::samples;

namespace {

template <class R, int D> R barrier(const PairPlanes<R, D>& planes, const R* x)
{
	R sum = 0;
	for (int i = 0; i < planes.total; ++i) {
		if (planes.offset[i] >= R(padOffset) / 2) continue;
		R slack = planes.offset[i];
		for (int k = 0; k < D; ++k)
			slack -= planes.normal[k][i] * x[k];
		sum -= std::log(slack);
	}
	return sum;
}

/// Gradient against differences of φ, Hessian against differences of the gradient, the overlap scaled over decades:
/// dimensionless, since step and derivative scale with the slack.
template <int D> void expectDerivatives()
{
	using R = long double;
	std::mt19937_64 random(17);
	for (Real size : { 1e-9, 1e-3, 1., 1e3 }) {
		for (int trial = 0; trial < 50; ++trial) {
			HalfSpaces set1 = randomPlanes(4 + trial, random, D), set2 = randomPlanes(8, random, D);
			for (HalfSpaces* set : { &set1, &set2 })
				for (Real& offset : set->offsets)
					offset *= size;
			PlaneRows<R, D> rows(set1, set2);
			const Vector3   at = Real(0.3) * size * randomDirection(random, D);
			R               x[D], g[D], h[D][D];
			for (int k = 0; k < D; ++k)
				x[k] = at[k];
			ASSERT_TRUE((barrierDerivatives<R, D, 1>(rows.planes, x, g, h)));
			const R step = 1e-5L * size;
			for (int k = 0; k < D; ++k) {
				R ahead[D], back[D], gAhead[D], gBack[D], unused[D][D];
				std::copy(x, x + D, ahead);
				std::copy(x, x + D, back);
				ahead[k] += step;
				back[k] -= step;
				const R slope = (barrier(rows.planes, ahead) - barrier(rows.planes, back)) / (2 * step);
				EXPECT_NEAR(double(g[k] * size), double(slope * size), 1e-7);
				ASSERT_TRUE((barrierDerivatives<R, D, 1>(rows.planes, ahead, gAhead, unused)));
				ASSERT_TRUE((barrierDerivatives<R, D, 1>(rows.planes, back, gBack, unused)));
				for (int j = 0; j <= k; ++j)
					EXPECT_NEAR(double(h[k][j] * size * size),
					        double((gAhead[j] - gBack[j]) / (2 * step) * size * size), 1e-6);
			}
		}
	}
}

TEST(AnalyticCentre, DerivativesAreThoseOfTheBarrier)
{
	expectDerivatives<3>();
	expectDerivatives<2>();
}

TEST(AnalyticCentre, NewtonStepSolvesTheSystem)
{
	std::mt19937_64 random(18);
	for (int trial = 0; trial < 200; ++trial) {
		const HalfSpaces     set1 = randomPlanes(12, random), set2 = randomPlanes(8, random);
		PlaneRows<Real, 3>   rows(set1, set2);
		const Vector3        x = Real(0.5) * randomDirection(random);
		Real                 g[3], h[3][3];
		BarrierStep<Real, 3> step;
		ASSERT_TRUE((barrierDerivatives<Real, 3, 2>(rows.planes, x.data(), g, h)));
		ASSERT_TRUE((newtonStep<Real, 3>(g, h, step)));
		Matrix3 hessian;
		for (int k = 0; k < 3; ++k)
			for (int j = 0; j <= k; ++j)
				hessian(k, j) = hessian(j, k) = h[k][j];
		const Vector3 direction = vectorOf(step.direction, 3), gradient = vectorOf(g, 3);
		EXPECT_LE((hessian * direction + gradient).norm(), 1e-13 * gradient.norm());
		EXPECT_NEAR(step.decrement * step.decrement, direction.dot(hessian * direction), 1e-12 * step.decrement * step.decrement);
	}
}

TEST(AnalyticCentre, StepLengthIsNearTheMinimumAlongTheLineOrGoesDownByItsBound)
{
	std::mt19937_64 random(19);
	int             damped = 0, towards = 0;
	for (int trial = 0; trial < 5000; ++trial) {
		const HalfSpaces   set1 = randomPlanes(12, random), set2 = randomPlanes(8, random);
		PlaneRows<Real, 3> rows(set1, set2);
		// close to a face: the first ray's exit less a little
		const Vector3 direction = randomDirection(random);
		Real          exit      = 1e9;
		for (int i = 0; i < rows.planes.total; ++i) {
			const Real rate = rows.planes.normal[0][i] * direction[0] + rows.planes.normal[1][i] * direction[1]
			        + rows.planes.normal[2][i] * direction[2];
			if (rate > 0) exit = std::min(exit, rows.planes.offset[i] / rate);
		}
		const Vector3        x = (1 - decades(random, -12, -1)) * exit * direction;
		Real                 g[3], h[3][3];
		BarrierStep<Real, 3> step;
		ASSERT_TRUE((barrierDerivatives<Real, 3, 2>(rows.planes, x.data(), g, h)));
		if (!newtonStep<Real, 3>(g, h, step) || step.decrement <= tolerance::fullStep) continue;
		++damped;
		const Real length = stepLength<Real, 3, 2>(rows.planes, step);
		ASSERT_GT(length, 0);
		const Real pole = *std::max_element(rows.planes.rate, rows.planes.rate + rows.planes.total);
		if (pole > tolerance::nearPole) {
			// φ(t) ≤ φ(0) + φ'(0) (t + t/p + log(1 − t p)/p²), evaluated afresh
			++towards;
			Real change = 0;
			for (int i = 0; i < rows.planes.total; ++i)
				change -= std::log1p(-length * rows.planes.rate[i]);
			const Real slope = -step.decrement * step.decrement;
			const Real bound = slope * (length + length / pole + std::log1p(-length * pole) / (pole * pole));
			EXPECT_LT(bound, 0);
			EXPECT_LE(change, bound + 1e-9 * std::abs(slope));
			continue;
		}
		// still inside, and the slope has fallen as far as asked
		const Vector3 there = x + length * vectorOf(step.direction, 3);
		Real          ahead[3];
		ASSERT_TRUE((barrierDerivatives<Real, 3, 2>(rows.planes, there.data(), ahead, h)));
		EXPECT_LE(std::abs(vectorOf(ahead, 3).dot(vectorOf(step.direction, 3))),
		        1.01 * tolerance::lineSearchSlope * step.decrement * step.decrement);
	}
	EXPECT_GT(damped, 1200);
	EXPECT_GT(towards, 100);
	EXPECT_GT(damped - towards, 300);
}

TEST(AnalyticCentre, KnownCentres)
{
	// separable: along each axis the zero of a rational function; symmetric boxes have it in the middle
	Pair pair;
	pair.shape[0] = pair.shape[1] = ConvexShape::shared(cuboid(1, 1, 1), Real(0.1));
	pair.centre2                  = Vector3(1, Real(0.5), Real(1.75));
	EXPECT_LE((query(pair).point - pair.centre2 / 2).norm(), 1e-15);
	// 1/(1−z) + 1/(2−z) = 1/(z+1) + 1/z  has the root ½ in z about the middle of −1, 0, 1, 2
	pair.centre2 = Vector3(0, 0, 1);
	EXPECT_NEAR(query(pair).point.z(), 0.5, 1e-15);
	// redundant and repeated planes move the centre: it is that of z ≤ 1 twice, z ≤ 3 and −z ≤ 1 three times
	HalfSpaces set = cuboid(1, 1, 1);
	set.normals.insert(set.normals.end(), { Vector3(0, 0, 1), Vector3(0, 0, -1) });
	set.offsets.insert(set.offsets.end(), { Real(3), Real(1) });
	pair.shape[1] = ConvexShape::shared(set, Real(0.1));
	pair.centre2  = Vector3::Zero();
	// 2/(1−z) + 1/(3−z) = 3/(1+z)  ⇔  3z² − 8z + 1 = 0
	EXPECT_NEAR(query(pair).point.z(), (8 - std::sqrt(Real(52))) / 6, 1e-14);
}

/// Worst distance of the kernel's centre from the precise one in units of the accuracy that rounding allows.
struct Accuracy {
	Real worst   = 0;
	int  checked = 0, thin = 0;

	void add(const Pair& pair)
	{
		const ContactResult result = query(pair);
		if (!result.inContact) return;
		ASSERT_TRUE(answered(result.status) || result.status == ContactStatus::NoDirection) // of the normal, not of the centre
		        << statusName(result.status);
		const PrecisePair exact(pair);
		QuadVector        centre = precise(result.point);
		ASSERT_TRUE(exact.analyticCentre(centre)) << "s* " << result.infeasibility << " reach " << pair.reach();
		const Real moved = Real(exact.localLength(centre, minus(precise(result.point), centre)));
		worst            = std::max(worst, moved / (1e-9 + tolerance::rounding * pair.reach() / -result.infeasibility));
		++checked;
		thin += -result.infeasibility < 1e-9 * pair.size();
	}
};

TEST(AnalyticCentre, RandomOverlapsAgreeWithPreciseNewton)
{
	std::mt19937_64 random(20);
	const Shapes    solid = randomShapes(100, random), flat = randomShapes(60, random, 2);
	Accuracy        accuracy;
	for (int trial = 0; trial < 3000; ++trial) {
		accuracy.add(randomPair(solid, random));
		accuracy.add(randomPair(flat, random));
	}
	EXPECT_LE(accuracy.worst, 8); // roundings of a plane; each plane of the overlap adds its own
	EXPECT_GT(accuracy.checked, 4000);
	EXPECT_GT(accuracy.thin, 800);
	RecordProperty("worst", std::to_string(accuracy.worst));
}

TEST(AnalyticCentre, NearlyParallelPlanesAgreeWithPreciseNewton)
{
	std::mt19937_64 random(21);
	Accuracy        accuracy;
	for (int trial = 0; trial < 1500; ++trial) {
		accuracy.add(nearlyParallelPair(random));
		accuracy.add(nearlyParallelPair(random, 2));
	}
	EXPECT_LE(accuracy.worst, 8);
	EXPECT_GT(accuracy.checked, 2000);
	EXPECT_GT(accuracy.thin, 800);
}

// Two or three axes thin at once: blocks that meet along an edge or at a corner, a plate or needle inside a block. The
// Hessian's condition is 1e24 and no axis of the contact frame is the overlap's own.
TEST(AnalyticCentre, OverlapsThinAcrossSeveralAxes)
{
	std::mt19937_64 random(22);
	Accuracy        accuracy;
	for (int trial = 0; trial < 1500; ++trial)
		accuracy.add(thinPair(trial, random));
	EXPECT_LE(accuracy.worst, 8);
	EXPECT_GT(accuracy.checked, 1400);
}

} // namespace
