// SPDX-License-Identifier: GPL-2.0-or-later
#include "loads/VelocityHistory.hpp"

#include <algorithm>

namespace yade {

POLYTOPE_CLASSES((VelocityHistory));

void VelocityHistory::postLoad(VelocityHistory&)
{
	if (times.empty() && velocities.empty()) return; // YADE makes an empty one before it fills it
	const auto refuse = [](const std::string& what) { throw std::invalid_argument(what); };
	if (times.size() != velocities.size() || times.size() < 2)
		refuse("velocities: there must be one for each of times, two at least; got " + std::to_string(velocities.size()) + " for "
		        + std::to_string(times.size()));
	for (std::size_t k = 0; k < times.size(); ++k) {
		const std::string at = "[" + std::to_string(k) + "]";
		if (!math::isfinite(times[k])) refuse("times" + at + ": is not finite");
		if (!math::isfinite(velocities[k].squaredNorm())) refuse("velocities" + at + ": is not finite");
		if (k > 0 && !(times[k] > times[k - 1])) refuse("times" + at + ": is not above the one before; times must increase");
	}
}

Vector3r VelocityHistory::at(const Real& time) const
{
	if (times.empty() || time < times.front()) return Vector3r::Zero();
	const auto after = std::upper_bound(times.begin(), times.end(), time);
	if (after == times.end()) return velocities.back();
	const auto k    = std::size_t(after - times.begin());
	const Real part = (time - times[k - 1]) / (times[k] - times[k - 1]);
	return velocities[k - 1] + part * (velocities[k] - velocities[k - 1]);
}

} // namespace yade
