// SPDX-License-Identifier: GPL-2.0-or-later
#include "step/PotentialContacts.hpp"

#include <lib/high-precision/Constants.hpp>
#include <pkg/dem/FrictPhys.hpp>

#include <src/shape/Rings.hpp>
#include <src/timestep/RockingStiffness.hpp>
#include <src/timestep/TimeStepTolerances.hpp>

#include "contact/ContactSizes.hpp"
#include "contact/Ig2_Polytope_Polytope_PolytopeGeom.hpp"
#include "host/InteractionLoops.hpp"
#include "joint/Ip2_RockJointMat_RockJointMat_RockJointPhys.hpp"
#include "joint/RockJointDampers.hpp"
#include "joint/RockJointLaw.hpp"
#include "material/RockJointMat.hpp"
#include "material/StiffnessRules.hpp"
#include "shape/ShapeFamily.hpp"
#include "shape/ShapeOfBody.hpp"

namespace yade {

namespace {

	Real largestFace(const polytope::ConvexShape& shape)
	{
		const auto& hull = shape.polyhedron();
		Real        area = 0;
		for (std::size_t k = 0; k < hull.faces.size(); ++k)
			if (hull.planeOfFace[k] >= 0) area = math::max(area, Real(polytope::faceArea(hull, k).norm()));
		return area;
	}

	/// κ of a contact of stiffness 1 with a half-space on a whole face, rocking and twisting included. `second`: ∫ r rᵀ dA / A of the face.
	Real unitOfFace(const polytope::ConvexShape& shape, const Matrix3r& axes, const Vector3r& normal, const Vector3r& middle,
	        const Vector3r& centre, const polytope::Mobility& mobility, const Matrix3r& second, polytope::FaceForce force)
	{
		const Real               depth = polytope::tolerance::potentialDepth * shape.inscribedRadius();
		const Vector3r           point = middle - depth / 2 * normal; // from the part's centre
		polytope::ContactSprings springs;
		springs.normal          = -normal;
		springs.normalStiffness = springs.shearStiffness = 1;
		if (shape.dimension() == 3) springs.twistingStiffness = second.trace();
		if (force != polytope::FaceForce::AtCentre) springs.rockingStiffness = polytope::rockingOfFaces(second, normal, force);
		else {
			const auto floor         = polytope::ConvexShape::halfSpace(-normal, shape.dimension());
			springs.rockingStiffness = depth
			        * polytope::rockingArms({ *floor, normal * depth / 2, Matrix3r::Identity() }, { shape, -point, axes },
			                springs.normal, depth);
		}
		polytope::BodyStiffness sum(mobility);
		sum.add(springs, centre + point);
		return sum.stiffness();
	}

	/// What the normal force depends on in the scene's contacts. With YADE's own physics, whose stiffness may be any, it is the depth at the analytic
	/// centre in place of a pressure, so that no less stiffness is taken than there.
	polytope::FaceForce faceForce(const Scene& scene, StiffnessRule rule)
	{
		using polytope::FaceForce;
		const FaceForce found = Ig2_Polytope_Polytope_PolytopeGeom::orDefault(scene).faceForce(rule);
		return found == FaceForce::Pressure && rule == StiffnessRule::Unknown ? FaceForce::AtCentre : found;
	}

	/// The size, rounded up to the next power of tolerance::potentialSizes: a functor is then called once for all sizes in between.
	Real roundedUp(Real size)
	{
		if (!(size > 0)) return size;
		const Real step = math::log(Real(polytope::tolerance::potentialSizes));
		return math::exp(step * math::ceil(math::log(size) / step));
	}

	/// Initial stiffness of a joint's own normal law over the material's normalStiffness, where it is above 1; else 1.
	Real initialTangent(const NormShearPhys& phys)
	{
		const auto* const joint = dynamic_cast<const RockJointPhys*>(&phys);
		return joint && joint->laws.get() ? math::max(Real(1), joint->laws.get()->closure.initialTangent()) : Real(1);
	}

	/// Stiffnesses that an Ip2 functor gives a pair, or where it cannot be called without a real contact, those of elastic bodies.
	template <class Stiffness>
	Stiffness answer(
	        Scene& scene, shared_ptr<Material> material1, shared_ptr<Material> material2, const shared_ptr<Interaction>& contact)
	{
		const auto found = findInLoops(scene, [&](InteractionLoop& loop) -> std::optional<Stiffness> {
			bool       swap    = false;
			const auto functor = loop.physDispatcher->getFunctor2D(material1, material2, swap);
			if (!functor) return std::nullopt;
			if (const auto* giver = dynamic_cast<const GivesJointStiffness*>(functor.get())) {
				const auto* const geom  = dynamic_cast<const PolytopeGeom*>(contact->geom.get());
				const auto&       size  = static_cast<const ScGeom&>(*contact->geom);
				const auto        known = giver->stiffnesses(
                                        *material1, *material2, geom ? geom->contactArea : Real(0), size.refR1, size.refR2);
				if (known) return Stiffness { known->normal, known->shear };
			}
			auto* joints = dynamic_cast<Ip2_RockJointMat_RockJointMat_RockJointPhys*>(functor.get());
			if (joints || dynamic_cast<Ip2_FrictMat_FrictMat_FrictPhys*>(functor.get())) {
				functor->scene = &scene;
				if (joints) // which face they will lie on is not known
					joints->make(static_cast<const RockJointMat&>(*material1),
					        static_cast<const RockJointMat&>(*material2), contact);
				else functor->go(material1, material2, contact);
				if (const auto* phys = dynamic_cast<const NormShearPhys*>(contact->phys.get()))
					return Stiffness { phys->kn * initialTangent(*phys), phys->ks };
			}
			const auto *elastic1 = dynamic_cast<const ElastMat*>(material1.get()),
			           *elastic2 = dynamic_cast<const ElastMat*>(material2.get());
			if (!elastic1 || !elastic2) return std::nullopt;
			const auto& geom = static_cast<const ScGeom&>(*contact->geom);
			const Real  k    = stiffnessInSeries(elastic1->young * geom.refR1, elastic2->young * geom.refR2);
			return Stiffness { k, k };
		});
		return found.value_or(Stiffness {});
	}

} // namespace

void PotentialContacts::collect(const Scene& scene)
{
	partners_.clear();
	asked_.clear();
	std::map<const Material*, std::size_t> known;
	const Body*                            last     = nullptr; // consecutive bodies are often of one kind
	Real                                   lastArea = 0;
	std::size_t                            index    = 0;
	for (const auto& body : *scene.bodies) {
		if (!body || !body->material || !body->shape || body->isClump()) continue;
		if (!last || last->material != body->material) {
			const auto found = known.emplace(body->material.get(), partners_.size());
			if (found.second) partners_.push_back({ body->material });
			index = found.first->second;
		}
		Partners& partners                                 = partners_[index];
		(partners.one < 0 ? partners.one : partners.other) = body->id;
		const Real size                                    = sizeIfMoved(*body, scene);
		partners.size                                      = math::max(partners.size, size);
		partners.asLarge                                   = partners.asLarge || !(size > 0);
		if (const auto* polytope = polytopeOf(*body)) {
			partners.polytopes     = true;
			const Polytope* before = last ? polytopeOf(*last) : nullptr;
			if (!before || before->convex() != polytope->convex()) lastArea = largestFace(*polytope->convex());
			partners.area += lastArea;
		} else if (!familyOf(*body->shape).isRound(*body->shape)) {
			partners.area = std::numeric_limits<Real>::max(); // walls and their like
		}
		last = body.get();
	}
}

const PotentialContacts::Part& PotentialContacts::partOf(const Body& body, const Body& mover)
{
	const auto*    polytope = polytopeOf(body);
	const State &  state = *body.state, &moving = *mover.state;
	const void*    shape  = polytope ? static_cast<const void*>(polytope->convex().get()) : body.shape.get();
	const Vector3r centre = &body == &mover ? Vector3r(Vector3r::Zero()) : Vector3r(state.pos - moving.pos);
	Part           part { shape, moving.mass, moving.inertia, moving.blockedDOFs, centre.norm(), sizeOf(*body.shape), {}, {} };
	Part&          known = parts_[body.id];
	if (polytope && known.isOf(part)) return known; // other shapes may change their size
	if (body.id > 0 && &body == &mover && parts_[body.id - 1].isOf(part)) return known = parts_[body.id - 1]; // bodies of a kind

	const auto mobility = mobilityOf(mover);
	if (!polytope) {
		const Real radius = familyOf(*body.shape).boundingRadius(*body.shape);
		part.vertex       = { polytope::reachOfBall(mobility, centre, radius), Mathr::PI * radius * radius };
		return known      = part;
	}
	const auto&    convex = *polytope->convex();
	const auto&    hull   = convex.polyhedron();
	const Matrix3r axes   = state.ori.toRotationMatrix();
	const Real     margin = polytope->margin().value_or(0);
	for (const Vector3r& vertex : hull.vertices) {
		const Vector3r place = axes * vertex;
		part.vertex.unit = math::max(part.vertex.unit, polytope::reachOf(mobility, centre + place + margin * place.normalized()));
	}
	std::array<Real, 3> worst { { 0, 0, 0 } };
	for (std::size_t k = 0; k < hull.faces.size(); ++k) {
		if (hull.planeOfFace[k] < 0) continue; // a polygon's caps
		const Vector3r area = polytope::faceArea(hull, k), outward = axes * area.normalized();
		Vector3r       middle = Vector3r::Zero();
		for (int vertex : hull.faces[k])
			middle += axes * hull.vertices[vertex] / Real(hull.faces[k].size());
		const auto     moments = polytope::faceMoments(hull, k, area.normalized(), axes.transpose() * middle);
		const Matrix3r second  = axes * (moments.second / moments.zeroth) * axes.transpose();
		for (std::size_t force = 0; force < part.face.size(); ++force) {
			const Place place { unitOfFace(convex, axes, outward, middle + margin * outward, centre, mobility, second,
				                    polytope::FaceForce(force)),
				area.norm() };
			if (!(place.unit * place.area > worst[force])) continue;
			worst[force]     = place.unit * place.area;
			part.face[force] = place;
		}
	}
	return known = part;
}

const PotentialContacts::Stiffness& PotentialContacts::stiffness(
        const Body& part, Real partOwnSize, Partners& partners, const Place& place, Scene& scene)
{
	const bool polytopes = partners.polytopes || polytopeOf(part);
	// that of a part without a size is its partner's; YADE takes more than a sphere's own radius for what the sphere lies on
	const Real own     = partOwnSize > 0 ? partOwnSize : partners.size;
	const Real asLarge = !partners.asLarge ? Real(0) : polytopes ? own : polytope::tolerance::potentialPartner * own;
	const Real size = roundedUp(own), other = roundedUp(math::max(partners.size, asLarge)),
	           area = roundedUp(math::min(place.area, partners.area));
	const Key  key { part.material.get(), partners.material.get(), polytopes, size, area };
	const auto found = asked_.find(key);
	if (found != asked_.end()) return found->second;

	auto geom    = polytopes ? shared_ptr<ScGeom>(new PolytopeGeom) : shared_ptr<ScGeom>(new ScGeom);
	geom->normal = Vector3r::UnitZ();
	geom->refR1  = size;
	geom->refR2  = other;
	if (polytopes) static_cast<PolytopeGeom&>(*geom).contactArea = area;
	const auto contact = shared_ptr<Interaction>(new Interaction(part.id, partners.one == part.id ? partners.other : partners.one));
	contact->geom      = geom;
	return asked_[key] = answer<Stiffness>(scene, part.material, partners.material, contact);
}

template <class Visit> void PotentialContacts::forSteps(Scene& scene, const Visit& visit)
{
	collect(scene);
	parts_.resize(scene.bodies->size());
	const auto* law     = dampingLaw(scene);
	const Real  damping = law ? math::max(law->normalDamping, law->shearDamping) : Real(0);
	const Body* last    = nullptr;
	Real        ofLast  = 0;
	for (const auto& body : *scene.bodies) {
		if (!body || !isMovedByForces(*body) || body->state->blockedDOFs == State::DOF_ALL) continue;
		forParts(*body, scene, [&](const Body& part) {
			if (!part.material || !part.shape || part.isClump()) return;
			const Part& places = partOf(part, *body);
			if (&part == body.get()) { // members of a clump have different orientations
				if (last && last->material == part.material && places.isOf(parts_[last->id]))
					return visit(ofLast, body->id);
				last = &part;
			}
			Real step = std::numeric_limits<Real>::infinity();
			for (Partners& partners : partners_) {
				if (partners.one == part.id && partners.other < 0) continue; // no body but itself
				const auto force = faceForce(scene, stiffnessRuleOfNew(scene, *part.material, *partners.material));
				for (const Place& place : { places.vertex, places.face[std::size_t(force)] }) {
					if (!(place.unit > 0)) continue;
					const Stiffness& stiff  = stiffness(part, places.size, partners, place, scene);
					const Real       k      = math::max(stiff.normal, stiff.shear);
					const Real       damper = damping * criticalDamper(k, 1 / body->state->mass);
					const Real       own    = polytope::safeTimeStep(k * place.unit, damper * place.unit);
					if (own > 0) step = math::min(step, own);
				}
			}
			if (&part == body.get()) ofLast = step;
			visit(step, body->id);
		});
	}
}

TimeStepLimit PotentialContacts::limit(Scene& scene)
{
	TimeStepLimit limit;
	forSteps(scene, [&](Real step, Body::id_t id) { limit.take(step, id); });
	return limit;
}

std::vector<Real> PotentialContacts::steps(Scene& scene)
{
	std::vector<Real> steps(scene.bodies->size(), std::numeric_limits<Real>::infinity());
	forSteps(scene, [&](Real step, Body::id_t id) { steps[std::size_t(id)] = math::min(steps[std::size_t(id)], step); });
	return steps;
}

} // namespace yade
