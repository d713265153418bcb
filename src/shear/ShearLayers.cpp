// SPDX-License-Identifier: GPL-2.0-or-later
#include "shear/ShearLayers.hpp"

namespace polytope {

void ShearLayers::setArea(Real present)
{
	Real change = present - area();
	if (change > 0) {
		if (!growing_ || count_ == 0) {
			if (count_ == tolerance::shearLayers) mergeLeastDifferent();
			layer_[count_++] = Layer();
		}
		Layer& last = layer_[count_ - 1];
		last.displacement *= last.area / (last.area + change);
		last.area += change;
		growing_ = true;
		return;
	}
	while (change < 0 && count_ > 0) {
		Layer& last = layer_[count_ - 1];
		growing_    = false;
		if (last.area + change > 0) {
			last.area += change;
			return;
		}
		change += last.area;
		--count_;
	}
}

/// Unites the two neighbouring layers whose union loses the least energy.
void ShearLayers::mergeLeastDifferent()
{
	int  least = 0;
	Real loss  = -1;
	for (int k = 0; k + 1 < count_; ++k) {
		const Layer &one = layer_[k], &other = layer_[k + 1];
		const Real   all  = one.area + other.area;
		const Real   lost = all > 0 ? one.area * other.area / all * (one.displacement - other.displacement).squaredNorm() : Real(0);
		if (loss < 0 || lost < loss) {
			loss  = lost;
			least = k;
		}
	}
	Layer&     kept = layer_[least];
	const auto gone = layer_[least + 1];
	const Real all  = kept.area + gone.area;
	if (all > 0) kept.displacement = (kept.area * kept.displacement + gone.area * gone.displacement) / all;
	kept.area = all;
	for (int k = least + 1; k + 1 < count_; ++k)
		layer_[k] = layer_[k + 1];
	--count_;
}

} // namespace polytope
