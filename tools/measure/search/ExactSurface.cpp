// SPDX-License-Identifier: GPL-2.0-or-later
#include "ExactSurface.hpp"

#include "ExactCells.hpp"

#include <algorithm>

namespace polytope::search {

using namespace samples;

namespace {

	constexpr ContactModel models[] = { ContactModel::Foundation, ContactModel::Spring };

	/// What is compared, per metre of thickness in 2-D where the stiffness is per area.
	struct Loads {
		ContactLoad of[2]; ///< foundation, spring
	};

	template <class Numbers> Vector3 vectorOf(const Numbers& numbers)
	{
		if constexpr (std::tuple_size<Numbers>::value == 1) return { 0, 0, Real(numbers[0]) };
		Vector3 out = Vector3::Zero();
		for (std::size_t k = 0; k < numbers.size(); ++k)
			out[Eigen::Index(k)] = Real(numbers[k]);
		return out;
	}

	/// By the definitions in contact/SurfaceContact.hpp.
	template <int D> Loads loadsOf(const ExactCells<D>& cells)
	{
		Loads      loads;
		const Fine mean = cells.level / cells.volume, weight = 36 * mean / cells.volume;
		auto       force = cells.deeper;
		auto       turn  = cells.deeperTurn;
		for (std::size_t k = 0; k < force.size(); ++k)
			force[k] = weight * (force[k] - mean * cells.force[k]);
		for (std::size_t k = 0; k < turn.size(); ++k)
			turn[k] = weight * (turn[k] - mean * cells.moment[k]);
		loads.of[0].force  = 2 * vectorOf(cells.force);
		loads.of[0].moment = 2 * vectorOf(cells.moment);
		loads.of[0].energy = Real(2 * cells.volume);
		loads.of[1].force  = vectorOf(force);
		loads.of[1].moment = vectorOf(turn);
		loads.of[1].energy = Real(18 * mean * mean);
		return loads;
	}

	/// Near planes first: the others then leave nothing of a piece soon.
	template <int D> Loads measured(ExactCells<D> cells, Real size)
	{
		const auto nearer = [](const auto& a, const auto& b) { return a.offset < b.offset; };
		std::stable_sort(cells.planes.begin(), cells.planes.begin() + cells.first, nearer);
		std::stable_sort(cells.planes.begin() + cells.first, cells.planes.end(), nearer);
		cells.measure(3 * double(size));
		return loadsOf(cells);
	}

	/// The mean of both orders in which planes of both bodies that coincide may be taken.
	template <int D> Loads meanOfOrders(const Pair& pair, const Vector3& origin)
	{
		const double        twin = double(tolerance::twinPlanes), size = double(pair.size());
		const ExactCells<D> cells(pair, origin, { twin, twin * size, false });
		Loads               loads = measured(cells, pair.size());
		if (!cells.sharesPlanes) return loads;
		const Loads other = measured(ExactCells<D>(pair, origin, { twin, twin * size, true }), pair.size());
		for (int m = 0; m < 2; ++m) {
			loads.of[m].force  = (loads.of[m].force + other.of[m].force) / 2;
			loads.of[m].moment = (loads.of[m].moment + other.of[m].moment) / 2;
		}
		return loads;
	}

	template <int D> ExactSurface surfaceOf(const Pair& pair, const Vector3& origin, const Real& deepest, std::mt19937_64& random)
	{
		Loads loads = meanOfOrders<D>(pair, origin), moved[2];
		// planes off by up to as many roundings as they may be placed with, and by as much to the other side
		constexpr int     placed = 8;
		ExactCells<D>     cells(pair, origin, {});
		std::vector<Real> errors;
		for (std::size_t i = 0; i < cells.planes.size(); ++i)
			errors.push_back(uniform(random, -placed, placed) * tolerance::rounding * pair.reach());
		for (int side = 0; side < 2; ++side) {
			ExactCells<D> off = cells;
			for (std::size_t i = 0; i < errors.size(); ++i)
				off.planes[i].offset += Fine(side == 0 ? errors[i] : -errors[i]);
			moved[side] = measured(off, pair.size());
		}
		const Real   thickness = D == 2 ? std::min(pair.shape[0]->thickness(), pair.shape[1]->thickness()) : Real(1);
		ExactSurface out;
		out.ridge = false;
		for (int m = 0; m < 2; ++m) {
			ExactLoad&         exact = m == 0 ? out.foundation : out.spring;
			const ContactLoad& load  = loads.of[m];
			Real               force = 0, moment = 0;
			for (const Loads& other : moved) {
				force  = std::max(force, (other.of[m].force - load.force).norm());
				moment = std::max(moment, (other.of[m].moment - load.moment).norm());
			}
			// bodies moved against each other by δ change the energy by no more than planes that are off by δ do
			const Real unit   = roundingOf(pair, deepest);
			const Real thick  = models[m] == ContactModel::Foundation ? thickness : Real(1);
			const Real scale  = load.energy / deepest;
			out.ridge         = out.ridge || force > Real(1e-3) * scale;
			exact.load.force  = thick * load.force;
			exact.load.moment = thick * load.moment;
			exact.load.energy = thick * load.energy;
			exact.energyUnit  = thick * load.energy * unit;
			exact.forceUnit   = thick * (scale * unit + force / placed);
			exact.momentUnit  = thick * (scale * pair.size() * unit + moment / placed);
		}
		return out;
	}

} // namespace

ExactSurface exactSurface(const Pair& pair, const Vector3& origin, const Real& deepest, std::mt19937_64& random)
{
	return pair.dimension() == 3 ? surfaceOf<3>(pair, origin, deepest, random) : surfaceOf<2>(pair, origin, deepest, random);
}

} // namespace polytope::search
