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
	if (!sameSurface) surface.set(memory.surface);
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
	if (!internalFaces.get()) return planes;
	const std::vector<int>&  codes = *internalFaces.get();
	const std::vector<Real>& ends  = *internalEnds.get();
	for (std::size_t k = 0; k < codes.size(); ++k)
		planes.add(polytope::bodyOfCode(codes[k]), polytope::planeOfCode(codes[k]), ends[k]);
	return planes;
}

bool PolytopeGeom::setInternalPlanes(const polytope::InternalPlanes& planes)
{
	std::vector<int>  codes;
	std::vector<Real> ends;
	for (int body = 0; body < 2; ++body)
		for (int k = 0; k < planes.count[body]; ++k) {
			codes.push_back(polytope::planeCode(body, planes.plane[body][k]));
			ends.push_back(planes.beyond[body][k]);
		}
	// where a support ends obliquely it ends elsewhere for each place of the contact point
	const Real        room       = Real(polytope::tolerance::endOfSupport) * math::min(refR1, refR2);
	const auto        same       = [&](Real a, Real b) { return a == b || math::abs(a - b) <= room; };
	const auto* const knownCodes = internalFaces.get();
	const auto* const knownEnds  = internalEnds.get();
	if (knownCodes ? codes == *knownCodes && std::equal(ends.begin(), ends.end(), knownEnds->begin(), same) : codes.empty())
		return false;
	internalFaces.clear();
	internalEnds.clear();
	if (!codes.empty()) {
		internalFaces.make() = codes;
		internalEnds.make()  = ends;
	}
	return true;
}

} // namespace yade
