// SPDX-License-Identifier: GPL-2.0-or-later
#include "step/TimeStepLimits.hpp"

#include <src/shape/ShapeOrNull.hpp>

#include "contact/StandIns.hpp"
#include "host/GravityOfScene.hpp"
#include "host/PeriodOfPair.hpp"
#include "joint/RockJointPhys.hpp"
#include "material/RockJointMat.hpp"
#include "shape/ShapeFamily.hpp"
#include "shape/ShapeOfBody.hpp"
#include "shape/WallShape.hpp"
#include "step/MovingPair.hpp"

#include <algorithm>
#include <map>
#include <vector>

namespace yade {
namespace {

	const Real unlimited = std::numeric_limits<Real>::infinity();

	using Materials = std::vector<const RockJointMat*>;

	/// Materials with a closure law that a joint of the body may have: its own, and those of its faces.
	Materials closingMaterialsOf(const Body& body, const Scene& scene)
	{
		Materials  found;
		const auto add = [&](const Material* material) {
			const auto* const joint = dynamic_cast<const RockJointMat*>(material);
			if (joint && joint->closure && std::find(found.begin(), found.end(), joint) == found.end()) found.push_back(joint);
		};
		add(body.material.get());
		if (const Polytope* const shape = polytopeOf(body))
			for (const int index : shape->faceMaterials)
				if (index >= 0 && std::size_t(index) < scene.materials.size())
					add(scene.materials[std::size_t(index)].get());
		return found;
	}

	/// Closure laws that a joint of these two sides may have.
	template <class Visit> void forLaws(const Materials& sides1, const Materials& sides2, const Visit& visit)
	{
		for (const RockJointMat* side1 : sides1)
			for (const RockJointMat* side2 : sides2) {
				const Real stiffness = stiffnessInSeries(side1->normalStiffness, side2->normalStiffness);
				if (const auto law = closureOfJoint(*side1, *side2, stiffness)) visit(*law);
			}
	}

	/// Its acceleration by the forces of this step [m/s²]. Where these are not there yet, a body that touches another counts as held by it.
	Vector3r accelerationOf(const Body& mover, const Vector3r& gravity, Scene& scene)
	{
		Vector3r acceleration = Vector3r::Zero();
		if (!isMovedByForces(mover) || !(mover.state->mass > 0)) return acceleration;
		const Vector3r force = scene.forces.getForceSingle(mover.id);
		if (force == Vector3r::Zero()) {
			bool touches = false;
			forParts(mover, scene, [&](const Body& part) {
				for (const auto& known : part.intrs)
					touches = touches || known.second->isReal();
			});
			if (touches) return acceleration;
		}
		acceleration = force / mover.state->mass + gravity;
		for (int k = 0; k < 3; ++k)
			if (mover.state->blockedDOFs & State::axisDOF(k, false)) acceleration[k] = 0;
		return acceleration;
	}

	class ClosingJoints {
	public:
		ClosingJoints(Scene& scene, Real horizon, Real steps)
		        : scene_(scene), horizon_(horizon), steps_(steps), gravity_(gravityOf(scene))
		{
			std::map<const Material*, bool> known; // bodies are many, materials few
			for (const auto& body : *scene.bodies) {
				if (!body || !body->material || !body->shape || !body->state || body->isClump()) continue;
				const auto* const polytope = polytopeOf(*body);
				if (polytope && !polytope->faceMaterials.empty()) {
					if (!closingMaterialsOf(*body, scene).empty()) closing_.push_back(body->id);
					continue;
				}
				const auto found = known.emplace(body->material.get(), false);
				if (found.second) found.first->second = !closingMaterialsOf(*body, scene).empty();
				if (found.first->second) closing_.push_back(body->id);
			}
		}

		bool none() const { return closing_.empty(); }

		/// Of contacts that there are.
		TimeStepLimit ofContacts() const
		{
			TimeStepLimit limit;
			for (const auto& contact : *scene_.interactions) {
				if (!contact->isReal() || !scene_.bodies->exists(contact->getId1())
				        || !scene_.bodies->exists(contact->getId2()))
					continue;
				const auto* const joint = dynamic_cast<const RockJointPhys*>(contact->phys.get());
				const auto* const geom  = dynamic_cast<const PolytopeGeom*>(contact->geom.get());
				if (!joint || !geom || !joint->laws.get() || joint->laws.get()->closure.isLinear()) continue;
				const Body &one = *(*scene_.bodies)[contact->getId1()], &other = *(*scene_.bodies)[contact->getId2()];
				const Real  closure = math::max(geom->closedBy(), Real(0));
				withPair(one, other, contact->cellDist, /*accelerated*/ false, [&](MovingPair& pair) {
					limit.take(pair.step(joint->laws.get()->closure, closure, true, horizon_, steps_),
					        limitedOf(one, other));
				});
			}
			return limit;
		}

		/// Of bodies that will touch.
		TimeStepLimit ofBodiesApart(Real below) const
		{
			std::map<Body::id_t, Real> ways; // of movers
			for (const Body::id_t id : closing_) {
				const Body& body  = *(*scene_.bodies)[id];
				const auto  sides = closingMaterialsOf(body, scene_);
				const auto  known = ways.emplace(moverOf(body, scene_).id, unlimited).first;
				forLaws(sides, sides, [&](const polytope::ClosureLaw& law) {
					known->second = math::min(known->second, polytope::closingWay(law, 0, sizeOf(body)));
				});
			}
			std::vector<polytope::MovingBox> boxes;
			for (const auto& known : ways) {
				boxes.push_back(movingBoxOf(*(*scene_.bodies)[known.first], scene_));
				boxes.back().radius = known.second;
			}
			const auto    nearest = polytope::approachLimit(std::move(boxes), 1, horizon_, gravity_.norm() * horizon_, below,
			           [&](int id1, int id2) { return stepOfMovers(*(*scene_.bodies)[id1], *(*scene_.bodies)[id2]); });
			TimeStepLimit limit;
			limit.take(nearest.step, nearest.id);
			return limit;
		}

	private:
		static Real sizeOf(const Body& body)
		{
			const Real radius = familyOf(*body.shape).inscribedRadius(*body.shape);
			return radius < unlimited ? radius : Real(1);
		}

		Body::id_t limitedOf(const Body& one, const Body& other) const
		{
			const Body& mover = moverOf(one, scene_);
			return isMovedByForces(mover) ? mover.id : moverOf(other, scene_).id;
		}

		Real stepOfMovers(const Body& mover1, const Body& mover2) const
		{
			TimeStepLimit limit;
			forParts(mover1, scene_, [&](const Body& one) {
				const auto sides1 = closingMaterialsOf(one, scene_);
				if (sides1.empty()) return;
				forParts(mover2, scene_, [&](const Body& other) {
					const auto& contact = scene_.interactions->find(one.id, other.id);
					if (contact && contact->isReal()) return;
					const auto sides2 = closingMaterialsOf(other, scene_);
					if (sides2.empty()) return;
					withPair(one, other, Vector3i::Zero(), /*accelerated*/ true, [&](MovingPair& pair) {
						forLaws(sides1, sides2, [&](const polytope::ClosureLaw& law) {
							limit.take(pair.step(law, 0, false, horizon_, steps_), one.id);
						});
					});
				});
			});
			return limit.step;
		}

		Course courseOf(const Body& body, const Vector3i& cells, bool accelerated) const
		{
			const Body&    mover = moverOf(body, scene_);
			const Vector3r shift = placeByCells(scene_, cells);
			Course         course;
			course.position     = body.state->pos + shift;
			course.rotation     = body.state->ori.toRotationMatrix();
			course.centre       = mover.state->pos + shift;
			course.velocity     = velocityByCells(scene_, cells, mover.state->vel);
			course.spin         = mover.state->angVel;
			course.acceleration = accelerated ? accelerationOf(mover, gravity_, scene_) : Vector3r(Vector3r::Zero());
			return course;
		}

		/// Calls use(pair) where both bodies are half-spaces, or have some that stand for them.
		template <class Use>
		void withPair(const Body& one, const Body& other, const Vector3i& cells, bool accelerated, const Use& use) const
		{
			const polytope::ConvexShape* const shape1 = convexShapeOf(one);
			const polytope::ConvexShape* const shape2 = convexShapeOf(other);
			if (!shape1 && !shape2) return;
			if (!shape2) return withPair(other, one, -cells, accelerated, use);
			const MovingShape moving2 { *shape2, courseOf(other, cells, accelerated) };
			Course            course1 = courseOf(one, Vector3i::Zero(), accelerated);
			StandIn           standIn;
			if (const auto* const box = dynamic_cast<const Box*>(one.shape.get()))
				standForBox(*box, shape2->cornerRadius(), standIn);
			if (const auto* const wall = dynamic_cast<const Wall*>(one.shape.get()); wall && wall->axis < shape2->dimension()) {
				const Vector3r outward = outwardOf(*wall, moving2.course.position - course1.position);
				standIn.partner        = polytope::shapeOrNull(
                                        [&] { return polytope::ConvexShape::halfSpace(outward, shape2->dimension()); });
				course1.position = footOn(*wall, course1.position, moving2.course.position);
				course1.rotation = Matrix3r::Identity();
				course1.centre   = course1.position;
				course1.spin     = Vector3r::Zero();
			}
			if (!shape1 && !standIn.partner) return;
			const MovingShape moving1 { shape1 ? *shape1 : *standIn.partner, course1 };
			if (moving1.shape.dimension() != shape2->dimension()) return;
			MovingPair pair(moving1, moving2);
			use(pair);
		}

		Scene&                  scene_;
		const Real              horizon_, steps_;
		const Vector3r          gravity_;
		std::vector<Body::id_t> closing_;
	};

} // namespace

TimeStepLimit closingLimit(Scene& scene, Real below, Real steps)
{
	if (!(below < unlimited)) return {};
	const ClosingJoints joints(scene, below * steps, steps);
	if (joints.none()) return {};
	TimeStepLimit limit = joints.ofContacts();
	if (scene.isPeriodic || isDivided(scene)) return limit;
	const TimeStepLimit apart = joints.ofBodiesApart(math::min(below, limit.step));
	limit.take(apart.step, apart.body);
	return limit;
}

} // namespace yade
