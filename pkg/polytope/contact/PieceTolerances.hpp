// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <lib/base/Math.hpp>

/// Thresholds of bodies that lie on several pieces: facets of a mesh, plates.
namespace yade::pieces {

/// × edge of a facet: corners of two facets that are nearer are one corner of the mesh. STL files have six digits, in any unit, and where they come
/// with large coordinates some less.
constexpr double sameCorner = 1e-5;

/// Tilt of two facets [rad] that is no edge, and difference of planes, over their size, that is the rounding of poses: the prism stays as
/// it is, so that it is not built again in each step while a mesh turns.
constexpr double samePlane = 1e-9;

/// Angles of the solid at the edge of two facets [rad] between which the edge is mitred. Below, the facets are a sheet that is seen from
/// both sides; above, the prism would reach far beyond its facet.
constexpr double sharpestEdge = 0.05, widestEdge = 5.5;

/// Facets beyond the edges' neighbours by which the prism at a convex tip is cut.
constexpr int cutsAtTips = 24;

/// Sides of the polygon that stands for the disc in which a sphere lies on its pieces. Shares are parts of its area, so they add up to one with any
/// number; with 16 none is wrong by more than a hundredth.
constexpr int discSides = 16;

} // namespace yade::pieces
