// SPDX-License-Identifier: GPL-2.0-or-later
#include "joint/ClosureLaw.hpp"

#include "joint/JointTolerances.hpp"

#include <cmath>

namespace polytope {
namespace {

	/// 1/(1 − δ/δₘ) where the hyperbola ends.
	const Real endRatio = 1 / (1 - Real(tolerance::closureEnd));

	/// −x − ln(1 − x), by its series where that keeps more digits.
	Real hyperbolaEnergy(Real x)
	{
		using std::log;
		if (!(x < Real(tolerance::smallClosure))) return -x - log(1 - x);
		Real sum = 0, power = x * x;
		for (int k = 2; sum + power / k != sum; ++k, power *= x)
			sum += power / k;
		return sum;
	}

} // namespace

ClosureLaw ClosureLaw::hyperbola(Real most)
{
	ClosureLaw law;
	law.most_ = most;
	return law;
}

ClosureLaw ClosureLaw::power(Real exponent, Real length)
{
	ClosureLaw law;
	law.exponent_ = exponent;
	law.length_   = length;
	return law;
}

ClosureLaw ClosureLaw::between(const ClosureLaw& one, const ClosureLaw& other)
{
	ClosureLaw joint;
	joint.most_     = (one.most_ + other.most_) / 2;
	joint.exponent_ = (one.exponent_ + other.exponent_) / 2;
	joint.length_   = (one.length_ + other.length_) / 2;
	return joint;
}

Real ClosureLaw::end() const { return Real(tolerance::closureEnd) * most_; }

Real ClosureLaw::pressure(Real closure) const
{
	using std::pow;
	if (closure <= 0 || isLinear()) return closure;
	if (length_ > 0) return length_ * pow((1 - exponent_) * closure / length_, 1 / (1 - exponent_));
	return closure <= end() ? closure / (1 - closure / most_) : endRatio * (end() + endRatio * (closure - end()));
}

Real ClosureLaw::tangent(Real closure) const
{
	using std::pow;
	if (closure <= 0 || isLinear()) return 1;
	if (length_ > 0) return pow((1 - exponent_) * closure / length_, exponent_ / (1 - exponent_));
	const Real ratio = closure < end() ? 1 / (1 - closure / most_) : endRatio;
	return ratio * ratio;
}

Real ClosureLaw::energy(Real closure) const
{
	if (closure <= 0 || isLinear()) return closure * closure / 2;
	if (length_ > 0) return pressure(closure) * closure * (1 - exponent_) / (2 - exponent_);
	const Real within = closure < end() ? closure : end(), beyond = closure - within;
	return most_ * most_ * hyperbolaEnergy(within / most_) + beyond * endRatio * (end() + endRatio * beyond / 2);
}

Real ClosureLaw::closure(Real pressure) const
{
	using std::pow;
	if (pressure <= 0 || isLinear()) return pressure;
	if (length_ > 0) return length_ / (1 - exponent_) * pow(pressure / length_, 1 - exponent_);
	const Real most = end() * endRatio;
	return pressure <= most ? pressure / (1 + pressure / most_) : end() + (pressure - most) / (endRatio * endRatio);
}

} // namespace polytope
