// SPDX-License-Identifier: GPL-2.0-or-later
//
// Ellipsoids: planes that touch them all around, for boxes, drawing and where two bodies meet, and the true surface for mass and depth. A geometry of its own keeps the radius
// of curvature.
#include <yade-polytope/contact/PolytopeGeomFunctor.hpp>

#include <core/Scene.hpp>
#include <lib/high-precision/Constants.hpp>

namespace yade {

class Ellipsoid : public Polytope {
public:
	virtual ~Ellipsoid() = default;
	std::optional<Real>      margin() const override { return 0; }
	polytope::MassProperties massProperties() const override
	{
		polytope::MassProperties mass;
		mass.volume             = 4 * Mathr::PI / 3 * semiAxes.prod();
		const Vector3r squares  = semiAxes.cwiseProduct(semiAxes);
		mass.inertia.diagonal() = mass.volume / 5 * (Vector3r::Constant(squares.sum()) - squares);
		return mass;
	}
	/// Extent from the centre along a unit vector of its own axes.
	Real reach(const Vector3r& direction) const { return semiAxes.cwiseProduct(direction).norm(); }
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR(Ellipsoid, Polytope, "Ellipsoid within planes that touch it.", ((Vector3r, semiAxes, Vector3r::Ones(), , "[m]")), createIndex(););
	// clang-format on
	REGISTER_CLASS_INDEX(Ellipsoid, Polytope);
};
REGISTER_SERIALIZABLE(Ellipsoid);

class EllipsoidGeom : public PolytopeGeom {
public:
	virtual ~EllipsoidGeom() = default;
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR(EllipsoidGeom, PolytopeGeom, "Contact of an ellipsoid.", ((Real, curvatureRadius, 0, , "Geometric mean of body 2's radii of curvature [m]")), createIndex(););
	// clang-format on
	REGISTER_CLASS_INDEX(EllipsoidGeom, PolytopeGeom);
};
REGISTER_SERIALIZABLE(EllipsoidGeom);

/// Where the planes touch, with their normal, and as deep as the surfaces reach into each other along it.
class EllipsoidFunctor : public PolytopeGeomFunctor {
public:
	bool go(const shared_ptr<Shape>& shape1, const shared_ptr<Shape>& shape2, const State& state1, const State& state2,
	        const Vector3r& shift2, const bool& force, const shared_ptr<Interaction>& c) override
	{
		static thread_local polytope::ContactWorkspace workspace;
		const auto &one = static_cast<const Polytope&>(*shape1), &other = static_cast<const Polytope&>(*shape2);
		if (!one.convex() || !other.convex() || other.convex()->dimension() != one.convex()->dimension()) return failed(c);
		auto settings                  = this->settings(StiffnessRule::PerContact);
		settings.geometryAcrossGap     = c->isReal() || force; // the law ends it
		auto* const             known  = static_cast<PolytopeGeom*>(c->geom.get());
		auto                    memory = known ? known->memory() : polytope::PairMemory();
		polytope::ContactResult result;
		contactQuery({ *one.convex(), state1.ori.toRotationMatrix(), *other.convex(), state2.ori.toRotationMatrix(),
		                     state2.pos + shift2 - state1.pos },
		        settings, memory, workspace, result);
		if (!result.hasGeometry) return apply(result, state1.pos, state1, state2, shift2, force, c);
		const Vector3r normal1 = state1.ori.conjugate() * result.normal, normal2 = state2.ori.conjugate() * -result.normal;
		const Real     reach1 = reach(one, normal1), reach2 = reach(other, normal2);
		result.depth  = reach1 + reach2 - result.normal.dot(state2.pos + shift2 - state1.pos);
		result.energy = result.depth * result.depth / 2;
		result.point += (reach1 - result.depth / 2 - result.normal.dot(result.point)) * result.normal;
		result.inContact = result.depth > 0;
		if (!result.inContact) result.status = polytope::ContactStatus::Separated;
		else {
			if (!c->geom) c->geom = shared_ptr<EllipsoidGeom>(new EllipsoidGeom);
			auto& geom = static_cast<EllipsoidGeom&>(*c->geom);
			geom.remember(memory);
			geom.curvatureRadius = curvatureRadius(other, normal2);
		}
		return apply(result, state1.pos, state1, state2, shift2, force, c);
	}
	YADE_CLASS_BASE_DOC(EllipsoidFunctor, PolytopeGeomFunctor, "Base of the contacts of ellipsoids.");

private:
	static Real reach(const Polytope& shape, const Vector3r& normal)
	{
		const auto* ellipsoid = dynamic_cast<const Ellipsoid*>(&shape);
		return ellipsoid ? ellipsoid->reach(normal) : Real(shape.convex()->support(normal).dot(normal));
	}
	/// 1/√(Gauss's curvature): the product of the axes over reach².
	static Real curvatureRadius(const Polytope& shape, const Vector3r& normal)
	{
		const auto* ellipsoid = dynamic_cast<const Ellipsoid*>(&shape);
		if (!ellipsoid) return 0;
		return ellipsoid->semiAxes.prod() / math::pow(ellipsoid->reach(normal), 2);
	}
};
REGISTER_SERIALIZABLE(EllipsoidFunctor);

class Ig2_Polytope_Ellipsoid_EllipsoidGeom : public EllipsoidFunctor {
public:
	FUNCTOR2D(Polytope, Ellipsoid);
	DEFINE_FUNCTOR_ORDER_2D(Polytope, Ellipsoid);
	YADE_CLASS_BASE_DOC(Ig2_Polytope_Ellipsoid_EllipsoidGeom, EllipsoidFunctor, "Contact of a polytope and an ellipsoid.");
};
REGISTER_SERIALIZABLE(Ig2_Polytope_Ellipsoid_EllipsoidGeom);

class Ig2_Ellipsoid_Ellipsoid_EllipsoidGeom : public EllipsoidFunctor {
public:
	FUNCTOR2D(Ellipsoid, Ellipsoid);
	DEFINE_FUNCTOR_ORDER_2D(Ellipsoid, Ellipsoid);
	YADE_CLASS_BASE_DOC(Ig2_Ellipsoid_Ellipsoid_EllipsoidGeom, EllipsoidFunctor, "Contact of two ellipsoids.");
};
REGISTER_SERIALIZABLE(Ig2_Ellipsoid_Ellipsoid_EllipsoidGeom);

YADE_PLUGIN((Ellipsoid)(EllipsoidGeom)(EllipsoidFunctor)(Ig2_Polytope_Ellipsoid_EllipsoidGeom)(Ig2_Ellipsoid_Ellipsoid_EllipsoidGeom));

} // namespace yade
