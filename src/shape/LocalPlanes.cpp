// SPDX-License-Identifier: GPL-2.0-or-later
#include "shape/LocalPlanes.hpp"

#include "numbers/NumberText.hpp"
#include "shape/CgalGeometry.hpp"
#include "shape/CheckedNumbers.hpp"
#include "shape/ConstructionTolerances.hpp"
#include "shape/InscribedBall.hpp"

#include <cmath>
#include <sstream>
#include <string>

namespace polytope {
namespace {

	[[noreturn]] void refuseOpen(const Vector3& direction)
	{
		std::ostringstream out;
		out.precision(3);
		out << "normals: the set is unbounded (it extends without end along (";
		for (int k = 0; k < 3; ++k)
			out << (k ? ", " : "") << (std::abs(double(direction[k])) < 5e-4 ? 0. : double(direction[k]));
		out << ")); add planes that close it";
		refuse(out.str());
	}

	/// A unit direction in which no plane bounds the set, or zero. Each face of the cube max|y_k| = 1 is searched in turn.
	Vector3 openDirection(const HalfSpaces& set)
	{
		const std::vector<Real> level(set.size(), Real(0));
		for (int k = 0; k < set.dimension; ++k)
			for (int sign = -1; sign <= 1; sign += 2) {
				exact::Bounds bounds { Vector3::Constant(-1), Vector3::Constant(1) };
				if (set.dimension == 2) bounds.lower.z() = bounds.upper.z() = 0;
				bounds.lower[k] = bounds.upper[k] = sign;
				const exact::DeepPoint flattest   = exact::deepest(set.normals, level, 1, bounds);
				if (flattest.depth >= -construction::recession) return flattest.point.normalized();
			}
		return Vector3::Zero();
	}

	/// The power of two below: dividing by it changes no digit.
	Real powerOfTwo(const Real& size)
	{
		using std::frexp;
		using std::ldexp;
		int exponent = 0;
		frexp(size, &exponent);
		return ldexp(Real(1), exponent - 1);
	}

	/// Which of the two a negative depth means: an empty set, or a flat one with rounding. Measured relative to the farthest plane,
	/// since there is no extent; a needlessly far plane can only make a small gap be reported as "flat".
	void refuseIfEmpty(const std::vector<Vector3>& normals, const std::vector<Real>& offsets, const exact::DeepPoint& ball)
	{
		Real size = ball.point.norm();
		for (std::size_t i = 0; i < normals.size(); ++i)
			size = std::max(size, magnitude(offsets[i] - normals[i].dot(ball.point)));
		if (ball.depth < -construction::coincidence * size)
			refuse("offsets: the half-spaces have no common point; a plane is normal·x <= offset with the normal pointing out "
			       "of the body: "
			       "check the signs of normals and offsets");
	}

	/// The largest ball in the arithmetic of Real. False where that is not certain to exist.
	template <int D> bool surelyDeepest(const HalfSpaces& set, const std::vector<Real>& offsets, exact::DeepPoint& ball)
	{
		std::vector<Real> arrays;
		const int         padded = fillPlaneArrays(set.normals, offsets, D, arrays);
		InscribedBall<D>  inscribed(arrays.data(), padded, int(set.size()), construction::ballReach);
		if (!inscribed.solve()) return false;
		const Real radius = -inscribed.basis().infeasibility;
		if (!(radius >= construction::sureInradius)) return false;
		for (int k = 0; k < D; ++k)
			ball.point[k] = inscribed.basis().point[k];
		ball.depth = radius;
		for (std::size_t i = 0; i < set.size(); ++i)
			ball.depth = std::min(ball.depth, Real(offsets[i] - set.normals[i].dot(ball.point)));
		return ball.depth >= radius / 2;
	}

	exact::DeepPoint deepest(const HalfSpaces& set, const std::vector<Real>& offsets)
	{
		exact::DeepPoint ball;
		if (set.dimension == 3 ? surelyDeepest<3>(set, offsets, ball) : surelyDeepest<2>(set, offsets, ball)) return ball;
		exact::Bounds bounds;
		if (set.dimension == 2) bounds.lower.z() = bounds.upper.z() = 0;
		// a bounded set's inradius is a weighted mean of its offsets, below 2 in this unit: the cap never cuts it
		return exact::deepest(set.normals, offsets, 2, bounds);
	}

} // namespace

void refuseIfOpen(const HalfSpaces& set)
{
	const Vector3 direction = openDirection(set);
	if (direction.squaredNorm() > 0) refuseOpen(direction);
}

void refuseFlat(const HalfSpaces& set)
{
	refuseIfOpen(set);
	refuse("offsets: the set is flat (it has points, but no interior to rounding); move opposite planes apart or, if the body lies "
	       "far from the origin, describe it near the origin");
}

LocalPlanes aboutInnerPoint(const HalfSpaces& set)
{
	Real largest = 0;
	for (const Real& offset : set.offsets)
		largest = std::max(largest, magnitude(offset));
	const Real        scale  = largest > 0 ? powerOfTwo(largest) : Real(1);
	std::vector<Real> scaled = set.offsets;
	for (Real& offset : scaled)
		offset /= scale;
	const exact::DeepPoint ball = deepest(set, scaled);
	if (ball.depth < 0) refuseIfEmpty(set.normals, scaled, ball);
	if (ball.depth <= construction::coincidence * (ball.point.norm() + ball.depth)) refuseFlat(set);
	if (ball.depth * scale < construction::smallestLength)
		refuse("offsets: the body is smaller than " + numberText(construction::smallestLength) + "; choose another unit of length");

	LocalPlanes local;
	local.centre   = ball.point * scale;
	local.unit     = powerOfTwo(ball.depth * scale);
	local.distance = local.centre.norm() / local.unit;
	local.inradius = ball.depth * scale / local.unit;
	for (std::size_t i = 0; i < set.size(); ++i)
		local.add(set.normals[i], (set.offsets[i] - set.normals[i].dot(local.centre)) / local.unit, int(i));
	for (int side = -1; side <= 1 && set.dimension == 2; side += 2)
		local.add(Vector3(0, 0, side), local.inradius, LocalPlanes::cap);
	for (const Vector3& corner : { Vector3(1, 1, 1), Vector3(1, -1, -1), Vector3(-1, 1, -1), Vector3(-1, -1, 1) })
		local.add(corner.normalized(), construction::horizon, LocalPlanes::closing);
	return local;
}

} // namespace polytope
