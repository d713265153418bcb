// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <Eigen/Core>

#include <IpSparseSymLinearSolverInterface.hpp>

#include <vector>

/// Ipopt's linear systems for the program of IpoptProgram.hpp, in its unknowns u (2 or 3), slacks σ and multipliers λ (one a
/// plane each):
///
///     ⎡ E   0   Cᵀ ⎤ ⎡u⎤         E, P, Δ diagonal; σ and λ are eliminated, and what is left for u is
///     ⎢ 0   P   1  ⎥ ⎢σ⎥ = b     (E + Cᵀ w C) u = …,   w = P/(1 + P Δ),
///     ⎣ C   1  −Δ  ⎦ ⎣λ⎦         solved through a QR factorisation of √E over √w C (Ipopt refines the solution).
///
/// Replaces MUMPS, the only solver of Debian's Ipopt. That one is built with MPI: Ipopt would start MPI inside the simulation, and
/// finalise it for the whole process when its last solver object is destroyed, that is, when a thread ends (MPI cannot be started
/// again). Besides, a general solver's threads and data structures cost more than solving this small system.
namespace polytope {

class IpoptLinearSolver : public Ipopt::SparseSymLinearSolverInterface {
public:
	/// Number of unknowns u, to be set before a program is solved.
	void setDimension(int dimension) { dimension_ = dimension; }

	bool                    InitializeImpl(const Ipopt::OptionsList&, const std::string&) override { return true; }
	Ipopt::ESymSolverStatus InitializeStructure(
	        Ipopt::Index size, Ipopt::Index nonZeros, const Ipopt::Index* rows, const Ipopt::Index* columns) override;
	Ipopt::Number*          GetValuesArrayPtr() override { return values_.data(); }
	Ipopt::ESymSolverStatus MultiSolve(bool newMatrix, const Ipopt::Index* rows, const Ipopt::Index* columns, Ipopt::Index rightSides,
	        Ipopt::Number* vectors, bool checkNegative, Ipopt::Index negative) override;

	Ipopt::Index  NumberOfNegEVals() const override { return planes_; }
	bool          IncreaseQuality() override { return false; }
	bool          ProvidesInertia() const override { return true; }
	EMatrixFormat MatrixFormat() const override { return Triplet_Format; }

private:
	Ipopt::ESymSolverStatus factorise(const Ipopt::Index* rows, const Ipopt::Index* columns);
	void                    solve(double* vector) const;

	int                 dimension_ = 3, planes_ = 0;
	std::vector<double> values_;               ///< of the triplets
	Eigen::VectorXd     diagonal_;             ///< E, P, −Δ
	Eigen::MatrixXd     constraints_, factor_; ///< C; R, upper triangular
};

} // namespace polytope
