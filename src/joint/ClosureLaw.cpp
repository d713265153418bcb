// SPDX-License-Identifier: GPL-2.0-or-later
#include "joint/ClosureLaw.hpp"

#include "joint/JointTolerances.hpp"

#include <cmath>
#include <stdexcept>

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

NormalLaw::NormalLaw(const char* name_, Function pressure_, Function tangent_, Function energy_)
        : name(name_), pressure(pressure_), tangent(tangent_), energy(energy_)
{
	all().push_back(this);
}

std::vector<const NormalLaw*>& NormalLaw::all()
{
	static std::vector<const NormalLaw*> made;
	return made;
}

const NormalLaw& NormalLaw::named(const std::string& name)
{
	for (const NormalLaw* law : all())
		if (law->name && law->name == name) return *law;
	throw std::runtime_error("the normal law " + name + " is not known: load the library that has it first");
}

std::string NormalLaw::fault() const
{
	if (!name || !*name) return "a normal law must have a name";
	if (!pressure || !tangent || !energy) return "the normal law " + std::string(name) + " must have all three functions";
	if (&named(name) == this) return "";
	return "there is a normal law " + std::string(name) + " already: give this one another name";
}

ClosureLaw ClosureLaw::own(const NormalLaw& law, Real p, Real q)
{
	if (const std::string fault = law.fault(); !fault.empty()) throw std::invalid_argument("law: " + fault);
	ClosureLaw made;
	made.own_ = &law;
	made.p_   = p;
	made.q_   = q;
	return made;
}

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
	joint.own_      = one.own_;
	joint.p_        = (one.p_ + other.p_) / 2;
	joint.q_        = (one.q_ + other.q_) / 2;
	return joint;
}

Real ClosureLaw::end() const { return Real(tolerance::closureEnd) * most_; }

Real ClosureLaw::pressure(Real closure) const
{
	using std::pow;
	if (closure <= 0 || isLinear()) return closure;
	if (own_) return own_->pressure(closure, p_, q_);
	if (length_ > 0) return length_ * pow((1 - exponent_) * closure / length_, 1 / (1 - exponent_));
	return closure <= end() ? closure / (1 - closure / most_) : endRatio * (end() + endRatio * (closure - end()));
}

Real ClosureLaw::tangent(Real closure) const
{
	using std::pow;
	if (closure <= 0 || isLinear()) return 1;
	if (own_) return own_->tangent(closure, p_, q_);
	if (length_ > 0) return pow((1 - exponent_) * closure / length_, exponent_ / (1 - exponent_));
	const Real ratio = closure < end() ? 1 / (1 - closure / most_) : endRatio;
	return ratio * ratio;
}

Real ClosureLaw::energy(Real closure) const
{
	if (closure <= 0 || isLinear()) return closure * closure / 2;
	if (own_) return own_->energy(closure, p_, q_);
	if (length_ > 0) return pressure(closure) * closure * (1 - exponent_) / (2 - exponent_);
	const Real within = closure < end() ? closure : end(), beyond = closure - within;
	return most_ * most_ * hyperbolaEnergy(within / most_) + beyond * endRatio * (end() + endRatio * beyond / 2);
}

Real ClosureLaw::closure(Real pressure) const
{
	using std::pow;
	if (pressure <= 0 || isLinear()) return pressure;
	if (own_) return ownClosure(pressure);
	if (length_ > 0) return length_ / (1 - exponent_) * pow(pressure / length_, 1 - exponent_);
	const Real most = end() * endRatio;
	return pressure <= most ? pressure / (1 + pressure / most_) : end() + (pressure - most) / (endRatio * endRatio);
}

/// Newton's method between bounds, which halves them where it would leave them.
Real ClosureLaw::ownClosure(Real pressure) const
{
	Real low = 0, high = pressure;
	for (int k = 0; k < tolerance::mostClosureSteps && !(own_->pressure(high, p_, q_) >= pressure); ++k) {
		low = high;
		high *= 2;
	}
	Real closure = (low + high) / 2;
	for (int k = 0; k < tolerance::mostClosureSteps; ++k) {
		const Real rest         = own_->pressure(closure, p_, q_) - pressure;
		(rest > 0 ? high : low) = closure;
		const Real newton       = closure - rest / own_->tangent(closure, p_, q_);
		const Real next         = newton > low && newton < high ? newton : Real((low + high) / 2);
		if (next == closure || !(rest < 0 || rest > 0)) break;
		closure = next;
	}
	return closure;
}

Real ClosureLaw::initialTangent() const { return tangent(Real(tolerance::leastClosure * tolerance::noClosure)); }

} // namespace polytope
