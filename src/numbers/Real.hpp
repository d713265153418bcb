// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <polytope/config.hpp>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cmath>

/// The arithmetic: Real is chosen by CMake, in polytope/config.hpp (Config.hpp.in). The plug-in is compiled against YADE's `Real`;
/// everything in src/ uses polytope::Real and the Eigen types below, nothing else.
///
/// From double (literals, thresholds, Python's floats) to Real is implicit and exact. The conversion back is always
/// explicit, double(x): for drawing, VTK files, messages and Ipopt, which use doubles only. Conversions for CGAL are in CgalGeometry.cpp.
namespace polytope {

/// Called unqualified: these for double, those of its own namespace for a wider type.
using std::abs;
using std::isfinite;
using std::sqrt;

using Vector2    = Eigen::Matrix<Real, 2, 1>;
using Vector3    = Eigen::Matrix<Real, 3, 1>;
using Matrix3    = Eigen::Matrix<Real, 3, 3>;
using Quaternion = Eigen::Quaternion<Real>;

// Programs that align Eigen's types, and the core, which does not (cmake/Compiler.cmake), have these in the same places.
static_assert(alignof(Vector3) == alignof(Real) && alignof(Matrix3) == alignof(Real));

} // namespace polytope
