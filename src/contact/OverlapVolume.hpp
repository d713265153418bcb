// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "contact/ContactTypes.hpp"
#include "numbers/Rotation.hpp"
#include "numbers/Tolerances.hpp"
#include "program/PairPlanes.hpp"

#include <algorithm>

/// The overlap of two bodies as a polyhedron (3-D) or a polygon (2-D): volume (area), centroid, and what is seen of it along a direction.
///
/// A box (a square) is cut by one plane after the other, the nearest first. Each face is a loop of vertices, counter-clockwise seen from
/// outside; what a cut leaves open is closed by a face of its own, whose loop is chained from the edges that the cut made in the other faces. Most
/// planes cut nothing: they cost one product with each vertex, or nothing if they are farther than any vertex. With an inner point x, and over the
/// faces i with area A_i, centroid c_i and slack σ_i = d_i − a_i·x, the cones from x give
///
///     V = Σ A_i σ_i / D,      centroid = x + Σ A_i σ_i (c_i − x) / ((D + 1) V).
///
/// Lengths in the planes' frame [m].
namespace polytope {

template <class R, int D> struct OverlapMass {
	R volume      = 0; ///< [m³], 2-D: [m²]
	R centroid[D] = {};
};

/// The overlap seen along n: its projection on the plane (the line) normal to n.
template <class R> struct Footprint {
	R area      = 0;  ///< [m²]; 2-D: length [m]
	R second[3] = {}; ///< ∫ u², ∫ u v, ∫ v² dA along the axes around n (axesAround), from a point p [m⁴]; 2-D: the first alone, [m³]
	/// The largest ∫ (r·t)² dA / A over unit vectors t in the plane [m²].
	R gyrationSquared() const
	{
		const R mean = (second[0] + second[2]) / 2, half = (second[0] - second[2]) / 2;
		return (mean + sqrt(half * half + second[1] * second[1])) / area;
	}
};

template <class R, int D> class Overlap;

/// The vertices of each face, in places of equal length; a face that was cut away has none.
template <class R> struct FaceLoops {
	R*   at[3]; ///< components of the vertices: face f's begin at f × room
	int* count;
	int* plane; ///< of each face; −1: of the box that is cut
	int  room  = 0;
	int  faces = 0;

	void get(int face, int vertex, R* p) const
	{
		for (int k = 0; k < 3; ++k)
			p[k] = at[k][face * room + vertex];
	}
	void set(int face, int vertex, const R* p)
	{
		for (int k = 0; k < 3; ++k)
			at[k][face * room + vertex] = p[k];
	}
};

template <class R> class Overlap<R, 3> {
public:
	/// x: a point inside. `halfWidth`: the overlap lies within this distance of the frame's origin, along each axis.
	POLYTOPE_INLINE Overlap(const PairPlanes<R, 3>& planes, const R* x, R halfWidth, ContactWorkspace& workspace)
	        : planes_(planes), tolerance_(R(tolerance::violation) * halfWidth),
	          room_(planes.total + 7 < tolerance::overlapFaces ? planes.total + 7 : tolerance::overlapFaces)
	{
		// a face of a polyhedron with so many faces has less vertices, one on each edge to another face
		R* numbers = workspace.polygons(3 * room_ * room_ + 10 * room_ + planes.total);
		for (R*& component : loops_.at) {
			component = numbers;
			numbers += room_ * room_;
		}
		value_       = numbers;
		left_        = value_ + room_;
		edge_        = left_ + 3 * room_;
		R* slack     = edge_ + 6 * room_;
		loops_.count = workspace.indices(2 * room_ + planes.total);
		loops_.plane = loops_.count + room_;
		int* nearest = loops_.plane + room_;
		loops_.room  = room_;
		box(halfWidth);
		const int count = sortBySlack(x, slack, nearest);
		R         reach = reachFrom(x);
		for (int k = 0; k < count && whole_ && slack[nearest[k]] < reach; ++k) // from there on planes are farther than any vertex
			if (cut(nearest[k])) reach = reachFrom(x);
	}

	/// x: a point inside. False if there is no measurable volume.
	POLYTOPE_INLINE bool mass(const R* x, OverlapMass<R, 3>& result) const
	{
		if (!whole_) return false;
		R moment[3] = {};
		for (int face = 0; face < loops_.faces; ++face) {
			const int count = loops_.count[face];
			if (count < 3 || loops_.plane[face] < 0)
				continue; // a face of the box: of an overlap that reaches to it, or of no area
			R a[3], d;
			planes_.plane(loops_.plane[face], a, d);
			const R height = d - dot<R, 3>(a, x);
			R       first[3], last[3], arm[3] = {}, area = 0;
			loops_.get(face, 0, first);
			for (int v = 1; v < count; ++v) {
				R next[3];
				loops_.get(face, v, next);
				for (int k = 0; k < 3; ++k)
					next[k] -= first[k];
				if (v > 1) {
					const R twice = triple(a, last, next);
					area += twice / 2;
					for (int k = 0; k < 3; ++k)
						arm[k] += twice * (last[k] + next[k]) / 6;
				}
				for (int k = 0; k < 3; ++k)
					last[k] = next[k];
			}
			result.volume += area * height / 3;
			for (int k = 0; k < 3; ++k)
				moment[k] += height / 4 * (area * (first[k] - x[k]) + arm[k]);
		}
		if (!(result.volume > 0)) return false;
		for (int k = 0; k < 3; ++k)
			result.centroid[k] = x[k] + moment[k] / result.volume;
		return true;
	}

	/// Over the faces that are turned to n.
	POLYTOPE_INLINE Footprint<R> footprint(const R* p, const R* n) const
	{
		const Rotation<R, 3> axes = axesAround<R, 3>(n);
		Footprint<R>         result;
		for (int face = 0; face < loops_.faces; ++face) {
			if (loops_.count[face] < 3 || loops_.plane[face] < 0) continue;
			R a[3], d;
			planes_.plane(loops_.plane[face], a, d);
			if (!(dot<R, 3>(a, n) > 0)) continue;
			R first[2], last[2];
			project(face, 0, p, axes, first);
			project(face, 1, p, axes, last);
			for (int v = 2; v < loops_.count[face]; ++v) {
				R next[2];
				project(face, v, p, axes, next);
				const R twice  = (last[0] - first[0]) * (next[1] - first[1]) - (last[1] - first[1]) * (next[0] - first[0]);
				const R sum[2] = { first[0] + last[0] + next[0], first[1] + last[1] + next[1] };
				result.area += twice / 2;
				for (int k = 0; k < 3; ++k) {
					const int i = k / 2, j = (k + 1) / 2;
					result.second[k] += twice / 24
					        * (first[i] * first[j] + last[i] * last[j] + next[i] * next[j] + sum[i] * sum[j]);
				}
				last[0] = next[0];
				last[1] = next[1];
			}
		}
		return result;
	}

private:
	/// The planes from the nearest to the farthest, without those of padding: near ones leave little for the others to cut. `slack`: of plane i.
	/// Returns how many.
	POLYTOPE_INLINE int sortBySlack(const R* x, R* slack, int* plane) const
	{
		int count = 0;
		for (int i = 0; i < planes_.total; ++i) {
			R a[3], d;
			planes_.plane(i, a, d);
			if (d >= R(padOffset) / 2) continue;
			slack[i]       = d - dot<R, 3>(a, x);
			plane[count++] = i;
		}
		const auto nearer = [slack](int i, int j) { return slack[i] < slack[j] || (slack[i] == slack[j] && i < j); };
		if (count > tolerance::fewPlanes) std::sort(plane, plane + count, nearer);
		else
			for (int next = 1; next < count; ++next) {
				const int own = plane[next];
				int       k   = next;
				for (; k > 0 && nearer(own, plane[k - 1]); --k)
					plane[k] = plane[k - 1];
				plane[k] = own;
			}
		return count;
	}

	/// Distance of the farthest vertex.
	POLYTOPE_INLINE R reachFrom(const R* x) const
	{
		R farthest = 0;
		for (int face = 0; face < loops_.faces; ++face)
			for (int v = 0; v < loops_.count[face]; ++v) {
				R from[3], square = 0;
				loops_.get(face, v, from);
				for (int k = 0; k < 3; ++k)
					square += (from[k] - x[k]) * (from[k] - x[k]);
				farthest = maxOf<R>(farthest, square);
			}
		return sqrt(farthest);
	}

	/// a·(u × v)
	static POLYTOPE_INLINE R triple(const R* a, const R* u, const R* v)
	{
		return a[0] * (u[1] * v[2] - u[2] * v[1]) + a[1] * (u[2] * v[0] - u[0] * v[2]) + a[2] * (u[0] * v[1] - u[1] * v[0]);
	}

	/// A vertex in the plane through p of both axes.
	POLYTOPE_INLINE void project(int face, int vertex, const R* p, const Rotation<R, 3>& axes, R* uv) const
	{
		R from[3];
		loops_.get(face, vertex, from);
		for (int k = 0; k < 3; ++k)
			from[k] -= p[k];
		for (int k = 0; k < 2; ++k)
			uv[k] = dot<R, 3>(axes.m[k], from);
	}

	POLYTOPE_INLINE void box(R halfWidth)
	{
		for (int axis = 0; axis < 3; ++axis)
			for (int side = 0; side < 2; ++side) {
				const int u = (axis + 1) % 3, v = (axis + 2) % 3;
				for (int corner = 0; corner < 4; ++corner) {
					R       p[3];
					const R along  = corner == 1 || corner == 2 ? halfWidth : -halfWidth,
					        across = corner < 2 ? -halfWidth : halfWidth;
					p[axis]        = side == 1 ? halfWidth : -halfWidth;
					p[u]           = side == 1 ? along : across;
					p[v]           = side == 1 ? across : along;
					loops_.set(loops_.faces, corner, p);
				}
				loops_.count[loops_.faces]   = 4;
				loops_.plane[loops_.faces++] = -1;
			}
	}

	/// Removes what lies beyond plane i; false if nothing does.
	POLYTOPE_INLINE bool cut(int i)
	{
		R a[3], d;
		planes_.plane(i, a, d);
		int  edges   = 0;
		bool changed = false;
		for (int face = 0; face < loops_.faces && whole_; ++face) {
			const int count = loops_.count[face];
			const R * px = loops_.at[0] + face * room_, *py = loops_.at[1] + face * room_, *pz = loops_.at[2] + face * room_;
			int       outside = 0;
			for (int v = 0; v < count; ++v) {
				value_[v] = a[0] * px[v] + a[1] * py[v] + a[2] * pz[v] - d;
				outside += value_[v] > tolerance_;
			}
			if (outside == 0) continue;
			changed = true;
			if (outside == count) loops_.count[face] = 0;
			else cutFace(face, edges);
		}
		if (changed && whole_) closeCut(i, edges);
		return changed;
	}

	/// Where the edge from the inner to the outer vertex meets the plane.
	POLYTOPE_INLINE void meeting(int face, int inner, int outer, R* p) const
	{
		const R t = maxOf<R>(0, value_[inner] / (value_[inner] - value_[outer])); // the inner one may lie beyond it by rounding
		R       from[3], to[3];
		loops_.get(face, inner, from);
		loops_.get(face, outer, to);
		for (int k = 0; k < 3; ++k)
			p[k] = from[k] + t * (to[k] - from[k]);
	}

	/// Leaves what is inside, and stores the edge that closes it.
	POLYTOPE_INLINE void cutFace(int face, int& edges)
	{
		const int count = loops_.count[face];
		R         exit[3], entry[3];
		int       exits = 0, entries = 0, kept = 0;
		for (int v = 0, last = count - 1; v < count; last = v++) {
			const bool inside = !(value_[v] > tolerance_), wasInside = !(value_[last] > tolerance_);
			if (kept + 2 > room_) {
				whole_ = false;
				return;
			}
			if (inside != wasInside) {
				R* point = inside ? entry : exit;
				meeting(face, inside ? v : last, inside ? last : v, point);
				for (int k = 0; k < 3; ++k)
					left_[3 * kept + k] = point[k];
				++kept;
				(inside ? entries : exits) += 1;
			}
			if (inside) loops_.get(face, v, left_ + 3 * kept++);
		}
		loops_.count[face] = kept;
		for (int v = 0; v < kept; ++v)
			loops_.set(face, v, left_ + 3 * v);
		if (exits != 1 || entries != 1) return; // rounding: no edge
		if (edges == room_) {
			whole_ = false;
			return;
		}
		for (int k = 0; k < 3; ++k) { // the new face runs along the edge the other way round
			edge_[6 * edges + k]     = entry[k];
			edge_[6 * edges + 3 + k] = exit[k];
		}
		++edges;
	}

	/// Chains the stored edges into the face in plane i. Neighbouring faces have computed a common vertex each for itself: the nearest is it.
	POLYTOPE_INLINE void closeCut(int i, int edges)
	{
		if (edges < 3) return; // cut along an edge or at a vertex
		if (loops_.faces == room_) {
			whole_ = false;
			return;
		}
		const int face = loops_.faces++;
		for (int done = 0; done < edges; ++done) {
			if (done > 0) {
				const R* end     = edge_ + 6 * (done - 1) + 3;
				int      nearest = done;
				R        least   = distance(edge_ + 6 * done, end);
				for (int other = done + 1; other < edges && least > 0; ++other) {
					const R off = distance(edge_ + 6 * other, end);
					if (!(off < least)) continue;
					least   = off;
					nearest = other;
				}
				if (nearest != done)
					for (int k = 0; k < 6; ++k) {
						const R swap           = edge_[6 * done + k];
						edge_[6 * done + k]    = edge_[6 * nearest + k];
						edge_[6 * nearest + k] = swap;
					}
			}
			loops_.set(face, done, edge_ + 6 * done);
		}
		loops_.count[face] = edges;
		loops_.plane[face] = i;
	}

	static POLYTOPE_INLINE R distance(const R* p, const R* q) { return abs(p[0] - q[0]) + abs(p[1] - q[1]) + abs(p[2] - q[2]); }

	const PairPlanes<R, 3>& planes_;
	R                       tolerance_; ///< a vertex less far beyond a plane is on it [m]
	int                     room_;      ///< for faces, for vertices of a face, and for edges of a cut
	bool                    whole_ = true;
	FaceLoops<R>            loops_;
	R*                      value_; ///< of a face's vertices: beyond the cutting plane [m]
	R*                      left_;  ///< vertices of a face after a cut
	R*                      edge_;  ///< of the new face, six numbers each
};

/// The loop of corners alone, cut by one line after the other.
template <class R> class Overlap<R, 2> {
public:
	POLYTOPE_INLINE Overlap(const PairPlanes<R, 2>& planes, const R*, R halfWidth, ContactWorkspace& workspace)
	        : planes_(planes), here_(workspace.polygons(4 * (planes.total + 5))), there_(here_ + 2 * (planes.total + 5))
	{
		const R corners[8] = { -halfWidth, -halfWidth, halfWidth, -halfWidth, halfWidth, halfWidth, -halfWidth, halfWidth };
		for (int k = 0; k < 8; ++k)
			here_[k] = corners[k];
		const R tolerance = R(tolerance::violation) * halfWidth;
		for (int i = 0; i < planes.total && count_ > 0; ++i)
			if (planes.offset[i] < R(padOffset) / 2) cut(i, tolerance);
	}

	POLYTOPE_INLINE bool mass(const R* x, OverlapMass<R, 2>& result) const
	{
		R moment[2] = {};
		for (int v = 0, last = count_ - 1; v < count_; last = v++) {
			const R from[2] = { here_[2 * last] - x[0], here_[2 * last + 1] - x[1] },
			        to[2]   = { here_[2 * v] - x[0], here_[2 * v + 1] - x[1] };
			const R twice   = from[0] * to[1] - from[1] * to[0];
			result.volume += twice / 2;
			for (int k = 0; k < 2; ++k)
				moment[k] += twice * (from[k] + to[k]) / 6;
		}
		if (!(result.volume > 0)) return false;
		for (int k = 0; k < 2; ++k)
			result.centroid[k] = x[k] + moment[k] / result.volume;
		return true;
	}

	POLYTOPE_INLINE Footprint<R> footprint(const R* p, const R* n) const
	{
		const Rotation<R, 2> axes = axesAround<R, 2>(n);
		R                    low = 0, high = 0;
		for (int v = 0; v < count_; ++v) {
			const R from[2] = { here_[2 * v] - p[0], here_[2 * v + 1] - p[1] }, at = dot<R, 2>(axes.m[0], from);
			low  = v > 0 ? minOf<R>(low, at) : at;
			high = v > 0 ? maxOf<R>(high, at) : at;
		}
		Footprint<R> result;
		result.area      = high - low;
		result.second[0] = (high * high * high - low * low * low) / 3;
		return result;
	}

private:
	POLYTOPE_INLINE void cut(int i, R tolerance)
	{
		R a[2], d;
		planes_.plane(i, a, d);
		const auto beyond = [&](int v) { return a[0] * here_[2 * v] + a[1] * here_[2 * v + 1] - d; };
		int        kept   = 0;
		R          before = beyond(count_ - 1);
		for (int v = 0, last = count_ - 1; v < count_; last = v++) {
			const R value = beyond(v);
			if ((value > tolerance) != (before > tolerance)) {
				const int inner = value > tolerance ? last : v, outer = value > tolerance ? v : last;
				const R   in = minOf<R>(value, before), out = maxOf<R>(value, before), t = maxOf<R>(0, in / (in - out));
				for (int k = 0; k < 2; ++k)
					there_[2 * kept + k] = here_[2 * inner + k] + t * (here_[2 * outer + k] - here_[2 * inner + k]);
				++kept;
			}
			if (!(value > tolerance)) {
				for (int k = 0; k < 2; ++k)
					there_[2 * kept + k] = here_[2 * v + k];
				++kept;
			}
			before = value;
		}
		R* const swap = here_;
		here_         = there_;
		there_        = swap;
		count_        = kept;
	}

	const PairPlanes<R, 2>& planes_;
	R *                     here_, *there_;
	int                     count_ = 4;
};

} // namespace polytope
