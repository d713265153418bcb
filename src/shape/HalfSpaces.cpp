// SPDX-License-Identifier: GPL-2.0-or-later
#include "shape/HalfSpaces.hpp"

#include "shape/CheckedNumbers.hpp"
#include "shape/ConstructionTolerances.hpp"

#include <algorithm>
#include <string>

namespace polytope {
namespace {

	std::string entry(std::size_t i) { return "entry " + std::to_string(i) + " (counted from 0) "; }

	void checkSizes(const HalfSpaces& set)
	{
		if (set.dimension != 2 && set.dimension != 3) refuse("dimension: " + std::to_string(set.dimension) + "; give 2 or 3");
		if (set.normals.size() != set.offsets.size())
			refuse("offsets: " + std::to_string(set.offsets.size()) + " values for " + std::to_string(set.normals.size())
			        + " normals; give one offset per normal");
		const std::size_t least = std::size_t(set.dimension) + 1;
		if (set.size() < least)
			refuse("normals: " + std::to_string(set.size()) + " planes cannot bound a body in " + std::to_string(set.dimension)
			        + "-D; give at least " + std::to_string(least));
	}

	/// The length without over- or underflow of the squares.
	Real lengthOf(const Vector3& normal, std::size_t i)
	{
		for (int k = 0; k < 3; ++k)
			if (!finite(normal[k])) refuse("normals: " + entry(i) + "is not finite; remove NaN and infinite values");
		const Real largest = normal.cwiseAbs().maxCoeff();
		if (!(largest > 0)) refuse("normals: " + entry(i) + "is zero; give the outward direction of the plane, of any length");
		return largest * (normal / largest).norm();
	}

	bool samePlane(const HalfSpaces& set, std::size_t i, std::size_t j, const Real& leastScale)
	{
		const Real scale = std::max({ magnitude(set.offsets[i]), magnitude(set.offsets[j]), leastScale });
		if (magnitude(set.offsets[i] - set.offsets[j]) > construction::duplicate * scale) return false;
		return (set.normals[i] - set.normals[j]).cwiseAbs().maxCoeff() <= construction::duplicate;
	}

	/// The median, not the largest: one far redundant plane must not make the tolerance too coarse for the near ones.
	Real medianOffset(const HalfSpaces& set)
	{
		std::vector<Real> sizes;
		for (const Real& offset : set.offsets)
			sizes.push_back(magnitude(offset));
		if (sizes.empty()) return 0;
		const auto middle = sizes.begin() + std::ptrdiff_t(sizes.size() / 2);
		std::nth_element(sizes.begin(), middle, sizes.end());
		return *middle;
	}

} // namespace

HalfSpaces normalised(const HalfSpaces& input)
{
	checkSizes(input);
	HalfSpaces unit = input;
	for (std::size_t i = 0; i < unit.size(); ++i) {
		Vector3&   normal = unit.normals[i];
		const Real length = lengthOf(normal, i);
		if (!finite(unit.offsets[i])) refuse("offsets: " + entry(i) + "is not finite; remove NaN and infinite values");
		if (unit.dimension == 2) {
			if (magnitude(normal.z()) > construction::outOfPlane * length)
				refuse("normals: " + entry(i) + "leaves the xy plane; in 2-D every normal needs z = 0");
			normal.z() = 0;
		}
		if (magnitude(length - 1) > construction::unitLength) {
			// two steps, because the reciprocal of a tiny length may overflow
			normal = (normal / normal.cwiseAbs().maxCoeff()).normalized();
			unit.offsets[i] /= length;
			if (!finite(unit.offsets[i]))
				refuse("offsets: " + entry(i) + "divided by the length of its normal overflows; scale the plane");
		}
		if (magnitude(unit.offsets[i]) > construction::largestLength)
			refuse("offsets: " + entry(i) + "(over the length of its normal) is beyond 1e50; choose another unit of length");
	}
	return unit;
}

HalfSpaces withoutDuplicates(const HalfSpaces& unit)
{
	const Real leastScale = medianOffset(unit);
	HalfSpaces kept;
	kept.dimension = unit.dimension;
	for (std::size_t i = 0; i < unit.size(); ++i) {
		bool repeated = false;
		for (std::size_t j = 0; j < i && !repeated; ++j)
			repeated = samePlane(unit, j, i, leastScale);
		if (repeated) continue;
		kept.normals.push_back(unit.normals[i]);
		kept.offsets.push_back(unit.offsets[i]);
	}
	return kept;
}

HalfSpaces cuboid(const Vector3& half)
{
	HalfSpaces planes;
	forPlanesOfCuboid(half, [&](int axis, int sign, const Real& offset) {
		planes.normals.push_back(sign * Vector3::Unit(axis));
		planes.offsets.push_back(offset);
	});
	return planes;
}

HalfSpaces moved(const HalfSpaces& set, const Matrix3& rotation, const Vector3& translation)
{
	HalfSpaces result = set;
	for (std::size_t i = 0; i < set.size(); ++i) {
		result.normals[i] = rotation * set.normals[i];
		result.offsets[i] = set.offsets[i] + result.normals[i].dot(translation);
	}
	return result;
}

} // namespace polytope
