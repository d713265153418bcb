// SPDX-License-Identifier: GPL-2.0-or-later
//
// Any two shapes, poses, settings and memories: a bounded number of iterations, a status, numbers that are finite; and for
// poses that are rigid motions the answer is an optimum of the linear program, whichever body comes first.
#include "Bytes.hpp"

#include "contact/ContactQuery.hpp"
#include "tests/core/ExactLp.hpp"

#include <array>
#include <map>
#include <stdexcept>

using namespace polytope;
using namespace polytope::fuzz;
using samples::Pair;

namespace {

using Shape = std::shared_ptr<const ConvexShape>;

/// Sound shapes of all kinds; by key, since construction takes longer than a hundred queries.
Shape knownShape(int kind, int seed, int decade, int dimension)
{
	static std::map<std::array<int, 4>, Shape> known;
	Shape&                                     shape = known[{ kind, seed, decade, dimension }];
	if (shape) return shape;
	std::mt19937_64 random(static_cast<unsigned long>(seed));
	const int       faces[] = { 4, 6, 8, 12, 20 };
	HalfSpaces      set     = dimension == 2 ? samples::rectangle(1, Real(1) / (1 + seed % 7)) : regularSolid(faces[seed % 5], 1);
	if (kind == 1 && dimension == 3)
		set = samples::cuboid(1, samples::decades(random, -seed % 4, 0), samples::decades(random, -seed % 8, 0));
	else if (kind == 2) set = samples::randomPlanes(4 + seed % 60, random, dimension);
	else if (kind == 3) set = samples::withNearCopies(set, 1 + seed % 8, random);
	const Real size = std::pow(Real(10), decade);
	for (Real& offset : set.offsets)
		offset *= size;
	const Real rounding[] = { 0, Real(0.02), Real(0.3), Real(0.9) };
	const Real inner      = *std::min_element(set.offsets.begin(), set.offsets.end());
	shape                 = ConvexShape::shared(set, rounding[seed % 4] * inner);
	return shape;
}

Shape readShape(Bytes& bytes, int dimension)
{
	const int kind = bytes.below(32);
	if (kind > 1) {
		const int seed = bytes.byte(), decade = bytes.below(8);
		return knownShape(kind % 4, seed, decade < 5 ? 0 : decade < 6 ? int(bytes.below(14)) - 9 : decade - 6, dimension);
	}
	if (kind == 1) {
		std::mt19937_64 random(bytes.byte());
		return ConvexShape::halfSpace(samples::randomDirection(random, dimension), dimension);
	}
	HalfSpaces set = planes(bytes, dimension);
	for (Real& offset : set.offsets) // within lengths that bodies have
		if (std::abs(offset) > 1e9) offset = 1;
	return std::make_shared<ConvexShape>(set, 0);
}

Matrix3 readRotation(Bytes& bytes, const Matrix3& other, int dimension, bool& rigid)
{
	const int kind = bytes.below(16);
	if (kind == 0) return other;
	if (kind == 1) return Matrix3::Identity();
	if (kind == 2) {
		rigid = false;
		Matrix3 any;
		for (int k = 0; k < 3; ++k)
			any.col(k) = bytes.vector();
		return any;
	}
	Eigen::Matrix<Real, 4, 1> q;
	for (int k = 0; k < 4; ++k)
		q[k] = std::int8_t(bytes.byte());
	if (dimension == 2) q.head<2>().setZero();
	if (kind < 6) q.head<3>() *= 1e-9; // nearly parallel faces (coefficients: x y z w)
	if (!(q.norm() > 0)) return other;
	const Matrix3 turn = Eigen::Quaternion<Real>(q.normalized()).toRotationMatrix();
	return kind % 2 ? turn : Matrix3(other * turn);
}

Pair readPair(Bytes& bytes, bool& rigid)
{
	Pair      pair;
	const int dimension = bytes.below(4) ? 3 : 2;
	for (auto& shape : pair.shape)
		shape = readShape(bytes, dimension);
	pair.rotation[0] = readRotation(bytes, Matrix3::Identity(), dimension, rigid);
	pair.rotation[1] = readRotation(bytes, pair.rotation[0], dimension, rigid);
	Vector3 aside;
	for (int k = 0; k < 3; ++k)
		aside[k] = std::int8_t(bytes.byte());
	if (dimension == 2) aside.z() = 0;
	if (!(aside.norm() > 0)) aside = pair.rotation[0].col(0);
	const int  kind = bytes.below(8);
	const Real far  = std::min(pair.shape[0]->boundingRadius(), Real(1e9)) + std::min(pair.shape[1]->boundingRadius(), Real(1e9));
	const bool both = std::isfinite(pair.shape[0]->boundingRadius() + pair.shape[1]->boundingRadius());
	if (kind == 0) pair.centre2 = bytes.vector();
	else if (kind == 1) pair.centre2.setZero();
	else if (kind < 5 || !both || !rigid) pair.centre2 = far * Real(bytes.byte()) / 200 * aside.normalized();
	else // to a chosen depth
		samples::moveTo(pair, aside.normalized(),
		        Real(bytes.flag() ? 1 : -1) * std::pow(Real(10), -Real(bytes.below(17))) * pair.inscribedRadius());
	if (!pair.centre2.allFinite() || pair.centre2.norm() > 1e12) rigid = false;
	return pair;
}

/// Settings within the documented range, or (`proper` false) anything that a script might set.
ContactSettings readSettings(Bytes& bytes, bool& proper)
{
	ContactSettings settings;
	const int       flags      = bytes.byte();
	settings.contactModel      = !(flags & 1) ? ContactModel::Boon2012 : flags & 128 ? ContactModel::Foundation : ContactModel::Spring;
	settings.warmStart         = !(flags & 2);
	settings.section           = flags & 4;
	settings.geometryAcrossGap = flags & 8;
	settings.timed             = flags & 16;
	settings.outline           = flags & 32;
	settings.energy            = flags & 64;
	settings.contactPoint      = ContactPoint(bytes.below(3));
	settings.solver            = bytes.below(64) == 1 ? CentreSolver::Ipopt : CentreSolver::Newton; // expensive
	const int others           = bytes.below(8);
	if (others == 1) {
		settings.newtonTolerance = std::pow(Real(10), -Real(bytes.below(17)));
		settings.tolerance       = std::pow(Real(10), -Real(bytes.below(17)));
		settings.normalWeight[0] = Real(bytes.byte()) / 255;
		settings.normalWeight[1] = 1 - settings.normalWeight[0];
	} else if (others == 2) {
		proper                   = false;
		settings.newtonTolerance = bytes.number();
		settings.tolerance       = bytes.number();
		settings.normalWeight[0] = bytes.number();
		settings.normalWeight[1] = bytes.number();
	}
	return settings;
}

/// Any planes of the pair, any points.
PairMemory readMemory(Bytes& bytes, const Pair& pair)
{
	PairMemory memory;
	const int  kind = bytes.below(4);
	if (kind < 2) return memory;
	memory.hasBasis = true;
	for (int k = 0; k <= pair.dimension(); ++k) {
		const int body               = bytes.below(2);
		memory.basis[std::size_t(k)] = 2 * (bytes.byte() % pair.shape[body]->planeCount()) + body;
	}
	memory.weights = memory.dualDirection = bytes.vector();
	if (kind < 3) return memory;
	memory.hasPoint = true;
	for (Vector3& point : memory.point)
		point = bytes.vector();
	return memory;
}

void checkMemory(const PairMemory& memory, const Pair& pair)
{
	if (!memory.hasBasis) return;
	for (int k = 0; k <= pair.dimension(); ++k) {
		const int code = memory.basis[std::size_t(k)];
		POLYTOPE_REQUIRE(code >= 0 && (code >> 1) < pair.shape[code & 1]->planeCount(), "basis %d: code %d", k, code);
	}
}

void checkResult(const ContactResult& result, const Pair& pair, const ContactSettings& settings)
{
	const int status = int(result.status);
	POLYTOPE_REQUIRE(status >= 0 && status < contactStatusCount, "status %d", status);
	const int planes = pair.shape[0]->paddedCount() + pair.shape[1]->paddedCount();
	POLYTOPE_REQUIRE(result.simplexPivots >= 0
	                && result.simplexPivots <= 2
	                                * std::max(tolerance::pivotsAtLeast,
	                                        tolerance::pivotsPerPlane * planes), // twice: also with more digits
	        "%d pivots", result.simplexPivots);
	POLYTOPE_REQUIRE(
	        result.newtonIterations >= 0 && result.newtonIterations <= (1 + tolerance::turns) * (tolerance::newtonIterations + 1),
	        "%d iterations", result.newtonIterations);
	if (result.status == ContactStatus::Failed)
		POLYTOPE_REQUIRE(!result.inContact && !result.hasGeometry, "failed, but there is an answer");
	if (result.inContact)
		POLYTOPE_REQUIRE(result.hasGeometry && std::isfinite(result.infeasibility), "%s: s* = %g", statusName(result.status),
		        result.infeasibility);
	if (!result.hasGeometry) return;
	POLYTOPE_REQUIRE(result.point.allFinite() && std::isfinite(result.depth), "%s: point or depth", statusName(result.status));
	POLYTOPE_REQUIRE(result.dualDirection.allFinite(), "%s: dual direction", statusName(result.status));
	POLYTOPE_REQUIRE(std::isfinite(result.area) && result.area >= 0 && result.sectionCentroid.allFinite(), "%s: area %g",
	        statusName(result.status), result.area);
	const bool notAsked = !settings.energy && settings.contactModel == ContactModel::Foundation && result.energy == -1;
	POLYTOPE_REQUIRE(notAsked || (std::isfinite(result.energy) && result.energy >= 0), "%s: energy %g", statusName(result.status),
	        result.energy);
	POLYTOPE_REQUIRE(std::isfinite(result.turningArm), "%s: turning arm", statusName(result.status));
}

/// All planes in world axes about body 1's centre, in more digits.
struct Planes {
	std::vector<std::array<long double, 4>> rows[2];

	explicit Planes(const Pair& pair)
	{
		for (int body = 0; body < 2; ++body)
			for (int i = 0; i < pair.shape[body]->planeCount(); ++i) {
				std::array<long double, 4> row { { 0, 0, 0, pair.shape[body]->planes().offsets[std::size_t(i)] } };
				for (int j = 0; j < 3; ++j) {
					for (int k = 0; k < 3; ++k)
						row[std::size_t(j)] += static_cast<long double>(pair.rotation[body](j, k))
						        * pair.shape[body]->planes().normals[std::size_t(i)][k];
					row[3] += body * row[std::size_t(j)] * pair.centre2[j];
				}
				rows[body].push_back(row);
			}
	}

	/// max a·x − d
	long double violation(const Vector3& x) const
	{
		long double most = -std::numeric_limits<long double>::infinity();
		for (const auto& body : rows)
			for (const auto& row : body)
				most = std::max(most, row[0] * x[0] + row[1] * x[1] + row[2] * x[2] - row[3]);
		return most;
	}

	/// The lower bound of s* by the weights λ, for any point within `reach`.
	long double bound(const ContactResult& result, int dimension, Real reach) const
	{
		std::array<long double, 4> sum {};
		long double                total = 0;
		for (int k = 0; k <= dimension; ++k) {
			const int   code   = result.basis[std::size_t(k)];
			const auto  weight = std::max<long double>(result.weights[std::size_t(k)], 0);
			const auto& row    = rows[code & 1][std::size_t(code >> 1)];
			total += weight;
			for (std::size_t j = 0; j < 4; ++j)
				sum[j] += weight * row[j];
		}
		return (-sum[3] - std::sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]) * reach) / total;
	}
};

Real exactInfeasibility(const Pair& pair)
{
	return pair.dimension() == 2 ? Real(samples::ExactLp<2>(pair).infeasibility) : Real(samples::ExactLp<3>(pair).infeasibility);
}

/// The linear program's answer is an optimum: its point attains it and its weights prove that none is lower; where they
/// are too uncertain (nearly parallel planes), exact arithmetic decides. The same with the bodies exchanged.
void checkOptimum(const Pair& pair)
{
	const ContactResult result = samples::linearProgram(pair);
	if (!result.hasGeometry || result.status == ContactStatus::LpNotConverged) return; // dismissed, or reported as such
	const Real   allowed = 64 * tolerance::rounding * pair.reach();
	const Planes planes(pair);
	const Real   above = Real(planes.violation(result.point) - result.infeasibility);
	const Real   below = Real(result.infeasibility - planes.bound(result, pair.dimension(), pair.reach()));
	if (!(above <= allowed && below <= allowed)) {
		const Real exact = exactInfeasibility(pair);
		POLYTOPE_REQUIRE(std::abs(result.infeasibility - exact) <= allowed,
		        "s* = %.17g, exactly %.17g: %g apart, %g allowed (point %g, weights %g)", result.infeasibility, exact,
		        std::abs(result.infeasibility - exact), allowed, above, below);
	}
	const ContactResult other = samples::linearProgram(samples::swapped(pair));
	if (!other.hasGeometry || other.status == ContactStatus::LpNotConverged) return;
	POLYTOPE_REQUIRE(std::abs(other.infeasibility - result.infeasibility) <= allowed, "s* = %.17g, with the bodies exchanged %.17g",
	        result.infeasibility, other.infeasibility);
}

void checkPair(Bytes& bytes)
{
	bool            rigid = true, proper = true;
	Pair            pair     = readPair(bytes, rigid);
	ContactSettings settings = readSettings(bytes, proper);
	PairMemory      memory   = readMemory(bytes, pair);
	const bool      bounded  = std::isfinite(pair.shape[0]->boundingRadius() + pair.shape[1]->boundingRadius());
	if (!bounded && !std::isfinite(pair.size())) return; // two walls never meet
	for (int step = 0; step < 3; ++step) {
		const ContactResult result = samples::query(pair, settings, &memory);
		checkResult(result, pair, settings);
		checkMemory(memory, pair);
		if (rigid && proper) {
			POLYTOPE_REQUIRE(
			        std::isfinite(result.infeasibility), "%s: s* = %g", statusName(result.status), result.infeasibility);
			if (result.hasGeometry)
				POLYTOPE_REQUIRE(std::abs(result.normal.norm() - 1) <= 1e-14, "|n| − 1 = %g", result.normal.norm() - 1);
			if (result.inContact)
				POLYTOPE_REQUIRE(result.infeasibility < 0, "%s: s* = %g", statusName(result.status), result.infeasibility);
			if (bounded) checkOptimum(pair);
		}
		if (bytes.empty()) return;
		// a step, small or not; the memory is kept
		const Real stride = std::pow(Real(10), -Real(bytes.below(12))) * pair.inscribedRadius();
		for (int k = 0; k < pair.dimension(); ++k)
			pair.centre2[k] += stride * Real(std::int8_t(bytes.byte())) / 128;
	}
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
	Bytes bytes(data, size);
	try {
		checkPair(bytes);
	} catch (const std::invalid_argument&) {
		// no shape: construction.cpp's matter
	}
	return 0;
}
