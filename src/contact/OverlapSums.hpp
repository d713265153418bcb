// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "numbers/Lanes.hpp"

/// What is asked of the overlap of two bodies (OverlapPolyhedron.hpp, OverlapPolygon.hpp).
namespace polytope {

template <class R, int D> struct OverlapMass {
	R volume      = 0; ///< [m³], 2-D: [m²]
	R centroid[D] = {};
};

/// The overlap seen along n: its projection on the plane (the line) normal to n.
template <class R> struct Footprint {
	R area      = 0;  ///< [m²]; 2-D: length [m]
	R second[3] = {}; ///< ∫ u², ∫ u v, ∫ v² dA along the axes around n (axesAround), from a point p [m⁴]; 2-D: the first alone, [m³]
};

/// The overlap of two bodies as a polyhedron (3-D) or a polygon (2-D), in the planes' frame [m].
template <class R, int D, int W> class Overlap;

} // namespace polytope
