// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "cutting/FiniteJoint.hpp"

/// How much of joints lies inside a region: their area, by which the density of a joint network is measured (P32).
namespace polytope {

/// joint → its area inside convex regions that do not overlap. Refuses what polyhedron() refuses of a region.
std::vector<Real> areasWithin(const std::vector<HalfSpaces>& regions, const std::vector<FiniteJoint>& joints);

} // namespace polytope
