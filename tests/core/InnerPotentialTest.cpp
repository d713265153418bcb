// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact/InnerPotential.hpp"
#include "PlaneRows.hpp"

#include <gtest/gtest.h>

using namespace polytope;
using namespace polytope::samples;

namespace {

/// f(x) = Σ ⟨a·x − d + r⟩² − r² of body `body`, in R.
template <class R, int D> R potential(const PairPlanes<R, D>& planes, int body, const R* x, R cornerRadius)
{
	R sum = -cornerRadius * cornerRadius;
	for (int i = planes.begin(body); i < planes.end(body); ++i) {
		R value = cornerRadius - planes.offset[i];
		for (int k = 0; k < D; ++k)
			value += planes.normal[k][i] * x[k];
		if (value > 0) sum += value * value;
	}
	return sum;
}

template <int D> void expectGradientOfPotential()
{
	using R = long double;
	std::mt19937_64 random(42);
	int             curved = 0;
	for (int trial = 0; trial < 200; ++trial) {
		const HalfSpaces set1 = randomPlanes(4 + trial % 40, random, D), set2 = randomPlanes(12, random, D);
		PlaneRows<R, D>  rows(set1, set2);
		const int        body         = trial % 2;
		const R          cornerRadius = uniform(random, 0, 1);
		R                x[D], gradient[D];
		const Vector3    direction = randomDirection(random, D), at = uniform(random, 0, Real(1.5)) * direction;
		for (int k = 0; k < D; ++k)
			x[k] = at[k];
		innerPotentialGradient<R, D, 1>(rows.planes, body, x, cornerRadius, gradient);
		R length = 0;
		for (int k = 0; k < D; ++k) {
			const R h = 1e-6L;
			R       ahead[D], back[D];
			for (int j = 0; j < D; ++j)
				ahead[j] = back[j] = x[j];
			ahead[k] += h;
			back[k] -= h;
			// f is quadratic in pieces: a central difference is exact but where a piece changes within h
			const R difference
			        = (potential(rows.planes, body, ahead, cornerRadius) - potential(rows.planes, body, back, cornerRadius))
			        / (2 * h);
			EXPECT_NEAR(double(gradient[k]), double(difference), 60 * 1e-6);
			length += gradient[k] * gradient[k];
		}
		curved += length > 0;
		for (int i = rows.planes.begin(body); i < rows.planes.end(body); ++i) {
			R slack = rows.planes.offset[i];
			for (int k = 0; k < D; ++k)
				slack -= rows.planes.normal[k][i] * x[k];
			EXPECT_EQ(rows.planes.slack[i], slack) << "slacks are left for the depth";
		}
	}
	EXPECT_GT(curved, 100);
	EXPECT_LT(curved, 200);
}

TEST(InnerPotential, GradientIsThatOfThePotentialInThreeDimensions) { expectGradientOfPotential<3>(); }

TEST(InnerPotential, GradientIsThatOfThePotentialInTwoDimensions) { expectGradientOfPotential<2>(); }

TEST(InnerPotential, KnownValues)
{
	PlaneRows<Real, 3> rows(cuboid(1, 1, 1), cuboid(2, 2, 2));
	Real               gradient[3];
	// deeper than r inside every face: no direction
	const Real deep[] = { Real(0.25), Real(-0.5), Real(0.5) };
	innerPotentialGradient<Real, 3, 2>(rows.planes, 0, deep, Real(0.5), gradient);
	EXPECT_EQ(vectorOf(gradient, 3), Vector3(0, 0, 0));
	// one face: 2 (r − slack) along it
	const Real face[] = { Real(0.25), 0, Real(-0.75) };
	innerPotentialGradient<Real, 3, 2>(rows.planes, 0, face, Real(0.5), gradient);
	EXPECT_EQ(vectorOf(gradient, 3), Vector3(0, 0, -0.5));
	// an edge: both faces
	const Real edge[] = { Real(0.875), Real(-0.75), 0 };
	innerPotentialGradient<Real, 3, 2>(rows.planes, 0, edge, Real(0.5), gradient);
	EXPECT_EQ(vectorOf(gradient, 3), Vector3(0.75, -0.5, 0));
	// outside, and with no rounding: the violated faces alone
	const Real outside[] = { Real(1.25), 0, Real(0.5) };
	innerPotentialGradient<Real, 3, 2>(rows.planes, 0, outside, Real(0), gradient);
	EXPECT_EQ(vectorOf(gradient, 3), Vector3(0.5, 0, 0));
	// the other body's planes do not count
	innerPotentialGradient<Real, 3, 2>(rows.planes, 1, outside, Real(0.5), gradient);
	EXPECT_EQ(vectorOf(gradient, 3), Vector3(0, 0, 0));
}

TEST(InnerPotential, LaneWidthsAgree)
{
	std::mt19937_64 random(7);
	for (int trial = 0; trial < 100; ++trial) {
		const HalfSpaces   set1 = randomPlanes(4 + trial % 50, random), set2 = randomPlanes(9, random);
		PlaneRows<Real, 3> rows(set1, set2);
		const Vector3      x = uniform(random, 0, 1) * randomDirection(random);
		Real               gradient[2][3];
		innerPotentialGradient<Real, 3, 1>(rows.planes, 0, x.data(), Real(0.8), gradient[0]);
		innerPotentialGradient<Real, 3, 2>(rows.planes, 0, x.data(), Real(0.8), gradient[1]);
		EXPECT_LE((vectorOf(gradient[1], 3) - vectorOf(gradient[0], 3)).norm(), 1e-14 * (1 + vectorOf(gradient[0], 3).norm()));
	}
}

} // namespace
