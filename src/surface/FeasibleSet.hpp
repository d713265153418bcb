// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "surface/FeasiblePieces.hpp"
#include "surface/FeasibleVertices.hpp"
#include "surface/FlushPlanes.hpp"

#include <utility>

/// The set {(x, s): a_i·x + s ≤ d_i, s ≥ 0} of a pair that overlaps, a polytope in four dimensions, by its vertices and edges.
///
/// A vertex has four tight planes, an edge three; the plane of no pressure, s ≥ 0, counts as one. The vertices are found from the linear
/// program's optimum along the edges, as in the simplex method. In the next step the same planes are mostly tight in the same vertices.
/// Then nothing is looked for: points at which no plane is violated, and each of whose four edges ends in another of them, are all
/// vertices, for the edges of a polytope connect all its vertices.
///
/// Where more planes meet (regular bodies have the same slack on several planes along a line), offsets that are changed by
/// tolerance::splitPlanes say which four belong together. The vertices themselves have the planes' true offsets, by which planes of both
/// bodies that lie by each other are told apart (FlushPlanes.hpp). What all that does not make a simple polytope is left to SurfaceWalk
/// (ContactSurface.hpp).
namespace polytope {

template <class R, int W> class FeasibleSet {
public:
	using Buffers = FeasibleBuffers<R>;

	/// `size`: that of the smaller body. The planes may be all of a pair, or those that are near.
	POLYTOPE_INLINE FeasibleSet(const PairPlanes<R, 3>& planes, R size, Buffers& buffers)
	        : planes_(planes), size_(size), buffers_(buffers), vertices_(planes, size, buffers), flush_(planes, size, buffers)
	{
	}

	/// Finds the vertices with the tight planes of the last step. False if they do not make this step's vertices.
	POLYTOPE_INLINE bool recall(const KeptVertices& kept, int rowsOfBody1, bool energy)
	{
		const int planes = kept.planes, vertices = kept.vertices;
		if (vertices < 5 || vertices > Buffers::mostVertices || planes < 5 || planes > Buffers::mostPlanes) return false;
		for (int k = 0; k < planes; ++k) {
			const int row = kept.row(k, rowsOfBody1, planes_.total);
			if (row < 0) return false;
			vertices_.setPlane(k, row);
		}
		buffers_.planes   = planes;
		buffers_.vertices = vertices;
		std::memcpy(buffers_.tight, kept.tight.data(), 4 * std::size_t(vertices));
		const bool known = kept.bytesOfPieces > 0 && kept.ofEnergy == energy;
		for (int v = 0; v < vertices && known; ++v)
			buffers_.mask[v] = maskOf(buffers_.tight[v]);
		if (!known && !isPolytope()) return false;
		if (!vertices_.placeAll() || (kept.shared != 0 && flush_.shareCoinciding() != kept.shared)) return false;
		if (known) {
			buffers_.pieces         = kept.piece.data();
			buffers_.bytesOfPieces  = kept.bytesOfPieces;
			buffers_.piecesOfEnergy = energy;
		} else FeasiblePieces<R>(buffers_, energy);
		return true;
	}

	/// What recall() needs in the next step; `rowOfAll`: gives a row's number among all planes of the pair.
	template <class Rows> POLYTOPE_INLINE void keep(KeptVertices& kept, int rowsOfBody1, const Rows& rowOfAll) const
	{
		kept.exchanged = 0;
		kept.shared    = 0;
		kept.planes    = std::uint8_t(buffers_.planes);
		kept.vertices  = std::uint8_t(buffers_.vertices);
		for (int k = 0; k < buffers_.planes; ++k) {
			const bool none = buffers_.owner[k] == Buffers::NoBody;
			if (buffers_.owner[k] == Buffers::Both) kept.shared |= bit(k);
			const int name
			        = none ? int(KeptVertices::noPressure) : KeptVertices::name(rowOfAll(buffers_.rowOf[k]), rowsOfBody1);
			if (name < 0) kept.vertices = 0;
			kept.plane[std::size_t(k)] = std::uint16_t(name);
		}
		for (int v = 0; v < buffers_.vertices; ++v)
			for (int k = 0; k < 4; ++k)
				kept.tight[std::size_t(v)][std::size_t(k)] = buffers_.tight[v][k];
		keepPieces(kept);
	}

	/// If they are not those. Of more than there is room for none are kept.
	POLYTOPE_INLINE void keepPieces(KeptVertices& kept) const
	{
		if (buffers_.pieces == kept.piece.data()) return;
		const bool fit     = buffers_.bytesOfPieces <= KeptVertices::mostBytes;
		kept.bytesOfPieces = std::uint8_t(fit ? buffers_.bytesOfPieces : 0);
		kept.ofEnergy      = buffers_.piecesOfEnergy;
		std::memcpy(kept.piece.data(), buffers_.pieces, kept.bytesOfPieces);
	}

	/// Finds the vertices, beginning with the one at which these planes are tight. False if the set is not simple.
	POLYTOPE_INLINE bool explore(const int* basis, bool energy)
	{
		buffers_.planes = 0;
		for (int k = 0; k <= planes_.total; ++k)
			buffers_.localOf[k] = -1;
		for (int k = 0; k < planes_.total; ++k)
			buffers_.split[k] = planes_.offset[k] + R(tolerance::splitPlanes) * size_ * shareOf(k);
		const bool twins = flush_.leaveOutTwins();
		for (int k = 0; k < 4; ++k) {
			const int plane = use(twins ? flush_.nearerTwin(basis[k]) : basis[k]);
			if (plane < 0) return false;
			buffers_.tight[0][k] = std::uint8_t(plane);
		}
		buffers_.vertices = 1;
		begin(0);
		if (!startIsFeasible()) return false;
		for (int v = 0; v < buffers_.vertices; ++v)
			if (!goOn(v)) return false;
		for (int k = 0; k < buffers_.planes; ++k)
			vertices_.setPlane(k, buffers_.rowOf[k]);
		if (twins) flush_.shareCoinciding();
		if (buffers_.vertices < 5 || !everyEdgeEnds() || !vertices_.placeAll()) return false;
		FeasiblePieces<R>(buffers_, energy);
		return true;
	}

	/// s of the program's optimum, which is one of the vertices.
	R largestPressure() const { return vertices_.largestPressure(); }

private:
	static constexpr int lastPlane = Buffers::mostPlanes - 1;
	static_assert((Buffers::mostPlanes & lastPlane) == 0);

	using V        = typename Lanes<R, W>::Type;
	using Four     = typename FeasibleVertices<R, W>::Four;
	using Crossing = typename FeasibleVertices<R, W>::Crossing;

	static std::uint64_t bit(int plane) { return std::uint64_t(1) << plane; }

	static POLYTOPE_INLINE std::uint64_t maskOf(const std::uint8_t* tight)
	{
		return bit(tight[0]) | bit(tight[1]) | bit(tight[2]) | bit(tight[3]);
	}

	/// Whether the vertices, whatever they are, are joined as those of a polytope: on each edge there are two of them.
	POLYTOPE_APART bool isPolytope()
	{
		std::uint64_t noPressure = 0, named = 0, misplaced = 0;
		bool          four = true;
		for (int k = 0; k < buffers_.planes; ++k)
			if (buffers_.owner[k] == Buffers::NoBody) noPressure |= bit(k);
		for (int v = 0; v < buffers_.vertices; ++v) {
			const std::uint8_t* const tight = buffers_.tight[v];
			if ((tight[0] | tight[1] | tight[2] | tight[3]) > lastPlane) return false;
			buffers_.mask[v]    = maskOf(tight);
			buffers_.dropped[v] = 0;
			four                = four && __builtin_popcountll(buffers_.mask[v]) == 4;
			named |= buffers_.mask[v];
			misplaced |= (bit(tight[0]) | bit(tight[1]) | bit(tight[2])) & noPressure;
		}
		bool right = four && misplaced == 0 && (named >> (buffers_.planes - 1)) <= 1 && !(buffers_.mask[0] & noPressure);
		for (int v = 1; v < buffers_.vertices; ++v)
			for (int w = 0; w < v; ++w) {
				if (!buffers_.areJoined(v, w)) continue;
				const std::uint64_t one   = buffers_.mask[v] & ~buffers_.mask[w],
				                    other = buffers_.mask[w] & ~buffers_.mask[v];
				right                     = right && ((buffers_.dropped[v] & one) | (buffers_.dropped[w] & other)) == 0;
				buffers_.dropped[v] |= one;
				buffers_.dropped[w] |= other;
			}
		return right && everyEdgeEnds();
	}

	/// Each vertex' four edges end in another.
	POLYTOPE_INLINE bool everyEdgeEnds() const
	{
		bool all = true;
		for (int v = 0; v < buffers_.vertices; ++v)
			all = all && buffers_.dropped[v] == buffers_.mask[v];
		return all;
	}

	// --------------------------------------------------------------------------------------------------------------------------------- exploring

	/// A number from 0 to 1, different for each plane and the same in each step. Its bits are mixed, since sums of such numbers must differ,
	/// too, for the planes of a regular body.
	static R shareOf(int row)
	{
		std::uint32_t mixed = 2654435761u * std::uint32_t(row + 1);
		mixed               = (mixed ^ mixed >> 15) * 2246822519u;
		return R(mixed >> 1) / R(2147483648.);
	}

	/// Number of a row of the planes, or of that of no pressure, among those that are tight, with its split offset; −1: there is no room.
	POLYTOPE_INLINE int use(int row)
	{
		if (buffers_.localOf[row] >= 0) return buffers_.localOf[row];
		if (buffers_.planes == Buffers::mostPlanes) return -1;
		const int k = buffers_.localOf[row] = buffers_.planes++;
		vertices_.setPlane(k, row);
		if (row != vertices_.none()) buffers_.plane[4 * k + 3] = buffers_.split[row];
		return k;
	}

	/// A new vertex, whose planes are known. That of no pressure, whose slack is s and not d − a·x − s, comes last.
	POLYTOPE_INLINE void begin(int v)
	{
		std::uint8_t* const tight = buffers_.tight[v];
		for (int k = 0; k < 3; ++k)
			if (buffers_.owner[tight[k]] == Buffers::NoBody) std::swap(tight[k], tight[3]);
		buffers_.mask[v]    = maskOf(tight);
		buffers_.dropped[v] = 0;
	}

	/// The edge on which the plane in `slot` is not tight: for the planes that are tight, the differences stay zero, and so does d − a·x − s of one of
	/// them. Returns how s changes on it.
	POLYTOPE_INLINE R edge(int v, const Crossing& c, int slot, Four& way) const
	{
		const Four out = repeated<Four>(c.volume > 0 ? R(1) : R(-1));
		way            = slot < 3 ? -out * c.across[slot] : out * (c.across[0] + c.across[1] + c.across[2]);
		if (slot == 3 && vertices_.isNone(v, 3)) way = -way;
		return slot < 3 ? -vertices_.dotOf3(c.last, way)
		                : -vertices_.dotOf3(loadFour<Four>(buffers_.plane + 4 * buffers_.tight[v][0]), way);
	}

	/// The optimum's planes may be no vertex with the split offsets. Dual pivots lead to that which is the optimum with those.
	POLYTOPE_INLINE bool startIsFeasible()
	{
		for (int pivot = 0; pivot <= tolerance::splitPivots; ++pivot) {
			Crossing c;
			if (!vertices_.cross(0, c)) return false;
			vertices_.place(0, c);
			if (slacksAt(0)) return true;
			int violated = 0;
			for (int k = 1; k < planes_.total; ++k)
				if (buffers_.slack[k] < buffers_.slack[violated]) violated = k;
			int leaves = -1;
			R   least  = R(padOffset);
			for (int slot = 0; slot < 4; ++slot) {
				Four    way;
				const R up      = edge(0, c, slot, way);
				R       towards = up;
				for (int m = 0; m < 3; ++m)
					towards += planes_.normal[m][violated] * way[m];
				if (!(towards < 0) || !(up / towards < least)) continue;
				least  = up / towards;
				leaves = slot;
			}
			const int plane = use(violated);
			if (leaves < 0 || plane < 0) return false;
			buffers_.tight[0][leaves] = std::uint8_t(plane);
			begin(0);
		}
		return false;
	}

	/// Follows the edges of vertex v that have not been followed from their other end.
	POLYTOPE_INLINE bool goOn(int v)
	{
		Crossing c;
		if (!vertices_.cross(v, c)) return false;
		vertices_.place(v, c);
		if (!slacksAt(v)) return false;
		for (int slot = 0; slot < 4; ++slot) {
			if (buffers_.dropped[v] & bit(buffers_.tight[v][slot])) continue;
			Four      way;
			const R   up   = edge(v, c, slot, way);
			const int next = firstMet(v, way, up), plane = next < 0 ? -1 : use(next);
			if (plane < 0 || !arrive(v, slot, plane)) return false;
		}
		return true;
	}

	/// Slacks at vertex v with the split offsets; false if a plane is violated. Those of its own planes count as far away: rounding must not
	/// meet them again.
	POLYTOPE_INLINE bool slacksAt(int v)
	{
		const R* const p    = buffers_.point + 4 * v;
		const V        x[3] = { broadcast<R, W>(p[0]), broadcast<R, W>(p[1]), broadcast<R, W>(p[2]) }, s = broadcast<R, W>(p[3]);
		V              least = s;
		for (int k = 0; k < planes_.total; k += W) {
			V slack = load<R, W>(buffers_.split + k) - s;
			for (int m = 0; m < 3; ++m)
				slack -= load<R, W>(planes_.normal[m] + k) * x[m];
			least = minOf(least, slack);
			store<R, W>(buffers_.slack + k, slack);
		}
		for (int k = 0; k < 4; ++k)
			if (!vertices_.isNone(v, k)) buffers_.slack[buffers_.rowOf[buffers_.tight[v][k]]] = R(padOffset);
		return horizontalMin<R, W>(least) >= -vertices_.closeness(v);
	}

	/// The row that is met first along an edge, on which s changes by `up`; −1: none.
	POLYTOPE_INLINE int firstMet(int v, const Four& way, R up) const
	{
		const V along[3] = { broadcast<R, W>(way[0]), broadcast<R, W>(way[1]), broadcast<R, W>(way[2]) };
		const V far = broadcast<R, W>(R(padOffset)), zero = far - far;
		V       least = far, place = zero, here = firstIndices<R, W>();
		for (int k = 0; k < planes_.total; k += W) {
			V towards = broadcast<R, W>(up);
			for (int m = 0; m < 3; ++m)
				towards += load<R, W>(planes_.normal[m] + k) * along[m];
			const V    step   = towards > zero ? V(load<R, W>(buffers_.slack + k) / towards) : far;
			const auto better = step < least;
			place             = better ? here : place;
			least             = better ? step : least;
			here += broadcast<R, W>(R(W));
		}
		R first[W], row[W];
		store<R, W>(first, least);
		store<R, W>(row, place);
		int best = 0;
		for (int lane = 1; lane < W; ++lane)
			if (first[lane] < first[best]) best = lane;
		if (up < 0 && !vertices_.isNone(v, 3) && buffers_.point[4 * v + 3] < -up * first[best]) return vertices_.none();
		return first[best] < R(padOffset) / 2 ? int(row[best]) : -1;
	}

	/// Arrives at the vertex that has plane `next` in place of v's in `slot`.
	POLYTOPE_INLINE bool arrive(int v, int slot, int next)
	{
		const std::uint64_t left = bit(buffers_.tight[v][slot]), mask = (buffers_.mask[v] & ~left) | bit(next);
		int                 w = 0;
		while (w < buffers_.vertices && buffers_.mask[w] != mask)
			++w;
		if (w == v || w == Buffers::mostVertices) return false;
		if (w == buffers_.vertices) {
			++buffers_.vertices;
			for (int k = 0; k < 4; ++k)
				buffers_.tight[w][k] = k == slot ? std::uint8_t(next) : buffers_.tight[v][k];
			begin(w);
		}
		if (buffers_.dropped[w] & bit(next)) return false;
		buffers_.dropped[w] |= bit(next);
		buffers_.dropped[v] |= left;
		return true;
	}

	const PairPlanes<R, 3>& planes_;
	R                       size_;
	Buffers&                buffers_;
	FeasibleVertices<R, W>  vertices_;
	FlushPlanes<R, W>       flush_;
};

} // namespace polytope
