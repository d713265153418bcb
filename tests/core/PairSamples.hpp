// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "contact/ContactQuery.hpp"
#include "shape/RegularSolids.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

/// Seeded random shapes and pairs for tests and benchmarks.
namespace polytope::samples {

struct Pair {
	std::shared_ptr<const ConvexShape> shape[2];
	Matrix3                            rotation[2] = { Matrix3::Identity(), Matrix3::Identity() };
	Vector3                            centre2     = Vector3::Zero();

	/// The smaller circumradius: what the kernel's tolerances are relative to.
	Real size() const { return std::min(shape[0]->boundingRadius(), shape[1]->boundingRadius()); }
	/// A plane of the pair in one frame is rounded to about machine precision × this.
	Real       reach() const { return shape[0]->boundingRadius() + shape[1]->boundingRadius() + centre2.norm(); }
	Real       inscribedRadius() const { return std::min(shape[0]->inscribedRadius(), shape[1]->inscribedRadius()); }
	int        dimension() const { return shape[0]->dimension(); }
	PlacedPair placed() const { return { *shape[0], rotation[0], *shape[1], rotation[1], centre2 }; }
};

inline Real uniform(std::mt19937_64& random, Real low, Real high) { return std::uniform_real_distribution<Real>(low, high)(random); }

/// 10^u, u uniform between the exponents.
inline Real decades(std::mt19937_64& random, Real low, Real high) { return std::pow(Real(10), uniform(random, low, high)); }

inline Vector3 randomDirection(std::mt19937_64& random, int dimension = 3)
{
	std::normal_distribution<double> gauss;
	Vector3                          v = Vector3::Zero();
	for (int k = 0; k < dimension; ++k)
		v[k] = gauss(random);
	return v.normalized();
}

inline Matrix3 randomRotation(std::mt19937_64& random, int dimension = 3)
{
	if (dimension == 2) return Eigen::AngleAxis<Real>(uniform(random, -Real(M_PI), Real(M_PI)), Vector3::UnitZ()).toRotationMatrix();
	std::normal_distribution<double> gauss;
	Eigen::Matrix<Real, 4, 1>        q;
	for (int k = 0; k < 4; ++k)
		q[k] = gauss(random);
	return Eigen::Quaternion<Real>(q.normalized()).toRotationMatrix();
}

inline ContactResult query(const Pair& pair, const ContactSettings& settings = {}, PairMemory* memory = nullptr)
{
	static thread_local ContactWorkspace workspace;
	PairMemory                           fresh;
	ContactResult                        result;
	contactQuery(pair.placed(), settings, memory ? *memory : fresh, workspace, result);
	return result;
}

/// The LP alone, without dismissal: a tolerance so negative that every pair counts as touching.
inline ContactResult linearProgram(const Pair& pair)
{
	ContactSettings settings;
	settings.tolerance    = -1e6;
	settings.contactPoint = ContactPoint::ChebyshevCentre;
	return query(pair, settings);
}

inline Real infeasibility(const Pair& pair) { return linearProgram(pair).infeasibility; }

/// Moves body 2 along the direction from body 1 until s* = target (s* is convex along it; bisection to rounding).
inline void moveTo(Pair& pair, const Vector3& direction, Real target)
{
	Real near = 0, far = pair.shape[0]->boundingRadius() + pair.shape[1]->boundingRadius() + 2 * std::abs(target);
	for (int step = 0; step < 60 && near < far; ++step) {
		const Real middle                           = (near + far) / 2;
		pair.centre2                                = middle * direction;
		(infeasibility(pair) < target ? near : far) = middle;
	}
}

inline Pair swapped(const Pair& pair)
{
	Pair other;
	for (int body = 0; body < 2; ++body) {
		other.shape[body]    = pair.shape[1 - body];
		other.rotation[body] = pair.rotation[1 - body];
	}
	other.centre2 = -pair.centre2;
	return other;
}

inline Pair turned(Pair pair, const Matrix3& rotation)
{
	for (Matrix3& r : pair.rotation)
		r = rotation * r;
	pair.centre2 = rotation * pair.centre2;
	return pair;
}

inline Pair movedApart(Pair pair, const Vector3& by)
{
	pair.centre2 += by;
	return pair;
}

inline std::shared_ptr<const ConvexShape> scaled(const ConvexShape& shape, Real factor)
{
	HalfSpaces planes = shape.planes();
	for (Real& offset : planes.offsets)
		offset *= factor;
	return ConvexShape::shared(planes, shape.cornerRadius() * factor, shape.thickness() * factor);
}

inline Pair scaled(Pair pair, Real factor)
{
	for (auto& shape : pair.shape)
		shape = scaled(*shape, factor);
	pair.centre2 *= factor;
	return pair;
}

// ---------------------------------------------------------------------------------------------------------- shapes

/// The set with its planes' points multiplied per axis.
inline HalfSpaces stretched(HalfSpaces set, const Vector3& factors)
{
	for (std::size_t i = 0; i < set.size(); ++i) {
		Vector3& normal   = set.normals[i];
		normal            = normal.cwiseQuotient(factors);
		const Real length = normal.norm();
		normal /= length;
		set.offsets[i] /= length;
	}
	return set;
}

inline HalfSpaces cuboid(Real halfX, Real halfY, Real halfZ)
{
	HalfSpaces set;
	const Real half[3] = { halfX, halfY, halfZ };
	for (int k = 0; k < 3; ++k)
		for (int side = 1; side >= -1; side -= 2) {
			set.normals.push_back(side * Vector3::Unit(k));
			set.offsets.push_back(half[k]);
		}
	return set;
}

inline HalfSpaces rectangle(Real halfX, Real halfY)
{
	HalfSpaces set = cuboid(halfX, halfY, 1);
	set.normals.resize(4);
	set.offsets.resize(4);
	set.dimension = 2;
	return set;
}

/// Random planes about the unit ball; the first ones close the set. Many are redundant, and every eighth is there twice.
inline HalfSpaces randomPlanes(int planes, std::mt19937_64& random, int dimension = 3)
{
	HalfSpaces set;
	if (dimension == 3) set = regularSolid(4, 3);
	else {
		set           = rectangle(1, 1);
		set.dimension = 2;
	}
	const Matrix3 turn = randomRotation(random, dimension);
	for (Vector3& normal : set.normals)
		normal = turn * normal;
	while (int(set.size()) < planes) {
		const bool again = set.size() % 8 == 7;
		set.normals.push_back(again ? set.normals.back() : randomDirection(random, dimension));
		set.offsets.push_back(again ? set.offsets.back() : uniform(random, Real(0.7), Real(1.3)));
	}
	return set;
}

/// The set with copies of some planes, turned by 1e-16 … 1e-3 and moved by as much or not at all: faces of a mesh that are flat but
/// for rounding.
inline HalfSpaces withNearCopies(HalfSpaces set, int copies, std::mt19937_64& random)
{
	const std::size_t own = set.size();
	for (int i = 0; i < copies; ++i) {
		const std::size_t j      = random() % own;
		const Vector3     aside  = randomDirection(random, set.dimension);
		const bool        turned = random() % 4 != 0, shifted = random() % 3 != 0;
		const Real        turn = decades(random, -16, -3), shift = (random() % 2 ? 1 : -1) * decades(random, -16, -3);
		set.normals.push_back(turned ? (set.normals[j] + turn * aside).normalized() : set.normals[j]);
		set.offsets.push_back(set.offsets[j] * (shifted ? 1 + shift : 1));
	}
	return set;
}

using Shapes = std::vector<std::shared_ptr<const ConvexShape>>;

/// Regular solids (in 2-D: polygons), random hulls of 4 to 60 planes, and plates, needles and slivers of aspect up to 1e4,
/// of circumradius about 10^[smallest, 0].
inline Shapes randomShapes(int count, std::mt19937_64& random, int dimension = 3, Real smallest = -3)
{
	const int  faces[]    = { 4, 6, 8, 12, 20 };
	const Real rounding[] = { 0, Real(0.02), Real(0.3), Real(0.9) };
	Shapes     shapes;
	for (int i = 0; i < count; ++i) {
		HalfSpaces set;
		if (i % 3 == 0 && dimension == 3) set = regularSolid(faces[i / 3 % 5], 1);
		else set = randomPlanes(4 + int(random() % 57), random, dimension);
		if (i % 3 == 2) {
			const Real aspect = decades(random, -4, 0);
			const int  kind   = int(random() % 3);
			set               = stretched(set, Vector3(1, kind == 1 ? aspect : kind == 0 ? 1 : std::sqrt(aspect), aspect));
			if (dimension == 2) set = stretched(set, Vector3(1, aspect, 1));
		}
		const Real size = decades(random, smallest, 0);
		for (Real& offset : set.offsets)
			offset *= size;
		const Real inner = *std::min_element(set.offsets.begin(), set.offsets.end());
		shapes.push_back(ConvexShape::shared(set, rounding[random() % 4] * inner));
	}
	return shapes;
}

// ----------------------------------------------------------------------------------------------------------- pairs

/// Two of the shapes in random orientations. Of four, one is separated by up to its inscribed radius; the others overlap
/// with −s* from 1e-12 (but no less than 2000 roundings of the pair) to 0.5 of the smaller inscribed radius.
inline Pair randomPair(const Shapes& shapes, std::mt19937_64& random)
{
	Pair pair;
	for (int body = 0; body < 2; ++body) {
		pair.shape[body]    = shapes[random() % shapes.size()];
		pair.rotation[body] = randomRotation(random, pair.shape[body]->dimension());
	}
	const Real    inner     = pair.inscribedRadius();
	const Vector3 direction = randomDirection(random, pair.dimension());
	if (random() % 4 == 0) moveTo(pair, direction, decades(random, -12, 0) * inner);
	else
		moveTo(pair, direction,
		        -std::max(decades(random, -12, std::log10(Real(0.5))) * inner, 2000 * tolerance::rounding * pair.reach()));
	return pair;
}

/// Draws are named where two meet: compilers differ in which argument comes first.
inline HalfSpaces randomCuboid(std::mt19937_64& random)
{
	const Real third = decades(random, -3, 0), second = decades(random, -3, 0);
	return cuboid(1, second, third);
}

/// Boxes and regular solids (rectangles) with near copies of their planes, every third pair with its axes aligned.
inline Pair nearlyParallelPair(std::mt19937_64& random, int dimension = 3)
{
	const int faces[] = { 4, 6, 8, 12, 20 };
	Pair      pair;
	for (auto& shape : pair.shape) {
		HalfSpaces set = rectangle(1, decades(random, -3, 0));
		if (dimension == 3) set = random() % 2 ? randomCuboid(random) : regularSolid(faces[random() % 5], 1);
		const Matrix3 turn = random() % 2 ? randomRotation(random, dimension) : Matrix3(Matrix3::Identity());
		for (Vector3& normal : set.normals)
			normal = turn * normal;
		set   = withNearCopies(set, 1 + int(random() % 6), random);
		shape = ConvexShape::shared(set, Real(0.1) * *std::min_element(set.offsets.begin(), set.offsets.end()));
	}
	for (Matrix3& rotation : pair.rotation)
		rotation = randomRotation(random, dimension);
	Vector3 direction = randomDirection(random, dimension);
	if (random() % 3 == 0) {
		pair.rotation[1] = pair.rotation[0];
		direction        = pair.rotation[0].col(int(random() % dimension));
	}
	const bool apart = random() % 4 == 0;
	moveTo(pair, direction, (apart ? 1 : -1) * decades(random, -11, -1) * pair.inscribedRadius());
	return pair;
}

/// Two regular solids in random orientations, s* = −depth × inscribed radius of the first.
inline Pair regularPair(int faces1, int faces2, Real relativeDepth, std::mt19937_64& random, Real size2 = 1)
{
	Pair pair;
	pair.shape[0] = ConvexShape::shared(regularSolid(faces1, 1), Real(0.1));
	pair.shape[1] = ConvexShape::shared(regularSolid(faces2, size2), Real(0.1) * size2);
	for (Matrix3& rotation : pair.rotation)
		rotation = randomRotation(random);
	moveTo(pair, randomDirection(random), -relativeDepth * pair.shape[0]->inscribedRadius());
	return pair;
}

/// Overlaps thin across two or three axes, by `trial` in turn: a plate or needle inside a block, blocks that meet along an edge,
/// at a corner.
inline Pair thinPair(int trial, std::mt19937_64& random)
{
	Pair pair;
	pair.shape[0] = ConvexShape::shared(cuboid(1, 1, 1), Real(0.1));
	if (trial % 3 == 0) {
		const Real thin = decades(random, -7, -1);
		pair.shape[1]   = ConvexShape::shared(cuboid(1, thin, trial % 2 ? thin * decades(random, -1, 0) : Real(0.5)), 0);
		pair.centre2    = Real(0.3) * randomDirection(random);
	} else {
		pair.shape[1]    = pair.shape[0];
		const Real third = decades(random, -11, -1), second = decades(random, -11, -1);
		pair.centre2 = Vector3(uniform(random, -1, 1), 2 - second, 2 - third);
		if (trial % 3 == 2) pair.centre2[0] = 2 - decades(random, -11, -1);
	}
	return turned(pair, randomRotation(random));
}

} // namespace polytope::samples
