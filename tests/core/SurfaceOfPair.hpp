// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "ExactCells.hpp"
#include "PlaneRows.hpp"
#include "surface/ContactSurface.hpp"

#include <algorithm>
#include <vector>

/// The contact surface of a pair from the kernel's parts, in world axes about the linear program's point, for tests.
namespace polytope::samples {

template <int D> struct SurfaceOfPair {
	SurfaceStatus        status;
	SurfaceSums<Real, D> sums;
	Vector3              origin; ///< world axes, from body 1's centre
	Real                 deepest;

	/// `seeded`: begun at the program's basis, otherwise without.
	explicit SurfaceOfPair(const Pair& pair, SurfaceParts parts = SurfaceParts::Cells, bool seeded = true)
	        : SurfaceOfPair(pair, linearProgram(pair), parts, seeded)
	{
	}

	/// The same of rows that are there, whose offsets are left as they were.
	SurfaceOfPair(PlaneRows<Real, D>& rows, const std::vector<int>& basis, Real size, Real deep, SurfaceParts parts) : deepest(deep)
	{
		walk(rows, basis, size, parts);
	}

	static PlaneRows<Real, D> rowsAbout(const Pair& pair, const Vector3& origin)
	{
		return { moved(pair.shape[0]->planes(), pair.rotation[0], -origin),
			moved(pair.shape[1]->planes(), pair.rotation[1], pair.centre2 - origin) };
	}

	Vector3 force() const { return vectorOf(sums.force, D); }
	Vector3 deeper() const { return vectorOf(sums.deeper, D); }
	/// About body 1's centre.
	Vector3 moment() const { return about(sums.moment, force()); }
	Vector3 deeperTurn() const { return about(sums.deeperTurn, deeper()); }

private:
	SurfaceOfPair(const Pair& pair, const ContactResult& program, SurfaceParts parts, bool seeded)
	        : origin(program.point), deepest(-program.infeasibility)
	{
		PlaneRows<Real, D> rows = rowsAbout(pair, origin);
		std::vector<int>   basis;
		for (int k = 0; k <= D && seeded; ++k)
			basis.push_back(rows.row(program.basis[k] & 1, program.basis[k] >> 1));
		walk(rows, basis, pair.size(), parts);
	}

	void walk(PlaneRows<Real, D>& rows, const std::vector<int>& basis, Real size, SurfaceParts parts)
	{
		const int                     total = rows.planes.total;
		std::vector<Real>             numbers(std::size_t(SurfaceBuffers<Real, D>::numbersNeeded(total)), Real(NAN));
		std::vector<int>              indices(std::size_t(SurfaceBuffers<Real, D>::indicesNeeded(total)), -77);
		const SurfaceBuffers<Real, D> buffers(total, numbers.data(), indices.data());
		constexpr int                 width = std::is_same_v<Real, double> ? 4 : 1;
		status = contactSurface<Real, D, width>(rows.planes, basis.data(), int(basis.size()), size, deepest, parts, buffers, sums);
	}

	Vector3 about(const Real* turn, const Vector3& f) const
	{
		const Vector3 own = D == 3 ? Vector3(turn[0], turn[1], turn[2]) : Vector3(0, 0, turn[0]);
		return own + origin.cross(f);
	}
};

} // namespace polytope::samples
