// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact/PolytopeGeomFunctor.hpp"

#include <src/program/PlaneCode.hpp>
#include <src/shape/CheckedNumbers.hpp>

#include <core/Omega.hpp>
#include <core/Scene.hpp>
#include <pkg/common/ElastMat.hpp>

#include "contact/ContactSizes.hpp"
#include "contact/FollowedContact.hpp"
#include "contact/Ig2_Polytope_Polytope_PolytopeGeom.hpp"
#include "contact/InternalFaces.hpp"
#include "contact/SearchDue.hpp"
#include "contact/StiffnessShare.hpp"
#include "host/ExactClass.hpp"
#include "host/PeriodOfPair.hpp"
#include "host/Prefetch.hpp"
#include "material/RockJointMat.hpp"

#include <boost/make_shared.hpp>

namespace yade {

POLYTOPE_CLASSES((PolytopeGeomFunctor));

namespace {

	/// A body's stiffness as it enters the weights of the normals.
	Real stiffnessOf(const Body* body)
	{
		if (!body || !body->material) return 1;
		if (const auto* joint = dynamic_cast<const RockJointMat*>(body->material.get())) return joint->normalStiffness;
		if (const auto* elastic = dynamic_cast<const ElastMat*>(body->material.get())) return elastic->young;
		return 1;
	}

	/// Whether all codes of internal faces are those of planes that the bodies have: a body whose shape was exchanged must not be read beyond
	/// its planes.
	bool fit(const std::vector<int>& codes, const polytope::ConvexShape& convex1, const polytope::ConvexShape& convex2)
	{
		for (int code : codes)
			if (code < 0 || polytope::planeOfCode(code) >= (polytope::bodyOfCode(code) ? convex2 : convex1).planeCount())
				return false;
		return true;
	}

} // namespace

Real normalWeightOfFirst(const Body* body1, const Body* body2)
{
	const Real k1 = stiffnessOf(body1), k2 = stiffnessOf(body2);
	return k1 > 0 && k2 > 0 && math::isfinite(k1 + k2) ? k1 / (k1 + k2) : Real(0.5);
}

const Ig2_Polytope_Polytope_PolytopeGeom& PolytopeGeomFunctor::ofScene() const
{
	return Ig2_Polytope_Polytope_PolytopeGeom::orDefault(settings_.in(*scene));
}

polytope::ContactOptions PolytopeGeomFunctor::options(StiffnessRule rule) const
{
	polytope::ContactOptions options = ofScene().options(rule);
	options.energy                   = options.energy || scene->trackEnergy;
	return options;
}

void PolytopeGeomFunctor::refuse(const std::string& name) const
{
	polytope::refuse(name + ": " + getClassName()
	        + " has no settings of its own; set it in the scene's Ig2_Polytope_Polytope_PolytopeGeom, for all contacts");
}

void PolytopeGeomFunctor::pyHandleCustomCtorArgs(boost::python::tuple&, boost::python::dict& named)
{
	for (const char* name : names)
		if (named.has_key(name)) refuse(name);
}

boost::python::object PolytopeGeomFunctor::settingOfScene(const char* name) const
{
	const auto& settings = Ig2_Polytope_Polytope_PolytopeGeom::orDefault(*Omega::instance().getScene());
	return boost::python::object(boost::python::ptr(&settings)).attr(name);
}

bool PolytopeGeomFunctor::goReverse(const shared_ptr<Shape>& shape1, const shared_ptr<Shape>& shape2, const State& state1,
        const State& state2, const Vector3r& shift2, const bool& force, const shared_ptr<Interaction>& c)
{
	c->swapOrder();
	return go(shape2, shape1, state2, state1, -shift2, force, c);
}

PolytopeGeom& PolytopeGeomFunctor::geometry(const shared_ptr<Interaction>& c)
{
	if (!c->geom) {
		auto geom          = boost::make_shared<PolytopeGeom>(); // with its counts in one piece of memory
		geom->normalWeight = normalWeightOfFirst(Body::byId(c->getId1(), scene).get(), Body::byId(c->getId2(), scene).get());
		c->geom            = geom;
	}
	return static_cast<PolytopeGeom&>(*c->geom);
}

bool PolytopeGeomFunctor::isApart(const polytope::PlacedPair& pair, polytope::ContactWorkspace& workspace, const Interaction& c)
{
	polytope::PairMemory      memory   = candidates_.recall(c, scene->iter);
	polytope::ContactSettings settings = this->settings(StiffnessRule::Unknown);
	settings.programAlone              = hasSurface(settings.contactModel);
	polytope::ContactResult result;
	polytope::contactQuery(pair, settings, memory, workspace, result);
	candidates_.remember(c, scene->iter, memory);
	if (result.inContact) return false;
	count(result);
	return true;
}

namespace {

	/// What a contact's geometry has elsewhere in memory is needed soon.
	void fetchParts(const Interaction& contact)
	{
		const auto* const geom = exactly<PolytopeGeom>(contact.geom.get());
		if (!geom) return;
		if (const auto* const linear = geom->linear.get()) prefetch::fetch(linear, sizeof(LinearOfContact));
		else prefetch::fetch(&geom->surface, sizeof(StoredVertices));
		prefetch::fetch(geom->outline.corners(), std::size_t(geom->outline.count()) * sizeof(polytope::Vector2));
	}

	/// How much nearer than it is body 2 counts as: by what dilation holds the joint apart, along the last normal [m]. The law's newest dilation holds
	/// from now on.
	Vector3r takeDilation(const Interaction& contact)
	{
		auto* const geom = static_cast<PolytopeGeom*>(contact.geom.get());
		if (!geom || !geom->widened.get()) return Vector3r::Zero();
		WideningOfJoint& widened = *geom->widened.get();
		widened.present          = widened.next;
		return -widened.present * geom->normal;
	}

	MotionInStep motionAt(const PolytopeGeom& geom, const State& state1, const State& state2, const Vector3r& shift2,
	        const Scene& scene, const Interaction& c)
	{
		const Vector3r arm1 = geom.contactPoint - state1.pos, arm2 = geom.contactPoint - state2.pos - shift2;
		const Vector3r centres = velocityByCells(scene, c.cellDist, state2.vel - state1.vel);
		return { (centres + state2.angVel.cross(arm2) - state1.angVel.cross(arm1)) * scene.dt,
			(state2.angVel - state1.angVel) * scene.dt };
	}

} // namespace

polytope::ContactSettings PolytopeGeomFunctor::settings(
        const polytope::ContactOptions& options, const PolytopeGeom& geom, bool wasReal, bool force) const
{
	polytope::ContactSettings settings(options);
	settings.section           = ofScene().computeArea || geom.needsArea || !wasReal; // a new contact's physics may need it now
	settings.outline           = hasSurface(options.contactModel) && (geom.needsArea || !wasReal);
	settings.normalWeight[0]   = geom.normalWeight;
	settings.normalWeight[1]   = 1 - geom.normalWeight;
	settings.geometryAcrossGap = wasReal || force;
	if (const ClosureOfJoint* const closure = geom.closure.get()) settings.closure = &closure->law;
	return settings;
}

bool PolytopeGeomFunctor::query(const polytope::ConvexShape& convex1, const Body1Frame& frame1, const polytope::ConvexShape& convex2,
        const State& state1, const State& state2, const Vector3r& shift2, const bool& force, const shared_ptr<Interaction>& c)
{
	prefetchAfter(*c, *scene, PolytopeGeom::bytesOfEachStep(), sizeof(Polytope));
	if (const Interaction* const next = prefetch::readable(*c, *scene)) fetchParts(*next);
	const KnowsBonds* const bonds = bonds_.in(*scene);
	if (bonds && bonds->joins(c->getId1(), c->getId2())) return false; // the bond acts in its place
	// a thread's own buffers; they grow to the largest pair it has computed
	static thread_local polytope::ContactWorkspace workspace;
	const bool                                     wasReal = c->isReal();
	if (convex1.dimension() != convex2.dimension()) return failed(c);
	const Vector3r             centre2   = state2.pos + shift2 - frame1.origin;
	const Vector3r             nearer    = centre2 + takeDilation(*c);
	const Matrix3r             rotation2 = state2.ori.toRotationMatrix();
	const polytope::PlacedPair pair { convex1, frame1.rotation, convex2, rotation2, nearer };
	if (!c->geom && !force && isApart(pair, workspace, *c)) return false;

	auto& geom = geometry(c);
	if (!wasReal) geom.stiffnessRule = std::int8_t(stiffnessRuleOfNew(*scene, *c));
	const polytope::ContactOptions options = this->options(StiffnessRule(geom.stiffnessRule));
	const bool                     surface = hasSurface(options.contactModel);
	geom.atOnePoint                        = !surface;

	FollowedContact followed(pair, options, wasReal, geom);
	const bool      turn     = isTurn(*c, *scene, polytope::tolerance::internalFacesEvery);
	const bool      due      = turn && (!followed.isKnown() || isTurn(*c, *scene, polytope::tolerance::internalFacesEveryFollowed));
	const bool      asPieces = surface && mayHaveInternalFaces(*Body::byId(c->getId1(), scene), *Body::byId(c->getId2(), scene));
	const bool      search   = asPieces && (due || !geom.internalKnown || !wasReal || changeOfBodies_.in(*scene));
	polytope::ContactResult result;
	if (!search && followed.take(result)) return write(result, frame1.origin, state1, state2, shift2, force, c);
	polytope::ContactSettings settings    = this->settings(options, geom, wasReal, force);
	const bool                afterSearch = search && followed.isKnown(); // the search needs a full query, the contact may not
	const MotionInStep        motion      = motionAt(geom, state1, state2, shift2, *scene, *c);
	if (!afterSearch) settings.linear = followed.begin(turn, motion);

	polytope::PairMemory memory = geom.memory();
	if (geom.internalFaces.get() && !fit(*geom.internalFaces.get(), convex1, convex2)) geom.setInternalPlanes({});
	polytope::InternalPlanes internal  = geom.internalPlanes();
	const bool               elsewhere = asPieces && wasPutElsewhere(memory, pair);
	const auto               ask       = [&] {
                settings.internal = internal.none() ? nullptr : &internal;
                polytope::contactQuery(pair, settings, memory, workspace, result);
	};
	Vector3r inside;
	if (asPieces) settings.inside = &inside;
	polytope::KeptVertices last;
	if (asPieces) last = memory.surface;
	ask();
	bool sameSurface = result.surfaceKept;
	if (asPieces && result.inContact
	        && (search || elsewhere || mayHaveMetMore(*c, *scene, geom, result, motion, last, memory.surface))) {
		const TouchingPair touching { c.get(), scene, { &convex1, &convex2 }, { frame1.origin, frame1.origin + centre2 },
			{ frame1.rotation, rotation2 }, frame1.origin + inside, -result.infeasibility, nearer - centre2 };
		const bool         changed = findInternalFaces(touching, internal);
		geom.internalKnown         = true;
		if (changed) {
			geom.setInternalPlanes(internal);
			memory.surface.vertices = 0;
			ask();
			sameSurface = false;
		}
		geom.sizeAtSearch = sizeOfOverlap(result);
		if (polytope::ContactResult near; !changed && afterSearch && followed.take(near))
			return write(near, frame1.origin, state1, state2, shift2, force, c);
	}
	if (afterSearch) geom.linear.clear();
	if (result.inContact) giveShare(math::max(result.share, Real(polytope::tolerance::leastShareOfSupport)), geom, *c, result);
	geom.remember(memory, sameSurface);
	const bool goesOn = write(result, frame1.origin, state1, state2, shift2, force, c);
	followed.end(settings, memory, sameSurface, workspace, result); // the result's outline is gone after that
	return goesOn;
}

bool PolytopeGeomFunctor::apply(const polytope::ContactResult& result, const Vector3r& origin1, const State& state1, const State& state2,
        const Vector3r& shift2, const bool& force, const shared_ptr<Interaction>& c)
{
	if (auto* const known = static_cast<PolytopeGeom*>(c->geom.get())) {
		if (auto* const widened = known->widened.get()) widened->present = 0; // the law adds it to the depth
	}
	const Real rest  = math::abs(result.normal.squaredNorm() - 1);
	const Real sum   = result.point.sum() + result.depth + result.area + result.energy + result.turningArm;
	const bool sound = rest <= Real(polytope::tolerance::orthogonal) && math::isfinite(sum) && result.area >= 0
	        && (result.outlineCount == 0 || (result.outlineCount > 0 && result.outline));
	if (result.hasGeometry ? !sound : result.inContact) return failed(c);
	return write(result, origin1, state1, state2, shift2, force, c);
}

bool PolytopeGeomFunctor::write(const polytope::ContactResult& result, const Vector3r& origin1, const State& state1, const State& state2,
        const Vector3r& shift2, const bool& force, const shared_ptr<Interaction>& c)
{
	count(result);
	if (auto* const known = static_cast<PolytopeGeom*>(c->geom.get())) {
		known->statusCode    = std::int8_t(result.status);
		known->infeasibility = result.infeasibility;
	}

	const bool wasReal = c->isReal();
	if (!result.hasGeometry) return wasReal; // a failed query keeps a real contact's last geometry; it is counted
	if (!result.inContact && !wasReal && !force) return false;

	auto& geom         = geometry(c);
	geom.statusCode    = std::int8_t(result.status);
	geom.infeasibility = result.infeasibility;
	geom.contactArea   = result.area;
	geom.turningArm    = result.turningArm;
	if (!result.linear) {
		geom.outline.set(result.outline, result.outlineCount);
		geom.faceForceCode = std::int8_t(ofScene().faceForce(StiffnessRule(geom.stiffnessRule)));
	}
	if (const auto* const linear = geom.linear.get()) {
		if (linear->linear.known) geom.outline.keep();
	}
	geom.energyPerStiffness = geom.faceForce() != polytope::FaceForce::AtCentre ? result.energy : Real(-1);
	ContactSizes   sizes { geom.refR1, geom.refR2 };
	const Real     closed = result.depth, wider = geom.widening();
	const Vector3r middle = origin1 + result.point + wider / 2 * geom.normal; // of the gap
	if (!wasReal) sizes = contactSizes(*Body::byId(c->getId1(), scene), *Body::byId(c->getId2(), scene), *scene);
	geom.doIg2Work(middle, closed - wider, sizes.first, sizes.second, state1, state2, scene, c, result.normal, shift2, !wasReal,
	        /*avoidGranularRatcheting*/ false);
	return true;
}

bool PolytopeGeomFunctor::isOfOthers(Interaction& contact)
{
	if (!contact.isReal()) contact.functorCache.geom = nullptr;
	return false;
}

bool PolytopeGeomFunctor::failed(const shared_ptr<Interaction>& c)
{
	ContactCounters& count = counters();
	++count.pairs;
	++count.statuses[int(polytope::ContactStatus::Failed)];
	if (auto* const known = static_cast<PolytopeGeom*>(c->geom.get())) known->statusCode = std::int8_t(polytope::ContactStatus::Failed);
	return c->isReal();
}

} // namespace yade
