// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact/PolytopeGeom.hpp"

#include <src/numbers/PlaneAxes.hpp>
#include <src/program/PlaneCode.hpp>

#include <algorithm>

namespace yade {

POLYTOPE_CLASSES((PolytopeGeom));

polytope::PairMemory PolytopeGeom::memory() const
{
	polytope::PairMemory memory;
	std::copy(basis.begin(), basis.end(), memory.basis.begin());
	memory.hasBasis                                    = hasBasis;
	memory.hasPoint                                    = hasPoint;
	(hasPoint ? memory.dualDirection : memory.weights) = direction;
	memory.point                                       = { point1, point2 };
	surface.get(memory.surface);
	return memory;
}

void PolytopeGeom::remember(const polytope::PairMemory& memory, bool sameSurface)
{
	constexpr int most = std::numeric_limits<std::uint16_t>::max();
	const bool    fits = std::all_of(memory.basis.begin(), memory.basis.end(), [](int code) { return code >= 0 && code <= most; });
	hasBasis           = memory.hasBasis && fits;
	hasPoint           = memory.hasPoint && fits;
	if (fits) std::copy(memory.basis.begin(), memory.basis.end(), basis.begin());
	point1    = memory.point[0];
	point2    = memory.point[1];
	direction = hasPoint ? memory.dualDirection : memory.weights;
	if (!sameSurface || surface.lacksPiecesOf(memory.surface)) surface.set(memory.surface);
}

std::vector<Vector3r> PolytopeGeom::cornersOfOutline() const
{
	std::vector<Vector3r>     corners;
	const polytope::PlaneAxes axes(normal);
	for (int k = 0; k < outline.count(); ++k)
		corners.push_back(contactPoint + axes.inSpace(outline.corners()[k]));
	return corners;
}

boost::python::list PolytopeGeom::outlineCorners() const
{
	boost::python::list corners;
	for (const Vector3r& corner : cornersOfOutline())
		corners.append(corner);
	return corners;
}

polytope::InternalPlanes PolytopeGeom::internalPlanes() const
{
	polytope::InternalPlanes planes;
	if (!internalFaces.get() || !internalEnds.get() || internalEnds.get()->size() % 5 != 2) return planes;
	for (int code : *internalFaces.get())
		planes.add(polytope::bodyOfCode(code), polytope::planeOfCode(code));
	const std::vector<Real>& numbers = *internalEnds.get();
	for (int body = 0; body < 2; ++body)
		planes.radius[body] = numbers[std::size_t(body)];
	for (std::size_t k = 2; k < numbers.size(); k += 5)
		planes.addEnd(numbers[k] > 0, { Vector3r(numbers[k + 1], numbers[k + 2], numbers[k + 3]), numbers[k + 4] });
	return planes;
}

void PolytopeGeom::setInternalPlanes(const polytope::InternalPlanes& planes)
{
	internalFaces.clear();
	internalEnds.clear();
	if (planes.none()) return;
	std::vector<int>&  codes   = internalFaces.make();
	std::vector<Real>& numbers = internalEnds.make();
	numbers                    = { planes.radius[0], planes.radius[1] };
	for (int body = 0; body < 2; ++body) {
		for (int k = 0; k < planes.count[body]; ++k)
			codes.push_back(polytope::planeCode(body, planes.plane[body][k]));
		for (int k = 0; k < planes.ends[body]; ++k) {
			const polytope::Plane& end = planes.end[body][k];
			numbers.insert(numbers.end(), { Real(body), end.normal[0], end.normal[1], end.normal[2], end.offset });
		}
	}
}

} // namespace yade
