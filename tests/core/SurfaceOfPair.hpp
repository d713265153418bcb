// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "ExactCells.hpp"
#include "PlaneRows.hpp"
#include "surface/FeasibleSums.hpp"
#include "surface/NearPlanes.hpp"

#include <algorithm>
#include <vector>

/// The contact surface of a pair from the kernel's parts, in world axes about the linear program's point, for tests.
namespace polytope::samples {

template <int D> struct SurfaceOfPair {
	SurfaceStatus        status;
	SurfaceSums<Real, D> sums;
	Vector3              origin; ///< world axes, from body 1's centre
	Real                 deepest;
	int                  planes = 0;     ///< that are looked at
	bool                 facing = false; ///< NearPlanes::facing()

	enum Start { Nowhere, Basis, NearPlanesAlone, Vertices };

	/// Walked from the program's basis, without any, or from the basis with those planes alone that can be near; or (3-D) from the vertices of the
	/// feasible set: then the status is NoRoom where they do not say what it is.
	explicit SurfaceOfPair(const Pair& pair, SurfaceParts parts = SurfaceParts::Cells, Start start = Basis)
	        : SurfaceOfPair(pair, linearProgram(pair), parts, start)
	{
	}

	static PlaneRows<Real, D> rowsAbout(const Pair& pair, const Vector3& origin)
	{
		return { moved(pair.shape[0]->planes(), pair.rotation[0], -origin),
			moved(pair.shape[1]->planes(), pair.rotation[1], pair.centre2 - origin) };
	}

	Vector3 force() const { return vectorOf(sums.force, D); }
	Vector3 deeper() const { return vectorOf(sums.deeper, D); }
	/// Moment about body 1's centre.
	Vector3 moment() const { return about(sums.moment, force()); }
	Vector3 deeperTurn() const { return about(sums.deeperTurn, deeper()); }

private:
	static constexpr int width = std::is_same_v<Real, double> ? 4 : 1;

	SurfaceOfPair(const Pair& pair, const ContactResult& program, SurfaceParts parts, Start start)
	        : origin(program.point), deepest(-program.infeasibility)
	{
		PlaneRows<Real, D> rows = rowsAbout(pair, origin);
		LpBasis<Real, D>   basis;
		basis.infeasibility = program.infeasibility;
		for (int k = 0; k <= D; ++k)
			basis.plane[k] = rows.row(program.basis[k] & 1, program.basis[k] >> 1);
		std::vector<Real>          numbers(std::size_t(NearPlanes<Real, D, width>::numbersNeeded(rows.planes.total)), Real(NAN));
		LpBasis<Real, D>           ofNear = basis;
		std::vector<int>           indices(std::size_t(NearPlanes<Real, D, width>::indicesNeeded(rows.planes.total)), -77);
		NearPlanes<Real, D, width> near(rows.planes, ofNear, pair.size(), numbers.data(), indices.data());
		facing = near.facing();
		if (start == Vertices) explore(near.planes(), ofNear.plane, pair.size());
		else if (start == NearPlanesAlone) walk(near.planes(), ofNear.plane, D + 1, pair.size(), parts);
		else walk(rows.planes, basis.plane, start == Basis ? D + 1 : 0, pair.size(), parts);
	}

	void walk(PairPlanes<Real, D>& all, const int* basis, int count, Real size, SurfaceParts parts)
	{
		planes = all.total;
		std::vector<Real>             numbers(std::size_t(SurfaceBuffers<Real, D>::numbersNeeded(planes)), Real(NAN));
		std::vector<int>              indices(std::size_t(SurfaceBuffers<Real, D>::indicesNeeded(planes)), -77);
		const SurfaceBuffers<Real, D> buffers(planes, numbers.data(), indices.data());
		status = contactSurface<Real, D, width>(all, basis, count, size, deepest, parts, buffers, sums);
	}

	void explore(const PairPlanes<Real, D>& all, const int* basis, Real size)
	{
		status = SurfaceStatus::NoRoom;
		if constexpr (D == 3) {
			std::vector<Real>        numbers(std::size_t(FeasibleBuffers<Real>::numbersNeeded(all.total)), Real(NAN));
			std::vector<int>         indices(std::size_t(FeasibleBuffers<Real>::indicesNeeded(all.total)), -77);
			FeasibleBuffers<Real>    buffers(all.total, numbers.data(), indices.data());
			FeasibleSet<Real, width> set(all, size, buffers);
			if (!set.explore(basis, true)) return;
			FeasibleSums<Real, width> sum(buffers, true, sums);
			status = sums.pieces > 0 ? SurfaceStatus::Found : SurfaceStatus::None;
		}
	}

	Vector3 about(const Real* turn, const Vector3& f) const
	{
		const Vector3 own = D == 3 ? Vector3(turn[0], turn[1], turn[2]) : Vector3(0, 0, turn[0]);
		return own + origin.cross(f);
	}
};

} // namespace polytope::samples
