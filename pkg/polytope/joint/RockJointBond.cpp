// SPDX-License-Identifier: GPL-2.0-or-later
//
// An intact joint with tensile strength and a stiffness per area is a bond of its two faces: an elastic foundation that holds on both sides.
//
// The overlap of two bodies is a foundation that takes pressure only. Where such a joint tilts, part of its faces parts, and where it is pulled all
// of them: the overlap, and with it the area that the strength acts on, would vanish at tilts that the strength allows. So from the step in which
// the faces lie on each other all over, force and moment are those of springs over the whole area that the faces have in common, in tension and
// in compression. While all of it is pressed, both are the same. The contact's geometry then has normal, point and energy of the bond
// (PolytopeGeom::actAsBond()).
#include "joint/RockJointStep.hpp"

#include "bond/CommonFaceOfBodies.hpp"

#include <optional>

namespace yade {
namespace {

	/// Unstrained where the faces are flush, but for `slide`, the displacement of body 2 along them from there.
	shared_ptr<PolytopeBond> bondOf(const polytope::CommonFace& face, const Interaction& contact, const State& state1,
	        const State& state2, const Vector3r& shift, const Vector3r& slide)
	{
		auto              bond   = shared_ptr<PolytopeBond>(new PolytopeBond);
		const Vector3r    normal = face.axes.col(0), half = (face.gap * normal + slide) / 2;
		const Quaternionr axes(face.axes);
		bond->join(contact.getId1(), contact.getId2(), face);
		bond->cellDist = contact.cellDist;
		bond->attach(1, state1, Vector3r::Zero(), face.centroid - half, Quaternionr::FromTwoVectors(normal, face.normal1) * axes);
		bond->attach(2, state2, shift, face.centroid + half, Quaternionr::FromTwoVectors(normal, -face.normal2) * axes);
		bond->frictionAngle = 0; // the joint has it
		return bond;
	}

	void takeStiffnesses(PolytopeBond& bond, const RockJointPhys& phys)
	{
		bond.normalStiffness = bond.bendingStiffness = phys.normalStiffness;
		bond.shearStiffness = bond.twistingStiffness = phys.shearStiffness;
		bond.tensileStrength                         = phys.tensileStrength;
		bond.cohesion                                = phys.cohesion;
	}

	/// The bond of the two faces that lie on each other, if they do so all over; else null.
	shared_ptr<PolytopeBond> bondOfFaces(const Interaction& contact, const Body& body1, const Body& body2, const Vector3r& shift,
	        const Vector3r& normal, const RockJointPhys& phys, const Vector3r& shear)
	{
		const auto largest = largestCommonFace(body1, body2, shift, normal, polytope::touchingGap, 0);
		if (!largest) return nullptr;
		const State &state1 = *body1.state, &state2 = *body2.state;
		const auto   bond = bondOf(*largest, contact, state1, state2, shift, -shear / (phys.shearStiffness * largest->area));
		takeStiffnesses(*bond, phys);
		bond->follow(state1, state2, shift);
		const Real touching = polytope::touchingGap(*convexShapeOf(body1), *convexShapeOf(body2));
		return bond->edgeStress <= phys.normalStiffness * touching ? bond : nullptr;
	}

	/// Where the bodies are now. Fibres of a joint with residual tensile strength yield from where its edge has reached the strength on.
	/// \param lost set where that took a part of the strength away
	polytope::BondMotion followOrYield(PolytopeBond& bond, RockJointPhys& phys, const State& state1, const State& state2,
	        const Vector3r& shift, bool unbreakable, bool& lost)
	{
		takeStiffnesses(bond, phys);
		if (unbreakable && bond.yields()) bond.tensileStrength = std::numeric_limits<Real>::infinity();
		const auto motion = bond.follow(state1, state2, shift);
		lost              = false;
		if (unbreakable || bond.yields() || bond.edgeStress <= phys.tensileStrength || !(phys.residualTensileStrength > 0))
			return motion;
		lost = phys.tensileStrength > phys.residualTensileStrength;
		phys.losesTension();
		bond.tensileStrength = phys.tensileStrength;
		bond.beginToYield();
		return bond.follow(state1, state2, shift);
	}

} // namespace

/// Force and moment of the joint's bond in this step, which is made where the faces have come to lie on each other. False where there is none, or
/// it fails in this step: then the joint acts without it.
bool Law2_PolytopeGeom_RockJointPhys_MohrCoulomb::actsAsBond(
        Interaction& contact, PolytopeGeom& geom, RockJointPhys& phys, const Last& last, const Vector3r& elasticShear)
{
	const Pair     pair(contact, geom, scene);
	const Vector3r shift     = pair.shift2();
	const Vector3r increment = geom.shearIncrement();
	if (!phys.intact || !(phys.tensileStrength > 0)) phys.bond.reset(); // a script has changed them
	else if (!phys.bond)
		phys.bond = bondOfFaces(contact, *pair.body1, *pair.body2, shift, geom.normal, phys, elasticShear - phys.ks * increment);
	if (!phys.bond) return false;

	PolytopeBond&  bond = *phys.bond;
	StepWork       work;
	const auto     motion  = followOrYield(bond, phys, pair.state1, pair.state2, shift, unbreakable, work.fractured);
	const Vector3r normal  = motion.mean * Vector3r(1, 0, 0);
	const Real     elastic = bond.force.dot(normal);
	const Vector3r shear   = bond.force - elastic * normal;
	phys.contactArea       = bond.area;
	phys.setStiffnesses(1);
	// what rounding of positions leaves is no shear: a joint without cohesion has no strength against it when pulled
	const Real size = math::min(geom.refR1, geom.refR2), shown = Real(polytope::tolerance::rounding) * phys.shearStiffness * size;
	const bool parted = !unbreakable && !(bond.edgeStress <= phys.tensileStrength && (motion.displacement[0] < size || !bond.yields()));
	const bool sheared = !unbreakable && !(bond.shearStress <= math::max(phys.shearStrength(elastic) / bond.area, shown));
	if (parted || sheared) {
		if (sheared) phys.fail();
		else phys.losesTension();
		phys.lastingOpening = bond.meanLastingOpening();
		phys.shearPoint     = bond.point;
		phys.twistingMoment = bond.moment.dot(normal);
		phys.bond.reset();
		return false;
	}
	geom.actAsBond(normal, bond.point, (bond.energy - shear.squaredNorm() / (2 * phys.ks)) / phys.kn);
	const Pair                atBond(contact, geom, scene);
	std::optional<DampedPair> damped;
	if (damps()) damped.emplace(atBond, phys, stiffnessSums);
	const bool     yields       = bond.yields() && bond.plasticWork() > 0; // then it is not damped
	const Real     viscous      = normalDamping > 0 && !yields ? normalDamper(atBond, *damped, phys, elastic, 0) : Real(0);
	const Vector3r shearViscous = shearDamping > 0 ? shearDamper(atBond, *damped, phys, elastic + viscous, shear) : Vector3r::Zero();
	phys.isSliding              = false;
	phys.normalViscous          = viscous * normal;
	phys.normalForce            = (elastic + viscous) * normal;
	phys.shearViscous           = shearViscous;
	phys.shearForce             = shear + shearViscous;
	phys.shearAt(bond.point);
	phys.rockingMoment = rockingDamping > 0 ? rockingDamper(atBond, *damped, phys, std::numeric_limits<Real>::infinity())
	                                        : Vector3r(Vector3r::Zero());
	if (!apply(atBond, phys)) return true;
	if (damped) takePart(atBond, *damped, phys);

	if (!scene->trackEnergy) phys.lastStep.clear();
	else {
		work.plastic = bond.yields() ? bond.plasticWork() : Real(0);
		work.stored  = bond.energy;
		book(atBond, phys, last, work);
	}
	return true;
}

} // namespace yade
