// SPDX-License-Identifier: GPL-2.0-or-later
//
// Joints that close along a hyperbola (Bandis, Lumsden & Barton 1983): σ = k u/(1 − u/V), with Coulomb's friction. A material, its physics with the functor that
// makes them, and the law.
#include <yade-polytope/contact/ContactForce.hpp>
#include <yade-polytope/contact/PolytopeGeom.hpp>

#include <pkg/common/ElastMat.hpp>

namespace yade {

class OwnJointMat : public FrictMat {
public:
	virtual ~OwnJointMat() = default;
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR(OwnJointMat, FrictMat, "Joint with hyperbolic closure.",
		((Real, initialStiffness, 1e9, , "$k$ [Pa/m]"))
		((Real, maximumClosure, 1e-3, , "$V$ [m]"))
		((Real, shearStiffness, 1e9, , "[Pa/m]"))
		((Real, largestStress, 1e6, , "σ up to which the time step is stable [Pa]"))
		, createIndex(););
	// clang-format on
	REGISTER_CLASS_INDEX(OwnJointMat, FrictMat);
};
REGISTER_SERIALIZABLE(OwnJointMat);

class OwnJointPhys : public FrictPhys {
public:
	virtual ~OwnJointPhys() = default;
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR(OwnJointPhys, FrictPhys, "Physics of such a joint.",
		((Real, initialStiffness, 0, , "$k$ [Pa/m]"))
		((Real, maximumClosure, 0, , "$V$ [m]"))
		((Real, shearStiffness, 0, , "[Pa/m]"))
		, createIndex(););
	// clang-format on
	REGISTER_CLASS_INDEX(OwnJointPhys, FrictPhys);
};
REGISTER_SERIALIZABLE(OwnJointPhys);

class Ip2_OwnJointMat_OwnJointMat_OwnJointPhys : public IPhysFunctor, public GivesJointStiffness {
public:
	void go(const shared_ptr<Material>& material1, const shared_ptr<Material>& material2, const shared_ptr<Interaction>& c) override
	{
		if (c->phys) return;
		const auto &a = static_cast<const OwnJointMat&>(*material1), &b = static_cast<const OwnJointMat&>(*material2);
		auto        phys             = shared_ptr<OwnJointPhys>(new OwnJointPhys);
		phys->initialStiffness       = math::min(a.initialStiffness, b.initialStiffness);
		phys->maximumClosure         = math::min(a.maximumClosure, b.maximumClosure);
		phys->shearStiffness         = math::min(a.shearStiffness, b.shearStiffness);
		phys->tangensOfFrictionAngle = math::tan(math::min(a.frictionAngle, b.frictionAngle));
		if (auto* geom = dynamic_cast<PolytopeGeom*>(c->geom.get())) geom->needsArea = true;
		c->phys = phys;
	}
	/// The depth is then the mean over the area.
	StiffnessRule stiffnessRule(const Material& a, const Material& b) const override
	{
		return dynamic_cast<const OwnJointMat*>(&a) && dynamic_cast<const OwnJointMat*>(&b) ? StiffnessRule::PerArea
		                                                                                    : StiffnessRule::Unknown;
	}
	/// Stiffnesses before the first contact: the slope of the hyperbola at the largest stress, k (1 + σ/(k V))².
	std::optional<ContactStiffness> stiffnesses(const Material& a, const Material& b, Real area, Real, Real) const override
	{
		const auto &one = static_cast<const OwnJointMat&>(a), &other = static_cast<const OwnJointMat&>(b);
		const Real  k      = math::min(one.initialStiffness, other.initialStiffness),
		           v       = math::min(one.maximumClosure, other.maximumClosure);
		const Real steeper = 1 + math::max(one.largestStress, other.largestStress) / (k * v);
		return ContactStiffness { area * k * steeper * steeper, area * math::min(one.shearStiffness, other.shearStiffness) };
	}
	FUNCTOR2D(OwnJointMat, OwnJointMat);
	YADE_CLASS_BASE_DOC(Ip2_OwnJointMat_OwnJointMat_OwnJointPhys, IPhysFunctor, "Makes OwnJointPhys.");
};
REGISTER_SERIALIZABLE(Ip2_OwnJointMat_OwnJointMat_OwnJointPhys);

class Law2_PolytopeGeom_OwnJointPhys_Hyperbolic : public LawFunctor {
public:
	bool go(shared_ptr<IGeom>& geometry, shared_ptr<IPhys>& physics, Interaction* c) override
	{
		auto&      geom = static_cast<PolytopeGeom&>(*geometry);
		auto&      phys = static_cast<OwnJointPhys&>(*physics);
		const Real u = geom.penetrationDepth, area = geom.contactArea;
		if (u <= 0) return false; // apart: YADE deletes the contact
		const Real open = math::max(1 - u / phys.maximumClosure, Real(1e-6)), force = area * phys.initialStiffness * u / open;
		phys.kn          = area * phys.initialStiffness / (open * open); // PolytopeTimeStepper reads it
		phys.ks          = area * phys.shearStiffness;
		phys.normalForce = force * geom.normal;
		followShear(geom, phys);
		addContactForce(geom, phys, *c, *scene);
		return true;
	}
	FUNCTOR2D(PolytopeGeom, OwnJointPhys);
	YADE_CLASS_BASE_DOC(Law2_PolytopeGeom_OwnJointPhys_Hyperbolic, LawFunctor, "Hyperbolic closure and friction.");
};
REGISTER_SERIALIZABLE(Law2_PolytopeGeom_OwnJointPhys_Hyperbolic);

YADE_PLUGIN((OwnJointMat)(OwnJointPhys)(Ip2_OwnJointMat_OwnJointMat_OwnJointPhys)(Law2_PolytopeGeom_OwnJointPhys_Hyperbolic));

} // namespace yade
