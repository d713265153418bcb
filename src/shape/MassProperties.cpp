// SPDX-License-Identifier: GPL-2.0-or-later
#include "shape/MassProperties.hpp"

#include "shape/ConstructionTolerances.hpp"
#include "shape/SolidMoments.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>

#include <cmath>
#include <stdexcept>
#include <utility>

namespace polytope {
namespace {

	using Points = std::vector<Vector3>;

	SolidMoments momentsOf(const Polyhedron& shape, const Points& points)
	{
		SolidMoments sum;
		for (const std::vector<int>& face : shape.faces)
			for (std::size_t k = 2; k < face.size(); ++k)
				sum.addTetrahedron(
				        points[std::size_t(face[0])], points[std::size_t(face[k - 1])], points[std::size_t(face[k])]);
		return sum;
	}

	Real boxVolume(const Points& points)
	{
		Eigen::AlignedBox<Real, 3> box(points.front());
		for (const Vector3& p : points)
			box.extend(p);
		return box.sizes().prod();
	}

	/// Rotation whose columns are the directions in which the points extend most and least.
	Matrix3 alongThePoints(const Points& points)
	{
		Eigen::Matrix<Real, Eigen::Dynamic, 3> rows(Eigen::Index(points.size()), 3);
		for (std::size_t i = 0; i < points.size(); ++i)
			rows.row(Eigen::Index(i)) = points[i].transpose();
		Matrix3 axes = Eigen::JacobiSVD<decltype(rows)>(rows, Eigen::ComputeFullV).matrixV();
		axes.col(2)  = axes.col(0).cross(axes.col(1));
		return axes;
	}

	/// ∫ x xᵀ dV about the centroid, in the axes of the points.
	Matrix3 secondAboutCentroid(const Polyhedron& shape, Points points, const Vector3& centroid)
	{
		for (Vector3& p : points)
			p -= centroid;
		const Matrix3 second = momentsOf(shape, points).second;
		return (second + second.transpose()) / 2;
	}

	bool isDiagonal(const Matrix3& tensor)
	{
		const Real    largest = tensor.diagonal().cwiseAbs().maxCoeff();
		const Vector3 products(tensor(0, 1), tensor(0, 2), tensor(1, 2));
		return products.cwiseAbs().maxCoeff() <= construction::diagonal * largest;
	}

	/// Eigenvectors carry no sign: the largest component is made positive, so that equal input gives equal axes.
	Vector3 withFixedSign(const Vector3& axis)
	{
		int largest = 0;
		axis.cwiseAbs().maxCoeff(&largest);
		return axis[largest] < 0 ? Vector3(-axis) : axis;
	}

} // namespace

MassProperties massProperties(const Polyhedron& shape)
{
	if (shape.vertices.empty()) throw std::invalid_argument("shape: it has no vertices; make it with polyhedron()");
	Vector3 inner = Vector3::Zero();
	for (const Vector3& vertex : shape.vertices)
		inner += (vertex - shape.vertices.front()) / Real(shape.vertices.size());
	inner += shape.vertices.front();
	Points points = shape.vertices;
	for (Vector3& p : points)
		p -= inner;

	SolidMoments about = momentsOf(shape, points);
	Matrix3      turn  = Matrix3::Identity();
	if (about.zeroth < construction::slender * boxVolume(points)) {
		turn = alongThePoints(points);
		for (Vector3& p : points)
			p = (turn.transpose() * p).eval();
		about = momentsOf(shape, points);
	}
	if (!(about.zeroth > 0))
		throw std::invalid_argument("shape: its volume is not positive; list each face counter-clockwise seen from outside");
	// a second sum about the centroid itself: the parallel-axis theorem would subtract nearly equal numbers
	const Vector3 shift   = about.first / about.zeroth;
	const Matrix3 second  = secondAboutCentroid(shape, points, shift);
	Matrix3       inertia = -second;
	for (int k = 0; k < 3; ++k) // not trace − own term: a needle's small moment would be the difference of two large ones
		inertia(k, k) = second((k + 1) % 3, (k + 1) % 3) + second((k + 2) % 3, (k + 2) % 3);

	MassProperties result;
	result.volume   = about.zeroth;
	result.centroid = inner + turn * shift;
	result.inertia  = inertia;
	if (turn != Matrix3::Identity()) {
		const Matrix3 turned = turn * inertia * turn.transpose();
		result.inertia       = (turned + turned.transpose()) / 2;
	}
	return result;
}

PrincipalAxes principalAxes(const Matrix3& inertia, int dimension)
{
	PrincipalAxes result;
	if (isDiagonal(inertia)) {
		result.moments = inertia.diagonal();
		return result;
	}
	if (dimension == 2) {
		using std::atan2;
		using std::cos;
		using std::hypot;
		using std::sin;
		const Real    half = (inertia(0, 0) - inertia(1, 1)) / 2, product = inertia(0, 1);
		const Real    mean = (inertia(0, 0) + inertia(1, 1)) / 2, radius = hypot(half, product);
		const Real    angle    = atan2(product, half) / 2; // of the axis with the larger moment
		const Vector3 first    = withFixedSign(Vector3(-sin(angle), cos(angle), 0));
		result.rotation.col(0) = first;
		result.rotation.col(1) = Vector3(-first.y(), first.x(), 0);
		result.moments         = Vector3(mean - radius, mean + radius, inertia(2, 2));
		return result;
	}
	const Eigen::SelfAdjointEigenSolver<Matrix3> solver(inertia);
	result.moments         = solver.eigenvalues();
	result.rotation.col(0) = withFixedSign(solver.eigenvectors().col(0));
	result.rotation.col(1) = withFixedSign(solver.eigenvectors().col(1));
	result.rotation.col(2) = result.rotation.col(0).cross(result.rotation.col(1));
	return result;
}

} // namespace polytope
