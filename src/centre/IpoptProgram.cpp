// SPDX-License-Identifier: GPL-2.0-or-later
#include "centre/IpoptProgram.hpp"

#include "numbers/Lanes.hpp"

#include <algorithm>
#include <cmath>

namespace polytope {

using namespace Ipopt;

void IpoptProgram::start(int dimension, int count, const Real* const* normal, const Real* offset, const Real* x)
{
	dimension_ = dimension;
	normal_.clear();
	slack_.clear();
	for (int k = 0; k < dimension; ++k)
		point_[k] = x[k];
	for (int i = 0; i < count; ++i) {
		if (offset[i] >= Real(padOffset) / 2) continue;
		Real slack = offset[i];
		for (int k = 0; k < dimension; ++k) {
			normal_.push_back(normal[k][i]);
			slack -= normal[k][i] * x[k];
		}
		slack_.push_back(slack);
	}
	planes_ = int(slack_.size());
}

bool IpoptProgram::inside() const
{
	return std::all_of(slack_.begin(), slack_.end(), [](const Real& slack) { return slack > 0; });
}

IpoptProgram::Chord IpoptProgram::chord(const std::vector<Real>& slacks, int k) const
{
	Chord chord { padOffset, padOffset };
	for (int i = 0; i < planes_; ++i) {
		const Real rate = plane(i, k);
		if (rate > 0 && slacks[i] < chord.ahead * rate) chord.ahead = slacks[i] / rate;
		if (rate < 0 && slacks[i] < -chord.back * rate) chord.back = slacks[i] / -rate;
	}
	return chord;
}

void IpoptProgram::moveToMiddle()
{
	for (int k = 0; k < dimension_; ++k) {
		const Chord c    = chord(slack_, k);
		const Real  move = (c.ahead - c.back) / 2;
		point_[k] += move;
		for (int i = 0; i < planes_; ++i)
			slack_[i] -= move * plane(i, k);
	}
}

void IpoptProgram::scale()
{
	solution_.clear();
	// for a plane that passes through x₀: the smallest positive length
	Real smallest = padOffset;
	for (const Real& slack : slack_)
		if (slack != 0) smallest = std::min<Real>(smallest, slack < 0 ? -slack : slack);
	slackUnit_.clear();
	for (const Real& slack : slack_)
		slackUnit_.push_back(std::max<Real>(smallest, slack < 0 ? -slack : slack));
	for (int k = 0; k < dimension_; ++k) {
		const Chord c = chord(slackUnit_, k);
		unit_[k]      = (c.ahead + c.back) / 2;
	}
	// from outside the distance may be long against the slacks: no coefficient above one
	if (!inside())
		for (int i = 0; i < planes_; ++i)
			for (int k = 0; k < dimension_; ++k)
				slackUnit_[i] = std::max<Real>(slackUnit_[i], (plane(i, k) < 0 ? -plane(i, k) : plane(i, k)) * unit_[k]);
	coefficient_.resize(normal_.size());
	for (int i = 0; i < planes_; ++i)
		for (int k = 0; k < dimension_; ++k)
			coefficient_[std::size_t(i) * dimension_ + k] = double(plane(i, k) * unit_[k] / slackUnit_[i]);
}

Real IpoptProgram::moveToSolution()
{
	using std::sqrt;
	if (solution_.empty()) return -1; // Ipopt ended in an error
	Real step[3], sum = 0;
	for (int k = 0; k < dimension_; ++k) {
		step[k] = unit_[k] * solution_[k];
		point_[k] += step[k];
	}
	// computed from u, since σ is accurate to Ipopt's tolerance only
	for (int i = 0; i < planes_; ++i) {
		Real approach = 0;
		for (int k = 0; k < dimension_; ++k)
			approach += plane(i, k) * step[k];
		const Real relative = approach / slackUnit_[i];
		slack_[i] -= approach;
		sum += relative * relative;
	}
	return sqrt(sum);
}

bool IpoptProgram::get_nlp_info(Index& n, Index& m, Index& nonZerosJacobian, Index& nonZerosHessian, IndexStyleEnum& style)
{
	n                = dimension_ + planes_;
	m                = planes_;
	nonZerosJacobian = planes_ * (dimension_ + 1);
	nonZerosHessian  = planes_;
	style            = C_STYLE;
	return true;
}

bool IpoptProgram::get_bounds_info(Index n, Number* lower, Number* upper, Index m, Number* constraintLower, Number* constraintUpper)
{
	constexpr Number infinite = 1e20; // beyond Ipopt's nlp_upper_bound_inf
	for (Index j = 0; j < n; ++j) {
		lower[j] = j < dimension_ ? -infinite : 0;
		upper[j] = infinite;
	}
	for (Index i = 0; i < m; ++i)
		constraintLower[i] = constraintUpper[i] = double(slack_[i] / slackUnit_[i]);
	return true;
}

bool IpoptProgram::get_starting_point(Index n, bool, Number* z, bool, Number*, Number*, Index, bool, Number*)
{
	for (Index j = 0; j < n; ++j)
		z[j] = j < dimension_ ? 0 : 1;
	return true;
}

bool IpoptProgram::eval_f(Index n, const Number* z, bool, Number& value)
{
	value = 0;
	for (Index j = dimension_; j < n; ++j) {
		if (!(z[j] > 0)) return false;
		value -= std::log(z[j]);
	}
	return true;
}

bool IpoptProgram::eval_grad_f(Index n, const Number* z, bool, Number* gradient)
{
	for (Index j = 0; j < n; ++j)
		gradient[j] = j < dimension_ ? 0 : -1 / z[j];
	return true;
}

bool IpoptProgram::eval_g(Index, const Number* z, bool, Index m, Number* constraint)
{
	for (Index i = 0; i < m; ++i) {
		constraint[i] = z[dimension_ + i];
		for (int k = 0; k < dimension_; ++k)
			constraint[i] += coefficient_[std::size_t(i) * dimension_ + k] * z[k];
	}
	return true;
}

bool IpoptProgram::eval_jac_g(Index, const Number*, bool, Index m, Index, Index* rows, Index* columns, Number* values)
{
	Index next = 0;
	for (Index i = 0; i < m; ++i)
		for (int k = 0; k <= dimension_; ++k, ++next) {
			const bool sigma = k == dimension_;
			if (values) values[next] = sigma ? 1 : coefficient_[std::size_t(i) * dimension_ + k];
			else {
				rows[next]    = i;
				columns[next] = sigma ? dimension_ + i : k;
			}
		}
	return true;
}

bool IpoptProgram::eval_h(
        Index n, const Number* z, bool, Number factor, Index, const Number*, bool, Index, Index* rows, Index* columns, Number* values)
{
	// the constraints are linear: only the objective's own diagonal of the Lagrangian is left
	for (Index j = dimension_; j < n; ++j) {
		const Index i = j - dimension_;
		if (values) values[i] = factor / (z[j] * z[j]);
		else rows[i] = columns[i] = j;
	}
	return true;
}

void IpoptProgram::finalize_solution(SolverReturn, Index n, const Number* z, const Number*, const Number*, Index, const Number*,
        const Number*, Number, const IpoptData*, IpoptCalculatedQuantities*)
{
	solution_.assign(z, z + n);
}

} // namespace polytope
