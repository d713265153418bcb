// SPDX-License-Identifier: GPL-2.0-or-later
//
// A contact point of one's own: two polytopes meet as always, but their force acts on the first body's surface.
#include <yade-polytope/contact/PolytopeGeomFunctor.hpp>

#include <polytope/shape/ClosestPoint.hpp>

#include <core/Scene.hpp>

namespace yade {

class Ig2_Polytope_Polytope_OwnPoint : public PolytopeGeomFunctor {
public:
	bool go(const shared_ptr<Shape>& shape1, const shared_ptr<Shape>& shape2, const State& state1, const State& state2,
	        const Vector3r& shift2, const bool& force, const shared_ptr<Interaction>& c) override
	{
		static thread_local polytope::ContactWorkspace workspace;
		const auto &one = static_cast<const Polytope&>(*shape1).convex(), &other = static_cast<const Polytope&>(*shape2).convex();
		if (!one || !other || one->dimension() != other->dimension()) return failed(c);
		const Material &material1      = *Body::byId(c->getId1(), scene)->material,
		               &material2      = *Body::byId(c->getId2(), scene)->material;
		auto settings                  = this->settings(stiffnessRuleOfNew(*scene, material1, material2));
		settings.section               = true;
		settings.geometryAcrossGap     = c->isReal() || force; // of a pair that comes apart: the law ends it
		auto* const             known  = static_cast<PolytopeGeom*>(c->geom.get());
		auto                    memory = known ? known->memory() : polytope::PairMemory();
		polytope::ContactResult result;
		contactQuery(
		        { *one, state1.ori.toRotationMatrix(), *other, state2.ori.toRotationMatrix(), state2.pos + shift2 - state1.pos },
		        settings, memory, workspace, result);
		if (result.inContact) {
			const Matrix3r turn = state1.ori.toRotationMatrix();
			result.point        = turn * polytope::closestPoint(*one, Vector3r(turn.transpose() * result.point)).point;
			geometry(c).remember(memory); // made here where there is none
		}
		return apply(result, state1.pos, state1, state2, shift2, force, c);
	}
	FUNCTOR2D(Polytope, Polytope);
	DEFINE_FUNCTOR_ORDER_2D(Polytope, Polytope);
	YADE_CLASS_BASE_DOC(Ig2_Polytope_Polytope_OwnPoint, PolytopeGeomFunctor, "Contact of two polytopes on the first one's surface.");
};
REGISTER_SERIALIZABLE(Ig2_Polytope_Polytope_OwnPoint);

YADE_PLUGIN((Ig2_Polytope_Polytope_OwnPoint));

} // namespace yade
