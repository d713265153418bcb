// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/Dispatching.hpp>
#include <pkg/dem/FrictPhys.hpp>

#include "bond/PolytopeBond.hpp"
#include "contact/PolytopeGeom.hpp"
#include "host/FlatArchive.hpp"
#include "host/Seldom.hpp"
#include "joint/LawsOfJoint.hpp"

#include <src/shear/ShearLayers.hpp>

/// Physics of rock joints between Polytopes.
///
/// Signs: forces are those on body 2 from body 1 (as everywhere in YADE), the normal points from body 1 to body 2, so a
/// compressed contact has normalForce·normal > 0. Slip is body 2's relative to body 1.
namespace yade {

/// Elastic energy of a linear spring [J] that has this square of a force (of a moment); 0 without a stiffness.
inline Real energyOfSpring(const Real& square, const Real& stiffness) { return stiffness > 0 ? Real(square / (2 * stiffness)) : Real(0); }

/// What the law remembers of a joint's last step where energies are tracked.
struct LastStepOfJoint {
	Vector3r arm1 = Vector3r::Zero(), arm2 = Vector3r::Zero(); ///< from the bodies' centres to the contact point
	Vector3r moment        = Vector3r::Zero();                 ///< on body 2 about the contact point, without the rocking damper's
	Vector3r viscousMoment = Vector3r::Zero();                 ///< of that the part of the shear dampers
	Real     stored        = -1;                               ///< energy; negative: was not tracked

	template <class Archive> void serialize(Archive& archive, unsigned int)
	{
		archive& BOOST_SERIALIZATION_NVP(arm1);
		archive& BOOST_SERIALIZATION_NVP(arm2);
		archive& BOOST_SERIALIZATION_NVP(moment);
		archive& BOOST_SERIALIZATION_NVP(viscousMoment);
		archive& BOOST_SERIALIZATION_NVP(stored);
	}
};

/// When the springs of a joint's bed came under load (src/shear/ShearLayers.hpp), where not all at once.
struct LayersOfJoint {
	polytope::ShearLayers layers;
	Real                  rotation = 0; ///< of the springs about the normal, about their layers' middles

	template <class Archive> void serialize(Archive& archive, unsigned int)
	{
		visitParts(layers, [&](const char* name, auto& value) { archive& boost::serialization::make_nvp(name, value); });
		archive& boost::serialization::make_nvp("rotation", rotation);
	}
};

class RockJointPhys : public FrictPhys {
public:
	virtual ~RockJointPhys() = default;

	using LastStep = Seldom<LastStepOfJoint>;
	using Layers   = Seldom<LayersOfJoint>;
	using Laws     = Seldom<LawsOfJoint>;

	/// Sets the present kn and ks [N/m] from the joint's own stiffnesses: per area times the contact's area, per contact times the share that
	/// the contact has of it (PolytopeGeom::share).
	void setStiffnesses(Real share);
	/// Whether the joint has a peak strength above the residual one.
	bool hasPeak() const { return cohesion > residualCohesion || tensileStrength > 0 || tangensOfResidualFrictionAngle >= 0; }
	/// Cohesion of the joint as it is now [Pa].
	Real presentCohesion() const { return intact ? cohesion : residualCohesion; }
	/// Whether an open joint differs from one that is made anew when it closes.
	bool hasHistory() const { return hasPeak() || (tangensOfDilationAngle > 0 && slip != Vector3r::Zero()) || ownHistory(); }
	/// Tensile strength of the joint as it is now [Pa].
	Real presentTensileStrength() const { return intact ? tensileStrength : residualTensileStrength; }
	/// Force of the normal spring at this overlap [N], negative in tension.
	Real normalSpring(Real overlap) const
	{
		if (laws.get()) return ownSpring(overlap);
		const Real force = kn * (overlap + dilation - restOverlap);
		return force < 0 ? math::min(Real(0), Real(force + kn * lastingOpening)) : force;
	}
	/// Force of the normal spring of a joint with laws of its own (RockJointOwnLaws.cpp), while kn is that of its linear spring.
	Real ownSpring(Real overlap) const;
	/// Dilation of all slip up to now [m].
	Real dilationOfSlip() const
	{
		if (laws.get() && hasOwnStrength()) return ownDilation();
		return tangensOfDilationAngle > 0 ? math::min(Real(tangensOfDilationAngle * slip.norm()), dilationLimit) : dilation;
	}
	Real ownDilation() const;
	/// How fast dilation grows where the joint slides with this velocity of body 2 along it [m/s].
	Real rising(const Vector3r& velocity) const;
	/// Whether such a joint has slipped, or is worn.
	bool ownHistory() const;
	/// Energy over kn of a spring closed that far [m²].
	Real energyPerStiffness(Real overlap) const;
	/// Energy of the normal spring with this force [J]; a contact surface has the energy whose gradient its force is.
	Real normalEnergy(const PolytopeGeom& geom, Real force) const;
	/// Energy of the normal spring with its present force [J]; of a joint that acts as a bond, the energy of the bond without that of shear.
	Real presentNormalEnergy(const PolytopeGeom& geom) const;
	/// Gives kn, while it is that of the linear spring, the slope of the joint's own closure law at this overlap; returns that slope over the
	/// initial stiffness.
	Real stiffen(Real overlap);
	bool hasOwnStrength() const;
	/// All slip of a joint with a shear law of its own; the length of the slip of others [m].
	Real slipLength() const;
	/// What tan φ of a shear law of its own is divided by; 1 for other joints.
	Real getReduction() const;
	void setReduction(Real value);
	/// A force of the normal spring beyond the strength in tension: it keeps the residual one, and the rest becomes lasting opening; returns
	/// its work [J].
	Real yieldInTension(Real& normalForce);
	/// Slip by which the spring loses this part of its shear force [N], which is on body 2 and so against the slip.
	void slide(const Vector3r& excess);
	/// The joint fails: peak values are replaced by residual ones.
	void fail();
	/// The intact joint has its residual tensile strength from now on; without any it fails if it has no cohesion either.
	void losesTension();
	/// Whether it acts as a bond of its faces, or will once they lie on each other (RockJointBond.cpp).
	bool mayActAsBond() const { return bond || (intact && tensileStrength > 0 && normalStiffness > 0 && shearStiffness > 0); }
	/// Moment on body 2 about the contact point, of the joint's own bond or of its shear bed [N m].
	Vector3r momentAbout(const Vector3r& contactPoint, const Vector3r& normal) const
	{
		return bond ? bond->moment : Vector3r((shearPoint - contactPoint).cross(shearForce) + twistingMoment * normal);
	}
	/// Moment on body 2 of a normal force that turns about its own line (PolytopeGeom::turningArm) [N m].
	Vector3r normalMoment(Real turningArm) const { return turningArm * (normalForce - normalViscous); }
	/// Moment on body 2 about the contact point, without the rocking damper's [N m].
	Vector3r undampedMoment(const PolytopeGeom& geom) const
	{
		const Vector3r ofShear = momentAbout(geom.contactPoint, geom.normal);
		return bond ? ofShear : Vector3r(ofShear + normalMoment(geom.turningArm));
	}
	/// Moment on body 2 about the contact point of the shear dampers [N m].
	Vector3r viscousMoment(const PolytopeGeom& geom) const
	{
		return (shearPoint - geom.contactPoint).cross(shearViscous) + twistingViscous * geom.normal;
	}
	/// Shear acts at this point, without a moment.
	void shearAt(const Vector3r& point)
	{
		shearPoint     = point;
		twistingMoment = twistingViscous = twistingStiffness = 0;
		shearLayers.clear();
	}
	/// Normal and shear force are those of a bond of the two bodies, which acts at this point.
	void takeForce(const Vector3r& ofBond, const Vector3r& point, const Vector3r& normal)
	{
		normalForce = normal.dot(ofBond) * normal;
		shearForce  = ofBond - normalForce;
		shearAt(point);
	}
	/// Whether the joint can carry a tensile force [N].
	bool bearsTension(Real force) const;
	/// How many springs the shear bed has, up to a factor: the area [m²], or with a stiffness per contact the share [-] that this one of several pieces
	/// has; 0 where a script has set neither.
	Real extentOfBed() const
	{
		return shearStiffness > 0 ? contactArea : shearStiffnessPerContact > 0 ? Real(ks / shearStiffnessPerContact) : Real(0);
	}
	/// Largest shear force at a normal force (positive in compression) [N].
	Real shearStrength(Real normal) const;
	/// Energy of the springs of the shear bed [J].
	Real shearEnergy() const;

	/// NormPhys' and NormShearPhys' attributes; for a joint with stiffness per contact they are set for good.
	Real getKn() const { return kn; }
	Real getKs() const { return ks; }
	void setKn(Real value);
	void setKs(Real value);

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(RockJointPhys, FrictPhys,
	R"""(Physics of one rock joint contact, made by :yref:`Ip2_RockJointMat_RockJointMat_RockJointPhys` for
:yref:`Law2_PolytopeGeom_RockJointPhys_MohrCoulomb`. :yref:`kn<NormPhys.kn>` and :yref:`ks<NormShearPhys.ks>` are the contact's present stiffnesses
[N/m]. :yref:`normalForce<NormPhys.normalForce>` and :yref:`shearForce<NormShearPhys.shearForce>` are the whole forces, viscous parts included. All
values may be changed during a run and take effect in the next step; :yref:`tangensOfFrictionAngle<FrictPhys.tangensOfFrictionAngle>` is the present
friction, peak or residual.)""",
		((Real, normalStiffness, 0, , "Normal stiffness per area [Pa/m]: $k_n$ is this times :yref:`contactArea<RockJointPhys.contactArea>` "
		        "in each step; 0: stiffness per contact."))
		((Real, shearStiffness, 0, , "Shear stiffness per area [Pa/m], in the same way for $k_s$."))
		((Real, normalStiffnessPerContact, 0, , "$k_n$ of a joint with stiffness per contact [N/m]; 0: *kn* stays as it is. A script that "
		        "sets *kn* of such a joint sets this."))
		((Real, shearStiffnessPerContact, 0, , "$k_s$ of such a joint [N/m], in the same way."))
		((Real, contactArea, 0, , "Area the stiffnesses and strengths act on [m²]: :yref:`PolytopeGeom.contactArea`, that of the last "
		        "overlap while the bodies are apart (the joint is open, or its dilation keeps it closed across the gap). For other "
		        "geometries set once, see :yref:`stiffnessPerArea<Ip2_RockJointMat_RockJointMat_RockJointPhys.stiffnessPerArea>`."))
		((Real, cohesion, 0, , "Cohesion while :yref:`intact<RockJointPhys.intact>` [Pa]."))
		((Real, residualCohesion, 0, , "Cohesion once the joint has failed [Pa]."))
		((Real, tensileStrength, 0, , "Tensile strength while :yref:`intact<RockJointPhys.intact>` [Pa]; from where it was reached on the "
		        "residual one."))
		((Real, residualTensileStrength, 0, , "Tensile strength once it was reached, or the joint has failed [Pa]."))
		((Real, lastingOpening, 0, Attr::readonly, "Opening by which a joint with residual tensile strength has been torn open [m]: within it, "
		        "it bears nothing. The fibres of a :yref:`bond<RockJointPhys.bond>` have their own."))
		((Real, tangensOfResidualFrictionAngle, -1, , "Becomes :yref:`tangensOfFrictionAngle<FrictPhys.tangensOfFrictionAngle>` when the "
		        "joint fails [-]; negative: friction does not change."))
		((Real, tangensOfDilationAngle, 0, , "Widening over slip $\\tan\\psi$ [-]."))
		((Real, dilationLimit, std::numeric_limits<Real>::infinity(), , "Largest :yref:`dilation<RockJointPhys.dilation>` [m]."))
		((Real, dilation, 0, Attr::readonly, "Present widening of the joint by dilation [m], added to "
		        ":yref:`penetrationDepth<ScGeom.penetrationDepth>`."))
		((Real, restOverlap, 0, Attr::readonly, "Overlap at which the joint has no normal force [m], taken from "
		        ":yref:`penetrationDepth<ScGeom.penetrationDepth>`: where a bond has failed (:yref:`PolytopeBonds`) the overlap with which "
		        "it was made, else 0."))
		((Vector3r, shearPoint, Vector3r::Zero(), Attr::readonly, "Point through which the shear force acts [m]: the centroid of the "
		        "contact area, a joint being a bed of shear springs over it. The normal force acts at the contact point, the centroid of "
		        "the pressure."))
		((Real, twistingMoment, 0, , "Moment of the shear bed on body 2 about the normal at :yref:`shearPoint<RockJointPhys.shearPoint>`, "
		        "viscous part included [N·m]; body 1 gets the opposite."))
		((Real, twistingViscous, 0, Attr::readonly, "Viscous part of :yref:`twistingMoment<RockJointPhys.twistingMoment>` [N·m]."))
		((Real, twistingStiffness, 0, Attr::readonly, "Stiffness of the bed against turning about the normal, :yref:`ks<NormShearPhys.ks>` "
		        "times the mean square of the distance from the area's centroid [N·m/rad]; 0 for polygons and spheres."))
		((Vector3r, likelySlip, Vector3r::Zero(), (Attr::readonly | Attr::hidden), "Motion at which the last search for slip has ended, "
		        "along the outline's axes and about the normal, of any length: where the next begins"))
		((Layers, shearLayers, , (Attr::readonly | Attr::hidden), "Displacement of the bed's springs by when they joined; none: all alike"))
		((Vector3r, slip, Vector3r::Zero(), Attr::readonly, "Plastic slip of body 2 relative to body 1 since the contact was made [m], "
		        "turned with the normal: net motion along the joint without the elastic part, also while the joint is open. Never more than "
		        "the bodies have moved."))
		((Vector3r, normalViscous, Vector3r::Zero(), Attr::readonly, "Viscous part of :yref:`normalForce<NormPhys.normalForce>` [N]."))
		((Vector3r, shearViscous, Vector3r::Zero(), , "Viscous part of :yref:`shearForce<NormShearPhys.shearForce>` [N]. The law's memory "
		        "is *shearForce* without it: a script that sets *shearForce* sets this to zero."))
		((Vector3r, rockingMoment, Vector3r::Zero(), Attr::readonly, "Moment of the rocking damper on body 2 [N·m]; body 1 gets the "
		        "opposite."))
		((shared_ptr<PolytopeBond>, bond, , Attr::readonly, "The :yref:`bond<PolytopeBond>` as which an intact joint with tensile strength "
		        "and stiffness per area acts, with its forces and stresses; None for others. Its stiffnesses and strengths are those of the "
		        "joint."))
		((LastStep, lastStep, , (Attr::readonly | Attr::hidden), "Kept with O.trackEnergy; none: was not tracked"))
		((Real, dampedStiffness, 0, (Attr::readonly | Attr::hidden), "Stiffness with which the contact was part of the last step's sums, "
		        "for dampers (StiffnessSums); 0: it was not"))
		((bool, intact, false, , "Whether the joint still has its peak strength. Joints without residual friction, tensile strength and "
		        "cohesion above the residual one have none and are never intact."))
		((bool, isSliding, false, Attr::readonly, "Whether the shear force is at the strength in this step."))
		((Laws, laws, , (Attr::readonly | Attr::hidden), "Closure and shear law of its own; none: linear spring and Mohr-Coulomb"))
		((bool, followsBond, false, (Attr::readonly | Attr::hidden), "Forces are those of a bond that failed in the last step "
		        "(PolytopeBonds)"))
		, /*ctor*/ createIndex();
		, /*py*/
		.add_property("kn", &RockJointPhys::getKn, &RockJointPhys::setKn, "Present normal stiffness [N/m].")
		.add_property("hasOwnStrength", &RockJointPhys::hasOwnStrength, "Whether the joint has a shear law of its own "
		        "(:yref:`RockJointMat.strength`): then :yref:`tangensOfFrictionAngle<FrictPhys.tangensOfFrictionAngle>` is what it gives at "
		        "the present stress and displacement.")
		.add_property("slipLength", &RockJointPhys::slipLength, "Length of all slip so far, back and forth, of a joint with a shear "
		        "law of its own (:yref:`RockJointMat.strength`) [m]; for others the length of :yref:`slip<RockJointPhys.slip>`.")
		.add_property("reduction", &RockJointPhys::getReduction, &RockJointPhys::setReduction, "What tan φ of a shear law of its own is "
		        "divided by [-]; 1 for Mohr-Coulomb, whose values are divided themselves (polytope.factorOfSafety).")
		.def("normalEnergy", &RockJointPhys::presentNormalEnergy, boost::python::arg("geom"),
		        "Elastic energy of the normal spring [J] in the contact that has this geometry, as the law books it; of a joint that acts as "
		        "a :yref:`bond<RockJointPhys.bond>`, the bond's without that of :yref:`shearEnergy<RockJointPhys.shearEnergy>`.")
		.add_property("shearEnergy", &RockJointPhys::shearEnergy, "Elastic energy of the shear bed [J]; viscous forces are left out.")
		.add_property("ks", &RockJointPhys::getKs, &RockJointPhys::setKs, "Present shear stiffness [N/m].")
	);
	// clang-format on
	REGISTER_CLASS_INDEX(RockJointPhys, FrictPhys);
};
REGISTER_SERIALIZABLE(RockJointPhys);

} // namespace yade

POLYTOPE_SAVED_FLAT_WITH_ITS_OWNER(RockJointPhys)
