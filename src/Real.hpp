// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

/// The one place that chooses the arithmetic. The plug-in is compiled against YADE's `Real`;
/// everything in src/ uses polytope::Real and the Eigen types below, nothing else.
namespace polytope {

#ifdef POLYTOPE_REAL
using Real = POLYTOPE_REAL;
#else
using Real = double;
#endif

using Vector2    = Eigen::Matrix<Real, 2, 1>;
using Vector3    = Eigen::Matrix<Real, 3, 1>;
using Matrix3    = Eigen::Matrix<Real, 3, 3>;
using Quaternion = Eigen::Quaternion<Real>;

} // namespace polytope
