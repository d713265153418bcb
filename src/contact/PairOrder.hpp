// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "contact/ContactTypes.hpp"
#include "contact/PlacedPair.hpp"
#include "program/PlaneCode.hpp"

#include <utility>

/// An order of a pair's two bodies that does not depend on which one the caller names first: sums of rounded numbers taken
/// in it give both callers the same bits, so that exchanging the bodies exchanges the forces exactly.
namespace polytope {

/// −1, 0, 1 for a < b, a = b, a > b.
inline int compared(Real a, Real b) { return a < b ? -1 : a > b; }

inline int compared(const Real* a, const Real* b, int count)
{
	for (int i = 0; i < count; ++i)
		if (a[i] != b[i]) return compared(a[i], b[i]);
	return 0;
}

/// Whether body 2 goes first: by the shapes' sizes and planes, then orientations, then positions.
inline bool secondGoesFirst(const PlacedPair& pair)
{
	const ConvexShape &shape1 = *pair.shape[0], &shape2 = *pair.shape[1];
	int                order = 0;
	if (&shape1 != &shape2) {
		order = compared(shape1.boundingRadius(), shape2.boundingRadius());
		if (!order) order = compared(shape1.inscribedRadius(), shape2.inscribedRadius());
		if (!order) order = compared(Real(shape1.planeCount()), Real(shape2.planeCount()));
		if (!order) order = compared(shape1.normalArray(0), shape2.normalArray(0), (shape1.dimension() + 1) * shape1.paddedCount());
	}
	if (!order) order = compared(pair.rotation[0]->data(), pair.rotation[1]->data(), 9);
	for (int k = 0; k < shape1.dimension() && !order; ++k)
		order = compared((*pair.centre2)[k], 0);
	return order > 0;
}

/// The pair's memory with the two bodies exchanged.
inline void exchangeBodies(PairMemory& memory)
{
	for (int& code : memory.basis)
		code = exchangedCode(code);
	const Vector3 first  = memory.point[0];
	memory.point[0]      = memory.point[1];
	memory.point[1]      = first;
	memory.dualDirection = -memory.dualDirection;
	memory.surface.exchanged ^= 1;
}

inline void exchangeBodies(InternalPlanes& planes)
{
	std::swap(planes.count[0], planes.count[1]);
	std::swap(planes.plane[0], planes.plane[1]);
	std::swap(planes.ends[0], planes.ends[1]);
	std::swap(planes.end[0], planes.end[1]);
	std::swap(planes.radius[0], planes.radius[1]);
}

/// The result for the pair with the two bodies exchanged; `centre2` as the caller of the exchanged pair has it. Polygons have no z.
inline void exchangeBodies(ContactResult& result, const Vector3& centre2, int dimension)
{
	for (int& code : result.basis)
		code = exchangedCode(code);
	result.normal        = -result.normal;
	result.dualDirection = -result.dualDirection;
	if (!result.hasGeometry) return;
	for (int k = 0; k < dimension; ++k) {
		result.point[k] += centre2[k];
		result.sectionCentroid[k] += centre2[k];
	}
}

} // namespace polytope
