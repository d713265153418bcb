// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

// The build of a wider precision names YADE's header of its type, see src/CMakeLists.txt.
#ifdef POLYTOPE_REAL_HEADER
#include POLYTOPE_REAL_HEADER
#endif

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cmath>

/// The one place that chooses the arithmetic. The plug-in is compiled against YADE's `Real`;
/// everything in src/ uses polytope::Real and the Eigen types below, nothing else.
///
/// From double (literals, thresholds, Python's floats) to Real is implicit and exact. The conversion back is always
/// explicit, double(x): for drawing, VTK files, messages and Ipopt, which use doubles only. Conversions for CGAL are in CgalGeometry.cpp.
namespace polytope {

#ifdef POLYTOPE_REAL
using Real = POLYTOPE_REAL;
#else
using Real = double;
#endif

/// Called unqualified: these for double, those of its own namespace for a wider type.
using std::abs;
using std::isfinite;
using std::sqrt;

using Vector2    = Eigen::Matrix<Real, 2, 1>;
using Vector3    = Eigen::Matrix<Real, 3, 1>;
using Matrix3    = Eigen::Matrix<Real, 3, 3>;
using Quaternion = Eigen::Quaternion<Real>;

} // namespace polytope
