// SPDX-License-Identifier: GPL-2.0-or-later
//
// Joints with a closure and a shear law of their own (material/JointLaws.hpp; the laws are in src/joint). The law of rock joints asks for
// them in three places of its step: before the springs have their stiffness, with the trial forces, and with the forces that remain. All
// else is as with Mohr-Coulomb: a shear law says which friction angle there is at present.
#include "joint/RockJointShear.hpp"

#include <src/joint/JointTolerances.hpp>

namespace yade {

Real RockJointPhys::ownSpring(Real overlap) const { return kn * laws.get()->closure.pressure(overlap + dilation - restOverlap); }

Real RockJointPhys::stiffen(Real overlap)
{
	const Real tangent = laws.get()->closure.tangent(overlap + dilation - restOverlap);
	kn *= tangent;
	return tangent;
}

Real RockJointPhys::ownDilation() const { return laws.get()->dilation; }

Real RockJointPhys::rising(const Vector3r& velocity) const
{
	const Real steepness = hasOwnStrength() ? laws.get()->steepness : dilation < dilationLimit ? tangensOfDilationAngle : Real(0);
	const Real far       = slip.norm();
	return steepness * (far > 0 ? Real(slip.dot(velocity) / far) : velocity.norm());
}

bool RockJointPhys::ownHistory() const { return laws.get() && laws.get()->slipPath > 0; }

Real RockJointPhys::energyPerStiffness(Real overlap) const
{
	if (!laws.get()) return overlap * overlap / 2;
	const polytope::ClosureLaw& law     = laws.get()->closure;
	const Real                  tangent = law.tangent(overlap);
	return tangent > 0 ? law.energy(overlap) / tangent : Real(0);
}

bool RockJointPhys::hasOwnStrength() const { return laws.get() && laws.get()->law() != ShearLaw::MohrCoulomb; }

Real RockJointPhys::slipLength() const { return hasOwnStrength() ? laws.get()->slipPath : slip.norm(); }

Real RockJointPhys::getReduction() const { return laws.get() ? laws.get()->reduction : Real(1); }

void RockJointPhys::setReduction(Real value)
{
	if (!(value > 0 && math::isfinite(value))) throw std::invalid_argument("reduction: must be positive and finite");
	if (hasOwnStrength()) laws.make().reduction = value;
	else if (value != 1)
		throw std::invalid_argument("reduction: belongs to a shear law (RockJointMat.strength), which this joint does not have");
}

/// What it has before this step's motion: shear stiffness at the last stress.
void Law2_PolytopeGeom_RockJointPhys_MohrCoulomb::beginOwnLaws(RockJointPhys& phys, const PolytopeGeom& geom) const
{
	LawsOfJoint& laws = phys.laws.make();
	if (laws.law() != ShearLaw::ContinuouslyYielding) return;
	laws.yielding.turn([&](Vector3r& direction) { turnWithContact(geom, direction); });
	const Real elastic = (phys.normalForce - phys.normalViscous).dot(geom.normal);
	const Real present = laws.shearStiffness * laws.yielding.stiffness(phys.contactArea > 0 ? elastic / phys.contactArea : Real(0));
	(phys.shearStiffness > 0 ? phys.shearStiffness : phys.shearStiffnessPerContact) = present;
}

/// Stiffness and friction angle at the trial forces; a continuously-yielding joint slips before its strength.
void Law2_PolytopeGeom_RockJointPhys_MohrCoulomb::followOwnLaws(RockJointPhys& phys, Shear& shear, Real overlap, Real normal) const
{
	LawsOfJoint& laws  = phys.laws.make();
	laws.slipBefore    = phys.slip;
	const Real tangent = phys.stiffen(overlap);
	if (tangent > Real(polytope::tolerance::stiffening) * laws.stiffening) {
		laws.stiffening = tangent;
		stiffened_      = true;
	} else if (tangent * Real(polytope::tolerance::stiffening) < laws.stiffening) laws.stiffening = tangent;

	if (laws.law() == ShearLaw::BartonBandis) {
		const Real elastic          = phys.ks > 0 ? shear.force().norm() / phys.ks : Real(0);
		const Real stress           = phys.contactArea > 0 ? normal / phys.contactArea : Real(0);
		phys.tangensOfFrictionAngle = math::tan(laws.rough.frictionAngle(stress, laws.slipPath + elastic)) / laws.reduction;
	} else if (laws.law() == ShearLaw::ContinuouslyYielding) {
		phys.tangensOfFrictionAngle = math::tan(laws.yielding.frictionAngle()) / laws.reduction;
		const Real way = shear.motion().norm(), strength = normal * phys.tangensOfFrictionAngle;
		if (unbreakable || !(way > 0 && strength > 0)) return;
		const Vector3r direction = shear.motion() / way;
		const Real     elastic   = laws.yielding.elasticPart(direction, -shear.forceBefore().dot(direction) / strength);
		shear.yield((1 - elastic) * shear.motion());
	}
}

/// What the slip of this step has done: asperities that it mobilised or wore, and dilation for the next step.
void Law2_PolytopeGeom_RockJointPhys_MohrCoulomb::endOwnLaws(RockJointPhys& phys, const Shear& shear, Real normal) const
{
	LawsOfJoint& laws = phys.laws.make();
	if (laws.law() == ShearLaw::MohrCoulomb) return;
	if (laws.law() == ShearLaw::ContinuouslyYielding && !phys.isSliding) phys.slide(shear.excess());
	const Real way = (phys.slip - laws.slipBefore).norm();
	if (!(way > 0 && normal > 0)) return;
	laws.slipPath += way;
	Real angle;
	if (laws.law() == ShearLaw::BartonBandis) {
		const Real elastic = phys.ks > 0 ? shear.force().norm() / phys.ks : Real(0);
		angle              = laws.rough.dilationAngle(normal / phys.contactArea, laws.slipPath + elastic);
	} else {
		laws.yielding.wear(way);
		angle = laws.yielding.dilationAngle(shear.force().norm() / normal);
	}
	laws.steepness = math::tan(angle);
	laws.dilation  = math::max(Real(0), Real(phys.dilation + (phys.slip.norm() - laws.slipBefore.norm()) * laws.steepness));
}

} // namespace yade
