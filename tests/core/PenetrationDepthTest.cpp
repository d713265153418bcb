// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact/PenetrationDepth.hpp"
#include "PlaneRows.hpp"
#include "PrecisePair.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace polytope;
using namespace polytope::samples;

namespace {

/// Section 2.5 of the paper: bracket the surface along the normal, then halve the bracket. Independent of slopes.
Real bracketedExit(const PrecisePair& pair, int body, const QuadVector& x, const QuadVector& direction, Real far)
{
	Quad inside = 0, outside = far;
	EXPECT_LT(pair.violation(body, x), 0);
	EXPECT_GT(pair.violation(body, along(x, outside, direction)), 0);
	for (int step = 0; step < 64; ++step) {
		const Quad middle                                                          = (inside + outside) / 2;
		(pair.violation(body, along(x, middle, direction)) < 0 ? inside : outside) = middle;
	}
	return Real(inside);
}

void expectClosedFormIsBracketed(int dimension)
{
	std::mt19937_64 random(20120731 + dimension);
	const Shapes    shapes  = randomShapes(60, random, dimension);
	int             overlap = 0;
	for (int trial = 0; trial < 1000; ++trial) {
		const Pair          pair   = randomPair(shapes, random);
		const ContactResult result = query(pair);
		if (!result.inContact) continue;
		++overlap;
		const PrecisePair exact(pair);
		const QuadVector  x = precise(result.point), n = precise(result.normal), back = minus(QuadVector {}, n);
		if (!(exact.violation(x) < 0)) continue; // thinner than the point's rounding
		const Real exit1 = bracketedExit(exact, 0, x, n, pair.reach() * 4),
		           exit2 = bracketedExit(exact, 1, x, back, pair.reach() * 4);
		// point and planes are known to a rounding of the pair; a plane met at a glancing angle lengthens it
		const Real depth  = exit1 + exit2;
		const Real glance = Real(1 / exact.exit(0, x, n, 1).rate + 1 / exact.exit(1, x, n, -1).rate);
		EXPECT_NEAR(result.depth, depth, 16 * tolerance::rounding * pair.reach() * glance) << "trial " << trial;
		EXPECT_GT(result.depth, 0);

		// moved apart along the normal by the depth, the two ends of the chord meet, each on its body's surface
		const Vector3     end1 = result.point + exit1 * result.normal, end2 = result.point - exit2 * result.normal;
		const PrecisePair apart(movedApart(pair, depth * result.normal));
		EXPECT_LE((end2 + depth * result.normal - end1).norm(), 1e-15 * pair.reach());
		const Real onSurface = 16 * tolerance::rounding * pair.reach();
		EXPECT_NEAR(Real(apart.violation(0, precise(end1))), 0, onSurface);
		EXPECT_NEAR(Real(apart.violation(1, precise(end1))), 0, onSurface);
	}
	EXPECT_GT(overlap, 650);
	EXPECT_LT(overlap, 850);
}

TEST(PenetrationDepth, ClosedFormIsWhatBracketingFinds) { expectClosedFormIsBracketed(3); }

TEST(PenetrationDepth, ClosedFormIsWhatBracketingFindsInTwoDimensions) { expectClosedFormIsBracketed(2); }

TEST(PenetrationDepth, KnownExits)
{
	PlaneRows<Real, 3> rows(cuboid(1, 2, 3), cuboid(1, 1, 1));
	const Real         x[] = { Real(0.25), 0, 0 };
	for (int i = 0; i < rows.planes.total; ++i)
		rows.planes.slack[i] = rows.planes.offset[i] - rows.planes.normal[0][i] * x[0];
	const Real along[] = { 1, 0, 0 }, diagonal[] = { Real(0.6), Real(0.8), 0 };
	EXPECT_EQ((exitDistance<Real, 3, 2>(rows.planes, 0, along, 1)), 0.75);
	EXPECT_EQ((exitDistance<Real, 3, 2>(rows.planes, 0, along, -1)), 1.25);
	// leaves through +x at 0.75/0.6, before +y at 2/0.8
	EXPECT_DOUBLE_EQ((exitDistance<Real, 3, 2>(rows.planes, 0, diagonal, 1)), 1.25);
	// the other way through -x at 1.25/0.6, before -y at 2/0.8
	EXPECT_DOUBLE_EQ((exitDistance<Real, 3, 2>(rows.planes, 0, diagonal, -1)), 1.25 / 0.6);
	EXPECT_DOUBLE_EQ((exitDistance<Real, 3, 2>(rows.planes, 1, diagonal, 1)), 1.25);
}

TEST(PenetrationDepth, FaceOnFaceIsTheOverlapDistance)
{
	Pair pair;
	pair.shape[0] = pair.shape[1] = ConvexShape::shared(cuboid(1, 1, 1), Real(0.1));
	for (Real overlap : { 1e-1, 1e-4, 1e-8, 1e-12 }) {
		pair.centre2               = Vector3(Real(0.3), Real(-0.2), 2 - overlap);
		const ContactResult result = query(pair);
		const Real          actual = 2 - pair.centre2.z();
		// sides a length ℓ away turn the normal by (overlap/2ℓ)³, and the chord is longer by half its square
		EXPECT_NEAR(result.depth, actual, 1e-15 + actual * std::pow(overlap / 2 / Real(0.85), 6) / 2);
		EXPECT_NEAR(result.infeasibility, -actual / 2, 1e-15);
	}
}

} // namespace
