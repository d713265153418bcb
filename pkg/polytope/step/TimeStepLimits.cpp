// SPDX-License-Identifier: GPL-2.0-or-later
#include "step/TimeStepLimits.hpp"

#include <src/contact/OverlapFootprint.hpp>
#include <src/numbers/PlaneAxes.hpp>
#include <src/shear/ContactOutline.hpp>
#include <src/timestep/RockingStiffness.hpp>
#include <src/timestep/TimeStepTolerances.hpp>

#include "contact/PolytopeGeom.hpp"
#include "host/InteractionLoops.hpp"
#include "host/PeriodOfPair.hpp"
#include "host/SpringsOfScene.hpp"
#include "joint/RockJointDampers.hpp"
#include "joint/RockJointLaw.hpp"
#include "joint/RockJointPhys.hpp"
#include "shape/ShapeOfBody.hpp"

#include <optional>

namespace yade {

polytope::Mobility mobilityOf(const Body& body)
{
	const State&       state = *body.state;
	polytope::Mobility mobility;
	if (!isMovedByForces(body)) return mobility;
	const auto root = [](Real inertia) { return inertia > 0 ? 1 / math::sqrt(inertia) : Real(0); };
	for (int k = 0; k < 3; ++k) {
		if (!(state.blockedDOFs & State::axisDOF(k, false))) mobility.translation[k] = root(state.mass);
		if (!(state.blockedDOFs & State::axisDOF(k, true))) mobility.rotation(k, k) = root(state.inertia[k]);
	}
	if (turnsAboutOwnAxes(body)) mobility.rotation = Matrix3r(state.ori.toRotationMatrix() * mobility.rotation);
	return mobility;
}

const Law2_PolytopeGeom_RockJointPhys_MohrCoulomb* dampingLaw(const Scene& scene)
{
	return firstFunctor<const Law2_PolytopeGeom_RockJointPhys_MohrCoulomb>(scene, &InteractionLoop::lawDispatcher);
}

namespace {

	/// One contact as the scene has it.
	struct PairInScene {
		const Scene&                 scene;
		const Body &                 body1, &body2;
		const GenericSpheresContact& geom;
		const NormShearPhys&         phys;
		Vector3r                     shift2, shiftVelocity; ///< of body 2's period

		const Body& mover(const Body& body) const { return moverOf(body, scene); }
		/// Contacts are those of before the bodies' last move: the point goes along with them, or a body in a tray that moves fast would have a long arm.
		Vector3r point() const
		{
			return geom.contactPoint + scene.dt / 2 * (mover(body1).state->vel + mover(body2).state->vel + shiftVelocity);
		}
		/// Vector from the centre of what moves to the contact point.
		Vector3r arm(const Body& body) const
		{
			return point() - mover(body).state->pos - (&body == &body2 ? shift2 : Vector3r(Vector3r::Zero()));
		}
	};

	Matrix3r across(const Vector3r& normal) { return Matrix3r::Identity() - normal * normal.transpose(); }

	/// Moment per tilt of a force over the area seen along the normal.
	Matrix3r rockingOfOverlap(const std::vector<polytope::Plane>& planes, const PolytopeGeom& geom, Real reach, int dimension, Real kn)
	{
		const polytope::OverlapFootprint seen = polytope::overlapFootprint(planes, geom.normal, reach, dimension);
		if (!(seen.area > 0)) return Matrix3r::Zero();
		return kn * polytope::rockingOfFaces(seen.second / seen.area, geom.normal, geom.faceForce());
	}

	/// Moment per tilt of bodies with margins, whose half-spaces are apart: that of the faces that lie on each other (src/contact/SpreadContact.hpp).
	Matrix3r rockingOfOutline(const PolytopeGeom& geom, Real kn)
	{
		const auto seen = polytope::momentsOf(geom.outline.corners(), geom.outline.count());
		if (!(seen.area > 0)) return Matrix3r::Zero();
		const Matrix3r second = polytope::PlaneAxes(geom.normal).inSpace(seen.second);
		return kn * polytope::rockingOfFaces(second / seen.area, geom.normal, polytope::FaceForce::Spring);
	}

	bool hasMargin(const Body& body)
	{
		const Polytope* const shape = polytopeOf(body);
		return shape && shape->margin().value_or(0) > 0;
	}

	/// Moment per tilt of the bodies.
	Matrix3r rockingStiffness(const PairInScene& pair, const PolytopeGeom& geom)
	{
		if (hasMargin(pair.body1) || hasMargin(pair.body2)) return rockingOfOutline(geom, pair.phys.kn);
		const Real                   elastic = pair.phys.kn * math::max(geom.closedBy(), Real(0));
		const Real                   force   = math::max(elastic, pair.phys.normalForce.dot(geom.normal));
		const polytope::ConvexShape* shape1  = geom.standIn.get() ? geom.standIn.get()->partner.get() : convexShapeOf(pair.body1);
		const polytope::ConvexShape* shape2  = convexShapeOf(pair.body2);
		if (!shape1 || !shape2 || !(geom.closedBy() > 0 && force > 0)) return Matrix3r::Zero(); // a sphere's point stays
		const State &  state1 = *pair.body1.state, &state2 = *pair.body2.state;
		const bool     wall      = !(shape1->boundingRadius() < std::numeric_limits<Real>::infinity()); // in the world's axes
		const Matrix3r rotation1 = wall ? Matrix3r(Matrix3r::Identity()) : Matrix3r(state1.ori.toRotationMatrix()),
		               rotation2 = state2.ori.toRotationMatrix();
		// from the contact point, and so much nearer as dilation holds them apart
		const Vector3r              point = pair.point(), nearer = geom.widening() / 2 * geom.normal;
		const polytope::PlacedShape body1 { *shape1, state1.pos - point + nearer, rotation1 },
		        body2 { *shape2, state2.pos + pair.shift2 - point - nearer, rotation2 };
		if (geom.faceForce() != polytope::FaceForce::AtCentre) {
			std::vector<polytope::Plane> planes;
			polytope::addPlanesOf(body1, planes);
			polytope::addPlanesOf(body2, planes);
			return rockingOfOverlap(planes, geom, 2 * shape2->boundingRadius(), shape2->dimension(), pair.phys.kn);
		}
		return force * polytope::rockingArms(body1, body2, geom.normal, geom.closedBy());
	}

	void addDampers(const PairInScene& pair, const RockJointPhys& phys, const Law2_PolytopeGeom_RockJointPhys_MohrCoulomb& law,
	        polytope::ContactSprings& springs)
	{
		const Real inverse = inverseDampedMass(pair.body1, pair.body2, pair.geom.normal, phys, law.stiffnessSums, pair.scene);
		if (!(inverse > 0)) return;
		const Real normal    = criticalDamper(phys.kn, inverse);
		springs.normalDamper = law.normalDamping * normal;
		springs.shearDamper  = law.shearDamping * criticalDamper(phys.ks, inverse);
		if (phys.ks > 0) springs.twistingDamper = springs.shearDamper * phys.twistingStiffness / phys.ks;
		if (law.rockingDamping > 0)
			springs.rockingDamper = law.rockingDamping * normal * rockingGyrationSquared(pair.body1, pair.body2, phys)
			        * across(pair.geom.normal);
	}

	using AllSprings = std::vector<const HasSprings*>;

	bool hasContacts(const Body& body, const Scene& scene, const AllSprings& others)
	{
		bool has = false;
		forParts(body, scene, [&](const Body& part) {
			for (const HasSprings* other : others)
				has = has || other->holds(part.id);
			for (const auto& known : part.intrs)
				has = has || known.second->isReal();
		});
		return has;
	}

	/// Adds all bonds or bolts of a body, or of a member of a clump. `centre`: that of what moves.
	void addSprings(polytope::BodyStiffness& sum, const Body& part, const Vector3r& centre, const HasSprings& other)
	{
		other.forSpringsOf(part, [&](const SpringsAtPoint& at) {
			polytope::ContactSprings springs;
			springs.normal           = at.normal;
			springs.normalStiffness  = at.normalStiffness;
			springs.shearStiffness   = at.shearStiffness;
			springs.rockingStiffness = at.rotationStiffness;
			sum.add(springs, at.point - centre);
		});
	}

	/// All contacts, bonds and bolts of a body (or of a clump's members).
	polytope::BodyStiffness stiffnessOf(const Body& body, const polytope::Mobility& mobility, const Scene& scene,
	        const Law2_PolytopeGeom_RockJointPhys_MohrCoulomb* law, const AllSprings& others)
	{
		polytope::BodyStiffness sum(mobility);
		forParts(body, scene, [&](const Body& part) {
			for (const HasSprings* other : others)
				addSprings(sum, part, body.state->pos, *other);
			for (const auto& known : part.intrs) {
				const Interaction& contact = *known.second;
				if (!contact.isReal() || !scene.bodies->exists(contact.getId1()) || !scene.bodies->exists(contact.getId2()))
					continue;
				const auto* geom = dynamic_cast<const GenericSpheresContact*>(contact.geom.get());
				const auto* phys = dynamic_cast<const NormShearPhys*>(contact.phys.get());
				if (!geom || !phys) continue;
				const PairInScene pair { scene, *(*scene.bodies)[contact.getId1()], *(*scene.bodies)[contact.getId2()],
					*geom, *phys, placeByCells(scene, contact.cellDist), velocityByCells(scene, contact.cellDist) };
				polytope::ContactSprings springs;
				springs.normal          = geom->normal;
				springs.normalStiffness = phys->kn;
				springs.shearStiffness  = phys->ks;
				if (const auto* ours = dynamic_cast<const PolytopeGeom*>(geom)) {
					const auto* joint        = dynamic_cast<const RockJointPhys*>(phys);
					springs.rockingStiffness = joint && joint->bond
					        ? joint->bond->rotationStiffness(
					                  (pair.body1.state->ori * joint->bond->frame1).toRotationMatrix())
					        : rockingStiffness(pair, *ours);
					if (joint && joint->twistingStiffness > 0) {
						springs.twistingStiffness = joint->twistingStiffness;
						springs.shearOffset       = joint->shearPoint - geom->contactPoint;
					}
					if (joint && law) addDampers(pair, *joint, *law, springs);
				}
				sum.add(springs, pair.arm(part));
			}
		});
		return sum;
	}

	/// What each body that forces move has of contacts, bonds and bolts.
	class StiffnessOfBodies {
	public:
		explicit StiffnessOfBodies(const Scene& scene) : scene_(scene), law_(dampingLaw(scene)), others_(springsOf(scene)) { }

		long count() const { return long(scene_.bodies->size()); }
		/// None for a body that has no contact, or cannot move.
		std::optional<polytope::BodyStiffness> of(long id) const
		{
			const Body* const body = (*scene_.bodies)[Body::id_t(id)].get();
			if (!body || !isMovedByForces(*body) || !hasContacts(*body, scene_, others_)) return std::nullopt;
			const auto mobility = mobilityOf(*body);
			if (!mobility.moves()) return std::nullopt;
			return stiffnessOf(*body, mobility, scene_, law_, others_);
		}

	private:
		const Scene&                                             scene_;
		const Law2_PolytopeGeom_RockJointPhys_MohrCoulomb* const law_;
		const AllSprings                                         others_;
	};

} // namespace

ContactLimit contactLimit(const Scene& scene, Real below)
{
	const StiffnessOfBodies bodies(scene);
	const long              count = bodies.count();
	ContactLimit            limit;
#pragma omp parallel
	{
		ContactLimit own;
#pragma omp for schedule(static) nowait
		for (long id = 0; id < count; ++id) {
			const auto stiffness = bodies.of(id);
			// most bodies are not the limiting one: bounds of the eigenvalues are cheap, and exclude them
			if (!stiffness
			        || polytope::safeTimeStep(stiffness->stiffnessAtMost(), stiffness->dampingAtMost())
			                > math::min(below, own.step))
				continue;
			const Real all  = stiffness->stiffness();
			const Real step = polytope::safeTimeStep(all, stiffness->damping());
			if (step > below) continue;
			own.take(step, Body::id_t(id));
			if (own.body == Body::id_t(id))
				own.rocking = stiffness->stiffness(/*rocking*/ false) < (1 - polytope::tolerance::rockingShare) * all;
		}
#pragma omp critical(polytopeContactLimit)
		if (own.step < limit.step || (own.step == limit.step && own.body < limit.body)) limit = own;
	}
	return limit;
}

std::vector<Real> contactSteps(const Scene& scene)
{
	const StiffnessOfBodies bodies(scene);
	std::vector<Real>       steps(scene.bodies->size(), std::numeric_limits<Real>::infinity());
	const long              count = bodies.count();
#pragma omp parallel for schedule(static)
	for (long id = 0; id < count; ++id)
		if (const auto stiffness = bodies.of(id))
			steps[std::size_t(id)] = polytope::safeTimeStep(stiffness->stiffness(), stiffness->damping());
	return steps;
}

} // namespace yade
