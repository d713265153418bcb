// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "shape/ShapeFamily.hpp"

#include <pkg/common/Facet.hpp>

/// YADE's facet: its plane, and what bounds it there. The ground behind it, as a mesh makes it, is in contact/FacetPrism.hpp.
namespace yade {

/// Unit normal of a triangle, from which its corners are counter-clockwise. `corner(k)`: its corners.
template <class Corner> Vector3r normalOfTriangle(const Corner& corner)
{
	return (corner(1) - corner(0)).cross(corner(2) - corner(0)).normalized();
}

/// Unit vector in the triangle's plane, normal to the edge from corner k to the next, and away from it. `normal`: the plane's, either of both.
template <class Corner> Vector3r outwardOfEdge(const Corner& corner, const Vector3r& normal, int k)
{
	Vector3r out = (corner((k + 1) % 3) - corner(k)).cross(normal).normalized();
	if (out.dot(corner((k + 2) % 3) - corner(k)) > 0) out = -out;
	return out;
}

std::unique_ptr<const ShapeFamily> familyOfFacets();

} // namespace yade
