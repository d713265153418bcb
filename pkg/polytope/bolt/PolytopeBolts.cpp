// SPDX-License-Identifier: GPL-2.0-or-later
#include "bolt/PolytopeBolts.hpp"

#include <core/Omega.hpp>

namespace yade {

POLYTOPE_CLASSES((PolytopeBolts));

void PolytopeBolts::action()
{
	const long count = long(bolts.size());
#pragma omp parallel for schedule(static)
	for (long k = 0; k < count; ++k)
		bolts[std::size_t(k)]->act(*scene, unbreakable);
	settle();
}

/// What the threads leave to one: energies and counters.
void PolytopeBolts::settle()
{
	if (bolts.empty()) return;
	Real stored = 0, plastic = 0, broken = 0;
	for (const auto& bolt : bolts) {
		const PolytopeBolt::Loss& loss = bolt->loss();
		stored += bolt->energy;
		(loss.rupture ? broken : plastic) += loss.energy;
		dropped += loss.dropped;
		if (!loss.solved) ++unsolved;
	}
	if (!scene->trackEnergy) return;
	scene->energy->add(stored, "elastPotential", elasticId_, /*reset in each step*/ true);
	scene->energy->add(plastic, "plastDissip", plasticId_);
	if (broken != 0) scene->energy->add(broken, "fractureDissip", fractureId_);
}

void PolytopeBolts::enter(int index)
{
	for (const auto& crossing : bolts[std::size_t(index)]->crossings)
		for (Body::id_t id : { crossing->id1, crossing->id2 }) {
			if (ofBody_.size() <= std::size_t(id)) ofBody_.resize(std::size_t(id) + 1);
			auto& own = ofBody_[std::size_t(id)];
			if (own.empty() || own.back() != index) own.push_back(index);
		}
}

void PolytopeBolts::postLoad(PolytopeBolts&)
{
	ofBody_.clear();
	for (int k = 0; k < int(bolts.size()); ++k) {
		bolts[std::size_t(k)]->prepare();
		enter(k);
	}
}

boost::python::list PolytopeBolts::boltList() const
{
	boost::python::list all;
	for (const auto& bolt : bolts)
		all.append(bolt);
	return all;
}

long PolytopeBolts::actingCount() const
{
	return std::count_if(bolts.begin(), bolts.end(), [](const auto& bolt) { return bolt->acts(); });
}

long PolytopeBolts::actingInScene() const
{
	const auto& bodies = *Omega::instance().getScene()->bodies;
	return std::count_if(bolts.begin(), bolts.end(), [&](const auto& bolt) {
		return std::any_of(bolt->crossings.begin(), bolt->crossings.end(), [&](const auto& crossing) {
			return crossing->failure.empty() && crossing->knowsItsBodies() && crossing->hasItsBodies(bodies);
		});
	});
}

void PolytopeBolts::meetBodies()
{
	for (const auto& bolt : bolts)
		for (const auto& crossing : bolt->crossings)
			crossing->adoptBodies(*Omega::instance().getScene()->bodies);
}

bool PolytopeBolts::holds(Body::id_t id) const
{
	bool has = false;
	if (id < 0 || std::size_t(id) >= ofBody_.size()) return has;
	for (int k : ofBody_[std::size_t(id)])
		has = has || bolts[std::size_t(k)]->acts();
	return has;
}

void PolytopeBolts::forSpringsOf(const Body& body, const std::function<void(const SpringsAtPoint&)>& visit) const
{
	if (std::size_t(body.id) >= ofBody_.size()) return;
	for (int k : ofBody_[std::size_t(body.id)])
		for (const auto& crossing : bolts[std::size_t(k)]->crossings)
			if (crossing->failure.empty() && (crossing->id1 == body.id || crossing->id2 == body.id))
				visit(crossing->springsOn(body));
}

} // namespace yade
