// SPDX-License-Identifier: GPL-2.0-or-later
#include "RockJoint.hpp"

#include <core/Scene.hpp>
#include <lib/high-precision/Constants.hpp>

#include "PolytopeGeom.hpp"

namespace yade {

YADE_PLUGIN((RockJointMat)(RockJointPhys)(Ip2_RockJointMat_RockJointMat_RockJointPhys));

// ---------------------------------------------------------------------------------------------------- material

RockJointMat::Values RockJointMat::values() const
{
	return { { normalStiffness, shearStiffness, frictionAngle, cohesion, tensileStrength, residualFrictionAngle, dilationAngle,
		dilationLimit } };
}

void RockJointMat::setValues(const Values& v)
{
	normalStiffness       = v[0];
	shearStiffness        = v[1];
	frictionAngle         = v[2];
	cohesion              = v[3];
	tensileStrength       = v[4];
	residualFrictionAngle = v[5];
	dilationAngle         = v[6];
	dilationLimit         = v[7];
}

void RockJointMat::postLoad(RockJointMat&)
{
	const auto require = [&](bool good, const char* name, Real value, const char* rule) {
		if (good) return;
		setValues(good_);
		std::ostringstream message;
		message << name << ": must be " << rule << ", got " << value;
		throw std::invalid_argument(message.str());
	};
	const char* const angleRule = "an angle in radians, at least 0 and below pi/2 (use radians(degrees))";
	const auto        positive  = [](Real v) { return v > 0 && math::isfinite(v); };
	const auto        strength  = [](Real v) { return v >= 0 && math::isfinite(v); };
	// in wider precisions, too, Python's pi/2 is a double, and below the true one
	const auto angle = [](Real v) { return v >= 0 && v < double(Mathr::HALF_PI); };
	require(positive(normalStiffness), "normalStiffness", normalStiffness, "positive and finite [Pa/m, or N/m for each contact]");
	require(positive(shearStiffness), "shearStiffness", shearStiffness, "positive and finite [Pa/m, or N/m for each contact]");
	require(angle(frictionAngle), "frictionAngle", frictionAngle, angleRule);
	require(strength(cohesion), "cohesion", cohesion, "at least 0 and finite [Pa]");
	require(strength(tensileStrength), "tensileStrength", tensileStrength, "at least 0 and finite [Pa]");
	require(angle(residualFrictionAngle) || residualFrictionAngle == -1, "residualFrictionAngle", residualFrictionAngle,
	        "-1 (the same as frictionAngle) or an angle in radians, at least 0 and below pi/2");
	require(angle(dilationAngle), "dilationAngle", dilationAngle, angleRule);
	require(dilationLimit >= 0, "dilationLimit", dilationLimit, "at least 0 [m] (infinity: no limit)");
	good_ = values();
}

// ---------------------------------------------------------------------------------------------------- physics

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

bool RockJointPhys::bearsTension(Real force) const { return intact && force <= tensileStrength * contactArea; }

Real RockJointPhys::shearStrength(Real normal) const
{
	const Real strength = normal * tangensOfFrictionAngle + (intact ? cohesion * contactArea : Real(0));
	return strength > 0 ? strength : Real(0);
}

Real RockJointPhys::storedEnergy(Real normalEnergy, const Vector3r& shear) const
{
	return normalEnergy + (ks > 0 ? shear.squaredNorm() / (2 * ks) : Real(0));
}

namespace {

	/// Joint stiffness of two materials, each giving half of the compliance.
	Real seriesStiffness(Real k1, Real k2) { return k1 == k2 ? k1 : 2 * k1 * k2 / (k1 + k2); }

	Real residualAngle(const RockJointMat& material)
	{
		return material.residualFrictionAngle < 0 ? material.frictionAngle : material.residualFrictionAngle;
	}

	/// Area of a contact that has no contact section.
	Real nominalArea(const IGeom* geom)
	{
		const auto* spheres = dynamic_cast<const GenericSpheresContact*>(geom);
		if (!spheres) return 1;
		const Real r1 = spheres->refR1 > 0 ? spheres->refR1 : spheres->refR2,
		           r2 = spheres->refR2 > 0 ? spheres->refR2 : spheres->refR1;
		return Mathr::PI * math::pow(math::min(r1, r2), 2);
	}

} // namespace

void Ip2_RockJointMat_RockJointMat_RockJointPhys::go(
        const shared_ptr<Material>& material1, const shared_ptr<Material>& material2, const shared_ptr<Interaction>& contact)
{
	if (contact->phys) return;
	const auto& m1 = static_cast<const RockJointMat&>(*material1);
	const auto& m2 = static_cast<const RockJointMat&>(*material2);
	const auto  of = [&](const shared_ptr<MatchMaker>& rule, Real v1, Real v2, Real otherwise) {
                return rule ? (*rule)(m1.id, m2.id, v1, v2) : otherwise;
	};

	const Real normal = of(kn, m1.normalStiffness, m2.normalStiffness, seriesStiffness(m1.normalStiffness, m2.normalStiffness));
	const Real shear  = of(ks, m1.shearStiffness, m2.shearStiffness, seriesStiffness(m1.shearStiffness, m2.shearStiffness));

	auto phys = shared_ptr<RockJointPhys>(new RockJointPhys);
	phys->tangensOfFrictionAngle
	        = math::tan(of(frictAngle, m1.frictionAngle, m2.frictionAngle, math::min(m1.frictionAngle, m2.frictionAngle)));
	if (m1.residualFrictionAngle >= 0 || m2.residualFrictionAngle >= 0)
		phys->tangensOfResidualFrictionAngle = math::tan(math::min(residualAngle(m1), residualAngle(m2)));
	phys->cohesion               = math::min(m1.cohesion, m2.cohesion);
	phys->tensileStrength        = math::min(m1.tensileStrength, m2.tensileStrength);
	phys->tangensOfDilationAngle = math::tan(math::min(m1.dilationAngle, m2.dilationAngle));
	phys->dilationLimit          = math::min(m1.dilationLimit, m2.dilationLimit);
	if (phys->hasPeak()) {
		phys->intact = intactUntilStep < 0 || scene->iter <= intactUntilStep;
		if (!phys->intact) phys->fail();
	}

	if (auto* geom = dynamic_cast<PolytopeGeom*>(contact->geom.get())) {
		geom->needsShare  = !stiffnessPerArea;
		geom->needsArea   = stiffnessPerArea || phys->cohesion > 0 || phys->tensileStrength > 0;
		phys->contactArea = geom->contactArea; // a new contact's geometry has it already
		(stiffnessPerArea ? phys->normalStiffness : phys->normalStiffnessPerContact) = normal;
		(stiffnessPerArea ? phys->shearStiffness : phys->shearStiffnessPerContact)   = shear;
		phys->setStiffnesses(geom->share);
	} else {
		phys->contactArea = nominalArea(contact->geom.get());
		phys->kn          = stiffnessPerArea ? normal * phys->contactArea : normal;
		phys->ks          = stiffnessPerArea ? shear * phys->contactArea : shear;
	}
	contact->phys = phys;
}

} // namespace yade
