// SPDX-License-Identifier: GPL-2.0-or-later
#include "cutting/JointAreas.hpp"

#include "shape/ShapeConstruction.hpp"

#include <algorithm>

namespace polytope {
namespace {

	struct Region {
		HalfSpaces set;
		Vector3    middle = Vector3::Zero();
		Real       radius = 0; ///< of a ball about the middle that holds it
	};

	Region regionOf(const HalfSpaces& given)
	{
		Region           region { normalised(given) };
		const Polyhedron shape = polyhedron(region.set);
		for (const Vector3& vertex : shape.vertices)
			region.middle += Vector3(vertex / Real(shape.vertices.size()));
		for (const Vector3& vertex : shape.vertices)
			region.radius = std::max(region.radius, Real((vertex - region.middle).norm()));
		return region;
	}

	/// What the region has in common with a plane.
	Polygon section(const Region& region, const Plane& plane)
	{
		const Real height = plane.normal.dot(region.middle) - plane.offset;
		if (abs(height) >= region.radius) return {};
		const Real    reach = 2 * region.radius;
		const Vector3 foot = region.middle - height * plane.normal, first = reach * plane.normal.unitOrthogonal(),
		              second = plane.normal.cross(first);
		Polygon polygon { foot - first - second, foot + first - second, foot + first + second, foot - first + second };
		for (std::size_t i = 0; i < region.set.size() && !polygon.empty(); ++i)
			polygon = clipped(polygon, { region.set.normals[i], region.set.offsets[i] });
		return polygon;
	}

} // namespace

std::vector<Real> areasWithin(const std::vector<HalfSpaces>& regions, const std::vector<FiniteJoint>& joints)
{
	std::vector<Real> areas(joints.size(), 0);
	for (const HalfSpaces& given : regions) {
		const Region region = regionOf(given);
		for (std::size_t j = 0; j < joints.size(); ++j)
			areas[j] += areaWithin(joints[j], section(region, joints[j].plane));
	}
	return areas;
}

} // namespace polytope
