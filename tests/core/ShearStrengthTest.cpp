// SPDX-License-Identifier: GPL-2.0-or-later
#include "shear/ShearReturn.hpp"
#include "shear/ShearTolerances.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

using namespace polytope;

namespace {

Vector3 returned(const ShearStrength& strength, const Matrix3& stiffness, Vector3& load, Vector3 likely = Vector3::Zero())
{
	return returnToStrength(strength, stiffness, load, likely);
}

using Corners = std::vector<Vector2>;

Corners regularOutline(int sides, Real radius)
{
	Corners corners;
	for (int k = 0; k < sides; ++k)
		corners.push_back(radius * Vector2(std::cos(2 * M_PI * k / sides), std::sin(2 * M_PI * k / sides)));
	return corners;
}

Corners rectangleOutline(Real length, Real width)
{
	return { { -length / 2, -width / 2 }, { length / 2, -width / 2 }, { length / 2, width / 2 }, { -length / 2, width / 2 } };
}

Corners randomOutline(std::mt19937_64& random, std::size_t count = 7)
{
	std::uniform_real_distribution<double> uniform(-M_PI, M_PI);
	std::vector<double>                    angles(count);
	for (double& angle : angles)
		angle = uniform(random);
	std::sort(angles.begin(), angles.end());
	Corners points;
	for (double angle : angles)
		points.push_back(Vector2(2 * std::cos(angle) + 3, std::sin(angle) - 1));
	return points;
}

ShearStrength strengthOf(const Corners& corners, const Vector2& offset, Real total = 1)
{
	const OutlineMoments moments = momentsOf(corners.data(), int(corners.size()));
	return { corners.data(), int(corners.size()), moments, total, Vector2(moments.centroid + offset) };
}

/// Mean distance of the strength from its centre, by what turning on the spot meets.
Real meanRadius(const ShearStrength& strength) { return std::abs(strength.resistance(Vector3(0, 0, 1))[2]) / strength.total(); }

/// Force and moment by brute force: small squares, τ linear with its centre at `offset` from the centroid of a rectangle about the origin.
Vector3 bySquares(Real length, Real width, const Vector2& offset, const Vector3& slip, int cells = 600)
{
	const Vector2 gradient(12 * offset[0] / (length * length), 12 * offset[1] / (width * width)); // over the mean
	Vector3       sum = Vector3::Zero();
	Real          all = 0;
	for (int i = 0; i < cells; ++i)
		for (int j = 0; j < cells; ++j) {
			const Vector2 x((i + 0.5) / cells * length - length / 2, (j + 0.5) / cells * width - width / 2), arm = x - offset;
			const Real    tau = 1 + gradient.dot(x);
			const Vector2 v = Vector2(slip[0] - slip[2] * arm[1], slip[1] + slip[2] * arm[0]), d = v.normalized();
			sum += tau * Vector3(d[0], d[1], arm[0] * d[1] - arm[1] * d[0]);
			all += tau;
		}
	return sum / all;
}

TEST(ContactOutline, MomentsOfARectangleFarFromThePoint)
{
	Corners corners = rectangleOutline(3, 2);
	for (Vector2& corner : corners)
		corner += Vector2(50, -70);
	const OutlineMoments moments = momentsOf(corners.data(), 4);
	EXPECT_NEAR(moments.area, 6, 1e-12);
	EXPECT_NEAR((moments.centroid - Vector2(50, -70)).norm(), 0, 1e-12);
	EXPECT_NEAR(moments.second[0], 27 * 2 / 12., 1e-11);
	EXPECT_NEAR(moments.second[1], 0, 1e-11);
	EXPECT_NEAR(moments.second[2], 8 * 3 / 12., 1e-11);
	EXPECT_NEAR(moments.gyrationSquared(), (9 + 4) / 12., 1e-11);
	EXPECT_EQ(momentsOf(corners.data(), 2).area, 0);
}

TEST(ContactOutline, MomentsOfATurnedRectangleAndATriangle)
{
	Corners turned = rectangleOutline(3, 2);
	for (Vector2& corner : turned)
		corner = Eigen::Rotation2D<Real>(0.4) * corner;
	const OutlineMoments moments = momentsOf(turned.data(), 4);
	const Real           mean = (27 * 2 + 8 * 3) / 24., half = (27 * 2 - 8 * 3) / 24.;
	EXPECT_NEAR(moments.second[0], mean + half * std::cos(0.8), 1e-14);
	EXPECT_NEAR(moments.second[1], half * std::sin(0.8), 1e-14);
	EXPECT_NEAR(moments.second[2], mean - half * std::cos(0.8), 1e-14);
	const Corners triangle { { 1, 1 }, { 4, 1 }, { 1, 3 } };
	const auto    of = momentsOf(triangle.data(), 3);
	EXPECT_NEAR(of.area, 3, 1e-15);
	EXPECT_NEAR((of.centroid - Vector2(2, 5 / 3.)).norm(), 0, 1e-15);
	EXPECT_NEAR(of.second[0], 27 * 2 / 36., 1e-14);
	EXPECT_NEAR(of.second[1], -9 * 4 / 72., 1e-14);
	EXPECT_NEAR(of.second[2], 3 * 8 / 36., 1e-14);
}

TEST(ContactOutline, OfALineOrAPointHasNoMoments)
{
	for (const Corners& corners : { Corners { { 1, 2 }, { 2, 4 }, { 4, 8 } }, Corners { { 1, 2 }, { 1, 2 }, { 1, 2 }, { 1, 2 } } }) {
		const OutlineMoments moments = momentsOf(corners.data(), int(corners.size()));
		EXPECT_EQ(moments.area, 0);
		EXPECT_EQ(moments.centroid, Vector2::Zero());
		EXPECT_EQ(moments.gyrationSquared(), 0);
	}
}

// Mean distance from the centre: disc 2 R/3, square 0.382598 a, equilateral triangle by its closed form.
TEST(ShearStrength, MeanRadiusOfKnownShapes)
{
	EXPECT_NEAR(meanRadius(strengthOf(regularOutline(2000, 3), Vector2::Zero())), 2, 1e-5);
	EXPECT_NEAR(meanRadius(strengthOf(rectangleOutline(2, 2), Vector2::Zero())), 2 * (std::sqrt(2.) + std::asinh(1.)) / 6, 1e-14);
	const Real a = std::sqrt(3.); // side of the triangle in the unit circle, whose in-radius is 1/2
	const Real t = a / 2, h = 0.5;
	const Real edge = h * (t * std::hypot(t, h) + h * h * std::asinh(t / h)); // ∫ ρ dy over an edge, times h
	EXPECT_NEAR(meanRadius(strengthOf(regularOutline(3, 1), Vector2::Zero())), 3 * edge / 3 / (3 * std::sqrt(3.) / 4), 1e-14);
	EXPECT_NEAR(meanRadius(strengthOf(rectangleOutline(1, 1e-9), Vector2::Zero())), 0.25, 1e-7);
}

// The bound from below: mean square of the distance over the largest. With the centre at o from a rectangle's middle the former is (a² + b²)/12 − |o|².
TEST(ShearStrength, LeastRadiusIsTheMeanSquareOverTheLargest)
{
	for (const Vector2& offset : { Vector2(0, 0), Vector2(0.2, 0), Vector2(-0.1, 0.05) }) {
		const Corners       corners = rectangleOutline(3, 1);
		const ShearStrength field   = strengthOf(corners, offset, 5);
		const Real          largest = std::hypot(1.5 + std::abs(offset[0]), 0.5 + std::abs(offset[1]));
		EXPECT_NEAR(field.leastRadius(), (10 / 12. - offset.squaredNorm()) / largest, 1e-14);
		EXPECT_LT(field.leastRadius(), meanRadius(field));
	}
}

// The other bound is that of the densest disc: of a triangle whose strength falls from a corner to nothing on the opposite edge, a third of the area.
// Its radius is then R = √(A/3π), and its mean distance 2R/3.
TEST(ShearStrength, LeastRadiusOnAreaIsBelowTheMeanDistanceFromAnyPlace)
{
	EXPECT_NEAR(leastRadiusOnArea(3 * M_PI), 2 / 3., 1e-15);
	std::mt19937_64                        random(4);
	std::uniform_real_distribution<double> place(-1, 1);
	for (int k = 0; k < 200; ++k) {
		const Corners        corners = randomOutline(random, 3 + std::size_t(k % 5));
		const OutlineMoments moments = momentsOf(corners.data(), int(corners.size()));
		// as far as it goes to one side: there the strength is nowhere negative and nothing on the opposite edge or corner
		const ShearStrength field = strengthOf(corners, 5 * Vector2(place(random), place(random)));
		const Real          bound = leastRadiusOnArea(moments.area);
		EXPECT_GE(field.leastRadius(), bound);
		for (int turned = 0; turned < 20; ++turned) { // about other places than the centre, too
			const Vector3 slip(place(random), place(random), 1);
			EXPECT_GE(field.resistance(slip).dot(slip), bound * (1 - 1e-12));
			EXPECT_GE(field.resistance(slip).dot(slip), slip.head<2>().norm() * (1 - 1e-12));
		}
	}
}

/// The part of a convex outline in which way·x ≤ place.
Corners cutOff(const Corners& corners, const Vector2& way, Real place)
{
	Corners part;
	for (std::size_t k = 0; k < corners.size(); ++k) {
		const Vector2 &here = corners[k], &next = corners[(k + 1) % corners.size()];
		const Real     from = place - way.dot(here), to = place - way.dot(next);
		if (from >= 0) part.push_back(here);
		if ((from >= 0) != (to >= 0)) part.push_back(here + from / (from - to) * (next - here));
	}
	return part;
}

/// A strength with this gradient over the mean, and one at the centroid.
ShearStrength withGradient(const Corners& corners, const Vector2& gradient, Real atCentroid)
{
	const OutlineMoments moments = momentsOf(corners.data(), int(corners.size()));
	const Real           total   = atCentroid * moments.area;
	const Vector2        first(moments.second[0] * gradient[0] + moments.second[1] * gradient[1],
	               moments.second[1] * gradient[0] + moments.second[2] * gradient[1]);
	return { corners.data(), int(corners.size()), moments, total, Vector2(moments.centroid + first / total) };
}

// An outline cut in two has the resistance of both parts together, whatever its shape and wherever the centre of rotation is: inside, on the rim, far away.
TEST(ShearStrength, PartsOfAnOutlineAddUp)
{
	std::mt19937_64                        random(6);
	std::uniform_real_distribution<double> uniform(-1, 1);
	int                                    cut = 0;
	for (int trial = 0; trial < 2000; ++trial) {
		SCOPED_TRACE(trial);
		Corners    corners = randomOutline(random, std::size_t(3 + trial % 5));
		const Real flat    = trial % 4 ? Real(1) : std::pow(10, 2 * uniform(random) - 2);
		for (Vector2& corner : corners)
			corner[1] *= flat;
		const OutlineMoments moments = momentsOf(corners.data(), int(corners.size()));
		if (!(moments.area > 0.1 * flat)) continue;
		Vector2 gradient(uniform(random), uniform(random) / flat);
		Real    most = 0;
		for (const Vector2& corner : corners)
			most = std::max(most, std::abs(gradient.dot(corner - moments.centroid)));
		gradient *= 0.9 / most;
		const auto at    = [&](const Vector2& x) { return 1 + gradient.dot(x - moments.centroid); };
		const auto whole = withGradient(corners, gradient, 1);
		// about a pole near the outline, or at up to a million times its distance
		const Real    far  = std::pow(10, trial % 3 ? uniform(random) : 3 + 3 * uniform(random));
		const Vector2 pole = moments.centroid + far * Vector2(uniform(random), (trial % 2 ? 1 : flat) * uniform(random));
		const Vector2 way(uniform(random), uniform(random) / flat);
		const Real    place = way.dot(moments.centroid) + 0.1 * uniform(random);
		const auto    about = [&](const ShearStrength& strength) {
                        const Vector2 slip = left(strength.centre() - pole);
                        const Vector3 f    = strength.resistance(Vector3(slip[0], slip[1], 1));
                        return Vector3(f[0], f[1], f[2] + cross(strength.centre() - whole.centre(), f.head<2>()));
		};
		Vector3 sum = Vector3::Zero();
		for (const int side : { 1, -1 }) {
			const Corners        part = cutOff(corners, side * way, side * place);
			const OutlineMoments of   = momentsOf(part.data(), int(part.size()));
			if (of.area > 0) sum += about(withGradient(part, gradient, at(of.centroid)));
			cut += of.area > 0.01 * moments.area && of.area < 0.99 * moments.area;
		}
		EXPECT_LT((sum - about(whole)).norm(), 1e-11 * whole.total());
	}
	EXPECT_GT(cut, 2000);
}

// Pole inside, on the rim, outside; pressure even and towards one side.
TEST(ShearStrength, ResistanceIsThatOfManySmallSquares)
{
	for (const Vector2& offset : { Vector2(0, 0), Vector2(0.2, 0), Vector2(0.1, 0.05) })
		for (const Vector3& slip :
		        { Vector3(0, 0, 1), Vector3(0.3, 0.1, 1), Vector3(0.3, 0.1, -1), Vector3(1, -2, 1), Vector3(5, 3, 0.1) }) {
			const Corners corners = rectangleOutline(3, 1);
			const Vector3 exact = strengthOf(corners, offset).resistance(slip), squares = bySquares(3, 1, offset, slip);
			EXPECT_LT((exact - squares).norm(), 1e-5) << offset.transpose() << " / " << slip.transpose();
		}
	// a square has no long axis
	const Corners square = rectangleOutline(2, 2);
	const Vector2 offset(0.1, 0.2);
	const Vector3 slip(0.3, 0.1, 1);
	EXPECT_LT((strengthOf(square, offset).resistance(slip) - bySquares(2, 2, offset, slip)).norm(), 1e-5);
}

TEST(ShearStrength, ARepeatedCornerChangesNothing)
{
	std::mt19937_64 random(5);
	for (int sample = 0; sample < 200; ++sample) {
		const Corners corners = randomOutline(random);
		for (const Real aside : { 0., 1e-17, 1e-15, 1e-12 }) {
			Corners repeated = corners;
			repeated.insert(repeated.begin() + 2, corners[1] + Vector2(aside, -aside));
			const ShearStrength one   = strengthOf(corners, Vector2(0.02, -0.01)),
			                    other = strengthOf(repeated, Vector2(0.02, -0.01));
			// about that corner, a place inside, and one far away
			for (const Vector2& pole : { corners[1], Vector2(3, -1), Vector2(20, 5) }) {
				const Vector2 arm  = one.centre() - pole;
				const Vector3 slip = { -arm[1], arm[0], 1 };
				EXPECT_LE((one.resistance(slip) - other.resistance(slip)).norm(), 1e-10) << sample << ' ' << aside;
			}
		}
	}
}

TEST(ShearStrength, SlopeIsTheDerivativeAndPowerIsTheWork)
{
	std::mt19937_64                        random(3);
	std::uniform_real_distribution<double> uniform(-1, 1);
	for (int trial = 0; trial < 300; ++trial) {
		const Corners       corners = randomOutline(random);
		const ShearStrength field   = strengthOf(corners, 0.2 * Vector2(uniform(random), uniform(random)), 7);
		const Real          size    = trial % 3 == 0 ? 1 : std::pow(10, trial % 3 == 1 ? uniform(random) : 3 + uniform(random));
                const Real turn = uniform(random);
		const Vector3       slip(size * uniform(random), size * uniform(random), turn < 0 ? turn - 0.5 : turn + 0.5);
		Matrix3             slope;
		const Vector3       f = field.resistance(slip, &slope);
		EXPECT_LT((slope * slip).norm(), 1e-6 * slope.norm() * slip.norm()); // homogeneous of degree zero
		for (int k = 0; k < 3; ++k) {
			const Real    step  = 1e-5 * (k < 2 ? std::max(slip.head<2>().norm(), std::abs(slip[2])) : std::abs(slip[2]));
			const Vector3 there = field.resistance(slip + step * Vector3::Unit(k)),
			              back  = field.resistance(slip - step * Vector3::Unit(k));
			EXPECT_LT(((there - back) / (2 * step) - slope.col(k)).norm(), 1e-4 * slope.norm() + 1e-9 * f.norm() / step)
			        << trial << " " << k;
		}
		EXPECT_LE(f.head<2>().norm(), 7 * (1 + 1e-9));
		EXPECT_LE(std::abs(f[2]), 7 * meanRadius(field) * (1 + 1e-9));
	}
}

/// Force and moment of a narrow rectangle about `offset`, τ linear with its centre there: points of Gauss-Legendre, five across and in each of many parts along.
Vector3 byParts(Real length, Real width, const Vector2& offset, const Vector3& slip)
{
	const int      parts    = 1000;
	constexpr Real place[5] = { -0.906179845938663992797626878299L, -0.538469310105683091036314420701L, 0,
		0.538469310105683091036314420701L, 0.906179845938663992797626878299L },
	               heavy = 0.478628670499366468041291514836L, light = 0.236926885056189087514264040720L,
	               weight[5] = { light, heavy, 0.568888888888888888888888888889L, heavy, light };
	const Vector2 gradient(12 * offset[0] / (length * length), 12 * offset[1] / (width * width)); // over the mean
	Vector3       sum = Vector3::Zero();
	for (int k = 0; k < parts; ++k) {
		Vector3 part = Vector3::Zero();
		for (int i = 0; i < 5; ++i)
			for (int j = 0; j < 5; ++j) {
				const Vector2 x(((2 * k + 1 + place[i]) / parts - 1) * length / 2, place[j] * width / 2), arm = x - offset;
				const Vector2 v(slip[0] - slip[2] * arm[1], slip[1] + slip[2] * arm[0]), d = v.normalized();
				const Real    share = weight[i] * weight[j] / (4 * parts) * (1 + gradient.dot(x));
				part += share * Vector3(d[0], d[1], arm[0] * d[1] - arm[1] * d[0]);
			}
		sum += part;
	}
	return sum;
}

// A lifted face that slips has such an outline: all digits, whatever the width, with the centre of rotation beside it or on its line.
TEST(ShearStrength, ResistanceOfANarrowOutline)
{
	for (const Real width : { 1e-2, 1e-3, 1e-5, 1e-6 })
		for (const Vector2& offset : { Vector2(0, 0), Vector2(0.05, 0.1 * width) })
			for (const Vector2& pole : { Vector2(0.3, 0.4), Vector2(0.1, -0.07), Vector2(0.6, 0), Vector2(-0.45, 1.5) }) {
				const Corners corners = rectangleOutline(1, width);
				const Vector3 slip(pole[1] - offset[1], offset[0] - pole[0], 1); // no motion at the pole
				const Vector3 parts = byParts(1, width, offset, slip), found = strengthOf(corners, offset).resistance(slip);
				EXPECT_LT((found - parts).norm(), 1e-13)
				        << width << " / " << offset.transpose() << " / " << pole.transpose();
				// as the outline lies, too
				const Eigen::Rotation2D<Real> turn(0.7);
				Corners                       turned = corners;
				for (Vector2& corner : turned)
					corner = turn * corner;
				Vector3 there   = slip;
				there.head<2>() = turn * slip.head<2>();
				Vector3 back    = strengthOf(turned, turn * offset).resistance(there);
				back.head<2>()  = turn.inverse() * back.head<2>();
				EXPECT_LT((back - found).norm(), 1e-14 / width); // corners are rounded, which is more of a narrow outline
			}
}

// Where the sums over edges give way to sums at points, nothing jumps.
TEST(ShearStrength, FarAndNearCentresOfRotationAgree)
{
	const Corners       corners = rectangleOutline(3, 1);
	const ShearStrength field   = strengthOf(corners, Vector2(0.3, 0.1));
	const Vector2       centre(0.3, 0.1);
	Real                size = 0;
	for (const Vector2& corner : corners)
		size = std::max(size, (corner - centre).norm());
	for (const Real angle : { 0.1, 1., 2., 4. }) {
		const Vector2 way(std::cos(angle), std::sin(angle));
		const auto    at = [&](Real far) { return field.resistance(Vector3(far * size * way[0], far * size * way[1], 1)); };
		for (const Real edge : { Real(tolerance::shearPoleFar), Real(tolerance::shearPoleFarther) })
			EXPECT_LT((at(edge * (1 - 1e-13)) - at(edge * (1 + 1e-13))).norm(), 1e-10);
		// without rotation, and with hardly any
		const Vector3 straight = field.resistance(Vector3(way[0], way[1], 0)), nearly = at(1e9);
		EXPECT_NEAR((straight - Vector3(way[0], way[1], 0)).norm(), 0, 1e-14);
		EXPECT_LT((straight - nearly).norm(), 1e-8);
	}
}

// A load beyond the strength: what stays is on the limit surface, opposes the slip, and is the nearest by the energy of the bed.
TEST(ShearReturn, IsTheNearestPointOfTheLimitSurface)
{
	std::mt19937_64                        random(5);
	std::uniform_real_distribution<double> uniform(-1, 1);
	int                                    slipped = 0, stuck = 0;
	for (int trial = 0; trial < 2000; ++trial) {
		const Corners        corners = randomOutline(random);
		const OutlineMoments moments = momentsOf(corners.data(), int(corners.size()));
		const Vector2        offset  = 0.15 * Vector2(uniform(random), uniform(random));
		const ShearStrength  field(corners.data(), int(corners.size()), moments, 2, Vector2(moments.centroid + offset));
		const Matrix3        stiffness = bedStiffness(50, moments.gyrationSquared(), moments.centroid - field.centre());
		const Real           size      = std::pow(10, 1.5 * uniform(random));
		const Vector3        load(2 * size * uniform(random), 2 * size * uniform(random), 2 * size * uniform(random));
		Vector3              kept = load;
		const Vector3        slip = returned(field, stiffness, kept);
		if (slip == Vector3::Zero()) {
			++stuck;
			EXPECT_EQ(kept, load);
			// no motion does more work than the strength takes
			for (int k = 0; k < 40; ++k) {
				const Vector3 way(uniform(random), uniform(random), uniform(random));
				EXPECT_LE(way.dot(load), way.dot(field.resistance(way)) * (1 + 1e-6));
			}
			continue;
		}
		++slipped;
		EXPECT_LT((load - stiffness * slip - kept).norm(), 1e-11 * load.norm()) << trial;
		EXPECT_GT(slip.dot(kept), 0);
		for (int k = 0; k < 40; ++k) {
			const Vector3 way(uniform(random), uniform(random), uniform(random));
			EXPECT_LE(way.dot(kept), way.dot(field.resistance(way)) * (1 + 1e-9));
		}
	}
	EXPECT_GT(slipped, 600);
	EXPECT_GT(stuck, 300);
}

// The resistance to a slip is the point of the limit surface with that normal: a load that is less by a part of a million holds, one that is more slips.
TEST(ShearReturn, HoldsUpToTheLimitSurfaceAndNotBeyond)
{
	std::mt19937_64                        random(9);
	std::uniform_real_distribution<double> uniform(-1, 1);
	for (int trial = 0; trial < 3000; ++trial) {
		SCOPED_TRACE(trial);
		const Corners        corners = randomOutline(random, std::size_t(3 + trial % 5));
		const OutlineMoments moments = momentsOf(corners.data(), int(corners.size()));
		if (!(moments.area > 0.1)) continue;
		const Vector2       offset = 0.2 * std::sqrt(moments.area) * Vector2(uniform(random), uniform(random));
		const ShearStrength field(corners.data(), int(corners.size()), moments, 2, Vector2(moments.centroid + offset));
		const Matrix3       stiffness = bedStiffness(50, moments.gyrationSquared(), moments.centroid - field.centre());
		const Real          size      = std::pow(10, 2 * uniform(random));
		const Vector3       point     = field.resistance(Vector3(size * uniform(random), size * uniform(random), uniform(random)));
		const Vector3 likely = trial % 2 ? Vector3(uniform(random), uniform(random), uniform(random)) : Vector3(Vector3::Zero());
		Vector3       within = (1 - 1e-6) * point, beyond = (1 + 1e-6) * point;
		EXPECT_EQ(returned(field, stiffness, within, likely), Vector3::Zero());
		EXPECT_EQ(within, (1 - 1e-6) * point);
		EXPECT_NE(returned(field, stiffness, beyond, likely), Vector3::Zero());
		EXPECT_LT((beyond - point).norm(), 1e-4 * point.norm());
	}
}

TEST(ShearReturn, NothingHoldsMoreThanTheStrengthWhereACornerIsRepeated)
{
	for (const Real scale : { 1., 1e-9 })
		for (const Real aside : { 0., 1e-17, 1e-12 })
			for (const Real load : { 1.5, 5., 50. }) {
				Corners corners { { 0, 0 }, { 0.4, 0 }, { 0.4, 0.25 }, { 0, 0.5 }, { -aside, aside } };
				for (Vector2& corner : corners)
					corner = scale * (corner - Vector2(0.2, 0.2));
				const OutlineMoments moments  = momentsOf(corners.data(), int(corners.size()));
				const ShearStrength  strength = strengthOf(corners, Vector2::Zero());
				const Real           radius   = std::sqrt(moments.gyrationSquared());
				// the bed's force where the face has turned about the repeated corner
				const Vector2 arm = moments.centroid - corners[0], force = load / arm.norm() * left(arm);
				Vector3       stays = { force[0], force[1], load / arm.norm() * radius * radius };
				returned(strength, bedStiffness(1, radius * radius, Vector2::Zero()), stays);
				EXPECT_LE(stays.head<2>().norm(), 1 + 1e-9) << scale << ' ' << aside << ' ' << load;
			}
}

// Loads that differ by rounding leave forces that differ by rounding, also where the centre of rotation lies at a corner: the iteration does not end
// where the work that it compares is no longer known.
TEST(ShearReturn, LoadsThatDifferByRoundingLeaveTheSame)
{
	std::mt19937_64                        random(3);
	std::uniform_real_distribution<double> uniform(-1, 1);
	int                                    slipped = 0;
	for (int trial = 0; trial < 60000; ++trial) {
		Corners    corners = randomOutline(random, std::size_t(3 + trial % 3));
		const Real flat    = std::pow(10, -1.5 * std::abs(uniform(random)));
		for (Vector2& corner : corners)
			corner[1] *= flat;
		const OutlineMoments moments = momentsOf(corners.data(), int(corners.size()));
		if (!(moments.area > 1e-4)) continue;
		const Vector2       offset(0.2 * flat * uniform(random), 0.2 * flat * uniform(random));
		const ShearStrength field(corners.data(), int(corners.size()), moments, 1, Vector2(moments.centroid + offset));
		const Matrix3       stiffness = bedStiffness(50, moments.gyrationSquared(), moments.centroid - field.centre());
		const Real          angle     = M_PI * uniform(random);
		Vector3             load(std::cos(angle), std::sin(angle), uniform(random) * std::pow(10, -4 * std::abs(uniform(random))));
		load *= 1 + std::pow(10, -1 - 3 * std::abs(uniform(random)));
		Vector3 one = load, other = load * (1 + 2e-15);
		if (returned(field, stiffness, one) == Vector3::Zero() || returned(field, stiffness, other) == Vector3::Zero()) continue;
		++slipped;
		EXPECT_LT((one - other).norm(), 1e-9) << trial;
	}
	EXPECT_GT(slipped, 50000);
}

TEST(ShearReturn, APushWithoutMomentSlipsStraightAtFullStrength)
{
	const Corners        corners = rectangleOutline(1, 0.4);
	const OutlineMoments moments = momentsOf(corners.data(), 4);
	const ShearStrength  field(corners.data(), 4, moments, 3, moments.centroid);
	Vector3              load(6, 8, 0);
	const Vector3        slip = returned(field, bedStiffness(10, moments.gyrationSquared(), Vector2::Zero()), load);
	EXPECT_NEAR((load - Vector3(1.8, 2.4, 0)).norm(), 0, 1e-12);
	EXPECT_NEAR((slip - Vector3(0.42, 0.56, 0)).norm(), 0, 1e-12);
	load = Vector3(0, 0, 5);
	returned(field, bedStiffness(10, moments.gyrationSquared(), Vector2::Zero()), load);
	EXPECT_NEAR(load[2], 3 * meanRadius(field), 1e-12);
}

// Coulomb's disc: however it starts, sliding and spinning end together (Farkas, Bartels, Unger, Wolf 2003, Phys. Rev. Lett. 90:248302), and the ratio
// of velocity to rim speed tends to 0.653.
TEST(ShearStrength, ASlidingAndSpinningDiscStopsBothAtOnce)
{
	const Corners       corners = regularOutline(400, 1);
	const ShearStrength field   = strengthOf(corners, Vector2::Zero());
	for (const Real start : { 0.3, 0.653, 3. }) {
		Real v = start, w = 1;
		for (; v > 1e-7 && w > 1e-7;) {
			const Vector3 f  = field.resistance(Vector3(v, 0, w));
			const Real    dt = 1e-2 * std::min(v, w);
			v -= dt * f[0];
			w -= dt * 2 * f[2]; // inertia m R²/2
		}
		EXPECT_NEAR(v / w, 0.653, 0.02) << start;
	}
}

TEST(ShearStrength, SliversAndPointsHaveAnAnswer)
{
	for (const Real width : { 1e-3, 1e-6, 1e-9, 1e-12, 1e-15 })
		for (const Vector3& slip :
		        { Vector3(0, 0, 1), Vector3(0.1, 0.2, 1), Vector3(0.1, width / 2, 1), Vector3(1, 1, 0), Vector3(1, 1, 1e-6) }) {
			const Corners       corners = rectangleOutline(1, width);
			const ShearStrength field   = strengthOf(corners, Vector2(0.05, 0.1 * width));
			Matrix3             slope;
			const Vector3       f = field.resistance(slip, &slope);
			EXPECT_TRUE(f.allFinite() && slope.allFinite()) << width;
			EXPECT_LE(f.head<2>().norm(), 1 + 1e-6);
			Vector3 load(3, 1, 0.5);
			returned(field, bedStiffness(5, 1 / 12., Vector2::Zero()), load);
			EXPECT_TRUE(load.allFinite());
			EXPECT_LE(load.head<2>().norm(), 1 + 1e-6);
		}
}

} // namespace
