// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "numbers/Real.hpp"

#include <IpTNLP.hpp>

#include <vector>

namespace polytope {

/// The problem of the centre as Ipopt solves it (Boon et al. 2012, Eqs 19-36).
/// With x = x₀ + diag(D)·u and slacks in units of their own values at x₀, slack_i = S_i·σ_i:
///
///     minimise −Σ log σ_i   over u, σ      subject to   Σ_k (a_ik D_k/S_i) u_k + σ_i = b_i,   σ_i ≥ 0.
///
/// It starts at u = 0, σ = 1. Inside, all b_i are one and the constraints hold exactly, and every number in it is about
/// one if x₀ is about in the middle of the overlap and D_k about half its width along axis k, however thin the overlap
/// is. Outside, b_i is slack_i/S_i, down to −1: that slacks are unknowns of their own lets Ipopt start there, too.
/// Unknowns: u (`dimension`), then σ (one a plane).
class IpoptProgram : public Ipopt::TNLP {
public:
	/// Slacks at x₀ = x.
	void start(int dimension, int count, const Real* const* normal, const Real* offset, const Real* x);

	/// Whether x₀ is strictly inside.
	bool inside() const;

	/// Moves x₀, inside, along one axis after the other to the middle of the chord, across the overlap's thin axis last.
	void moveToMiddle();

	/// Makes half the chords' lengths the axes' units, and writes the program's coefficients.
	void scale();

	/// Moves x₀ to the solution. Gives how far that was, in the overlap's local norm at the old x₀: √Σ (a_i·step/S_i)²;
	/// negative if there is none.
	Real moveToSolution();

	const Real* point() const { return point_; }

	bool get_nlp_info(Ipopt::Index& n, Ipopt::Index& m, Ipopt::Index& nonZerosJacobian, Ipopt::Index& nonZerosHessian,
	        IndexStyleEnum& style) override;
	bool get_bounds_info(Ipopt::Index n, Ipopt::Number* lower, Ipopt::Number* upper, Ipopt::Index m, Ipopt::Number* constraintLower,
	        Ipopt::Number* constraintUpper) override;
	bool get_starting_point(
	        Ipopt::Index n, bool, Ipopt::Number* z, bool, Ipopt::Number*, Ipopt::Number*, Ipopt::Index, bool, Ipopt::Number*) override;
	bool eval_f(Ipopt::Index n, const Ipopt::Number* z, bool, Ipopt::Number& value) override;
	bool eval_grad_f(Ipopt::Index n, const Ipopt::Number* z, bool, Ipopt::Number* gradient) override;
	bool eval_g(Ipopt::Index, const Ipopt::Number* z, bool, Ipopt::Index m, Ipopt::Number* constraint) override;
	bool eval_jac_g(Ipopt::Index, const Ipopt::Number*, bool, Ipopt::Index m, Ipopt::Index, Ipopt::Index* rows, Ipopt::Index* columns,
	        Ipopt::Number* values) override;
	bool eval_h(Ipopt::Index n, const Ipopt::Number* z, bool, Ipopt::Number factor, Ipopt::Index, const Ipopt::Number*, bool,
	        Ipopt::Index, Ipopt::Index* rows, Ipopt::Index* columns, Ipopt::Number* values) override;
	void finalize_solution(Ipopt::SolverReturn, Ipopt::Index n, const Ipopt::Number* z, const Ipopt::Number*, const Ipopt::Number*,
	        Ipopt::Index, const Ipopt::Number*, const Ipopt::Number*, Ipopt::Number, const Ipopt::IpoptData*,
	        Ipopt::IpoptCalculatedQuantities*) override;

private:
	/// Distances from x₀ to the nearest planes along an axis, ahead and back.
	struct Chord {
		Real ahead, back;
	};
	Chord chord(const std::vector<Real>& slacks, int k) const;

	Real plane(int i, int k) const { return normal_[std::size_t(i) * dimension_ + k]; }

	int                 dimension_ = 0, planes_ = 0;
	Real                point_[3] = {};  ///< x₀
	Real                unit_[3]  = {};  ///< D
	std::vector<Real>   normal_, slack_; ///< a; d − a·x₀
	std::vector<Real>   slackUnit_;      ///< S
	std::vector<double> coefficient_;    ///< a_ik D_k/S_i
	std::vector<double> solution_;       ///< u, σ
};

} // namespace polytope
