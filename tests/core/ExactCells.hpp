// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "PrecisePair.hpp"
#include "program/PairPlanes.hpp"

#include <array>
#include <vector>

/// The definitions of the contact surface (src/surface/ContactSurface.hpp) once more, plainly and with 113 digits: each pair of planes, of one body or
/// both, is cut by all others, none is left out and none is found from another. Shares no code with the kernel.
namespace polytope::samples {

#ifdef __SIZEOF_FLOAT128__
using Fine = __float128;
#else
using Fine = Quad;
#endif

template <int D> class ExactCells {
public:
	using Point = std::array<Fine, D>;
	struct Plane {
		Point normal;
		Fine  offset;
	};

	std::vector<Plane> planes; ///< body 1's first
	int                first = 0;

	Fine                             overlap = 0, volume = 0, level = 0; ///< as SurfaceSums
	Point                            force {}, deeper {}, areaVector {};
	std::array<Fine, D == 3 ? 3 : 1> moment {}, deeperTurn {};
	std::vector<Fine>                cell, nearness; ///< of each plane: volume of its cell, and ∫ p dV over it
	int                              pieces   = 0;
	Fine                             farthest = 0; ///< largest distance of a vertex of the overlap from the origin

	/// Planes of both bodies that count as one: their normals differ by no more than `normal` and their offsets by no more than `offset`. The one that is kept
	/// is that of the body that goes first. Of one body only planes that are the same do: without one of two that are nearly the same others would meet in
	/// places that differ by less than 113 digits tell.
	struct Twins {
		double normal = 0, offset = 0;
		bool   secondGoesFirst = false;
	};
	bool sharesPlanes = false; ///< planes of both bodies are twins

	/// Rows as they stand, as exact numbers; neutral ones are left out.
	template <class R> explicit ExactCells(const PairPlanes<R, D>& rows) : ExactCells(rows, Twins()) { }
	template <class R> ExactCells(const PairPlanes<R, D>& rows, const Twins& twins)
	{
		std::vector<Plane> all[2];
		for (int body = 0; body < 2; ++body)
			for (int i = rows.begin(body); i < rows.end(body); ++i) {
				if (rows.offset[i] >= R(padOffset) / 2) continue;
				Plane plane;
				for (int k = 0; k < D; ++k)
					plane.normal[k] = Fine(rows.normal[k][i]);
				plane.offset = Fine(rows.offset[i]);
				all[body].push_back(plane);
			}
		keep(all, twins);
	}

	/// The pair's planes to 113 digits, in world axes from `origin`, a point from body 1's centre.
	ExactCells(const Pair& pair, const Vector3& origin, const Twins& twins)
	{
		const PrecisePairOf<Quad> exact(pair);
		const QuadVector          from = precise(origin);
		std::vector<Plane>        all[2];
		for (int body = 0; body < 2; ++body)
			for (const auto& own : exact.planes[body]) {
				Plane plane;
				for (int k = 0; k < D; ++k)
					plane.normal[k] = fine(own.normal[k]);
				plane.offset = fine(own.slack(from));
				all[body].push_back(plane);
			}
		keep(all, twins);
	}

	/// Everything; `reach`: larger than the overlap is far from the origin.
	void measure(double reach)
	{
		const int count = int(planes.size());
		cell.assign(planes.size(), 0);
		nearness.assign(planes.size(), 0);
		apex_.assign(planes.size(), Point {});
		open_.assign(planes.size(), true);
		for (int i = 0; i < count; ++i)
			for (int j = i + 1; j <= count; ++j)
				add(i, j, cut(i, j, Fine(reach)));
		for (int i = 0; i < count; ++i)
			volume += nearness[i];
	}

	Fine slack(int i, const Point& x) const
	{
		Fine sum = planes[i].offset;
		for (int k = 0; k < D; ++k)
			sum -= planes[i].normal[k] * x[k];
		return sum;
	}

private:
	static Fine fine(const Quad& x)
	{
		const double a = double(x), b = double(Quad(x - a)), c = double(Quad(x - a - b));
		return Fine(a) + Fine(b) + Fine(c);
	}

	void keep(const std::vector<Plane> (&all)[2], const Twins& twins)
	{
		std::vector<Plane> kept[2];
		for (int turn = 0; turn < 2; ++turn) {
			const int body = twins.secondGoesFirst ? 1 - turn : turn;
			for (const Plane& plane : all[body]) {
				bool there = false, shared = false;
				for (const Plane& other : kept[body])
					there = there || coincide(plane, other, Twins());
				for (const Plane& other : kept[1 - body])
					shared = shared || coincide(plane, other, twins);
				sharesPlanes = sharesPlanes || shared;
				if (!there && !shared) kept[body].push_back(plane);
			}
		}
		first  = int(kept[0].size());
		planes = kept[0];
		planes.insert(planes.end(), kept[1].begin(), kept[1].end());
	}

	static bool coincide(const Plane& one, const Plane& other, const Twins& twins)
	{
		Fine square = 0;
		for (int k = 0; k < D; ++k)
			square += (one.normal[k] - other.normal[k]) * (one.normal[k] - other.normal[k]);
		return square <= Fine(twins.normal) * Fine(twins.normal) && size(one.offset - other.offset) <= Fine(twins.offset);
	}

	Point difference(int i, int j) const
	{
		Point out = planes[i].normal;
		for (int k = 0; k < D && j < int(planes.size()); ++k)
			out[k] -= planes[j].normal[k];
		return out;
	}

	static Fine size(Fine x) { return x < 0 ? -x : x; }

	/// Vertices of the piece between planes i and j; j past the last: where slack i is zero.
	std::vector<Point> cut(int i, int j, Fine reach) const
	{
		const int          count = int(planes.size());
		const bool         face  = j == count;
		const Point        m     = difference(i, j);
		const Fine         step  = face ? planes[i].offset : planes[i].offset - planes[j].offset;
		int                main  = 0;
		std::vector<Point> piece;
		for (int k = 1; k < D; ++k)
			if (size(m[k]) > size(m[main])) main = k;
		if (m[main] == 0) return piece;
		for (int corner = 0; corner < (D == 3 ? 4 : 2); ++corner) {
			Point x {};
			x[(main + 1) % D] = corner == 1 || corner == 2 ? reach : -reach;
			if (D == 3) x[(main + 2) % D] = corner >= 2 ? reach : -reach;
			x[main] = step;
			for (int k = 0; k < D; ++k)
				if (k != main) x[main] -= m[k] * x[k];
			x[main] /= m[main];
			piece.push_back(x);
		}
		for (int l = 0; l <= count && !piece.empty(); ++l) {
			if (l == i || l == j || (face && l == count)) continue;
			std::vector<Point> left;
			for (std::size_t t = 0; t < piece.size(); ++t) {
				const Point &here = piece[t], &there = piece[(t + 1) % piece.size()];
				const Fine   f = beyond(l, i, face, here), g = beyond(l, i, face, there);
				if (f >= 0) left.push_back(here);
				if ((f >= 0) != (g >= 0) && (D == 3 || t == 0)) {
					Point x;
					for (int k = 0; k < D; ++k)
						x[k] = here[k] + f / (f - g) * (there[k] - here[k]);
					left.push_back(x);
				}
			}
			piece = left;
		}
		if (int(piece.size()) < D) piece.clear();
		return piece;
	}

	/// By how much plane l is farther than plane i at x; past the last: the slack itself.
	Fine beyond(int l, int i, bool face, const Point& x) const
	{
		if (l == int(planes.size())) return slack(i, x);
		return face ? slack(l, x) : slack(l, x) - slack(i, x);
	}

	/// Area vector of a triangle (2-D: of a segment), turned to m.
	static Point areaOf(const Point* x, const Point& m)
	{
		Point out;
		if constexpr (D == 3) {
			Point a, b;
			for (int k = 0; k < 3; ++k) {
				a[k] = x[1][k] - x[0][k];
				b[k] = x[2][k] - x[0][k];
			}
			for (int k = 0; k < 3; ++k)
				out[k] = (a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3]) / 2;
		} else out = { x[1][1] - x[0][1], x[0][0] - x[1][0] };
		Fine along = 0;
		for (int k = 0; k < D; ++k)
			along += out[k] * m[k];
		for (int k = 0; k < D && along < 0; ++k)
			out[k] = -out[k];
		return out;
	}

	void add(int i, int j, const std::vector<Point>& piece)
	{
		if (piece.empty()) return;
		for (const Point& x : piece) {
			Fine square = 0;
			for (int k = 0; k < D; ++k)
				square += x[k] * x[k];
			if (square > farthest * farthest) farthest = Fine(std::sqrt(double(square)));
		}
		const bool  face = j == int(planes.size());
		const Point m    = difference(i, j);
		pieces += !face && i < first && j >= first;
		for (std::size_t t = 2; t < piece.size() + (D == 2 ? 1 : 0); ++t) {
			Point x[D];
			x[0] = piece[0];
			for (int k = 1; k < D; ++k)
				x[k] = piece[t - std::size_t(D - 1 - k) - (D == 2 ? 1 : 0)];
			const Point area = areaOf(x, m);
			if (!face && i < first && j >= first) addContact(i, x, area);
			addCone(i, x, area, face ? 1 : -1);
			if (!face) addCone(j, x, area, 1);
		}
	}

	void addContact(int i, const Point* x, const Point& area)
	{
		Fine  p[D], sum = 0, squares = 0;
		Point corners {}, weighted {}, twice {};
		for (int v = 0; v < D; ++v) {
			p[v] = slack(i, x[v]);
			sum += p[v];
			squares += p[v] * p[v];
			for (int k = 0; k < D; ++k) {
				corners[k] += x[v][k];
				weighted[k] += p[v] * x[v][k];
				twice[k] += p[v] * p[v] * x[v][k];
			}
		}
		// of a simplex with D corners: ∫ f = |S| Σf / D, ∫ f g = |S| (Σf Σg + Σfg) / (D (D + 1)), and so on
		const Fine one = sum / D, half = (sum * sum + squares) / (2 * D * (D + 1));
		Point      px, ppx;
		for (int k = 0; k < D; ++k) {
			px[k]  = (sum * corners[k] + weighted[k]) / (D * (D + 1));
			ppx[k] = (sum * sum * corners[k] + squares * corners[k] + 2 * sum * weighted[k] + 2 * twice[k])
			        / (2 * D * (D + 1) * (D + 2));
			areaVector[k] += area[k];
			force[k] += one * area[k];
			deeper[k] += half * area[k];
		}
		turn(px, area, moment);
		turn(ppx, area, deeperTurn);
	}

	template <class Turn> static void turn(const Point& a, const Point& b, Turn& out)
	{
		if constexpr (D == 2) out[0] += a[0] * b[1] - a[1] * b[0];
		else
			for (int k = 0; k < 3; ++k)
				out[k] += a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
	}

	std::vector<Point> apex_;
	std::vector<bool>  open_; ///< no apex yet

	/// The cone over a piece of cell i's surface from a point of the cell: from elsewhere thin cells would cancel.
	void addCone(int i, const Point* x, const Point& area, int sign)
	{
		if (open_[i]) apex_[i] = x[0];
		open_[i]  = false;
		Fine part = 0, sum = slack(i, apex_[i]), squares = sum * sum;
		for (int k = 0; k < D; ++k)
			part += sign * (x[0][k] - apex_[i][k]) * area[k] / D;
		for (int v = 0; v < D; ++v) {
			const Fine p = slack(i, x[v]);
			sum += p;
			squares += p * p;
		}
		cell[i] += part;
		overlap += part;
		nearness[i] += part * sum / (D + 1);
		level += part * (sum * sum + squares) / (2 * (D + 1) * (D + 2));
	}
};

} // namespace polytope::samples
