// SPDX-License-Identifier: GPL-2.0-or-later
#include "shape/ConvexShape.hpp"

#include "numbers/NumberText.hpp"
#include "program/SimplexLp.hpp"

#include <cmath>
#include <map>
#include <mutex>
#include <stdexcept>
#include <string>

namespace polytope {

namespace {

	/// Largest inscribed ball by the same simplex, started from a simplex of artificial planes far outside.
	template <int D>
	Real findInscribedBall(const HalfSpaces& set, const Real* arrays, int padded, Real reach, std::array<int, 4>& planesOfBall,
	        std::optional<LpBasis<Real, D>>& ball)
	{
		const int           total = padded + padWidth;
		std::vector<Real>   rows(std::size_t(D + 3) * total, Real(0));
		PairPlanes<Real, D> planes;
		for (int k = 0; k < D; ++k)
			planes.normal[k] = rows.data() + k * total;
		planes.offset = rows.data() + D * total;
		planes.slack  = rows.data() + (D + 1) * total;
		planes.rate   = rows.data() + (D + 2) * total;
		planes.first  = padded;
		planes.total  = total;
		for (int i = 0; i < total; ++i) {
			for (int k = 0; k < D; ++k)
				planes.normal[k][i] = i < padded ? arrays[k * padded + i] : Real(0);
			planes.offset[i] = i < padded ? arrays[D * padded + i] : Real(padOffset);
		}
		// a regular simplex (tetrahedron, triangle): Σ a = 0, so λ = 1/(D+1) is feasible
		LpBasis<Real, D> basis;
		const Real       corner[4][3] = { { 1, 1, 1 }, { 1, -1, -1 }, { -1, 1, -1 }, { -1, -1, 1 } };
		const Real       half = Real(1) / 2, root3 = sqrt(Real(3)) / 2;
		const Real       fan[3][2] = { { 0, 1 }, { -root3, -half }, { root3, -half } };
		for (int c = 0; c <= D; ++c) {
			for (int k = 0; k < D; ++k)
				planes.normal[k][padded + c] = D == 3 ? corner[c][k] / sqrt(Real(3)) : fan[c][k];
			planes.offset[padded + c] = reach;
			basis.plane[c]            = padded + c;
		}
		const auto inside = [&] {
			bool all = true;
			for (int k = 0; k <= D; ++k)
				all = all && basis.plane[k] < padded;
			return all;
		};
		int       pivots = 0;
		const int limit  = 1000 + 100 * int(set.size());
		solveBasis<Real, D>(planes, basis);
		const LpStatus status = solveLp<Real, D, 1>(planes, basis, reach, Real(padOffset), reach, limit, pivots);
		if (status != LpStatus::Optimal || !inside()) {
			planes.total = padded; // solveWide() has artificial planes of its own
			if (!solveWide<Real, D>(planes, basis, reach, limit, pivots))
				throw std::runtime_error("ConvexShape: the inscribed ball of a bounded set was not found");
		}
		for (int k = 0; k <= D; ++k)
			planesOfBall[k] = basis.plane[k];
		const Real radius = -basis.infeasibility;
		// once more, for what refinement has left of the inverse
		if (solveBasis<Real, D>(planes, basis) && dualFeasible<Real, D>(basis)) ball = basis;
		return radius;
	}

} // namespace

ConvexShape::ConvexShape(const HalfSpaces& planes, Real cornerRadius, Real thickness)
        : planes_(normalised(planes)), cornerRadius_(cornerRadius), thickness_(thickness),
          polyhedron_(polytope::polyhedron(planes_, thickness)), mass_(massProperties(polyhedron_))
{
	fillArrays();
	const int D = dimension();
	for (const Vector3& v : polyhedron_.vertices)
		boundingRadius_ = std::max(boundingRadius_, Real(D == 2 ? v.head<2>().norm() : v.norm()));
	// artificial planes must lie outside the ball: it is inside the body. Not as far as the farthest plane: one that no corner of
	// the body reaches may be anywhere, and rounding is a part of the reach
	const Real reach = 16 * boundingRadius_;
	inscribedRadius_ = D == 3 ? findInscribedBall<3>(planes_, arrays_.data(), padded_, reach, inscribedBasis_, inscribedBall_.second)
	                          : findInscribedBall<2>(planes_, arrays_.data(), padded_, reach, inscribedBasis_, inscribedBall_.first);
	if (!isfinite(cornerRadius) || cornerRadius < 0 || cornerRadius >= boundingRadius_)
		throw std::invalid_argument(
		        "cornerRadius: must be at least 0 and fit inside the body, that is, be smaller than the inscribed ball's radius "
		        + numberText(inscribedRadius_) + " m; got " + numberText(cornerRadius));
}

void ConvexShape::fillArrays()
{
	const int D = dimension();
	padded_     = (planeCount() + padWidth - 1) / padWidth * padWidth;
	arrays_.assign(std::size_t(D + 1) * padded_, Real(0));
	for (int i = 0; i < padded_; ++i) {
		const bool real = i < planeCount();
		for (int k = 0; k < D; ++k)
			arrays_[k * padded_ + i] = real ? planes_.normals[i][k] : Real(0);
		arrays_[D * padded_ + i] = real ? planes_.offsets[i] : Real(padOffset);
	}
}

std::shared_ptr<const ConvexShape> ConvexShape::halfSpace(const Vector3& unitNormal, int dimension)
{
	std::shared_ptr<ConvexShape> wall(new ConvexShape);
	wall->planes_          = { { unitNormal }, { Real(0) }, dimension };
	wall->inscribedRadius_ = wall->boundingRadius_ = wall->thickness_ = std::numeric_limits<Real>::infinity();
	// below padOffset, so neutral planes stay neutral, and far above every slack
	wall->cornerRadius_ = Real(padOffset) / 1e30;
	wall->fillArrays();
	return wall;
}

std::shared_ptr<const ConvexShape> ConvexShape::shared(const HalfSpaces& planes, Real cornerRadius, Real thickness)
{
	// keyed by the exact numbers; entries whose last body is gone are swept when the map has doubled
	using Key = std::vector<Real>;
	static std::mutex                                      mutex;
	static std::map<Key, std::weak_ptr<const ConvexShape>> known;
	static std::size_t                                     sweepAt = 64;

	Key key { Real(planes.dimension), cornerRadius, thickness };
	for (const Vector3& n : planes.normals)
		key.insert(key.end(), { n[0], n[1], n[2] });
	key.insert(key.end(), planes.offsets.begin(), planes.offsets.end());
	for (const Real& number : key)
		if (!(number == number)) return std::make_shared<const ConvexShape>(planes, cornerRadius, thickness); // NaN: refused there

	const std::lock_guard<std::mutex> lock(mutex);
	if (auto shape = known[key].lock()) return shape;
	auto shape = std::make_shared<const ConvexShape>(planes, cornerRadius, thickness);
	known[key] = shape;
	if (known.size() > sweepAt) {
		for (auto it = known.begin(); it != known.end();)
			it = it->second.expired() ? known.erase(it) : std::next(it);
		sweepAt = std::max<std::size_t>(64, 2 * known.size());
	}
	return shape;
}

} // namespace polytope
