// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "numbers/Four.hpp"
#include "surface/FeasibleBuffers.hpp"

#include <utility>

/// Where the vertices of the feasible set of a pair (FeasibleSet.hpp) are, by the planes that are tight in them.
namespace polytope {

template <class R, int W> class FeasibleVertices {
public:
	using Buffers = FeasibleBuffers<R>;
	using Four    = polytope::Four<R, W>; ///< x, y, z and s, or a and d

	POLYTOPE_INLINE FeasibleVertices(const PairPlanes<R, 3>& planes, R size, Buffers& buffers)
	        : planes_(planes), size_(size), buffers_(buffers)
	{
	}

	/// The row of the plane of no pressure.
	int none() const { return planes_.total; }
	/// Whether that is the tight plane in this slot of a vertex.
	bool isNone(int v, int slot) const { return buffers_.owner[buffers_.tight[v][slot]] == Buffers::NoBody; }

	/// Tight plane k is that of this row of the pair, or that of no pressure.
	POLYTOPE_INLINE void setPlane(int k, int row)
	{
		const bool no     = row == none();
		buffers_.rowOf[k] = row;
		buffers_.owner[k] = no ? Buffers::NoBody : row >= planes_.first ? Buffers::Body2 : Buffers::Body1;
		const Four plane  = no
		         ? repeated<Four>(R(0))
		         : four<Four>(planes_.normal[0][row], planes_.normal[1][row], planes_.normal[2][row], planes_.offset[row]);
		storeFour(buffers_.plane + 4 * k, plane);
	}

	static POLYTOPE_INLINE R dotOf3(const Four& a, const Four& b)
	{
		const Four product = a * b;
		return product[0] + product[1] + product[2];
	}

	/// Where the planes of a vertex cross: three differences of them, and the cross products of two of those in turn.
	struct Crossing {
		Four row[3], across[3], last; ///< `last`: the plane in the last slot
		R    volume, lengths;         ///< of the three; the product of the squares of their lengths, or what that cannot exceed

		/// Whether the planes are so nearly parallel that it matters which is subtracted from which.
		bool isSharp() const { return volume * volume < R(tolerance::sharpVertex) * R(tolerance::sharpVertex) * lengths; }
	};
	/// Each of the others less the last one; false if they do not meet in a point.
	POLYTOPE_INLINE bool cross(int v, Crossing& c) const
	{
		c.last = tightPlane(v, 3);
		for (int k = 0; k < 3; ++k)
			c.row[k] = tightPlane(v, k) - c.last;
		multiply(c);
		if (c.isSharp()) c.lengths = dotOf3(c.row[0], c.row[0]) * dotOf3(c.row[1], c.row[1]) * dotOf3(c.row[2], c.row[2]);
		const R least = R(tolerance::vertexVolume);
		return c.volume * c.volume > least * least * c.lengths;
	}

	/// Point and pressure of a vertex.
	POLYTOPE_INLINE void place(int v, const Crossing& c)
	{
		if (c.isSharp()) {
			const Crossing sharp = crossNearest(v);
			placeAt(v, sharp);
			refine(v, sharp);
		} else placeAt(v, c);
	}

	/// What rounding leaves of the slack of a plane through a vertex.
	R closeness(int v) const
	{
		const R* const p = buffers_.point + 4 * v;
		return closenessAt(abs(p[0]) + abs(p[1]) + abs(p[2]));
	}

	/// Point and pressure of all vertices; false if they do not meet in a point, or violate a plane.
	POLYTOPE_INLINE bool placeAll()
	{
		const int last    = buffers_.vertices - 1;
		V         largest = broadcast<R, W>(R(0)), extent = largest, least = broadcast<R, W>(R(padOffset));
		moved_ = 0;
		for (int first = 0; first <= last; first += W) {
			V x[4];
			if (!placeSeveral(first, last, x)) return false;
			largest = maxOf(largest, x[3]);
			least   = minOf(least, x[3]);
			extent  = maxOf(extent, V(absolute(x[0]) + absolute(x[1]) + absolute(x[2])));
		}
		for (int v = 0; v <= last; ++v) {
			const R* const p    = buffers_.point + 4 * v;
			const V        x[3] = { broadcast<R, W>(p[0]), broadcast<R, W>(p[1]), broadcast<R, W>(p[2]) };
			V own = broadcast<R, W>(R(padOffset)); // for each vertex anew: AVX2 has no register left for one of all vertices
			for (int k = 0; k < planes_.total; k += W) {
				V a[3];
				own = minOf(own, slacksOf<R, 3, W>(planes_, k, x, a));
			}
			least = minOf(least, V(own - broadcast<R, W>(p[3])));
		}
		largest_ = horizontalMax<R, W>(largest);
		// a pressure is no more certain than a rounding over the overlap's thickness: a vertex need not be
		return horizontalMin<R, W>(least) >= -closenessAt(horizontalMax<R, W>(extent)) && moved_ * largest_ <= size_;
	}

	/// The largest pressure of those that placeAll() has placed.
	R largestPressure() const { return largest_; }

private:
	using V = typename Lanes<R, W>::Type;

	static_assert(Buffers::mostVertices % W == 0);

	/// closeness() of a vertex whose coordinates add up to so much.
	R closenessAt(R coordinates) const { return R(tolerance::feasibleVertex) * (size_ + coordinates); }

	/// Places W vertices from this one on, the last one again where there are no more. `x`: x, y, z and s of each.
	POLYTOPE_INLINE bool placeSeveral(int first, int last, V (&x)[4])
	{
		const auto vertex = [&](int lane) { return first + lane < last ? first + lane : last; };
		V          row[4][4];
		for (int slot = 0; slot < 4; ++slot)
			gatherFours<R, W>([&](int lane) { return buffers_.plane + 4 * buffers_.tight[vertex(lane)][slot]; }, row[slot]);
		V volume = broadcast<R, W>(0);
		for (int k = 0; k < 3; ++k)
			for (int m = 0; m < 4; ++m)
				row[k][m] -= row[3][m];
		for (int m = 0; m < 3; ++m)
			x[m] = volume;
		for (int k = 0; k < 3; ++k) {
			const V(&a)[4] = row[(k + 1) % 3], (&b)[4] = row[(k + 2) % 3];
			for (int m = 0; m < 3; ++m) {
				const int l = (m + 1) % 3, n = (m + 2) % 3;
				const V   across = a[l] * b[n] - a[n] * b[l];
				x[m] += across * row[k][3];
				if (k == 0) volume += across * row[0][m];
			}
		}
		const V inverse = broadcast<R, W>(1) / volume;
		x[3]            = row[3][3]; // zero for the plane of no pressure
		for (int m = 0; m < 3; ++m) {
			x[m] *= inverse;
			x[3] -= row[3][m] * x[m];
		}
		scatterFours<R, W>(x, buffers_.point + 4 * first);
		const R mayBeSharp = 8 * R(tolerance::sharpVertex); // differences of unit vectors are no longer than 2
		if (horizontalMin<R, W>(absolute(volume)) >= mayBeSharp) return true;
		R volumes[W];
		store<R, W>(volumes, volume);
		for (int lane = 0; lane < W && first + lane <= last; ++lane) {
			if (abs(volumes[lane]) >= mayBeSharp) continue;
			Crossing c;
			if (!cross(first + lane, c)) return false;
			place(first + lane, c);
		}
		gatherFours<R, W>([&](int lane) { return buffers_.point + 4 * vertex(lane); }, x);
		return true;
	}

	POLYTOPE_INLINE Four tightPlane(int v, int slot) const { return loadFour<Four>(buffers_.plane + 4 * buffers_.tight[v][slot]); }

	static POLYTOPE_INLINE void multiply(Crossing& c)
	{
		for (int k = 0; k < 3; ++k)
			c.across[k] = crossProduct(c.row[(k + 1) % 3], c.row[(k + 2) % 3]);
		c.volume  = dotOf3(c.row[0], c.across[0]);
		c.lengths = 64; // differences of unit vectors
	}

	/// As cross(), with each plane less the one of those before it that is most nearly parallel to it, in the order of a minimum spanning tree. The
	/// difference of planes that nearly coincide is exact; where a vertex has two such pairs, no plane subtracted from all others gives both.
	POLYTOPE_APART Crossing crossNearest(int v) const
	{
		Crossing c;
		c.last          = tightPlane(v, 3);
		Four reached[4] = { c.last };
		int  left[3]    = { 0, 1, 2 };
		for (int k = 0; k < 3; ++k) {
			R   least = R(padOffset);
			int place = k;
			for (int j = k; j < 3; ++j)
				for (int i = 0; i <= k; ++i) {
					const Four apart  = tightPlane(v, left[j]) - reached[i];
					const R    square = dotOf3(apart, apart);
					if (!(square < least)) continue;
					least    = square;
					place    = j;
					c.row[k] = apart;
				}
			reached[k + 1] = tightPlane(v, left[place]);
			std::swap(left[k], left[place]);
		}
		multiply(c);
		return c;
	}

	/// The cross products of planes that are nearly parallel give a vertex that is off its planes by what they round, times one over their
	/// angle. A step with what is left leaves what the slacks round. How long it is says how certain the vertex is along the line in which
	/// those planes meet.
	POLYTOPE_INLINE void refine(int v, const Crossing& c)
	{
		R* const   point = buffers_.point + 4 * v;
		const Four x     = loadFour<Four>(point);
		R          left[3];
		for (int k = 0; k < 3; ++k)
			left[k] = (c.row[k][3] - dotOf3(c.row[k], x)) / c.volume;
		const Four step = c.across[0] * repeated<Four>(left[0]) + c.across[1] * repeated<Four>(left[1])
		        + c.across[2] * repeated<Four>(left[2]);
		R moved = 0;
		for (int m = 0; m < 3; ++m) {
			point[m] += step[m];
			moved += abs(step[m]);
		}
		moved_ = maxOf<R>(moved_, moved / closeness(v));
		if (!isNone(v, 3)) point[3] = c.last[3] - dotOf3(c.last, loadFour<Four>(point));
	}

	POLYTOPE_INLINE void placeAt(int v, const Crossing& c)
	{
		const Four x = (c.across[0] * repeated<Four>(c.row[0][3]) + c.across[1] * repeated<Four>(c.row[1][3])
		                       + c.across[2] * repeated<Four>(c.row[2][3]))
		        * repeated<Four>(1 / c.volume);
		R point[4];
		storeFour(point, x);
		for (int m = 0; m < 3; ++m)
			buffers_.point[4 * v + m] = point[m];
		buffers_.point[4 * v + 3] = isNone(v, 3) ? R(0) : c.last[3] - dotOf3(c.last, x);
	}

	const PairPlanes<R, 3>& planes_;
	R                       size_, largest_ = 0;
	R                       moved_ = 0; ///< farthest step of refine() over what rounding leaves of a vertex' slacks
	Buffers&                buffers_;
};

} // namespace polytope
