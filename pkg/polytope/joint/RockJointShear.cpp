// SPDX-License-Identifier: GPL-2.0-or-later
#include "joint/RockJointShear.hpp"

#include <src/numbers/PlaneAxes.hpp>
#include <src/shear/ShearReturn.hpp>

namespace yade {

using Shear = Law2_PolytopeGeom_RockJointPhys_MohrCoulomb::Shear;

Shear::Shear(const Pair& pair, const RockJointPhys& phys, const Vector3r& turnedForce)
        : pair_(pair), lastPoint_(phys.shearPoint), force_(turnedForce), lastForce_(turnedForce),
          twist_(phys.twistingMoment - phys.twistingViscous), lastTwist_(twist_), stiffness_(phys.ks),
          twistingStiffness_(phys.twistingStiffness), extentBefore_(phys.extentOfBed()), likelySlip_(phys.likelySlip)
{
	const StoredOutline& outline = pair.geom.outline;
	if (outline.count() >= 3) {
		const polytope::PlaneAxes axes(pair.geom.normal);
		axis_[0]  = axes.u;
		axis_[1]  = axes.v;
		moments_  = polytope::momentsOf(outline.corners(), outline.count());
		gyration_ = moments_.gyrationSquared();
		offset_   = inWorld(moments_.centroid);
	} else axis_[0] = axis_[1] = Vector3r::Zero();

	if (stiffness_ > 0 && extentBefore_ > 0) {
		perExtent_ = stiffness_ / extentBefore_;
		if (phys.shearLayers.get()) {
			layers_ = phys.shearLayers.get()->layers;
			layers_.turn([&](Vector3r& displacement) { turnWithContact(pair.geom, displacement); });
		}
		// the force is the master: a script may have set it
		const Vector3r mean = -force_ / stiffness_;
		if (!(math::abs(layers_.area() - extentBefore_) <= Real(polytope::tolerance::sameArea) * extentBefore_))
			layers_ = polytope::ShearLayers(extentBefore_, mean);
		else layers_.move(mean - layers_.sum() / layers_.area());
	}
	if (const Real own = ownTwistingStiffness(); own > 0) rotation_ = (twistOfLayers() - twist_) / own;
	if (pair.scene->trackEnergy) before_ = energy();
}

void Shear::adapt(const RockJointPhys& phys)
{
	const Real before = stiffness_, own = ownTwistingStiffness();
	const Real extent = phys.extentOfBed();
	if (perExtent_ > 0) setExtent(phys, extent);
	else if (phys.ks < before) force_ *= phys.ks / before;
	if (perExtent_ == 0 && extent > 0) { // its first step
		perExtent_ = phys.ks / extent;
		layers_    = polytope::ShearLayers(extent, phys.ks > 0 ? Vector3r(-force_ / phys.ks) : Vector3r(Vector3r::Zero()));
	}
	stiffness_         = phys.ks;
	twistingStiffness_ = phys.ks * gyration_;
	if (perExtent_ > 0) layers_.limitSpread(twistingStiffness_ / perExtent_);
	const Real present = ownTwistingStiffness();
	rotation_ *= present > 0 ? math::min(Real(1), Real(own / present)) : Real(0);
	twist_ = twistOfLayers() - present * rotation_;
}

/// Does what adapt() does, where the bed's extent is known.
void Shear::setExtent(const RockJointPhys& phys, Real extent)
{
	const Real present = phys.ks / extent;
	if (extent > 0 && present != perExtent_) { // set by a script: as if springs joined or left everywhere
		if (math::abs(present - perExtent_) > Real(polytope::tolerance::sameArea) * perExtent_) {
			const Real ratio = present < perExtent_ ? Real(1) : perExtent_ / present;
			layers_.mapDisplacements([&](Vector3r& displacement) { displacement *= ratio; });
		}
		perExtent_ = present;
	}
	if (extent != extentBefore_) layers_.setArea(extent, changeOfArea(phys, extentBefore_, extent));
	if (pair_.geom.atOnePoint && layers_.count() > 1) layers_ = polytope::ShearLayers(layers_.area(), layers_.sum() / layers_.area());
	force_ = -perExtent_ * layers_.sum();
}

/// With springs that join or leave on one side the area's centroid moves through the bodies. What has joined carries nothing: the force stays in its line.
/// What has left takes its part along.
polytope::ShearLayers::Change Shear::changeOfArea(const RockJointPhys& phys, Real areaBefore, Real areaNow) const
{
	polytope::ShearLayers::Change change;
	if (!(gyration_ > 0 && phys.shearStiffness > 0)) return change;
	const State &  state1 = pair_.state1, &state2 = pair_.state2;
	const Vector3r way = (state1.vel + state1.angVel.cross(lastPoint_ - state1.pos) + pair_.centreVelocity() + state1.vel
	                             + state2.angVel.cross(lastPoint_ - pair_.centre2))
	        * pair_.scene->dt / 2;
	change.ofCentroid = pair_.geom.contactPoint + offset_ - lastPoint_ - way;
	change.ofCentroid -= pair_.geom.normal.dot(change.ofCentroid) * pair_.geom.normal;
	change.reach    = 2 * math::sqrt(gyration_);
	change.rotation = rotation_ * pair_.geom.normal;
	// a body that slides takes its area along: which of both does is not known. Nor is it farther than so much of the area can move it
	const Real far = change.ofCentroid.norm(), slid = velocity().norm() * pair_.scene->dt / 2,
	           most = math::abs(areaNow - areaBefore) / math::max(areaNow, areaBefore) * change.reach;
	if (far > 0) change.ofCentroid *= math::max(Real(0), math::min(most, Real(far - slid))) / far;
	return change;
}

void Shear::move(const Vector3r& increment)
{
	turn_   = hasOutline() ? pair_.geom.normal.dot(pair_.spin()) * pair_.scene->dt : Real(0);
	motion_ = increment + turn_ * acrossNormal(offset_);
	layers_.move(motion_);
	layers_.strain(turn_ * pair_.geom.normal);
	rotation_ += turn_;
	force_ -= stiffness_ * motion_;
	twist_ -= twistingStiffness_ * turn_;
	trialForce_ = force_;
}

polytope::Vector3 Shear::loadAbout(const polytope::Vector2& centre, const Vector3r& force, Real twist) const
{
	const Real              f0 = force.dot(axis_[0]), f1 = force.dot(axis_[1]);
	const polytope::Vector2 arm = moments_.centroid - centre;
	return polytope::Vector3(f0, f1, twist + arm[0] * f1 - arm[1] * f0);
}

Real Shear::twistOf(const polytope::Vector3& load, const polytope::Vector2& centre) const
{
	const polytope::Vector2 arm = moments_.centroid - centre;
	return load[2] - arm[0] * load[1] + arm[1] * load[0];
}

/// Friction acts where the pressure does, at the contact point, cohesion at the area's centroid.
polytope::Vector2 Shear::centreOfStrength(const RockJointPhys& phys, Real strength) const
{
	return phys.presentCohesion() * phys.contactArea / strength * moments_.centroid;
}

/// The damper asks for what the limit has asked for, if the joint did not fail there.
const polytope::ShearStrength& Shear::spreadStrength(Real strength, const polytope::Vector2& centre)
{
	if (!spread_ || spread_->total() != strength || spread_->centre() != centre)
		spread_.emplace(pair_.geom.outline.corners(), pair_.geom.outline.count(), moments_, strength, centre);
	return *spread_;
}

bool Shear::limit(const RockJointPhys& phys, Real normal)
{
	const Vector3r before   = force_;
	const Real     strength = phys.shearStrength(normal), square = force_.squaredNorm();
	if (!(strength > 0)) {
		const bool slips = square > 0 || twist_ != 0;
		if (slips) vanish();
		return slips;
	}
	if (!hasOutline()) {
		if (!(square > strength * strength)) return false;
		force_ *= strength / math::sqrt(square);
		layers_.move((before - force_) / stiffness_);
		return true;
	}
	const polytope::Vector2 centre = centreOfStrength(phys, strength);
	polytope::Vector3       load   = loadAbout(centre, force_, twist_);
	if (polytope::surelyHolds(load, strength, polytope::leastRadiusOnArea(moments_.area))) return false;
	const polytope::ShearStrength& spread = spreadStrength(strength, centre);
	if (spread.surelyHolds(load)) return false;
	const auto              bed  = polytope::bedStiffness(stiffness_, gyration_, moments_.centroid - centre);
	const polytope::Vector3 slip = polytope::returnToStrength(spread, bed, load, likelySlip_);
	if (slip == polytope::Vector3::Zero()) return false;
	const Real twistBefore = twist_;
	force_                 = inWorld(polytope::Vector2(load[0], load[1]));
	twist_                 = twistOf(load, centre);
	layers_.move((before - force_) / stiffness_);
	if (twistingStiffness_ > 0) {
		const Real turned = (twistBefore - twist_) / twistingStiffness_;
		layers_.strain(turned * pair_.geom.normal);
		rotation_ += turned;
	}
	return true;
}

void Shear::yield(const Vector3r& slip)
{
	force_ += stiffness_ * slip;
	layers_.move(-slip);
}

Vector3r Shear::velocity() const
{
	const Vector3r velocity = pair_.velocity() + pair_.spin().cross(offset_);
	return velocity - pair_.geom.normal.dot(velocity) * pair_.geom.normal;
}

void Shear::damp(const RockJointPhys& phys, Real normal, Real damper, Real twistingDamper)
{
	viscous_      = -damper * velocity();
	viscousTwist_ = -twistingDamper * pair_.geom.normal.dot(pair_.spin());
	Real strength = phys.shearStrength(normal);
	if (hasOutline() && strength > 0 && (twist_ != 0 || viscousTwist_ != 0)) {
		// within the part of the limit surface that ShearStrength::surelyHolds() knows
		const polytope::Vector2 centre = centreOfStrength(phys, strength);
		const Real              before = math::abs(loadAbout(centre, force_, twist_)[2]),
		           after               = math::abs(loadAbout(centre, force_ + viscous_, twist_ + viscousTwist_)[2]),
		           turning = math::max(before, after), sliding = strength - turning / polytope::leastRadiusOnArea(moments_.area);
		// what is within the bound that the area alone gives needs no other
		strength = fractionWithin(sliding, force_, viscous_) == 1
		        ? sliding
		        : strength - turning / spreadStrength(strength, centre).leastRadius();
	}
	const Real part = fractionWithin(strength, force_, viscous_);
	viscous_ *= part;
	viscousTwist_ *= part;
}

void Shear::vanish()
{
	force_ = Vector3r::Zero();
	twist_ = rotation_ = 0;
	layers_.mapDisplacements([](Vector3r& displacement) { displacement = Vector3r::Zero(); });
}

Real Shear::energy() const
{
	const Real along = perExtent_ > 0 ? Real(perExtent_ * layers_.energy()) : energyOfSpring(force_.squaredNorm(), stiffness_);
	return along + ownTwistingStiffness() * rotation_ * rotation_ / 2;
}

void Shear::keep(RockJointPhys& phys) const
{
	phys.shearViscous      = viscous_;
	phys.shearForce        = force_ + viscous_;
	phys.twistingViscous   = viscousTwist_;
	phys.twistingMoment    = twist_ + viscousTwist_;
	phys.twistingStiffness = twistingStiffness_;
	phys.likelySlip        = likelySlip_;
	phys.shearPoint        = pair_.geom.contactPoint + offset_;
	if (layers_.count() > 1) {
		LayersOfJoint& several = phys.shearLayers.make();
		several.layers         = layers_;
		several.rotation       = rotation_;
	} else phys.shearLayers.clear();
}

} // namespace yade
