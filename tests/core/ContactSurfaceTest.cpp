// SPDX-License-Identifier: GPL-2.0-or-later
#include "surface/ContactSurface.hpp"
#include "ShapeSamples.hpp"
#include "SurfaceOfPair.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <iostream>

using namespace polytope;
using namespace polytope::samples;

namespace {

using Maker = std::function<Pair(int, std::mt19937_64&)>;

/// A rod through a plate, or the end of one in it: the surface has up to two parts, and a part of the pairs have it off the optimum.
Pair piercingPair(std::mt19937_64& random)
{
	Pair       pair;
	const Real thick = decades(random, -2, 0), wide = decades(random, -2, 0), high = wide * decades(random, Real(-0.5), Real(0.5));
	pair.shape[0] = ConvexShape::shared(cuboid(1, 1, thick), 0);
	pair.shape[1] = ConvexShape::shared(cuboid(wide, high, 2), 0);
	const Real x = uniform(random, Real(-0.8), Real(0.8)), y = uniform(random, Real(-0.8), Real(0.8)), z = uniform(random, -2, 2);
	pair.centre2     = Vector3(x, y, z);
	const Real angle = uniform(random, 0, Real(0.5));
	pair.rotation[1] = Eigen::AngleAxis<Real>(angle, randomDirection(random)).toRotationMatrix();
	return turned(pair, randomRotation(random));
}

/// A cube on another with all sides in line, with two, with none, or a smaller one with one side in line: ties of planes of both bodies.
Pair stackedPair(int trial, std::mt19937_64& random)
{
	const int  sides = trial % 4;
	const Real half  = sides == 3 ? Real(0.5) : Real(1);
	Pair       pair;
	pair.shape[0]      = ConvexShape::shared(cuboid(1, 1, 1), Real(0.1));
	pair.shape[1]      = ConvexShape::shared(cuboid(half, half, half), Real(0.1));
	const Real overlap = decades(random, -12, Real(-0.3));
	const Real x[] = { 0, Real(0.375), Real(0.375), Real(0.5) }, y[] = { 0, 0, Real(-0.5), Real(0.125) };
	pair.centre2 = Vector3(x[sides], y[sides], 1 + half - overlap);
	return trial % 8 > 3 ? turned(pair, randomRotation(random)) : pair;
}

/// Bodies that coincide but for 1e-16 … 0.1 of their size and as much of a turn, or exactly.
Pair coincidingPair(int trial, std::mt19937_64& random, const Shapes& shapes)
{
	Pair pair;
	pair.shape[0] = pair.shape[1] = shapes[random() % shapes.size()];
	pair.rotation[0] = pair.rotation[1] = randomRotation(random, pair.dimension());
	if (trial % 3) pair.centre2 = decades(random, -16, -1) * pair.size() * randomDirection(random, pair.dimension());
	if (trial % 3 == 2) {
		const Vector3 axis = pair.dimension() == 2 ? Vector3(Vector3::UnitZ()) : randomDirection(random);
		pair.rotation[1]   = Eigen::AngleAxis<Real>(decades(random, -16, -1), axis).toRotationMatrix() * pair.rotation[0];
	}
	return pair;
}

template <class Numbers, class Exact> Real distance(const Numbers& numbers, const Exact& exact)
{
	Real square = 0;
	for (std::size_t k = 0; k < exact.size(); ++k) {
		const Real off = Real(Fine(numbers[k]) - exact[k]);
		square += off * off;
	}
	return std::sqrt(square);
}

/// The mean of both orders in which planes of both bodies that coincide may be taken.
template <int D> ExactCells<D> exactOf(const PlaneRows<Real, D>& rows, Real size)
{
	const double  twin = double(tolerance::twinPlanes);
	ExactCells<D> exact(rows.planes, { twin, twin * double(size), false }), other(rows.planes, { twin, twin * double(size), true });
	exact.measure(3 * double(size));
	other.measure(3 * double(size));
	const auto mean = [](auto& own, const auto& its) {
		for (std::size_t k = 0; k < own.size(); ++k)
			own[k] = (own[k] + its[k]) / 2;
	};
	mean(exact.force, other.force);
	mean(exact.moment, other.moment);
	mean(exact.deeper, other.deeper);
	mean(exact.deeperTurn, other.deeperTurn);
	return exact;
}

/// The sums of a surface against 113 digits. Errors are in roundings × size over the overlap's thickness, which is how certain a pressure is.
template <int D> void expectSums(const SurfaceOfPair<D>& own, const ExactCells<D>& exact, Real size)
{
	const Real deep     = own.deepest;
	const Real rounding = 32 * tolerance::rounding * size / deep;
	const Real pressure = std::max(own.sums.pressure, Real(exact.volume) / size);
	EXPECT_LE(distance(own.sums.force, exact.force), rounding * pressure);
	EXPECT_LE(distance(own.sums.moment, exact.moment), rounding * pressure * size);
	EXPECT_LE(distance(own.sums.deeper, exact.deeper), rounding * pressure * deep);
	EXPECT_LE(distance(own.sums.deeperTurn, exact.deeperTurn), rounding * pressure * deep * size);
	EXPECT_NEAR(Real(Fine(own.sums.overlap) / exact.overlap), 1, rounding);
	EXPECT_NEAR(Real(Fine(own.sums.volume) / exact.volume), 1, rounding);
	EXPECT_NEAR(Real(Fine(own.sums.level) / exact.level), 1, rounding);
	EXPECT_EQ(own.status, exact.pieces > 0 || own.sums.pieces > 0 ? SurfaceStatus::Found : SurfaceStatus::None);
}

/// Compares surfaces with exact ones, of pairs that overlap by more than rounding. `byVertices`: least number, in a hundred, that have a surface from the
/// vertices of the feasible set, too.
template <int D> void expectExact(const Maker& make, int trials, int least, int byVertices = 0)
{
	std::mt19937_64 random(71 + D);
	int             measured = 0, facing = 0, ofVertices = 0;
	for (int trial = 0; trial < trials; ++trial) {
		const Pair          pair = make(trial, random);
		const ContactResult lp   = linearProgram(pair);
		const Real          size = pair.size();
		if (!(lp.infeasibility < -tolerance::contact * size)) continue;
		SCOPED_TRACE(trial);
		using Surface = SurfaceOfPair<D>;
		const Surface        own(pair);
		std::vector<Surface> others { Surface(pair, SurfaceParts::Contact), Surface(pair, SurfaceParts::Contact, Surface::Nowhere),
			Surface(pair, SurfaceParts::Cells, Surface::NearPlanesAlone) };
		if (own.facing) others.emplace_back(pair, SurfaceParts::Facing, Surface::NearPlanesAlone);
		facing += own.facing;
		const PlaneRows<Real, D> rows  = SurfaceOfPair<D>::rowsAbout(pair, own.origin);
		const ExactCells<D>      exact = exactOf<D>(rows, size);
		expectSums<D>(own, exact, size);
		const Real rounding = 32 * tolerance::rounding * size / own.deepest;
		const Real pressure = std::max(own.sums.pressure, Real(exact.volume) / size);
		if constexpr (D == 3) {
			const Surface vertices(pair, SurfaceParts::Cells, Surface::Vertices);
			if (vertices.status != SurfaceStatus::NoRoom) {
				SCOPED_TRACE("by vertices");
				expectSums<D>(vertices, exact, size);
				++ofVertices;
			}
		}
		for (const Surface& other : others) {
			EXPECT_EQ(other.status, own.status);
			EXPECT_LE((other.force() - own.force()).norm(), rounding * pressure);
		}
		++measured;
	}
	EXPECT_GE(measured, least);
	EXPECT_GE(100 * ofVertices, byVertices * measured);
	std::cout << measured << " pairs, of which " << facing << " face each other and " << ofVertices << " have a simple feasible set\n";
}

TEST(ContactSurface, IsExactForRegularSolids)
{
	const int faces[] = { 4, 6, 8, 12, 20 };
	expectExact<3>(
	        [&](int t, auto& r) { return regularPair(faces[t % 5], faces[t / 5 % 5], decades(r, -9, Real(-0.3)), r); }, 100, 100, 99);
}

TEST(ContactSurface, IsExactForRandomShapesPlatesAndNeedles)
{
	std::mt19937_64 random(3);
	Shapes          shapes = randomShapes(40, random, 3, -2);
	shapes.erase(
	        std::remove_if(shapes.begin(), shapes.end(), [](const auto& shape) { return shape->planeCount() > 24; }), shapes.end());
	expectExact<3>([&](int, auto& r) { return randomPair(shapes, r); }, 60, 30, 95);
}

TEST(ContactSurface, IsExactForNearlyParallelAndRepeatedPlanes)
{
	expectExact<3>([](int, auto& r) { return nearlyParallelPair(r, 3); }, 200, 100, 75);
}

TEST(ContactSurface, IsExactForOverlapsThinAcrossTwoAxes)
{
	expectExact<3>([](int t, auto& r) { return thinPair(t, r); }, 100, 100, 95);
}

TEST(ContactSurface, IsExactWhereOneBodyPassesThroughTheOther)
{
	expectExact<3>([](int, auto& r) { return piercingPair(r); }, 200, 150, 95);
}

TEST(ContactSurface, IsExactWhereOneBodyIsInTheOther)
{
	const int  faces[] = { 4, 6, 8, 12, 20 };
	const auto inside  = [&](int t, std::mt19937_64& random) {
                Pair pair;
                for (int body = 0; body < 2; ++body) {
                        pair.shape[body]    = ConvexShape::shared(regularSolid(faces[random() % 5], body == 0 ? 1 : Real(0.5)), 0);
                        pair.rotation[body] = t % 2 ? randomRotation(random) : Matrix3(Matrix3::Identity());
                }
                if (t % 3) pair.centre2 = decades(random, -3, 0) * randomDirection(random);
                return pair;
	};
	expectExact<3>(inside, 100, 90, 75);
}

/// A pyramid on a floor's face at z = 0, which it overlaps by `depth`: on its base or, upside down, on its tip.
Pair pyramidOnFloor(int sides, Real radius, Real height, Real depth, bool onTip)
{
	Pair pair;
	pair.shape[0] = ConvexShape::shared(cuboid(8, 8, 2), 0);
	pair.shape[1] = ConvexShape::shared(pyramid(sides, radius, height), 0);
	if (onTip) pair.rotation[1] = Eigen::AngleAxis<Real>(Real(M_PI), Vector3::UnitX()).toRotationMatrix();
	pair.centre2 = Vector3(0, 0, 2 - depth + (onTip ? height : Real(0)));
	return pair;
}

/// The sides of a pyramid meet in its tip, and the places where all of them have the same slack are a line through it.
TEST(ContactSurface, IsExactForPyramidsOfManySides)
{
	expectExact<3>(
	        [](int t, auto& r) {
		        const int  sides = t % 2 ? 20 : 40;
		        const Pair pair  = pyramidOnFloor(sides, decades(r, -1, 0), 1, decades(r, -6, -2), t % 4 < 2);
		        return t % 3 ? turned(pair, randomRotation(r)) : pair;
	        },
	        16, 16);
}

TEST(ContactSurface, IsExactForStackedCubes) { expectExact<3>(stackedPair, 60, 60, 100); }

/// Blocks in a row or column as they come to rest: their sides lie in line but for some roundings of their places, or more.
Pair nearlyInLine(int trial, std::mt19937_64& random)
{
	Pair pair = stackedPair(trial, random);
	pair.centre2 += decades(random, -17, -9) * randomDirection(random);
	return pair;
}

TEST(ContactSurface, IsExactForCubesNearlyInLine) { expectExact<3>(nearlyInLine, 200, 190, 95); }

/// Planes of both bodies that coincide are of either by half, also in sums that have no exact ones to be compared with.
TEST(ContactSurface, OfPlanesInLineIsTheSameByVerticesAsWalked)
{
	std::mt19937_64 random(74);
	for (int trial = 0; trial < 40; ++trial) {
		SCOPED_TRACE(trial);
		const Pair             pair = stackedPair(trial, random);
		const SurfaceOfPair<3> walked(pair), vertices(pair, SurfaceParts::Cells, SurfaceOfPair<3>::Vertices);
		const auto&            one      = walked.sums;
		const auto&            two      = vertices.sums;
		const Real             rounding = 64 * tolerance::rounding * pair.size() / walked.deepest, p = one.pressure;
		EXPECT_NEAR(two.area / one.area, 1, rounding);
		EXPECT_NEAR(two.pressure / p, 1, rounding);
		EXPECT_NEAR(two.weight / one.weight, 1, rounding);
		for (int k = 0; k < 3; ++k) {
			EXPECT_NEAR(two.areaVector[k], one.areaVector[k], rounding * one.area);
			EXPECT_NEAR(two.centre[k], one.centre[k], rounding * p * pair.size());
			EXPECT_NEAR(two.mainNormal[k], one.mainNormal[k], rounding * one.weight);
			EXPECT_NEAR(two.mainCentre[k], one.mainCentre[k], rounding * one.weight * pair.size());
		}
	}
}

TEST(ContactSurface, IsExactForBodiesThatCoincide)
{
	const int faces[] = { 4, 6, 8, 12 };
	Shapes    shapes;
	for (const int count : faces)
		shapes.push_back(ConvexShape::shared(regularSolid(count, 1), 0));
	expectExact<3>([&](int t, auto& r) { return coincidingPair(t, r, shapes); }, 60, 60);
}

/// Boxes that coincide but for a small turn: in a vertex of their feasible set two pairs of planes may meet that nearly coincide.
TEST(ContactSurface, IsExactForTwoPairsOfNearlyParallelPlanesInAVertex)
{
	const auto make = [](int, auto& random) {
		Pair       pair;
		const Real little = decades(random, -8, -5);
		pair.shape[0]     = pair.shape[1]
		        = ConvexShape::shared(cuboid(1, uniform(random, Real(0.3), 1), uniform(random, Real(0.3), 1)), 0);
		pair.centre2     = little / 4 * randomDirection(random);
		pair.rotation[1] = Eigen::AngleAxis<Real>(little, randomDirection(random)).toRotationMatrix();
		return turned(pair, randomRotation(random));
	};
	expectExact<3>(make, 300, 300, 50);
}

TEST(ContactSurface, IsExactInTwoDimensions)
{
	std::mt19937_64 random(4);
	const Shapes    shapes = randomShapes(40, random, 2, -2);
	expectExact<2>([&](int, auto& r) { return randomPair(shapes, r); }, 60, 30);
	expectExact<2>([](int, auto& r) { return nearlyParallelPair(r, 2); }, 600, 400);
	expectExact<2>([&](int t, auto& r) { return coincidingPair(t, r, shapes); }, 100, 90);
}

TEST(ContactSurface, KeepsItsDigitsAtAllSizes)
{
	const int faces[] = { 4, 6, 8, 12, 20 };
	expectExact<3>(
	        [&](int t, auto& r) {
		        const Real ratio = decades(r, -3, 3);
		        return scaled(regularPair(faces[t % 5], faces[t / 5 % 5], decades(r, -9, -1), r, ratio), decades(r, -9, 4));
	        },
	        100, 100, 95);
}

TEST(ContactSurface, OfCubesInLineKeepsItsDigitsAtAllSizes)
{
	expectExact<3>(
	        [](int t, auto& r) {
		        const Pair pair = t % 2 ? stackedPair(t / 2, r) : nearlyInLine(t / 2, r);
		        return scaled(pair, decades(r, -9, 4));
	        },
	        100, 95, 95);
}

// ------------------------------------------------------------------------------------------------------------ closed forms

/// A floor's face at z = 0 below a cube of side 2 in this orientation, whose lowest point is `depth` below it.
Pair onFloor(const Matrix3& rotation, Real depth)
{
	Pair pair;
	pair.shape[0]    = ConvexShape::shared(cuboid(8, 8, 2), Real(0.1));
	pair.shape[1]    = ConvexShape::shared(cuboid(1, 1, 1), Real(0.1));
	pair.rotation[1] = rotation;
	pair.centre2     = Vector3(0, 0, 2 + rotation.row(2).cwiseAbs().sum() - depth);
	return pair;
}

TEST(ContactSurface, OfAFaceOnAFaceIsAnElasticFoundation)
{
	for (const Real h : { 1e-1, 1e-3, 1e-6 }) {
		const SurfaceOfPair<3> own(onFloor(Matrix3::Identity(), h));
		// the rim, where a side of the cube is nearer than its lower face, is h/2 wide: pressure from 0 to h/2 on a slope of 45°
		EXPECT_NEAR(2 * own.sums.force[2] / (4 * h), 1, h);
		EXPECT_NEAR(2 * 2 * own.sums.volume / (4 * h * h), 1, h);
		EXPECT_LE(std::hypot(own.sums.force[0], own.sums.force[1]), 1e-15);
		// W/V is a sixth of the depth
		EXPECT_NEAR(6 * own.sums.level / (own.sums.volume * h), 1, h);
		EXPECT_EQ(own.sums.pieces, 5);
	}
}

/// Integral over [from, to] of what is a polynomial of up to the fifth degree.
Real integral(Real from, Real to, const std::function<Real(Real)>& of)
{
	const Real middle = (from + to) / 2, half = (to - from) / 2, far = half * std::sqrt(Real(3) / 5);
	return half / 9 * (5 * of(middle - far) + 8 * of(middle) + 5 * of(middle + far));
}

/// Feasible with the pressure s is a frustum or a pyramid, whose area at a height is N tan(π/N) times the square of its inscribed radius.
TEST(ContactSurface, OfAConeOfManySidesIsAsItsClosedFormSays)
{
	std::mt19937_64 random(75);
	const Real      radius = Real(0.5), height = 1, tangent = radius / height, cosine = 1 / std::sqrt(1 + tangent * tangent),
	           sine = tangent * cosine;
	for (const int sides : { 30, 48, 80, 100, 160, 200, 300, 1000 })
		for (const bool onTip : { false, true })
			for (int trial = 0; trial < (sides < 200 ? 6 : 1); ++trial) {
				SCOPED_TRACE(testing::Message()
				        << sides << " sides, on its " << (onTip ? "tip" : "base") << ", trial " << trial);
				const Real             h = decades(random, -6, -2), shape = sides * std::tan(Real(M_PI) / sides);
				const SurfaceOfPair<3> own(turned(pyramidOnFloor(sides, radius, height, h, onTip), randomRotation(random)));
				const Real             steep = 1 + 1 / sine, c = shape * tangent * tangent;
				Real volume = c * std::pow(h, 4) / (12 * steep), level = c * std::pow(h, 5) / (60 * steep * steep);
				if (!onTip) {
					const auto above = [&](Real s) {
						return integral(s, h - s,
						        [&](Real z) { return shape * std::pow(radius - z * tangent - s / cosine, 2); });
					};
					volume = integral(0, h / 2, above);
					level  = integral(0, h / 2, [&](Real s) { return s * above(s); });
				}
				// about the line in which the sides meet there are pieces as narrow as rounding (MeetingPlanes.hpp)
				const Real rounding = 64 * tolerance::rounding / own.deepest + (onTip ? Real(1e-9) : Real(0));
				EXPECT_EQ(own.status, SurfaceStatus::Found);
				EXPECT_EQ(own.sums.pieces, onTip ? sides : sides + 1);
				EXPECT_NEAR(own.sums.volume / volume, 1, rounding);
				EXPECT_NEAR(own.sums.level / level, 1, rounding);
				if (onTip) {
					EXPECT_NEAR(own.force().norm() / (4 * volume / h), 1, rounding);
				}
			}
}

TEST(ContactSurface, PressesAlongTheNormalOfTheOnlyFace)
{
	const Matrix3 edge   = Eigen::AngleAxis<Real>(Real(0.7), Vector3::UnitY()).toRotationMatrix();
	const Matrix3 vertex = Eigen::AngleAxis<Real>(Real(0.4), Vector3::UnitX()).toRotationMatrix() * edge;
	for (const Matrix3& rotation : { Matrix3(Matrix3::Identity()), edge, vertex })
		for (const Real depth : { 1e-9, 1e-5, 1e-2 }) {
			const SurfaceOfPair<3> own(onFloor(rotation, depth));
			EXPECT_LE(std::hypot(own.sums.force[0], own.sums.force[1]), 1e-14 * own.sums.force[2] / depth);
			EXPECT_GT(own.sums.force[2], 0);
		}
}

// -------------------------------------------------------------------------------------------------------------- gradients

/// Body 2 moved along and turned about axis k, through body 1's centre.
Pair displaced(const Pair& pair, int k, Real way, Real angle)
{
	Pair          out  = pair;
	const Matrix3 turn = Eigen::AngleAxis<Real>(angle, Vector3::Unit(k)).toRotationMatrix();
	out.centre2        = turn * pair.centre2 + way * Vector3::Unit(k);
	out.rotation[1]    = turn * pair.rotation[1];
	return out;
}

/// Force and moment against differences of V and W. Both are piecewise polynomials of the motion, smooth to their second derivative, so that
/// central differences err by the square of the step, and where a piece comes or goes by a part of it.
template <int D> void expectGradient(const Pair& pair, Real allowed)
{
	const SurfaceOfPair<D> own(pair);
	const Real             step = Real(1e-4) * own.deepest, size = pair.reach();
	const auto             slope = [&](int k, bool turning, bool level) {
                Real value[2];
                for (int side = 0; side < 2; ++side) {
                        const Real             by = side == 0 ? -step : step;
                        const SurfaceOfPair<D> there(displaced(pair, k, turning ? 0 : by, turning ? by / size : 0));
                        value[side] = level ? there.sums.level : there.sums.volume;
                }
                return -(value[1] - value[0]) / (2 * step) * (turning ? size : 1);
	};
	for (int k = 0; k < D; ++k) {
		EXPECT_NEAR(slope(k, false, false) / own.sums.pressure, own.force()[k] / own.sums.pressure, allowed) << k;
		EXPECT_NEAR(slope(k, false, true) / (own.sums.pressure * own.deepest), own.deeper()[k] / (own.sums.pressure * own.deepest),
		        allowed);
	}
	for (int k = D == 3 ? 0 : 2; k < 3; ++k) {
		const Real scale = own.sums.pressure * size;
		EXPECT_NEAR(slope(k, true, false) / scale, own.moment()[k] / scale, allowed) << k;
		EXPECT_NEAR(slope(k, true, true) / (scale * own.deepest), own.deeperTurn()[k] / (scale * own.deepest), allowed) << k;
	}
}

TEST(ContactSurface, ForceAndMomentAreTheGradientOfTheEnergy)
{
	const Matrix3 tilted = Eigen::AngleAxis<Real>(Real(1e-3), Vector3(1, 2, 0).normalized()).toRotationMatrix();
	const Matrix3 edge   = Eigen::AngleAxis<Real>(Real(0.7), Vector3::UnitY()).toRotationMatrix();
	const Matrix3 vertex = Eigen::AngleAxis<Real>(Real(0.4), Vector3::UnitX()).toRotationMatrix() * edge;
	for (const Matrix3& rotation : { tilted, edge, vertex })
		expectGradient<3>(turned(onFloor(rotation, Real(0.01)), tilted), Real(1e-6));
	// two edges that cross
	Pair crossing;
	crossing.shape[0] = crossing.shape[1] = ConvexShape::shared(cuboid(1, 1, 1), Real(0.1));
	crossing.rotation[0]                  = Eigen::AngleAxis<Real>(Real(M_PI) / 4, Vector3::UnitX()).toRotationMatrix();
	crossing.rotation[1]                  = Eigen::AngleAxis<Real>(Real(0.8), Vector3::UnitY()).toRotationMatrix();
	crossing.rotation[1] = Eigen::AngleAxis<Real>(Real(0.3), Vector3::UnitZ()).toRotationMatrix() * crossing.rotation[1];
	moveTo(crossing, Vector3(Real(0.1), Real(-0.05), 1).normalized(), Real(-0.01));
	expectGradient<3>(crossing, Real(1e-6));
}

TEST(ContactSurface, ForceAndMomentAreTheGradientForRandomPairs)
{
	std::mt19937_64 random(12);
	const int       faces[] = { 4, 6, 8, 12, 20 };
	for (int trial = 0; trial < 50; ++trial) {
		SCOPED_TRACE(trial);
		expectGradient<3>(regularPair(faces[trial % 5], faces[trial / 5 % 5], decades(random, -3, Real(-0.3)), random), Real(1e-6));
	}
	for (int trial = 0; trial < 50; ++trial) {
		SCOPED_TRACE(trial);
		Pair pair;
		for (int body = 0; body < 2; ++body) {
			pair.shape[body]    = ConvexShape::shared(randomPlanes(4 + int(random() % 8), random, 2), 0);
			pair.rotation[body] = randomRotation(random, 2);
		}
		moveTo(pair, randomDirection(random, 2), -decades(random, -3, -1));
		expectGradient<2>(pair, Real(1e-6));
	}
}

// --------------------------------------------------------------------------------------------------------------- symmetries

TEST(ContactSurface, IsTheSameWithBodiesExchangedTurnedAndScaled)
{
	std::mt19937_64 random(8);
	const Shapes    shapes = randomShapes(30, random, 3, -1);
	for (int trial = 0; trial < 60; ++trial) {
		SCOPED_TRACE(trial);
		const Pair pair = randomPair(shapes, random);
		if (!(infeasibility(pair) < -1e-9 * pair.size())) continue;
		const SurfaceOfPair<3> own(pair), other(swapped(pair));
		const Real             rounding = 256 * tolerance::rounding * pair.reach() / own.deepest;
		const Real             force = rounding * own.sums.pressure, moment = force * pair.reach();
		EXPECT_LE((other.force() + own.force()).norm(), force);
		EXPECT_LE((other.moment() + (own.moment() - pair.centre2.cross(own.force()))).norm(), moment);
		const Matrix3          turn = randomRotation(random);
		const SurfaceOfPair<3> there(turned(pair, turn)), large(scaled(pair, 1024));
		EXPECT_LE((there.force() - turn * own.force()).norm(), force);
		EXPECT_LE((there.moment() - turn * own.moment()).norm(), moment);
		EXPECT_NEAR(there.sums.volume / own.sums.volume, 1, rounding);
		EXPECT_LE((large.force() / std::pow(Real(1024), 3) - own.force()).norm(), force);
		EXPECT_NEAR(large.sums.volume / std::pow(Real(1024), 4) / own.sums.volume, 1, rounding);
		EXPECT_NEAR(large.sums.level / std::pow(Real(1024), 5) / own.sums.level, 1, rounding);
	}
}

/// Three planes of one body have the same slack along a line: the one between the two others is nearest nowhere, and which of them are looked at first is
/// of no account.
TEST(ContactSurface, PlanesOfAPencilBoundACellOnce)
{
	const Real turns[][3] = { { 0, -5e-10, 1e-10 }, { -5e-10, 0, 1e-10 }, { 1e-10, -5e-10, 0 }, { -5e-10, 1e-10, 0 } };
	Pair       pair;
	pair.centre2     = Vector3(Real(-1.9), Real(0.1), 0);
	pair.shape[1]    = ConvexShape::shared(rectangle(1, Real(0.5)), 0);
	pair.rotation[1] = Eigen::AngleAxis<Real>(Real(0.3), Vector3::UnitZ()).toRotationMatrix();
	pair.shape[0]    = ConvexShape::shared(rectangle(1, 1), 0);
	const SurfaceOfPair<2> flat(pair);
	for (const auto& turn : turns) {
		HalfSpaces body = rectangle(1, 1);
		body.normals[1] = Vector3(-1, turn[0], 0);
		for (int k = 1; k < 3; ++k) {
			body.normals.push_back(Vector3(-1, turn[k], 0));
			body.offsets.push_back(1);
		}
		PlaneRows<Real, 2>            rows(body, moved(pair.shape[1]->planes(), pair.rotation[1], pair.centre2));
		std::vector<Real>             numbers(std::size_t(SurfaceBuffers<Real, 2>::numbersNeeded(rows.planes.total)), Real(NAN));
		std::vector<int>              indices(std::size_t(SurfaceBuffers<Real, 2>::indicesNeeded(rows.planes.total)), -77);
		const SurfaceBuffers<Real, 2> buffers(rows.planes.total, numbers.data(), indices.data());
		SurfaceSums<Real, 2>          sums;
		int                           basis[] = { rows.row(0, 1), rows.row(0, 4), rows.row(1, 0) };
		EXPECT_EQ(
		        (contactSurface<Real, 2, 1>(rows.planes, basis, 3, pair.size(), flat.deepest, SurfaceParts::Cells, buffers, sums)),
		        SurfaceStatus::Found);
		EXPECT_NEAR(sums.volume / flat.sums.volume, 1, 1e-8);
		EXPECT_NEAR(sums.overlap / flat.sums.overlap, 1, 1e-8);
		EXPECT_NEAR(sums.level / flat.sums.level, 1, 1e-8);
	}
}

// ------------------------------------------------------------------------------------------------------------------- memory

/// Places in memory: each within all, and none on another.
template <class T> void expectApart(const T* memory, int size, std::vector<std::pair<const T*, int>> places)
{
	std::sort(places.begin(), places.end());
	const T* free = memory;
	for (const auto& [begin, count] : places) {
		EXPECT_GE(begin, free);
		free = begin + count;
	}
	EXPECT_LE(free, memory + size);
}

TEST(ContactSurface, BuffersAreWithinTheirMemoryAndApart)
{
	for (const int total : { 8, 12, 400 }) {
		using Walk = SurfaceBuffers<Real, 3>;
		std::vector<Real> numbers(std::size_t(Walk::numbersNeeded(total)));
		std::vector<int>  indices(std::size_t(Walk::indicesNeeded(total)));
		const Walk        walk(total, numbers.data(), indices.data());
		const int         clipped = Walk::clippedRoom(total);
		EXPECT_GE(walk.length, total + 1); // the plane of no pressure, too
		expectApart<Real>(numbers.data(), int(numbers.size()),
		        { { walk.rate[0], walk.length }, { walk.rate[1], walk.length }, { walk.rest, walk.length },
		                { walk.vertex[0][0], walk.room }, { walk.vertex[0][1], walk.room }, { walk.vertex[0][2], walk.room },
		                { walk.vertex[1][0], walk.room }, { walk.vertex[1][1], walk.room }, { walk.vertex[1][2], walk.room },
		                { walk.clipped[0][0], clipped }, { walk.clipped[0][1], clipped }, { walk.clipped[1][0], clipped },
		                { walk.clipped[1][1], clipped }, { walk.line[0], walk.room }, { walk.line[1], walk.room },
		                { walk.line[2], walk.room }, { walk.cell, 5 * total }, { walk.dropped, total } });
		expectApart<int>(indices.data(), int(indices.size()),
		        { { walk.lineTag, walk.room }, { walk.edge[0], walk.room }, { walk.edge[1], walk.room }, { walk.twin, total },
		                { walk.queue, Walk::queued * walk.pieces }, { walk.slot, 4 * walk.pieces } });

		using Set = FeasibleBuffers<Real>;
		numbers.resize(std::size_t(Set::numbersNeeded(total)));
		const Set set(total, numbers.data(), indices.data());
		expectApart<Real>(numbers.data(), int(numbers.size()),
		        { { set.plane, 4 * Set::mostPlanes }, { set.point, 4 * Set::mostVertices }, { set.split, total + padWidth },
		                { set.slack, total + padWidth }, { set.outline, Set::outlineRows * Set::mostPlanes } });
		EXPECT_GE(Set::indicesNeeded(total), total + 1);
		// the copy of the tight planes is on none of them
		FeasibleBuffers<Real> full(total, numbers.data(), indices.data());
		full.planes = Set::mostPlanes;
		for (int k = 0; k < 4 * Set::mostPlanes; ++k)
			full.plane[k] = k;
		const PairPlanes<Real, 3> copy = full.tightPlanes();
		for (int k = 0; k < Set::mostPlanes; ++k) {
			EXPECT_EQ(Vector3(copy.normal[0][k], copy.normal[1][k], copy.normal[2][k]), Vector3(4 * k, 4 * k + 1, 4 * k + 2));
			EXPECT_EQ(copy.offset[k], 4 * k + 3);
		}
	}
}

TEST(ContactSurface, MorePiecesThanThereIsRoomForAreToldOf)
{
	const Pair               pair = onFloor(Matrix3::Identity(), Real(0.1));
	const SurfaceOfPair<3>   own(pair);
	const PlaneRows<Real, 3> rows   = SurfaceOfPair<3>::rowsAbout(pair, own.origin);
	PairPlanes<Real, 3>      planes = rows.planes;
	std::vector<Real>        numbers(std::size_t(SurfaceBuffers<Real, 3>::numbersNeeded(planes.total)));
	std::vector<int>         indices(std::size_t(SurfaceBuffers<Real, 3>::indicesNeeded(planes.total)));
	SurfaceBuffers<Real, 3>  buffers(planes.total, numbers.data(), indices.data());
	int                      facing[2]; // the planes between the bodies
	for (int body = 0; body < 2; ++body)
		for (int k = planes.begin(body); k < planes.end(body); ++k)
			if (planes.normal[2][k] * (1 - 2 * body) > Real(0.9)) facing[body] = k;
	for (const int room : { 1, 3, 12, buffers.pieces }) {
		buffers.pieces = room;
		SurfaceSums<Real, 3> sums;
		const auto           status
		        = contactSurface<Real, 3, 1>(planes, facing, 2, pair.size(), own.deepest, SurfaceParts::Cells, buffers, sums);
		EXPECT_EQ(status, room < 20 ? SurfaceStatus::NoRoom : SurfaceStatus::Found);
	}
}

TEST(KeptVertices, ARowIsFoundByItsNameAndOneWithoutANameIsToldOf)
{
	const int    first = 40000, total = 80000;
	KeptVertices kept;
	for (const int row : { 0, 5, 32766, first, first + 7, first + 32766 }) {
		const int name = KeptVertices::name(row, first);
		ASSERT_GE(name, 0);
		kept.plane[0] = std::uint16_t(name);
		EXPECT_EQ(kept.row(0, first, total), row);
	}
	EXPECT_EQ(KeptVertices::name(32767, first), -1);
	EXPECT_EQ(KeptVertices::name(first + 32767, first), -1);
	kept.plane[0] = KeptVertices::noPressure;
	EXPECT_EQ(kept.row(0, first, total), total);
	// of bodies with fewer planes
	kept.plane[0] = std::uint16_t(planeCode(0, 8));
	EXPECT_EQ(kept.row(0, 8, 16), -1);
	kept.plane[0] = std::uint16_t(planeCode(1, 8));
	EXPECT_EQ(kept.row(0, 8, 16), -1);
	kept.plane[0] = std::uint16_t(planeCode(1, 7));
	EXPECT_EQ(kept.row(0, 8, 16), 15);
}

// --------------------------------------------------------------------------------------------------------------- many pieces

TEST(ContactSurface, PiecesOfAFloorAddUp)
{
	const Real h = Real(1e-3);
	Pair       whole, left, right;
	whole.shape[0] = ConvexShape::shared(cuboid(4, 4, 1), Real(0.1));
	left.shape[0] = right.shape[0] = ConvexShape::shared(cuboid(2, 4, 1), Real(0.1));
	whole.shape[1] = left.shape[1] = right.shape[1] = ConvexShape::shared(cuboid(1, 1, 1), Real(0.1));
	for (const Real beyond : { 0.05, 0.5, 1., 1.7 }) {
		whole.centre2 = Vector3(-1 + beyond, Real(0.2), 2 - h);
		left.centre2  = whole.centre2 + Vector3(2, 0, 0);
		right.centre2 = whole.centre2 - Vector3(2, 0, 0);
		const SurfaceOfPair<3> one(whole), first(left), second(right);
		EXPECT_LE((first.force() + second.force() - one.force()).norm() / one.force().norm(), h) << beyond;
		EXPECT_NEAR((first.sums.volume + second.sums.volume) / one.sums.volume, 1, h) << beyond;
	}
}

/// Deep overlaps, whose planes are nearest far from the optimum.
TEST(ContactSurface, OfDeepOverlapsIsThatOfTheNearPlanes)
{
	std::mt19937_64 random(31);
	const Shapes    shapes = randomShapes(60, random, 3, -2);
	int             fewer  = 0;
	for (int trial = 0; trial < 3000; ++trial) {
		SCOPED_TRACE(trial);
		Pair pair;
		for (int body = 0; body < 2; ++body) {
			pair.shape[body]    = shapes[random() % shapes.size()];
			pair.rotation[body] = randomRotation(random);
		}
		pair.centre2 = uniform(random, 0, 2) * pair.inscribedRadius() * randomDirection(random);
		if (!(infeasibility(pair) < Real(-1e-6) * pair.size())) continue;
		const SurfaceOfPair<3> own(pair), near(pair, SurfaceParts::Cells, SurfaceOfPair<3>::NearPlanesAlone);
		const Real             rounding = 256 * tolerance::rounding * pair.reach() / own.deepest;
		EXPECT_EQ(near.status, own.status);
		EXPECT_NEAR(near.sums.volume / own.sums.volume, 1, rounding);
		EXPECT_LE((near.force() - own.force()).norm(), rounding * own.sums.volume / own.deepest);
		fewer += near.planes < own.planes;
	}
	EXPECT_GT(fewer, 100);
}

TEST(ContactSurface, OfManyPlanesIsThatOfTheNearOnes)
{
	std::mt19937_64 random(30);
	for (const int count : { 100, 400, 1000 }) {
		Pair pair;
		for (auto& shape : pair.shape)
			shape = ConvexShape::shared(randomPlanes(count, random), 0);
		for (Matrix3& rotation : pair.rotation)
			rotation = randomRotation(random);
		moveTo(pair, randomDirection(random), Real(-1e-4));
		const SurfaceOfPair<3>   own(pair);
		const PlaneRows<Real, 3> rows = SurfaceOfPair<3>::rowsAbout(pair, own.origin);
		// a plane farther from the origin than the overlap reaches, and its depth, is nearest nowhere
		PairPlanes<Real, 3> near = rows.planes;
		std::vector<Real>   offset(rows.planes.offset, rows.planes.offset + near.total);
		const Real          reach = Real(0.2);
		near.offset               = offset.data();
		for (Real& d : offset)
			if (d > reach + own.deepest) d = Real(padOffset);
		ExactCells<3> exact(near);
		exact.measure(3);
		ASSERT_LT(exact.farthest, Fine(reach));
		ASSERT_LT(exact.planes.size(), 150u);
		EXPECT_NEAR(Real(Fine(own.sums.volume) / exact.volume), 1, 1e-10) << count;
		EXPECT_LE(distance(own.sums.force, exact.force), 1e-10 * own.sums.pressure) << count;
		EXPECT_EQ(own.status, SurfaceStatus::Found);
		const SurfaceOfPair<3> few(pair, SurfaceParts::Cells, SurfaceOfPair<3>::NearPlanesAlone);
		EXPECT_LT(few.planes, own.planes / 4);
		EXPECT_NEAR(few.sums.volume / own.sums.volume, 1, 1e-10);
	}
}

} // namespace
