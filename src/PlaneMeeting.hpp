// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "ConstructionTolerances.hpp"
#include "LocalPlanes.hpp"
#include "TriangleClusters.hpp"

#include <Eigen/QR>

/// Where planes meet. The planes are n_i·x = s_i with unit normals.
namespace polytope {

/// The point nearest to all of the planes (least squares), and the largest distance left.
struct Meeting {
	Vector3 point;
	Real    misfit;
};

/// Three planes that do not meet at a sharp angle, by Cramer's rule and one correction by the residual, which makes it backward
/// stable. False where the corner is too sharp for that.
inline bool meetingOfThree(const Vector3* n, const Real* s, Meeting& result)
{
	const Vector3 rows[3] = { n[1].cross(n[2]), n[2].cross(n[0]), n[0].cross(n[1]) };
	const Real    volume  = n[0].dot(rows[0]);
	if (!(abs(volume) >= construction::sharpCorner)) return false;
	const auto residual = [&](int k) { return Real(s[k] - n[k].dot(result.point)); };
	result.point        = (s[0] * rows[0] + s[1] * rows[1] + s[2] * rows[2]) / volume;
	result.point += (residual(0) * rows[0] + residual(1) * rows[1] + residual(2) * rows[2]) / volume;
	result.misfit = std::max({ Real(abs(residual(0))), Real(abs(residual(1))), Real(abs(residual(2))) });
	return true;
}

template <int AtMost> Meeting leastSquaresMeeting(const std::vector<Vector3>& normals, const std::vector<Real>& slacks, const Indices& planes)
{
	Eigen::Matrix<Real, Eigen::Dynamic, 3, Eigen::ColMajor, AtMost, 3> n(Eigen::Index(planes.size()), 3);
	Eigen::Matrix<Real, Eigen::Dynamic, 1, Eigen::ColMajor, AtMost, 1> s(Eigen::Index(planes.size()));
	for (std::size_t k = 0; k < planes.size(); ++k) {
		n.row(Eigen::Index(k)) = normals[std::size_t(planes[k])].transpose();
		s[Eigen::Index(k)]     = slacks[std::size_t(planes[k])];
	}
	Meeting result;
	result.point  = n.colPivHouseholderQr().solve(s);
	result.misfit = (n * result.point - s).cwiseAbs().maxCoeff();
	return result;
}

inline Meeting meeting(const std::vector<Vector3>& normals, const std::vector<Real>& slacks, const Indices& planes)
{
	constexpr int few = 8; // need no memory of their own
	if (planes.size() == 3) {
		Vector3 n[3];
		Real    s[3];
		for (std::size_t k = 0; k < 3; ++k) {
			n[k] = normals[std::size_t(planes[k])];
			s[k] = slacks[std::size_t(planes[k])];
		}
		Meeting result;
		if (meetingOfThree(n, s, result)) return result;
	}
	return planes.size() <= few ? leastSquaresMeeting<few>(normals, slacks, planes)
	                            : leastSquaresMeeting<Eigen::Dynamic>(normals, slacks, planes);
}

/// Whether four planes certainly miss every point by more than the tolerance. With Σ y_i n_i = 0 (y: the minors of the normals)
///
///     |Σ y_i s_i| = |Σ y_i (s_i − n_i·x)| ≤ Σ |y_i| max_i |s_i − n_i·x|   for every x,
///
/// and rounding takes no more from a minor than construction::minorRounding.
inline bool missEachOther(const LocalPlanes& local, const std::array<int, 4>& planes, const Real& tolerance)
{
	const Vector3* n[4];
	Real           s[4], sizes = 0, lengths = 0, sum = 0;
	for (std::size_t k = 0; k < 4; ++k) {
		n[k] = &local.normals[std::size_t(planes[k])];
		s[k] = local.slacks[std::size_t(planes[k])];
		sizes += abs(s[k]);
	}
	const Vector3 first = n[0]->cross(*n[1]), second = n[2]->cross(*n[3]);
	const Real    y[4] = { n[1]->dot(second), -n[0]->dot(second), n[3]->dot(first), -n[2]->dot(first) };
	for (int k = 0; k < 4; ++k) {
		sum += y[k] * s[k];
		lengths += abs(y[k]);
	}
	return abs(sum) - construction::minorRounding * sizes > tolerance * (lengths + 4 * construction::minorRounding);
}

/// The four corners of two triangles that share an edge: those of the first, and the one that only the second has.
inline std::array<int, 4> cornersOfTwo(const Triangle& first, const Triangle& second)
{
	std::array<int, 4> corners { { first[0], first[1], first[2], second[0] } };
	for (int corner : second)
		if (std::find(first.begin(), first.end(), corner) == first.end()) corners[3] = corner;
	return corners;
}

} // namespace polytope
