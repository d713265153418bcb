// SPDX-License-Identifier: GPL-2.0-or-later
#include <core/Clump.hpp>
#include <core/Omega.hpp>
#include <core/Scene.hpp>
#include <lib/high-precision/Constants.hpp>

#include <src/bond/BondTolerances.hpp>
#include <src/bond/CommonFace.hpp>
#include <src/neighbours/BoxGrid.hpp>
#include <src/shape/CheckedNumbers.hpp>

#include "bonding/PolytopeBonds.hpp"
#include "host/CheckedAttributes.hpp"
#include "host/PartsOfBodies.hpp"
#include "host/PeriodOfPair.hpp"
#include "joint/RockJointPhys.hpp"
#include "material/RockJointMat.hpp"
#include "shape/ShapeOfBody.hpp"

#include <cmath>
#include <limits>
#include <tuple>

/// Where bonds are made: pairs of neighbours, their common faces, values from the materials.
namespace yade {
namespace {

	struct Bondable {
		const Body*                  body;
		const polytope::ConvexShape* shape;
		Real                         radius;
	};

	bool mayBeBonded(const Bondable& one, const Bondable& other)
	{
		return one.shape->dimension() == other.shape->dimension() && !inOneClump(*one.body, *other.body);
	}

	std::vector<Bondable> bondablesOf(const std::vector<int>& ids, const Scene& scene)
	{
		std::vector<Bondable> all;
		const auto            add = [&](const Body& body) {
                        if (const auto* shape = convexShapeOf(body)) all.push_back({ &body, shape, shape->boundingRadius() });
		};
		if (ids.empty()) {
			for (const auto& body : *scene.bodies)
				if (body) add(*body);
		} else
			for (int id : ids)
				add(*(*scene.bodies)[id]);
		return all;
	}

	/// A box about its ball and half of the gap, `at` its centre; corners rounded outwards.
	polytope::BoxGrid::Box boxOf(const Bondable& one, const Vector3r& at, const Real& gap, std::size_t number)
	{
		constexpr double       far = std::numeric_limits<double>::infinity();
		polytope::BoxGrid::Box box;
		for (int k = 0; k < 3; ++k) {
			box.low[std::size_t(k)]  = std::nextafter(double(at[k] - one.radius - gap / 2), -far);
			box.high[std::size_t(k)] = std::nextafter(double(at[k] + one.radius + gap / 2), far);
		}
		box.id = std::int32_t(number);
		return box;
	}

	/// Calls visit(a, b, shift of b by cells) for pairs whose balls are within the gap.
	template <class Visit> void forNeighbours(const std::vector<Bondable>& all, const Scene& scene, const Real& gap, const Visit& visit)
	{
		// all in one period, each in the cells around it
		const auto cellOf = [&](const Bondable& one) {
			Vector3i cell = Vector3i::Zero();
			if (!scene.isPeriodic) return cell;
			const Vector3r place = scene.cell->hSize.inverse() * one.body->state->pos;
			for (int k = 0; k < 3; ++k)
				cell[k] = int(math::floor(place[k]));
			return cell;
		};
		std::vector<polytope::BoxGrid::Box> boxes;
		for (std::size_t k = 0; k < all.size(); ++k)
			boxes.push_back(boxOf(all[k], placeByCells(scene, -cellOf(all[k]), all[k].body->state->pos), gap, k));
		polytope::BoxGrid grid;
		grid.reset(boxes);
		const int around = scene.isPeriodic ? 1 : 0;
		for (std::size_t k = 0; k < all.size(); ++k) {
			const Bondable& b    = all[k];
			const Vector3i  back = -cellOf(b);
			Vector3i        by;
			for (by[0] = -around; by[0] <= around; ++by[0])
				for (by[1] = -around; by[1] <= around; ++by[1])
					for (by[2] = -around; by[2] <= around; ++by[2]) {
						const Vector3r moved = placeByCells(scene, back + by, b.body->state->pos);
						grid.forOverlaps(boxOf(b, moved, gap, k), [&](const polytope::BoxGrid::Box& other) {
							if (std::size_t(other.id) >= k) return;
							const Bondable& a     = all[std::size_t(other.id)];
							const Vector3i  cells = back + by + cellOf(a);
							const Real      reach = a.radius + b.radius + gap;
							const Vector3r  way
							        = placeByCells(scene, cells, b.body->state->pos) - a.body->state->pos;
							if (way.squaredNorm() <= reach * reach) visit(a, b, cells);
						});
					}
		}
	}

	/// Strengths of the joint between the two materials, where it has any: a joint without strength of its own is bonded for good.
	void takeStrengths(PolytopeBond& bond, const RockJointMat* m1, const RockJointMat* m2)
	{
		Real tension = std::numeric_limits<Real>::infinity(), cohesion = tension;
		if (m1 && m2) {
			const Real t = math::min(m1->tensileStrength, m2->tensileStrength), c = math::min(m1->cohesion, m2->cohesion);
			if (t > 0 || c > 0) std::tie(tension, cohesion) = std::make_pair(t, c);
		}
		if (bond.tensileStrength < 0) bond.tensileStrength = tension;
		if (bond.cohesion < 0) bond.cohesion = cohesion;
	}

	/// Values that the pattern leaves to the materials.
	void takeFromMaterials(PolytopeBond& bond, const Body& body1, const Body& body2)
	{
		const auto *m1  = dynamic_cast<const RockJointMat*>(body1.material.get()),
		           *m2  = dynamic_cast<const RockJointMat*>(body2.material.get());
		const auto take = [&](Real& value, const char* name, const auto& rule) {
			if (value >= 0) return;
			if (!m1 || !m2)
				polytope::refuse(std::string(name) + ": must be given, bodies " + std::to_string(body1.id) + " and "
				        + std::to_string(body2.id) + " are not both of a RockJointMat, whose value would be taken");
			value = rule(*m1, *m2);
		};
		using Mat            = RockJointMat;
		const auto stiffness = [&](Real& value, const char* name, Real Mat::* of) {
			take(value, name, [&](const Mat& a, const Mat& b) {
				if (!a.stiffnessPerArea || !b.stiffnessPerArea)
					polytope::refuse(std::string(name)
					        + ": must be given per area [Pa/m], that of the RockJointMat is per contact [N/m]");
				return stiffnessInSeries(a.*of, b.*of);
			});
		};
		stiffness(bond.normalStiffness, "normalStiffness", &Mat::normalStiffness);
		stiffness(bond.shearStiffness, "shearStiffness", &Mat::shearStiffness);
		take(bond.frictionAngle, "frictionAngle",
		        [&](const Mat& a, const Mat& b) { return math::min(a.frictionAngle, b.frictionAngle); });
		takeStrengths(bond, m1, m2);
		if (bond.bendingStiffness < 0) bond.bendingStiffness = bond.normalStiffness;
		if (bond.twistingStiffness < 0) bond.twistingStiffness = bond.shearStiffness;
	}

	void checkPattern(const PolytopeBond& pattern, const Real& angle)
	{
		const auto                         unset  = [](Real value) { return value == -1; };
		const auto                         finite = [](Real value) { return math::isfinite(value); };
		const std::pair<const char*, Real> stiffnesses[]
		        = { { "normalStiffness", pattern.normalStiffness }, { "shearStiffness", pattern.shearStiffness } };
		for (const auto& [name, value] : stiffnesses)
			requireValue(unset(value) || (value > 0 && finite(value)), name, value, "positive and finite [Pa/m]");
		const std::pair<const char*, Real> turning[]
		        = { { "bendingStiffness", pattern.bendingStiffness }, { "twistingStiffness", pattern.twistingStiffness } };
		for (const auto& [name, value] : turning)
			requireValue(unset(value) || (value >= 0 && finite(value)), name, value, "at least 0 and finite [Pa/m]");
		requireValue(unset(pattern.tensileStrength) || pattern.tensileStrength > 0, "tensileStrength", pattern.tensileStrength,
		        "above 0 [Pa] (infinity: none)");
		requireValue(unset(pattern.cohesion) || pattern.cohesion > 0, "cohesion", pattern.cohesion,
		        "above 0 [Pa] (infinity: no failure in shear)");
		requireValue(unset(pattern.frictionAngle) || (pattern.frictionAngle >= 0 && pattern.frictionAngle < double(Mathr::HALF_PI)),
		        "frictionAngle", pattern.frictionAngle, "an angle in radians, at least 0 and below pi/2 (use radians(degrees))");
		requireValue(pattern.bendingShare >= 0 && pattern.bendingShare <= 1, "bendingShare", pattern.bendingShare, "from 0 to 1");
		requireValue(angle >= 0 && angle < 0.5, "angle", angle, "an angle in radians, from 0 to below 0.5");
	}

	shared_ptr<PolytopeBond> bondAt(
	        const polytope::CommonFace& face, const PolytopeBond& pattern, const Body& body1, const Body& body2, const Vector3r& shift)
	{
		auto              bond = shared_ptr<PolytopeBond>(new PolytopeBond(pattern));
		const Quaternionr axes(face.axes);
		bond->join(body1.id, body2.id, face);
		bond->attach(1, *body1.state, Vector3r::Zero(), face.centroid, axes);
		bond->attach(2, *body2.state, shift, face.centroid, axes);
		bond->point   = face.centroid;
		bond->overlap = math::max(-face.gap, Real(0));
		takeFromMaterials(*bond, body1, body2);
		return bond;
	}

} // namespace

std::vector<shared_ptr<PolytopeBond>> PolytopeBonds::found(
        const std::vector<int>& ids, const Real& gap, const Real& angle, const PolytopeBond& pattern, const Scene& where) const
{
	const auto                            all = bondablesOf(ids, where);
	std::vector<shared_ptr<PolytopeBond>> found;
	forNeighbours(all, where, math::max(gap, Real(0)), [&](const Bondable& a, const Bondable& b, const Vector3i& cells) {
		// fixed bodies are moved by a script, if at all: they are bonded if it names them
		if (ids.empty() && isFixed(*a.body, where) && isFixed(*b.body, where)) return;
		if (!mayBeBonded(a, b) || joins(a.body->id, b.body->id)) return;
		const bool      ordered = a.body->id < b.body->id;
		const Bondable &one = ordered ? a : b, &two = ordered ? b : a;
		const Vector3i  by     = ordered ? cells : Vector3i(-cells);
		const Vector3r  shift  = placeByCells(where, by);
		const Real      within = gap >= 0 ? gap : polytope::touchingGap(*one.shape, *two.shape);
		for (const polytope::CommonFace& face : polytope::commonFaces(
		             placed(*one.shape, *one.body->state), placed(*two.shape, *two.body->state, shift), within, angle)) {
			found.push_back(bondAt(face, pattern, *one.body, *two.body, shift));
			found.back()->cellDist = by;
		}
	});
	// in the order of the ids, whatever the places of the bodies
	std::stable_sort(found.begin(), found.end(),
	        [](const auto& a, const auto& b) { return std::make_pair(a->id1, a->id2) < std::make_pair(b->id1, b->id2); });
	return found;
}

boost::python::list PolytopeBonds::find(const std::vector<int>& ids, const Real& gap, const Real& angle, const PolytopeBond& pattern) const
{
	checkPattern(pattern, angle);
	boost::python::list list;
	for (const auto& bond : found(ids, gap, angle, pattern, *Omega::instance().getScene()))
		list.append(bond);
	return list;
}

long PolytopeBonds::make(const std::vector<int>& ids, const Real& gap, const Real& angle, const PolytopeBond& pattern)
{
	Scene& where = *Omega::instance().getScene();
	checkPattern(pattern, angle);
	endErased(where);
	const auto made = found(ids, gap, angle, pattern, where); // nothing is changed before all could be made
	for (const auto& bond : made) {
		bond->adoptBodies(*where.bodies);
		bonds.push_back(bond);
		enter(int(bonds.size()) - 1);
		where.interactions->requestErase(bond->id1, bond->id2); // its contact
	}
	return long(made.size());
}

} // namespace yade
