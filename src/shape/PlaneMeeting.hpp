// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "shape/ConstructionTolerances.hpp"
#include "shape/LocalPlanes.hpp"
#include "shape/TriangleClusters.hpp"

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
inline bool meetingOfThree(const Vector3& n0, const Vector3& n1, const Vector3& n2, const Vector3& s, Vector3& point)
{
	const Vector3 rows[3] = { n1.cross(n2), n2.cross(n0), n0.cross(n1) };
	const Real    volume  = n0.dot(rows[0]);
	if (!(abs(volume) >= construction::sharpCorner)) return false;
	const Real reciprocal = 1 / volume;
	point                 = (s[0] * rows[0] + s[1] * rows[1] + s[2] * rows[2]) * reciprocal;
	const Vector3 rest    = s - Vector3(n0.dot(point), n1.dot(point), n2.dot(point));
	point += (rest[0] * rows[0] + rest[1] * rows[1] + rest[2] * rows[2]) * reciprocal;
	return true;
}

/// The least squares of planes three of which make no sharp corner: from these three's point by the normal equations. They square
/// the condition, but of a correction that is small where the planes do meet; where they do not, no accuracy is needed.
inline bool meetingFromThree(const std::vector<Vector3>& normals, const std::vector<Real>& slacks, const Indices& planes, Vector3& point)
{
	const auto  normal = [&](std::size_t k) -> const Vector3& { return normals[std::size_t(planes[k])]; };
	const auto  slack  = [&](std::size_t k) -> const Real& { return slacks[std::size_t(planes[k])]; };
	std::size_t second = 1, third = 2;
	if (planes.size() > 3) {
		Real most = 0;
		for (std::size_t k = 1; k < planes.size(); ++k) {
			const Real square = normal(0).cross(normal(k)).squaredNorm();
			if (square > most) {
				most   = square;
				second = k;
			}
		}
		const Vector3 edge = normal(0).cross(normal(second));
		most               = 0;
		for (std::size_t k = 1; k < planes.size(); ++k) {
			const Real volume = abs(edge.dot(normal(k)));
			if (volume > most) {
				most  = volume;
				third = k;
			}
		}
	}
	if (!meetingOfThree(normal(0), normal(second), normal(third), Vector3(slack(0), slack(second), slack(third)), point)) return false;
	if (planes.size() == 3) return true;
	Matrix3 square = Matrix3::Zero();
	Vector3 right  = Vector3::Zero();
	for (std::size_t k = 0; k < planes.size(); ++k) {
		square += normal(k) * normal(k).transpose();
		right += normal(k) * (slack(k) - normal(k).dot(point));
	}
	const Vector3 rows[3]
	        = { square.row(1).cross(square.row(2)), square.row(2).cross(square.row(0)), square.row(0).cross(square.row(1)) };
	point += Vector3(rows[0].dot(right), rows[1].dot(right), rows[2].dot(right)) / rows[0].dot(square.row(0));
	return true;
}

/// Where planes meet, by orthogonal elimination, whatever the planes are.
template <int AtMost>
Vector3 leastSquaresMeeting(const std::vector<Vector3>& normals, const std::vector<Real>& slacks, const Indices& planes)
{
	Eigen::Matrix<Real, Eigen::Dynamic, 3, Eigen::ColMajor, AtMost, 3> n(Eigen::Index(planes.size()), 3);
	Eigen::Matrix<Real, Eigen::Dynamic, 1, Eigen::ColMajor, AtMost, 1> s(Eigen::Index(planes.size()));
	for (std::size_t k = 0; k < planes.size(); ++k) {
		n.row(Eigen::Index(k)) = normals[std::size_t(planes[k])].transpose();
		s[Eigen::Index(k)]     = slacks[std::size_t(planes[k])];
	}
	return n.colPivHouseholderQr().solve(s);
}

inline Meeting meeting(const std::vector<Vector3>& normals, const std::vector<Real>& slacks, const Indices& planes)
{
	constexpr int few = 8; // need no memory of their own
	Meeting       result;
	if (!meetingFromThree(normals, slacks, planes, result.point))
		result.point = planes.size() <= few ? leastSquaresMeeting<few>(normals, slacks, planes)
		                                    : leastSquaresMeeting<Eigen::Dynamic>(normals, slacks, planes);
	result.misfit = 0;
	for (int i : planes)
		result.misfit = std::max(result.misfit, Real(abs(normals[std::size_t(i)].dot(result.point) - slacks[std::size_t(i)])));
	return result;
}

/// Whether four planes certainly miss every point by more than the tolerance. With Σ y_i n_i = 0 (y: the minors of the normals)
///
///     |Σ y_i s_i| = |Σ y_i (s_i − n_i·x)| ≤ Σ |y_i| max_i |s_i − n_i·x|   for every x,
///
/// and rounding changes a minor by no more than construction::minorRounding.
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
