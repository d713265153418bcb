// SPDX-License-Identifier: GPL-2.0-or-later
#include "ExactSurface.hpp"

#include "ExactCells.hpp"

#include <algorithm>

namespace polytope::search {

using namespace samples;

namespace {

	/// By how much planes may be off: by as many roundings of the pair's reach as they are placed with, and each normal by what turning it rounds.
	constexpr int placed = 8, turned = 2;

	struct Loads {
		ContactLoad foundation, spring;
	};

	template <class Numbers> Vector3 vectorOf(const Numbers& numbers)
	{
		Vector3           out  = Vector3::Zero();
		const std::size_t last = numbers.size() == 1 ? 2 : 0; // a turn in the plane is about z
		for (std::size_t k = 0; k < numbers.size(); ++k)
			out[Eigen::Index(last + k)] = Real(numbers[k]);
		return out;
	}

	/// By the definitions in contact/SurfaceContact.hpp. Near planes first: the others then soon leave nothing of a piece.
	template <int D> Loads loadsOf(ExactCells<D> cells, const Pair& pair)
	{
		const auto nearer = [](const auto& a, const auto& b) { return a.offset < b.offset; };
		std::stable_sort(cells.planes.begin(), cells.planes.begin() + cells.first, nearer);
		std::stable_sort(cells.planes.begin() + cells.first, cells.planes.end(), nearer);
		cells.measure(3 * double(pair.size()));
		const Fine mean = cells.level / cells.volume, weight = 36 * mean / cells.volume;
		auto       force = cells.deeper;
		auto       turn  = cells.deeperTurn;
		for (std::size_t k = 0; k < force.size(); ++k)
			force[k] = weight * (force[k] - mean * cells.force[k]);
		for (std::size_t k = 0; k < turn.size(); ++k)
			turn[k] = weight * (turn[k] - mean * cells.moment[k]);
		const Real thickness = D == 2 ? std::min(pair.shape[0]->thickness(), pair.shape[1]->thickness()) : Real(1);
		Loads      loads;
		loads.foundation.force  = 2 * thickness * vectorOf(cells.force);
		loads.foundation.moment = 2 * thickness * vectorOf(cells.moment);
		loads.foundation.energy = 2 * thickness * Real(cells.volume);
		loads.spring.force      = vectorOf(force);
		loads.spring.moment     = vectorOf(turn);
		loads.spring.energy     = Real(18 * mean * mean);
		return loads;
	}

	ContactLoad meanOf(ContactLoad one, const ContactLoad& other)
	{
		one.force  = (one.force + other.force) / 2;
		one.moment = (one.moment + other.moment) / 2;
		return one;
	}

	/// The mean of both orders in which planes of both bodies that coincide may be taken.
	template <int D> Loads exactLoads(const Pair& pair, const Vector3& origin)
	{
		const double        twin = double(tolerance::twinPlanes), offset = twin * double(pair.size());
		const ExactCells<D> cells(pair, origin, { twin, offset, false });
		const Loads         loads = loadsOf(cells, pair);
		if (!cells.sharesPlanes) return loads;
		const Loads other = loadsOf(ExactCells<D>(pair, origin, { twin, offset, true }), pair);
		return { meanOf(loads.foundation, other.foundation), meanOf(loads.spring, other.spring) };
	}

	template <int D> Loads loadsWithErrors(const Pair& pair, const Vector3& origin, std::mt19937_64& random)
	{
		ExactCells<D> cells(pair, origin, {});
		for (auto& plane : cells.planes) {
			for (Fine& component : plane.normal)
				component += uniform(random, -turned, turned) * tolerance::rounding;
			plane.offset += uniform(random, -placed, placed) * tolerance::rounding * pair.reach();
		}
		return loadsOf(cells, pair);
	}

	Loads exactLoadsOf(const Pair& pair, const Vector3& origin)
	{
		return pair.dimension() == 3 ? exactLoads<3>(pair, origin) : exactLoads<2>(pair, origin);
	}

} // namespace

ExactSurface::ExactSurface(const Pair& pair, const Vector3& origin, const Real& deepest)
        : pair_(pair), origin_(origin), deepest_(deepest), foundation_(ContactLoad(), pair, deepest), spring_(ContactLoad(), pair, deepest)
{
	const Loads loads = exactLoadsOf(pair, origin);
	foundation_       = LoadWithUnits(loads.foundation, pair, deepest);
	spring_           = LoadWithUnits(loads.spring, pair, deepest);
}

void ExactSurface::drawErrors(std::mt19937_64& random)
{
	const bool  solid = pair_.dimension() == 3;
	const Loads moved = solid ? loadsWithErrors<3>(pair_, origin_, random) : loadsWithErrors<2>(pair_, origin_, random);
	const auto  add   = [&](LoadWithUnits& own, const ContactLoad& other) {
                const LoadWithUnits smooth(own.load, pair_, deepest_);
                // a change of the force acts somewhere on the overlap
                const Real size = pair_.size(), arm = (other.moment - own.load.moment).norm() / size,
                           change = std::max((other.force - own.load.force).norm(), arm) / placed;
                own.forceUnit     = std::max(own.forceUnit, smooth.forceUnit + change);
                own.momentUnit    = std::max(own.momentUnit, smooth.momentUnit + change * size);
                ridge_            = ridge_ || change > 10 * smooth.forceUnit;
	};
	add(foundation_, moved.foundation);
	add(spring_, moved.spring);
}

} // namespace polytope::search
