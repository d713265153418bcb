// SPDX-License-Identifier: GPL-2.0-or-later
#include "centre/IpoptLinearSolver.hpp"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>

namespace polytope {

using namespace Ipopt;

ESymSolverStatus IpoptLinearSolver::InitializeStructure(Index size, Index nonZeros, const Index*, const Index*)
{
	planes_ = (size - dimension_) / 2;
	values_.resize(nonZeros);
	diagonal_.resize(size);
	constraints_.resize(planes_, dimension_);
	return size == dimension_ + 2 * planes_ ? SYMSOLVER_SUCCESS : SYMSOLVER_FATAL_ERROR;
}

ESymSolverStatus IpoptLinearSolver::factorise(const Index* rows, const Index* columns)
{
	const int firstMultiplier = dimension_ + planes_;
	diagonal_.setZero();
	constraints_.setZero();
	for (std::size_t i = 0; i < values_.size(); ++i) {
		const int row = std::max(rows[i], columns[i]) - 1, column = std::min(rows[i], columns[i]) - 1;
		if (row == column) diagonal_[row] += values_[i];
		else if (row >= firstMultiplier && column < dimension_) constraints_(row - firstMultiplier, column) += values_[i];
		else if (row != column + planes_ || values_[i] != 1) return SYMSOLVER_FATAL_ERROR; // not used by this program
	}
	Eigen::MatrixXd stack(dimension_ + planes_, dimension_);
	stack.setZero();
	for (int k = 0; k < dimension_; ++k)
		stack(k, k) = std::sqrt(diagonal_[k]);
	for (int i = 0; i < planes_; ++i) {
		const double p = diagonal_[dimension_ + i], delta = -diagonal_[firstMultiplier + i];
		// P > 0 makes as many eigenvalues negative as there are planes; it is, for the program is convex
		if (!(p > 0)) return SYMSOLVER_WRONG_INERTIA;
		stack.row(dimension_ + i) = std::sqrt(p / (1 + p * delta)) * constraints_.row(i);
	}
	const Eigen::HouseholderQR<Eigen::MatrixXd> qr(stack);
	factor_ = qr.matrixQR().topRows(dimension_);
	for (int k = 0; k < dimension_; ++k)
		if (!(std::abs(factor_(k, k)) > 0) || !std::isfinite(factor_(k, k))) return SYMSOLVER_SINGULAR;
	return SYMSOLVER_SUCCESS;
}

void IpoptLinearSolver::solve(double* vector) const
{
	using Part = Eigen::Map<Eigen::VectorXd>;
	Part                  u(vector, dimension_), sigma(vector + dimension_, planes_), lambda(vector + dimension_ + planes_, planes_);
	const Eigen::ArrayXd  p      = diagonal_.segment(dimension_, planes_).array();
	const Eigen::ArrayXd  onePd  = 1 - p * diagonal_.tail(planes_).array();
	const Eigen::ArrayXd  t      = (sigma.array() - p * lambda.array()) / onePd; // λ = t + w C u
	const Eigen::VectorXd rightU = sigma;
	u -= constraints_.transpose() * t.matrix();
	const auto r = factor_.triangularView<Eigen::Upper>();
	r.transpose().solveInPlace(u);
	r.solveInPlace(u);
	lambda = t + p / onePd * (constraints_ * u).array();
	sigma  = (rightU.array() - lambda.array()) / p;
}

ESymSolverStatus IpoptLinearSolver::MultiSolve(
        bool newMatrix, const Index* rows, const Index* columns, Index rightSides, Number* vectors, bool checkNegative, Index negative)
{
	if (newMatrix) {
		const ESymSolverStatus status = factorise(rows, columns);
		if (status != SYMSOLVER_SUCCESS) return status;
	}
	if (checkNegative && negative != planes_) return SYMSOLVER_WRONG_INERTIA;
	for (Index i = 0; i < rightSides; ++i)
		solve(vectors + std::size_t(i) * diagonal_.size());
	return SYMSOLVER_SUCCESS;
}

} // namespace polytope
