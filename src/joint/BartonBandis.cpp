// SPDX-License-Identifier: GPL-2.0-or-later
#include "joint/BartonBandis.hpp"

#include <limits>

namespace polytope {
namespace {

	Real degrees(Real angle)
	{
		using std::acos;
		return angle * acos(Real(-1)) / 180;
	}

} // namespace

Real mobilisedRoughness(Real displacement)
{
	static const double at[] = { 0.3, 0.6, 1, 2, 4, 10, 25, 100 }, part[] = { 0, 0.75, 1, 0.85, 0.70, 0.50, 0.40, 0 };
	if (!(displacement > Real(at[0]))) return 0;
	for (int k = 1; k < 8; ++k)
		if (displacement < Real(at[k]))
			return part[k - 1] + (displacement - at[k - 1]) / (at[k] - at[k - 1]) * (Real(part[k]) - part[k - 1]);
	return 0;
}

BartonBandis::BartonBandis(const Values& values) : friction_(values.residualFriction)
{
	using std::pow;
	const Real scale = values.jointLength / values.sampleLength;
	roughness_       = values.roughness * pow(scale, Real(-0.02) * values.roughness);
	wallStrength_    = values.wallStrength * pow(scale, Real(-0.03) * values.roughness);
	peak_            = values.jointLength / 500 * pow(roughness_ / values.jointLength, Real(0.33));
}

BartonBandis BartonBandis::between(const BartonBandis& one, const BartonBandis& other)
{
	BartonBandis joint  = one;
	joint.roughness_    = other.roughness_ < one.roughness_ ? other.roughness_ : one.roughness_;
	joint.wallStrength_ = other.wallStrength_ < one.wallStrength_ ? other.wallStrength_ : one.wallStrength_;
	joint.friction_     = other.friction_ < one.friction_ ? other.friction_ : one.friction_;
	joint.peak_         = other.peak_ > one.peak_ ? other.peak_ : one.peak_;
	return joint;
}

Real BartonBandis::logarithm(Real stress) const
{
	using std::log10;
	if (!(stress > 0)) return std::numeric_limits<Real>::infinity();
	return stress < wallStrength_ ? Real(log10(wallStrength_ / stress)) : Real(0);
}

Real BartonBandis::roughnessAngle(Real stress, Real displacement) const
{
	// a smooth joint has no peak
	const Real mobilised = peak_ > 0 ? roughness_ * mobilisedRoughness(displacement / peak_) : Real(0);
	if (!(mobilised > 0)) return 0;
	const Real angle = degrees(mobilised * logarithm(stress)), most = degrees(tolerance::steepestBarton) - friction_;
	return angle < most ? angle : most > 0 ? most : Real(0);
}

Real BartonBandis::frictionAngle(Real stress, Real displacement) const { return friction_ + roughnessAngle(stress, displacement); }

Real BartonBandis::dilationAngle(Real stress, Real displacement) const
{
	const Real angle = roughnessAngle(stress, displacement);
	if (!(angle > 0)) return 0;
	const Real damage = roughness_ / (12 * logarithm(stress)) + Real(0.7);
	return angle / (damage < 1 ? Real(1) : damage > 2 ? Real(2) : damage);
}

} // namespace polytope
