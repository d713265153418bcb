// SPDX-License-Identifier: GPL-2.0-or-later
#include "bolt/BoltLayout.hpp"

#include "bolt/BoltTolerances.hpp"

#include <algorithm>
#include <cmath>

namespace polytope {

namespace {

	/// A station with the block that holds it, and how far that block holds the steel around it.
	struct Station {
		Real place, from, to;
		int  block, passage;
		Real half       = 0; ///< half the length of the grouted part that a node stands for
		Real compliance = 0; ///< what this half yields to a pull [m/N]
		bool grouted() const { return half > 0; }
	};

	int elementsOf(const BoltDesign& design, const Real& length)
	{
		const Real transfer = sqrt(design.axialStiffness / design.groutStiffness);
		const Real wanted   = length / (tolerance::elementOverTransfer * transfer);
		return int(std::min(Real(tolerance::mostElements), std::max(Real(tolerance::leastElements), Real(ceil(wanted)))));
	}

	/// Nodes in the middle of equal parts of what is grouted. A part of length h, all elastic, acts at its ends as a node of stiffness √(EAk) sinh μ,
	/// μ = h √(k/EA), between two arms of compliance tanh(μ/2)/√(EAk), exactly (of short parts: kh, and h/2 of steel).
	void addGrouted(BoltLayout& made, std::vector<Station>& stations, const BoltDesign& design, const Real& from, const Real& to,
	        int block, int passage)
	{
		const int  count = elementsOf(design, to - from);
		const Real part  = (to - from) / count;
		const Real rate  = sqrt(design.groutStiffness / design.axialStiffness),
		           deep  = sqrt(design.groutStiffness * design.axialStiffness);
		for (int k = 0; k < count; ++k) {
			BoltNode node;
			node.stiffness = deep * sinh(std::min(Real(rate * part), Real(tolerance::longestElement)));
			node.strength  = design.groutStrength * part;
			made.chain.nodes.push_back(node);
			stations.push_back(
			        { from + (k + Real(0.5)) * part, from, to, block, passage, part / 2, tanh(rate * part / 2) / deep });
		}
	}

	std::vector<Station> stationsOf(
	        BoltLayout& made, const std::vector<BoltPassage>& passages, const BoltDesign& design, const Real& length)
	{
		std::vector<Station> stations;
		const int            last = int(passages.size()) - 1;
		if (design.plate) stations.push_back({ passages[0].from, passages[0].from, passages[0].from, passages[0].block, 0 });
		if (!(design.groutStiffness > 0)) {
			const Real end = std::min(passages[std::size_t(last)].to, length);
			stations.push_back({ end, end, end, passages[std::size_t(last)].block, last });
			return stations;
		}
		for (int k = 0; k <= last; ++k) {
			const BoltPassage& in = passages[std::size_t(k)];
			const Real margin     = std::min(Real(design.freeLength / 2), Real(tolerance::mostOfPassage * (in.to - in.from)));
			// grout that begins at a joint, or behind it, holds from there on
			const bool across = k > 0 && design.groutedFrom < in.from - tolerance::leastPassage * length;
			const Real from   = std::max(design.groutedFrom, Real(across ? in.from + margin : in.from));
			const Real to     = k < last ? Real(in.to - margin) : in.to;
			if (to - from > tolerance::leastPassage * length) addGrouted(made, stations, design, from, to, in.block, k);
		}
		return stations;
	}

} // namespace

std::optional<BoltPassage> passageThrough(
        const PlacedShape& body, int block, const Vector3& head, const Vector3& direction, const Real& length)
{
	BoltPassage        passage { block, 0, length };
	std::vector<Plane> planes;
	addPlanesOf(body, planes);
	for (const Plane& plane : planes) {
		const Real outside = plane.normal.dot(head) - plane.offset, rate = plane.normal.dot(direction);
		if (rate == 0) {
			if (outside > 0) return {};
			continue;
		}
		const Real meets = -outside / rate;
		if (rate > 0) passage.to = std::min(passage.to, meets);
		else passage.from = std::max(passage.from, meets);
	}
	if (passage.from < passage.to) return passage;
	return {};
}

std::vector<BoltPassage> inOrder(std::vector<BoltPassage> passages, const Real& least)
{
	std::stable_sort(passages.begin(), passages.end(),
	        [](const BoltPassage& a, const BoltPassage& b) { return a.from < b.from || (a.from == b.from && a.to > b.to); });
	std::vector<BoltPassage> found;
	for (BoltPassage next : passages) {
		if (next.to - next.from < least) continue;
		if (!found.empty()) {
			BoltPassage& last = found.back();
			if (last.block == next.block) {
				last.to = std::max(last.to, next.to);
				continue;
			}
			if (next.to - last.to < least) continue;
			if (next.from < last.to) last.to = next.from = (next.from + last.to) / 2;
		}
		found.push_back(next);
	}
	return found;
}

BoltLayout layOut(const std::vector<BoltPassage>& passages, const BoltDesign& design, const Real& length)
{
	BoltLayout made;
	BoltChain& chain     = made.chain;
	chain.axialStiffness = design.axialStiffness;
	chain.yieldForce     = design.yieldForce;
	chain.ruptureStrain  = design.ruptureStrain;
	chain.headHeld       = design.plate;
	if (passages.empty()) return made;
	const std::vector<Station> stations = stationsOf(made, passages, design, length);
	if (!stations.empty()) made.firstStation = stations[0].place;
	for (std::size_t k = 1; k < stations.size(); ++k) {
		const Station &one = stations[k - 1], &next = stations[k];
		BoltElement    element;
		element.length = next.place - one.place;
		element.stiffness
		        = 1 / (one.compliance + next.compliance + (element.length - one.half - next.half) / design.axialStiffness);
		element.slackens = k == 1 && design.plate;
		if (one.block != next.block)
			made.crossings.push_back({ chain.elements.size(), one.block, next.block, one.to, next.from,
			        one.grouted() && next.grouted() && next.passage == one.passage + 1 });
		chain.elements.push_back(element);
	}
	chain.prepare();
	return made;
}

} // namespace polytope
