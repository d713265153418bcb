// SPDX-License-Identifier: GPL-2.0-or-later
#include "bolt/PolytopeBolt.hpp"

namespace yade {

POLYTOPE_CLASSES((PolytopeBolt));

void PolytopeBolt::prepare()
{
	chain.prepare();
	openings_.assign(chain.elements.size(), 0);
}

bool PolytopeBolt::acts() const
{
	return std::any_of(crossings.begin(), crossings.end(), [](const auto& crossing) { return crossing->failure.empty(); });
}

/// The steel is cut where a body is gone.
void PolytopeBolt::dropErased(const BodyContainer& bodies)
{
	for (const auto& crossing : crossings) {
		if (!crossing->failure.empty()) continue;
		if (crossing->hasItsBodies(bodies)) {
			crossing->adoptBodies(bodies);
			continue;
		}
		chain.elements[std::size_t(crossing->element)].broken = true;
		crossing->end("erased");
		++loss_.dropped;
	}
}

void PolytopeBolt::act(Scene& scene, bool unlimited)
{
	const BodyContainer& bodies = *scene.bodies;
	loss_                       = Loss();
	dropErased(bodies);
	for (const auto& crossing : crossings)
		if (crossing->failure.empty()) {
			const Real now = crossing->newOpening(bodies);
			if (!math::isfinite(now)) return; // as contacts: left out of this step
			openings_[std::size_t(crossing->element)] = now;
		}
	const auto change = chain.solve(openings_, unlimited);
	bool       lost   = change.flowed || change.broke;
	Real       work = 0, stored = chain.energy();
	for (const auto& crossing : crossings) {
		if (!crossing->failure.empty()) continue;
		const polytope::BoltElement& element = chain.elements[std::size_t(crossing->element)];
		const Vector2r               slid    = crossing->plasticShear;
		work += crossing->follow(bodies, openings_[std::size_t(crossing->element)], element.force, unlimited);
		lost = lost || slid != crossing->plasticShear;
		if (element.broken) crossing->end("rupture");
		else crossing->apply(scene);
		stored += crossing->energy();
	}
	if (lost && loss_.dropped == 0) loss_.energy = work - (stored - energy);
	loss_.rupture = change.broke;
	loss_.solved  = change.solved;
	energy        = stored;
}

std::vector<boost::optional<Vector3r>> PolytopeBolt::stationPoints(const BodyContainer& bodies) const
{
	const vector<Real>                     places = stations();
	std::vector<boost::optional<Vector3r>> points(places.size());
	std::size_t                            block = 0;
	for (std::size_t k = 0; k < places.size(); ++k) {
		while (block < crossings.size() && std::size_t(crossings[block]->element) < k)
			++block;
		// the first block is on the near side of crossing 0, block b on the far side of crossing b - 1
		const PolytopeBoltCrossing& beside = *crossings[block > 0 ? block - 1 : 0];
		if (bodies.exists(block > 0 ? beside.id2 : beside.id1)) points[k] = beside.placeOn(bodies, block > 0, places[k]);
	}
	return points;
}

boost::python::list PolytopeBolt::crossingList() const
{
	boost::python::list all;
	for (const auto& crossing : crossings)
		all.append(crossing);
	return all;
}

vector<Real> PolytopeBolt::stations() const
{
	vector<Real> all { firstStation };
	for (const auto& element : chain.elements)
		all.push_back(all.back() + element.length);
	return all;
}

vector<Real> PolytopeBolt::elementForces() const
{
	vector<Real> all;
	for (const auto& element : chain.elements)
		all.push_back(element.force);
	return all;
}

vector<Real> PolytopeBolt::elementStrains() const
{
	vector<Real> all;
	for (const auto& element : chain.elements)
		all.push_back(element.strain);
	return all;
}

vector<Real> PolytopeBolt::slips() const
{
	vector<Real> all;
	for (const auto& node : chain.nodes)
		all.push_back(node.slip);
	return all;
}

vector<Real> PolytopeBolt::groutForces() const
{
	vector<Real> all;
	for (const auto& node : chain.nodes)
		all.push_back(node.force);
	return all;
}

vector<Real> PolytopeBolt::groutStrengths() const
{
	vector<Real> all;
	for (const auto& node : chain.nodes)
		all.push_back(node.strength);
	return all;
}

Real PolytopeBolt::headForce() const { return plate && !chain.elements.empty() ? chain.elements.front().force : Real(0); }

Real PolytopeBolt::largestForce() const
{
	Real largest = 0;
	for (const auto& element : chain.elements)
		largest = math::max(largest, element.force);
	return largest;
}

} // namespace yade
