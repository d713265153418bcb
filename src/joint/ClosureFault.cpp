// SPDX-License-Identifier: GPL-2.0-or-later
//
// Whether pressure, tangent and energy of a law belong together. A law that somebody wrote down wrong would give forces whose energy is not
// accounted for, or time steps that are too large, and nothing would say so.
#include "joint/ClosureLaw.hpp"

#include "joint/JointTolerances.hpp"

#include <boost/math/quadrature/gauss_kronrod.hpp>

#include <algorithm>
#include <sstream>

namespace polytope {
namespace {

	/// The law's values at one closure; in double, since more digits say no more here.
	struct Values {
		double closure, pressure, tangent, energy;

		bool areFinite() const { return std::isfinite(pressure) && std::isfinite(tangent) && std::isfinite(energy); }
	};

	Values valuesAt(const ClosureLaw& law, double closure)
	{
		return { closure, double(law.pressure(closure)), double(law.tangent(closure)), double(law.energy(closure)) };
	}

	/// Integral of a function; the interval is halved where the function has a bend.
	template <class Function> double integral(const Function& function, double from, double to)
	{
		return boost::math::quadrature::gauss_kronrod<double, 15>::integrate(
		        function, from, to, tolerance::mostClosureHalvings, tolerance::closureAgreement / 100);
	}

	/// What does not belong together from one closure to the next.
	std::string faultBetween(const ClosureLaw& law, const Values& low, const Values& high)
	{
		std::ostringstream text;
		const auto from = [&]() -> std::ostream& { return text << "from " << low.closure << " to " << high.closure << " m"; };
		if (!high.areFinite()) {
			text << "pressure, tangent and energy must be finite for every closure: at " << high.closure << " m they are "
			     << high.pressure << ", " << high.tangent << " and " << high.energy << "; end the law on a straight line";
			return text.str();
		}
		if (!(high.pressure > low.pressure && high.tangent >= 0)) {
			text << "the pressure must rise: ";
			from() << " it goes from " << low.pressure << " to " << high.pressure << ", and the tangent there is "
			       << high.tangent << "; end the law on a straight line";
			return text.str();
		}
		const auto disagree = [&](const char* sum, const char* part, double grown, double integrated) {
			if (std::abs(grown - integrated) <= tolerance::closureAgreement * std::abs(integrated)) return false;
			text << "its " << sum << " is not the integral of its " << part << ": ";
			from() << " it grows by " << grown << ", and the integral is " << integrated;
			return true;
		};
		const double slope = integral([&](double closure) { return double(law.tangent(closure)); }, low.closure, high.closure);
		if (disagree("pressure", "tangent", high.pressure - low.pressure, slope)) return text.str();
		const double work = integral([&](double closure) { return double(law.pressure(closure)); }, low.closure, high.closure);
		disagree("energy", "pressure", high.energy - low.energy, work);
		return text.str();
	}

	/// Pressure and energy are 0 at closure 0: far below the least closure they are less than there.
	std::string faultAtZero(const ClosureLaw& law, const Values& least)
	{
		const Values zero = valuesAt(law, least.closure * tolerance::noClosure);
		if (std::abs(zero.pressure) <= tolerance::closureAgreement * least.pressure
		        && std::abs(zero.energy) <= tolerance::closureAgreement * least.energy)
			return "";
		std::ostringstream text;
		text << "pressure and energy must be 0 at closure 0: at " << zero.closure << " m they are " << zero.pressure << " and "
		     << zero.energy << ", at " << least.closure << " m " << least.pressure << " and " << least.energy;
		return text.str();
	}

} // namespace

std::string ClosureLaw::fault() const
{
	Values      low   = valuesAt(*this, tolerance::leastClosure);
	std::string found = low.areFinite() ? faultAtZero(*this, low) : faultBetween(*this, valuesAt(*this, 0), low);
	for (int octave = 0; found.empty() && octave < tolerance::closureOctaves; ++octave) {
		const Values high = valuesAt(*this, 2 * low.closure);
		found             = faultBetween(*this, low, high);
		low               = high;
	}
	if (found.empty()) return "";
	std::ostringstream text;
	text << "the normal law ";
	if (own_) text << own_->name << " (p = " << double(p_) << ", q = " << double(q_) << ")";
	return text.str() + ": " + found;
}

} // namespace polytope
