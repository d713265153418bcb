// SPDX-License-Identifier: GPL-2.0-or-later
#include "shear/ShearLayers.hpp"

#include <cmath>

namespace polytope {

namespace {

	/// No farther from the centroid than the bed reaches.
	Vector3 within(const Vector3& place, const Real& reach)
	{
		using std::sqrt;
		const Real square = place.squaredNorm();
		return square > reach * reach ? Vector3(place * (reach / sqrt(square))) : place;
	}

} // namespace

void ShearLayers::setArea(Real present, const Change& change)
{
	const Real before = area(), more = present - before;
	if (more == 0) return;
	for (int k = 0; k < count_; ++k)
		layer_[k].place -= change.ofCentroid;
	// from the first moments of the area before and after
	const Vector3 place = change.reach > 0 ? within(change.ofCentroid * (before / more), change.reach) : Vector3(Vector3::Zero());
	if (more > 0) join(more, place);
	else leave(-more, place, change);
	Vector3 mean = Vector3::Zero();
	for (int k = 0; k < count_; ++k)
		mean += layer_[k].area * layer_[k].place;
	if (count_ > 0) mean /= area();
	for (int k = 0; k < count_; ++k)
		layer_[k].place -= mean;
}

void ShearLayers::join(Real more, const Vector3& place)
{
	if (!growing_ || count_ == 0) {
		if (count_ == tolerance::shearLayers) mergeLeastDifferent();
		layer_[count_++] = Layer();
	}
	Layer&     last = layer_[count_ - 1];
	const Real kept = last.area / (last.area + more);
	last.displacement *= kept;
	last.place = kept * last.place + (1 - kept) * place;
	last.area += more;
	growing_ = true;
}

/// Those that stay are strained as they were: the middle of what is left of a layer is elsewhere, and has another displacement where the bed is turned.
void ShearLayers::leave(Real less, Vector3 place, const Change& change)
{
	growing_ = false;
	while (less > 0 && count_ > 0) {
		const int  k    = leavingAt(place, change.reach);
		Layer&     one  = layer_[k];
		const Real left = one.area - less;
		if (left > 0) {
			const Vector3 way  = within(less / left * (one.place - place), change.reach);
			const Vector3 then = one.displacement + change.rotation.cross(way);
			if (left * then.squaredNorm() <= one.area * one.displacement.squaredNorm()) one.displacement = then;
			one.place += way;
			one.area = left;
			return;
		}
		const Real rest = less - one.area;
		if (rest > 0) place = within((less * place - one.area * one.place) / rest, change.reach);
		less = rest;
		remove(k);
	}
}

/// The layer that loses area there: the last of those that are about as near as the nearest.
int ShearLayers::leavingAt(const Vector3& place, Real reach) const
{
	using std::sqrt;
	Real nearest = -1;
	for (int k = 0; k < count_; ++k) {
		const Real far = sqrt((layer_[k].place - place).squaredNorm());
		if (nearest < 0 || far < nearest) nearest = far;
	}
	for (int k = count_ - 1; k > 0; --k)
		if (sqrt((layer_[k].place - place).squaredNorm()) <= nearest + Real(tolerance::sameRim) * reach) return k;
	return 0;
}

void ShearLayers::remove(int k)
{
	for (; k + 1 < count_; ++k)
		layer_[k] = layer_[k + 1];
	--count_;
}

void ShearLayers::limitSpread(Real second)
{
	using std::sqrt;
	const Real most = Real(tolerance::mostSpread) * second, present = spread();
	if (!(present > most)) return;
	const Real part = most > 0 ? Real(sqrt(most / present)) : Real(0);
	for (int k = 0; k < count_; ++k)
		layer_[k].place *= part;
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
	if (all > 0) {
		kept.displacement = (kept.area * kept.displacement + gone.area * gone.displacement) / all;
		kept.place        = (kept.area * kept.place + gone.area * gone.place) / all;
	}
	kept.area = all;
	remove(least + 1);
}

} // namespace polytope
