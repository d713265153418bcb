// SPDX-License-Identifier: GPL-2.0-or-later
#include <core/Omega.hpp>
#include <core/Scene.hpp>
#include <lib/high-precision/Constants.hpp>

#include <src/bolt/BoltLayout.hpp>
#include <src/bolt/BoltTolerances.hpp>
#include <src/shape/CheckedNumbers.hpp>

#include "bolt/PolytopeBolts.hpp"
#include "host/CheckedAttributes.hpp"
#include "host/PartsOfBodies.hpp"
#include "shape/ShapeOfBody.hpp"

#include <map>

/// Where bolts are made: the blocks on their lines, what is asked of their values, their crossings.
namespace yade {
namespace {

	void checkSteel(const PolytopeBolt& bolt)
	{
		const auto positive = [](Real value) { return value > 0 && math::isfinite(value); };
		requireValue(positive(bolt.area), "area", bolt.area, "positive and finite [m²]");
		requireValue(positive(bolt.youngsModulus), "youngsModulus", bolt.youngsModulus, "positive and finite [Pa]");
		requireValue(bolt.yieldForce > 0, "yieldForce", bolt.yieldForce, "above 0 [N] (infinity: no yield)");
		requireValue(bolt.ruptureStrain > 0, "ruptureStrain", bolt.ruptureStrain, "above 0 (infinity: no rupture)");
		const Real breaks = bolt.ruptureStrain * bolt.area * bolt.youngsModulus;
		if (math::isfinite(bolt.yieldForce) && breaks < bolt.yieldForce) {
			std::ostringstream message;
			message << "ruptureStrain: must be at least that at which the steel yields, yieldForce/(area youngsModulus) = "
			        << bolt.yieldForce / (bolt.area * bolt.youngsModulus) << ", got " << bolt.ruptureStrain
			        << ": it would break at " << breaks << " N and never yield; leave out yieldForce for steel that breaks so";
			polytope::refuse(message.str());
		}
		requireValue(bolt.pretension >= 0 && math::isfinite(bolt.pretension), "pretension", bolt.pretension,
		        "at least 0 and finite [N]");
		requireValue(bolt.pretension == 0 || bolt.pretension <= bolt.yieldForce, "pretension", bolt.pretension,
		        "at most the yieldForce");
		requireValue(bolt.pretension == 0 || bolt.pretension < breaks, "pretension", bolt.pretension,
		        "less than that at which the steel reaches its ruptureStrain");
		if (bolt.pretension > 0 && !bolt.plate) polytope::refuse("pretension: needs a plate to pull against, take plate=True");
	}

	void checkGrout(const PolytopeBolt& bolt)
	{
		requireValue(bolt.groutStiffness >= 0 && math::isfinite(bolt.groutStiffness), "grout", bolt.groutStiffness,
		        "of a stiffness per length that is positive and finite [N/m²]");
		requireValue(bolt.freeLength == -1 || (bolt.freeLength > 0 && math::isfinite(bolt.freeLength)), "freeLength",
		        bolt.freeLength, "positive and finite [m]");
		requireValue(bolt.dowelStiffness >= 0 && math::isfinite(bolt.dowelStiffness), "dowel", bolt.dowelStiffness,
		        "of a stiffness that is positive and finite [N/m]");
		if (bolt.groutStiffness > 0) {
			requireValue(bolt.groutStrength > 0, "grout", bolt.groutStrength,
			        "of a strength per length above 0 [N/m] (infinity: no slip)");
			requireValue(
			        bolt.groutedLength == -1 || bolt.groutedLength > 0, "grout", bolt.groutedLength, "of a length above 0 [m]");
		} else {
			if (!bolt.plate)
				polytope::refuse(
				        "plate: nothing holds the head of a bolt without plate and grout; take plate=True or give grout");
			if (bolt.dowelStiffness > 0) polytope::refuse("dowel: a bolt without grout has room in its hole; give grout, too");
		}
		if (bolt.dowelStiffness > 0)
			requireValue(bolt.dowelStrength > 0, "dowel", bolt.dowelStrength, "of a strength above 0 [N] (infinity: no yield)");
	}

	std::string textOf(const Vector3r& point)
	{
		std::ostringstream text;
		text << "(" << point[0] << ", " << point[1] << ", " << point[2] << ")";
		return text.str();
	}

	std::string lineOf(const PolytopeBolt& bolt) { return "the line from " + textOf(bolt.head) + " to " + textOf(bolt.end); }

	/// Parts of the line in each block; members of a clump are one block, which has the clump's number.
	std::vector<polytope::BoltPassage> passagesOf(const PolytopeBolt& bolt, const Scene& scene, std::map<int, Body::id_t>& carriers)
	{
		const Vector3r                     line = bolt.end - bolt.head, direction = line.normalized();
		const Real                         length = line.norm();
		std::vector<polytope::BoltPassage> found;
		for (const auto& body : *scene.bodies) {
			const Polytope* shape = body ? polytopeOf(*body) : nullptr;
			if (!shape) continue;
			const State&   state = *body->state;
			const Vector3r apart = state.pos - bolt.head;
			if (shape->dimension == 3 && (apart - direction * direction.dot(apart)).norm() > shape->convex()->boundingRadius())
				continue;
			const int  owner  = moverOf(*body, scene).id;
			const auto inside = polytope::passageThrough(placed(*shape->convex(), state), owner, bolt.head, direction, length);
			if (!inside) continue;
			if (shape->dimension == 2 && math::abs(line[2]) > polytope::tolerance::leastPassage * length)
				polytope::refuse("head, end: a bolt through polygons must lie in their plane, with the same z at both");
			found.push_back(*inside);
			carriers.emplace(owner, body->id);
		}
		return polytope::inOrder(found, polytope::tolerance::leastPassage * length);
	}

	/// Passages that the bolt can be made of.
	std::vector<polytope::BoltPassage> goodPassages(const PolytopeBolt& bolt, const Scene& scene, std::map<int, Body::id_t>& carriers)
	{
		const Real length = (bolt.end - bolt.head).norm();
		if (!math::isfinite(length)) polytope::refuse("head, end: must be finite points [m]");
		if (!(length > 0)) polytope::refuse("head, end: are the same point " + textOf(bolt.head) + "; a bolt has a length");
		const auto passages = passagesOf(bolt, scene, carriers);
		if (passages.empty())
			polytope::refuse("head, end: " + lineOf(bolt)
			        + " meets no block with a Polytope shape; make the blocks first, and aim at them");
		if (!(bolt.groutStiffness > 0) && passages.back().to < (1 - polytope::tolerance::leastPassage) * length)
			polytope::refuse("end: " + textOf(bolt.end)
			        + " lies in no block, so that nothing holds the anchor; move the end into a block, or give grout");
		if (passages.size() == 1)
			polytope::refuse("head, end: " + lineOf(bolt) + " lies in body " + std::to_string(carriers.at(passages[0].block))
			        + " alone; a bolt ties at least two blocks together, lengthen it");
		return passages;
	}

	polytope::BoltDesign designOf(const PolytopeBolt& bolt, const Real& length)
	{
		polytope::BoltDesign design;
		design.axialStiffness = bolt.area * bolt.youngsModulus;
		design.yieldForce     = bolt.yieldForce;
		design.ruptureStrain  = bolt.ruptureStrain;
		design.plate          = bolt.plate;
		design.groutStiffness = bolt.groutStiffness;
		design.groutStrength  = bolt.groutStrength;
		design.groutedFrom    = bolt.groutedLength < 0 ? Real(0) : math::max(Real(0), Real(length - bolt.groutedLength));
		design.freeLength     = bolt.freeLength;
		return design;
	}

	shared_ptr<PolytopeBoltCrossing> crossingOf(
	        const polytope::BoltCrossing& found, PolytopeBolt& bolt, const std::map<int, Body::id_t>& carriers, const Scene& scene)
	{
		const auto        made      = shared_ptr<PolytopeBoltCrossing>(new PolytopeBoltCrossing);
		const Vector3r    direction = (bolt.end - bolt.head).normalized();
		const Quaternionr frame     = Quaternionr::FromTwoVectors(Vector3r::UnitX(), direction);
		const auto        at        = [&](const Real& place) { return Vector3r(bolt.head + place * direction); };
		made->id1                   = carriers.at(found.block1);
		made->id2                   = carriers.at(found.block2);
		made->start                 = found.from;
		made->stop                  = found.to;
		made->element               = int(found.element);
		made->stiffness             = bolt.chain.elasticStiffness(found.element);
		if (found.atJoint) {
			made->dowelStiffness = bolt.dowelStiffness;
			made->dowelStrength  = bolt.dowelStrength;
		}
		const State &state1 = *(*scene.bodies)[made->id1]->state, &state2 = *(*scene.bodies)[made->id2]->state;
		const auto   in
		        = [](const State& state, const Vector3r& point) { return Vector3r(state.ori.conjugate() * (point - state.pos)); };
		const Vector3r middle = at((found.from + found.to) / 2);
		made->point1          = in(state1, at(found.from));
		made->point2          = in(state2, at(found.to));
		made->middle1         = in(state1, middle);
		made->middle2         = in(state2, middle);
		made->frame1          = (state1.ori.conjugate() * frame).normalized();
		made->frame2          = (state2.ori.conjugate() * frame).normalized();
		made->adoptBodies(*scene.bodies);
		return made;
	}

	void jack(PolytopeBolt& bolt)
	{
		if (!(bolt.pretension > 0)) return;
		if (bolt.groutStiffness > 0 && bolt.pretension >= bolt.chain.groutStrength()) {
			std::ostringstream message;
			message << "pretension: " << bolt.pretension << " N is more than the grout holds, " << bolt.chain.groutStrength()
			        << " N; take less, or a longer or stronger grout";
			polytope::refuse(message.str());
		}
		bolt.chain.jack(bolt.pretension);
		bolt.energy = bolt.chain.energy();
		for (const auto& crossing : bolt.crossings)
			crossing->tension = bolt.chain.elements[std::size_t(crossing->element)].force;
	}

} // namespace

long PolytopeBolts::make(const PolytopeBolt& pattern)
{
	checkSteel(pattern);
	checkGrout(pattern);
	const Scene& where = *Omega::instance().getScene();
	if (where.isPeriodic)
		polytope::refuse(
		        "head, end: bolts in a periodic cell are not supported; O.periodic = False, or bonds (polytope.bond) between "
		        "blocks");
	std::map<int, Body::id_t> carriers;
	const auto                passages = goodPassages(pattern, where, carriers);
	const auto                bolt     = shared_ptr<PolytopeBolt>(new PolytopeBolt(pattern));
	const Real                length   = (bolt->end - bolt->head).norm();
	requireValue(bolt->groutedLength <= length * (1 + polytope::tolerance::leastPassage), "grout", bolt->groutedLength,
	        "of a length at most the bolt's own, from head to end [m] (without one: all of it)");
	if (bolt->freeLength < 0) bolt->freeLength = polytope::tolerance::freeLengthOverDiameter * math::sqrt(4 * bolt->area / Mathr::PI);
	auto layout        = polytope::layOut(passages, designOf(*bolt, length), length);
	bolt->chain        = layout.chain;
	bolt->firstStation = layout.firstStation;
	bolt->crossings.clear();
	bolt->prepare();
	for (const auto& crossing : layout.crossings)
		bolt->crossings.push_back(crossingOf(crossing, *bolt, carriers, where));
	if (bolt->crossings.empty())
		polytope::refuse(
		        "grout: holds the bolt in one block alone, and no plate in another one; lengthen the grout or the bolt, or take "
		        "plate=True");
	bolt->energy = 0;
	jack(*bolt);
	bolts.push_back(bolt);
	enter(int(bolts.size()) - 1);
	return long(bolts.size()) - 1;
}

} // namespace yade
