// SPDX-License-Identifier: GPL-2.0-or-later
#include "pairs/PairSearch.hpp"

#include <core/Scene.hpp>
#include <pkg/common/Box.hpp>
#include <pkg/common/Facet.hpp>
#include <pkg/common/Wall.hpp>

#include <src/contact/PairApart.hpp>
#include <src/numbers/Tolerances.hpp>

#include "host/ExactClass.hpp"
#include "host/PartsOfBodies.hpp"
#include "shape/Polytope.hpp"

#include <algorithm>
#include <boost/make_shared.hpp>
#include <cmath>
#include <limits>
#include <omp.h>

namespace yade {

namespace {

	/// The next double that is not above, or with infinity not below, a number of YADE's.
	double roundedTo(double towards, const Real& number)
	{
		const double near = double(number);
		const bool   past = towards < 0 ? Real(near) > number : Real(near) < number;
		return past ? std::nextafter(near, towards) : near;
	}

	constexpr std::uint32_t nowhere = std::numeric_limits<std::uint32_t>::max();

	polytope::BoxGrid::Box boxOf(const Body& body)
	{
		constexpr double       infinity = std::numeric_limits<double>::infinity();
		polytope::BoxGrid::Box box;
		box.id = body.id;
		for (int k = 0; k < 3; ++k) {
			box.low[k]  = roundedTo(-infinity, body.bound->min[k]);
			box.high[k] = roundedTo(infinity, body.bound->max[k]);
		}
		return box;
	}

	bool mayMeet(Collider& collider, const Body& one, const Body& other, const Scene& scene)
	{
#ifdef YADE_MPI
		return collider.mayCollide(&one, &other, scene.subdomain);
#else
		(void)scene;
		return collider.mayCollide(&one, &other);
#endif
	}

	/// Whether it is of the classes that have no contact with each other in YADE.
	bool isBoundary(const Shape* shape) { return exactly<Facet>(shape) || exactly<Box>(shape) || exactly<Wall>(shape); }

	/// What rounding may leave of the overlap of two bodies that lie flush, of their places, too.
	Real flushRoom(const BoxRoom::Reference& one, const BoxRoom::Reference& other)
	{
		const Real farthest = math::max(one.position.cwiseAbs().maxCoeff(), other.position.cwiseAbs().maxCoeff());
		return Real(polytope::tolerance::flush) * math::max(one.radius, other.radius)
		        + Real(polytope::tolerance::flushPlaces) * farthest;
	}

	bool boxesOverlap(const Bound& one, const Bound& other)
	{
		for (int k = 0; k < 3; ++k)
			if (!(one.min[k] <= other.max[k] && other.min[k] <= one.max[k])) return false;
		return true;
	}

} // namespace

void PairSearch::makeGrid(const Scene& scene)
{
	const BodyContainer&                bodies = *scene.bodies;
	std::vector<polytope::BoxGrid::Box> boxes;
	boxes.reserve(bodies.size());
	const auto add = [&](Body::id_t id) {
		const Body* body = bodies[id].get();
		if (body && body->bound) boxes.push_back(boxOf(*body));
	};
	if (bodies.useRedirection)
		for (const Body::id_t id : bodies.realBodies)
			add(id);
	else
		for (std::size_t id = 0; id < bodies.size(); ++id)
			add(Body::id_t(id));
	grid_.reset(std::move(boxes));
	moved_.reset({});
	movedIds_.clear();
	places_.assign(bodies.size(), nowhere);
	for (std::size_t place = 0; place < grid_.boxes().size(); ++place)
		places_[grid_.boxes()[place].id] = std::uint32_t(place);
}

void PairSearch::sortPairs(Scene& scene) const
{
	InteractionContainer& pairs = *scene.interactions;
	struct Entry {
		std::uint32_t           lower, upper; ///< places of the bodies
		shared_ptr<Interaction> pair;
		bool operator<(const Entry& other) const { return lower < other.lower || (lower == other.lower && upper < other.upper); }
	};
	std::vector<Entry> entries;
	entries.reserve(pairs.size());
	for (auto& pair : pairs) {
		const auto [lower, upper] = std::minmax({ places_[pair->getId1()], places_[pair->getId2()] });
		entries.push_back({ lower, upper, std::move(pair) });
	}
	std::stable_sort(entries.begin(), entries.end());
	for (std::size_t k = 0; k < entries.size(); ++k) {
		pairs[k]        = std::move(entries[k].pair);
		pairs[k]->linIx = int(k);
	}
}

/// Puts these bodies, whose boxes are new, into the second grid.
void PairSearch::move(const Scene& scene, const std::vector<Body::id_t>& ids)
{
	std::vector<Body::id_t> all;
	std::set_union(movedIds_.begin(), movedIds_.end(), ids.begin(), ids.end(), std::back_inserter(all));
	movedIds_.swap(all);
	std::vector<polytope::BoxGrid::Box> boxes;
	for (const Body::id_t id : movedIds_) {
		if (places_[id] != nowhere) grid_.remove(std::exchange(places_[id], nowhere));
		const Body* body = (*scene.bodies)[id].get(); // none: it has been erased
		if (body && body->bound) boxes.push_back(boxOf(*body));
	}
	moved_.reset(std::move(boxes));
}

bool PairSearch::staysApart(const Body& one, const Body& other) const
{
	const auto &reference1 = room_.references()[one.id], &reference2 = room_.references()[other.id];
	if (judge_ && reference1.fixed && reference2.fixed && isBoundary(one.shape.get()) && isBoundary(other.shape.get())) return true;
	if (!judge_ || !reference1.convex || !reference2.convex || reference1.convex->dimension() != reference2.convex->dimension())
		return false;
	Real way = reference1.margin + reference2.margin;
	if (reference1.still && reference2.still) way -= flushRoom(reference1, reference2);
	else if (isPiece(one) || isPiece(other)) return false;
	else // along each axis a body moves by less than its sweep length
		way += math::sqrt(Real(3)) * math::max(reference1.sweep, reference2.sweep)
		        + math::max(room_.rooms()[one.id], room_.rooms()[other.id]);
	static thread_local polytope::ContactWorkspace workspace;
	return polytope::staysApart({ *reference1.convex, reference1.orientation.toRotationMatrix(), *reference2.convex,
	                                    reference2.orientation.toRotationMatrix(), reference2.position - reference1.position },
	        way, workspace);
}

bool PairSearch::shouldBeErased(Body::id_t id1, Body::id_t id2, Scene* scene) const
{
	const BodyContainer& bodies = *scene->bodies;
	if (!bodies.exists(id1) || !bodies.exists(id2)) return true;
	const Body &one = *bodies[id1], &other = *bodies[id2];
	if (!one.bound || !other.bound || !boxesOverlap(*one.bound, *other.bound)) return true;
	return staysApart(one, other);
}

bool PairSearch::isNew(Scene& scene, Collider& collider, const Body& one, const Body& other) const
{
	return mayMeet(collider, one, other, scene) && !scene.interactions->found(one.id, other.id) && !staysApart(one, other);
}

template <class Find> void PairSearch::insertFound(Scene& scene, long number, const Find& find) const
{
	std::vector<Pairs> found(std::max(1, omp_get_max_threads()));
	// parts of equal length, one a thread and in their order: what is found does not depend on their number
#pragma omp parallel for schedule(static)
	for (long k = 0; k < number; ++k) {
		Pairs& mine = found[omp_get_thread_num()];
		find(k, [&](Body::id_t one, Body::id_t other) { mine.emplace_back(std::min(one, other), std::max(one, other)); });
	}
	for (const Pairs& ofThread : found)
		for (const auto& [id1, id2] : ofThread)
			scene.interactions->insert(boost::make_shared<Interaction>(id1, id2)); // nothing where it is known
}

void PairSearch::ofAll(Scene& scene, Collider& collider, bool judge, bool sort)
{
	judge_ = judge;
	makeGrid(scene);
	scene.interactions->conditionalyEraseNonReal(*this, &scene);
	const BodyContainer& bodies = *scene.bodies;
	insertFound(scene, long(grid_.boxes().size()), [&](long place, const auto& add) {
		const Body& body = *bodies[grid_.boxes()[place].id];
		grid_.forPartners(place, [&](const polytope::BoxGrid::Box& box) {
			if (isNew(scene, collider, body, *bodies[box.id])) add(body.id, box.id);
		});
	});
	if (sort) sortPairs(scene);
}

void PairSearch::erasePairsOf(Scene& scene, const std::vector<Body::id_t>& ids) const
{
	InteractionContainer& pairs = *scene.interactions;
	std::vector<int>      apart; // erasing changes the lists that are looked at here
	for (const Body::id_t id : ids) {
		const Body* body = (*scene.bodies)[id].get();
		if (!body) continue;
		apart.clear();
		for (const auto& [other, pair] : body->intrs)
			if (!pair->isReal() && shouldBeErased(pair->getId1(), pair->getId2(), &scene)) apart.push_back(other);
		for (const Body::id_t other : apart)
			pairs.erase(id, other, pairs.find(id, other)->linIx);
	}
}

void PairSearch::ofSome(Scene& scene, Collider& collider, const std::vector<Body::id_t>& ids)
{
	const bool anew = areMany(movedIds_.size() + ids.size());
	if (anew) makeGrid(scene);
	else move(scene, ids);
	erasePairsOf(scene, ids);
	const BodyContainer& bodies = *scene.bodies;
	insertFound(scene, long(ids.size()), [&](long k, const auto& add) {
		const Body* body = bodies[ids[k]].get();
		if (!body || !body->bound) return;
		const auto visit = [&](const polytope::BoxGrid::Box& box) {
			const Body* other = bodies[box.id].get(); // none: erased since the grid was made
			if (other && other != body && isNew(scene, collider, *body, *other)) add(body->id, box.id);
		};
		grid_.forOverlaps(boxOf(*body), visit);
		moved_.forOverlaps(boxOf(*body), visit);
	});
	if (anew) sortPairs(scene);
}

std::vector<Body::id_t> PairSearch::overlapping(const Bound& bound, const Scene& scene) const
{
	std::vector<Body::id_t> found;
	polytope::BoxGrid::Box  asked;
	for (int k = 0; k < 3; ++k) {
		asked.low[k]  = double(bound.min[k]);
		asked.high[k] = double(bound.max[k]);
	}
	const auto visit = [&](const polytope::BoxGrid::Box& box) {
		if (!scene.bodies->exists(box.id)) return;
		const Body& body = *(*scene.bodies)[box.id];
		if (!body.bound) return;
		// the box was made before the body moved, and with room for that
		Aabb now;
		for (int k = 0; k < 3; ++k) {
			const Real moved = body.state->pos[k] - body.bound->refPos[k];
			now.min[k]       = body.bound->min[k] + body.bound->sweepLength + moved;
			now.max[k]       = body.bound->max[k] - body.bound->sweepLength + moved;
		}
		if (boxesOverlap(now, bound)) found.push_back(box.id);
	};
	grid_.forOverlaps(asked, visit);
	moved_.forOverlaps(asked, visit);
	return found;
}

} // namespace yade
