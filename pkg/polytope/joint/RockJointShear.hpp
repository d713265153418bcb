// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <src/shear/ShearLayers.hpp>
#include <src/shear/ShearStrength.hpp>

#include <optional>

#include "joint/RockJointStep.hpp"

/// Shear of a rock joint in one step: a bed of springs over the contact's outline, with the strength of each place (src/shear).
///
/// Faces are rigid, so the bed's state is a force and a moment about the normal. While nothing slips the force acts at the area's centroid
/// and the faces' turning about the normal meets k_s ρ², ρ the outline's radius of gyration. Slip takes what friction and cohesion at each
/// place allow. A contact without an outline (polygons, spheres, a failed query) is a point: it has no moment.
namespace yade {

class Law2_PolytopeGeom_RockJointPhys_MohrCoulomb::Shear {
public:
	/// Begins with the bed as it was at the end of the last step; `turnedForce`: its elastic shear force, turned to this step's normal.
	Shear(const Pair& pair, const RockJointPhys& phys, const Vector3r& turnedForce);

	/// Springs join and leave with the area, and stiffnesses become the present ones, after phys.setStiffnesses().
	void adapt(const RockJointPhys& phys);
	/// The motion of this step strains all springs: `increment`, of body 2 along the joint at the contact point.
	void move(const Vector3r& increment);
	/// Slips by this, without turning, whatever the strength: for a joint that yields before its strength is reached.
	void yield(const Vector3r& slip);
	/// Motion of body 2 along the joint at the area's centroid, in this step.
	const Vector3r& motion() const { return motion_; }
	/// The force before the motion of this step.
	Vector3r forceBefore() const { return trialForce_ + stiffness_ * motion_; }
	/// Slip, where force and moment are beyond the strength of the joint as it is. Returns whether there is any.
	bool limit(const RockJointPhys& phys, Real normal);
	/// Viscous force and moment of these dampers [N s/m], [N m s/rad], as far as the strength goes.
	void damp(const RockJointPhys& phys, Real normal, Real damper, Real twistingDamper);
	/// Velocity along the joint, at the area's centroid [m/s].
	Vector3r velocity() const;
	Real     gyrationSquared() const { return gyration_; }
	/// No force and no moment.
	void vanish();
	/// Leaves forces and memory for the next step.
	void keep(RockJointPhys& phys) const;

	const Vector3r& force() const { return force_; } ///< elastic, on body 2
	Vector3r        excess() const { return trialForce_ - force_; }
	const Vector3r& trialForce() const { return trialForce_; }
	/// Energy of the springs now [J].
	Real energy() const;
	/// What the springs lost in this step by slip, and with springs that left or joined [J].
	Real loss() const { return before_ - energy() - ((lastForce_ + force_).dot(motion_) + (lastTwist_ + twist_) * turn_) / 2; }

private:
	bool     hasOutline() const { return moments_.area > 0 && gyration_ > 0; }
	Vector3r inWorld(const polytope::Vector2& x) const { return x[0] * axis_[0] + x[1] * axis_[1]; }
	Vector3r acrossNormal(const Vector3r& x) const { return pair_.geom.normal.cross(x); }
	/// Force along the axes, and moment about a point of the outline.
	polytope::Vector3              loadAbout(const polytope::Vector2& centre, const Vector3r& force, Real twist) const;
	Real                           twistOf(const polytope::Vector3& load, const polytope::Vector2& centre) const;
	const polytope::ShearStrength& spreadStrength(Real strength, const polytope::Vector2& centre);
	polytope::Vector2              centreOfStrength(const RockJointPhys& phys, Real strength) const;
	void                           setExtent(const RockJointPhys& phys, Real extent);
	polytope::ShearLayers::Change  changeOfArea(const RockJointPhys& phys, Real areaBefore, Real areaNow) const;
	/// Stiffness against turning about the normal of the layers, each about its middle [N m/rad].
	Real ownTwistingStiffness() const { return twistingStiffness_ - perExtent_ * layers_.spread(); }
	Real twistOfLayers() const { return -perExtent_ * pair_.geom.normal.dot(layers_.moment()); }

	const Pair&                            pair_;
	Vector3r                               axis_[2];
	polytope::OutlineMoments               moments_;
	Vector3r                               offset_ = Vector3r::Zero(); ///< from the contact point to the area's centroid
	Vector3r                               lastPoint_;
	Real                                   gyration_ = 0; ///< ρ² [m²]
	Vector3r                               force_, lastForce_, trialForce_ = Vector3r::Zero();
	Real                                   twist_, lastTwist_;
	Real                                   stiffness_, twistingStiffness_; ///< k_s [N/m], k_s ρ² [N m/rad]
	Real                                   extentBefore_, perExtent_ = 0;  ///< of the bed (RockJointPhys::extentOfBed), and k_s over it
	Vector3r                               likelySlip_;                    ///< where the search for slip has ended
	std::optional<polytope::ShearStrength> spread_;                        ///< the last one that was asked for
	polytope::ShearLayers                  layers_;                        ///< their area: the bed's extent
	Real                                   rotation_     = 0;              ///< of the springs about their layers' middles
	Real                                   before_       = 0;
	Vector3r                               motion_       = Vector3r::Zero(); ///< at the area's centroid
	Real                                   turn_         = 0;                ///< about the normal
	Vector3r                               viscous_      = Vector3r::Zero();
	Real                                   viscousTwist_ = 0;
};

} // namespace yade
