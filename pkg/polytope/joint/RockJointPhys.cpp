// SPDX-License-Identifier: GPL-2.0-or-later
#include "joint/RockJointPhys.hpp"

#include "host/Prefetch.hpp"

#include <core/Scene.hpp>

#include <src/joint/JointTolerances.hpp>

namespace yade {

POLYTOPE_CLASSES((RockJointPhys));

static_assert(sizeof(RockJointPhys) <= prefetch::physicsBytes, "what is read in each step is prefetched");

void RockJointPhys::setStiffnesses(Real share)
{
	if (normalStiffness > 0) kn = normalStiffness * contactArea;
	else if (normalStiffnessPerContact != 0) kn = normalStiffnessPerContact * share;
	if (shearStiffness > 0) ks = shearStiffness * contactArea;
	else if (shearStiffnessPerContact != 0) ks = shearStiffnessPerContact * share;
}

void RockJointPhys::setKn(Real value)
{
	kn = value;
	if (!(normalStiffness > 0)) normalStiffnessPerContact = value;
}

void RockJointPhys::setKs(Real value)
{
	ks = value;
	if (!(shearStiffness > 0)) shearStiffnessPerContact = value;
}

void RockJointPhys::slide(const Vector3r& excess)
{
	if (ks > 0) slip -= excess / ks;
}

void RockJointPhys::fail()
{
	intact = false;
	if (tangensOfResidualFrictionAngle >= 0) tangensOfFrictionAngle = tangensOfResidualFrictionAngle;
}

void RockJointPhys::losesTension()
{
	tensileStrength = residualTensileStrength;
	if (!(tensileStrength > 0) && !(cohesion > residualCohesion)) fail();
}

Real RockJointPhys::yieldInTension(Real& normalForce)
{
	if (intact) losesTension();
	const Real bears = residualTensileStrength * contactArea, beyond = (-normalForce - bears) / kn;
	lastingOpening += beyond;
	normalForce = -bears;
	return bears * beyond;
}

Real RockJointPhys::normalEnergy(const PolytopeGeom& geom, Real force) const
{
	// of the geometry's own dilation; the joint's is that of a slip which has been turned since
	const bool ofGeometry = math::abs(dilation - geom.widening()) <= Real(polytope::tolerance::sameDilation) * dilation;
	if (geom.energyPerStiffness >= 0 && geom.closedBy() > 0 && ofGeometry && restOverlap == 0) return kn * geom.energyPerStiffness;
	if (force == 0) return 0; // an open joint with a closure law, too
	if (laws.get()) return kn * energyPerStiffness(geom.penetrationDepth + dilation - restOverlap);
	return energyOfSpring(force * force, kn);
}

Real RockJointPhys::presentNormalEnergy(const PolytopeGeom& geom) const
{
	return bond ? Real(bond->energy - shearEnergy()) : normalEnergy(geom, (normalForce - normalViscous).dot(geom.normal));
}

bool RockJointPhys::bearsTension(Real force) const { return force <= presentTensileStrength() * contactArea; }

Real RockJointPhys::shearStrength(Real normal) const
{
	const Real strength = normal * tangensOfFrictionAngle + presentCohesion() * contactArea;
	return strength > 0 ? strength : Real(0);
}

Real RockJointPhys::shearEnergy() const
{
	const Vector3r       force = shearForce - shearViscous;
	const Real           twist = twistingMoment - twistingViscous, bed = energyOfSpring(force.squaredNorm(), ks);
	const LayersOfJoint* several = shearLayers.get();
	if (!several || !(extentOfBed() > 0)) return bed + energyOfSpring(twist * twist, twistingStiffness);
	const polytope::ShearLayers& layers    = several->layers; // their mean is the force's
	const Real                   perExtent = ks / extentOfBed(), mean = layers.sum().squaredNorm() / (2 * layers.area());
	const Real                   own = twistingStiffness - perExtent * layers.spread();
	return bed + perExtent * (layers.energy() - mean) + own * several->rotation * several->rotation / 2;
}

} // namespace yade
