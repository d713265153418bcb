// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "contact/ContactTypes.hpp"
#include "numbers/Rotation.hpp"
#include "numbers/Tolerances.hpp"
#include "program/PairPlanes.hpp"

/// The overlap of two bodies as a polyhedron (3-D) or a polygon (2-D): volume (area), centroid, and what is seen of it along a direction.
///
/// A box (a square) is cut by one plane after the other. Each face is a loop of vertices, counter-clockwise seen from outside; what a cut
/// leaves open is closed by a face of its own, whose loop is chained from the edges that the cut made in the other faces. Most planes cut
/// nothing and cost one product with each vertex. With an inner point x, and over the faces i with area A_i, centroid c_i and slack
/// σ_i = d_i − a_i·x, the cones from x give
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

/// Loops of vertices one after another: face f has the vertices start[f] … start[f + 1] − 1.
template <class R> struct FaceLoops {
	R*   at[3]; ///< components of the vertices
	int* start;
	int* plane; ///< of each face; −1: of the box that is cut
	int  faces = 0;

	void clear() { faces = start[0] = start[1] = 0; }
	int  vertices() const { return start[faces + 1]; }
	/// To the face that close() ends.
	void add(const R* p)
	{
		for (int k = 0; k < 3; ++k)
			at[k][start[faces + 1]] = p[k];
		++start[faces + 1];
	}
	void close(int planeIndex)
	{
		plane[faces++]   = planeIndex;
		start[faces + 1] = start[faces];
	}
	void get(int vertex, R* p) const
	{
		for (int k = 0; k < 3; ++k)
			p[k] = at[k][vertex];
	}
};

template <class R> class Overlap<R, 3> {
public:
	/// `halfWidth`: the overlap lies within this distance of the frame's origin, along each axis.
	POLYTOPE_INLINE Overlap(const PairPlanes<R, 3>& planes, R halfWidth, ContactWorkspace& workspace)
	        : planes_(planes), tolerance_(R(tolerance::violation) * halfWidth), faces_(planes.total + 7), vertices_(6 * faces_)
	{
		R*   numbers = workspace.polygons(numberCount());
		int* indices = workspace.indices(4 * (faces_ + 2));
		for (FaceLoops<R>* loops : { &here_, &there_ }) {
			for (R*& component : loops->at) {
				component = numbers;
				numbers += vertices_;
			}
			loops->start = indices;
			loops->plane = indices + faces_ + 2;
			indices += 2 * (faces_ + 2);
		}
		value_ = numbers;
		edge_  = value_ + vertices_;
		box(halfWidth);
		for (int i = 0; i < planes.total && whole_; ++i)
			if (planes.offset[i] < R(padOffset) / 2) cut(i);
	}

	/// x: a point inside. False if there is no measurable volume.
	POLYTOPE_INLINE bool mass(const R* x, OverlapMass<R, 3>& result) const
	{
		if (!whole_) return false;
		R moment[3] = {};
		for (int face = 0; face < here_.faces; ++face) {
			if (here_.plane[face] < 0) continue; // a face of the box: of an overlap that reaches to it, or of no area
			R a[3], d;
			planes_.plane(here_.plane[face], a, d);
			const R height = d - dot<R, 3>(a, x);
			R       first[3], last[3], arm[3] = {}, area = 0;
			here_.get(here_.start[face], first);
			for (int v = here_.start[face] + 1; v < here_.start[face + 1]; ++v) {
				R next[3];
				here_.get(v, next);
				for (int k = 0; k < 3; ++k)
					next[k] -= first[k];
				if (v > here_.start[face] + 1) {
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
		for (int face = 0; face < here_.faces; ++face) {
			R a[3], d;
			if (here_.plane[face] < 0) continue;
			planes_.plane(here_.plane[face], a, d);
			if (!(dot<R, 3>(a, n) > 0)) continue;
			R first[2], last[2];
			project(here_.start[face], p, axes, first);
			project(here_.start[face] + 1, p, axes, last);
			for (int v = here_.start[face] + 2; v < here_.start[face + 1]; ++v) {
				R next[2];
				project(v, p, axes, next);
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
	int numberCount() const { return 7 * vertices_ + 6 * faces_; }

	/// a·(u × v)
	static POLYTOPE_INLINE R triple(const R* a, const R* u, const R* v)
	{
		return a[0] * (u[1] * v[2] - u[2] * v[1]) + a[1] * (u[2] * v[0] - u[0] * v[2]) + a[2] * (u[0] * v[1] - u[1] * v[0]);
	}

	/// A vertex in the plane through p of both axes.
	POLYTOPE_INLINE void project(int vertex, const R* p, const Rotation<R, 3>& axes, R* uv) const
	{
		R from[3];
		here_.get(vertex, from);
		for (int k = 0; k < 3; ++k)
			from[k] -= p[k];
		for (int k = 0; k < 2; ++k)
			uv[k] = dot<R, 3>(axes.m[k], from);
	}

	POLYTOPE_INLINE void box(R halfWidth)
	{
		here_.clear();
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
					here_.add(p);
				}
				here_.close(-1);
			}
	}

	/// Removes what lies beyond plane i.
	POLYTOPE_INLINE void cut(int i)
	{
		R a[3], d;
		planes_.plane(i, a, d);
		const int count   = here_.vertices();
		R         highest = -d;
		for (int v = 0; v < count; ++v) {
			value_[v] = a[0] * here_.at[0][v] + a[1] * here_.at[1][v] + a[2] * here_.at[2][v] - d;
			highest   = maxOf<R>(highest, value_[v]);
		}
		if (!(highest > tolerance_)) return;
		there_.clear();
		int edges = 0;
		for (int face = 0; face < here_.faces; ++face)
			if (!cutFace(face, edges)) return;
		if (!closeCut(i, edges)) return;
		const FaceLoops<R> swap = here_;
		here_                   = there_;
		there_                  = swap;
	}

	/// Where the edge from the inner to the outer vertex meets the plane.
	POLYTOPE_INLINE void meeting(int inner, int outer, R* p) const
	{
		const R t = maxOf<R>(0, value_[inner] / (value_[inner] - value_[outer])); // the inner one may lie beyond it by rounding
		for (int k = 0; k < 3; ++k)
			p[k] = here_.at[k][inner] + t * (here_.at[k][outer] - here_.at[k][inner]);
	}

	/// Copies what is left of a face, and stores the edge that closes it.
	POLYTOPE_INLINE bool cutFace(int face, int& edges)
	{
		const int begin = here_.start[face], end = here_.start[face + 1];
		if (there_.vertices() + end - begin + 2 > vertices_) return whole_ = false;
		R         exit[3], entry[3];
		int       exits = 0, entries = 0;
		const int first = there_.vertices();
		for (int v = begin, last = end - 1; v < end; last = v++) {
			const bool inside = !(value_[v] > tolerance_), wasInside = !(value_[last] > tolerance_);
			if (inside != wasInside) {
				R* point = inside ? entry : exit;
				meeting(inside ? v : last, inside ? last : v, point);
				there_.add(point);
				(inside ? entries : exits) += 1;
			}
			if (inside) {
				R p[3];
				here_.get(v, p);
				there_.add(p);
			}
		}
		if (there_.vertices() > first) there_.close(here_.plane[face]);
		if (exits == 1 && entries == 1) { // the new face runs along the edge the other way round
			if (edges == faces_) return whole_ = false;
			for (int k = 0; k < 3; ++k) {
				edge_[6 * edges + k]     = entry[k];
				edge_[6 * edges + 3 + k] = exit[k];
			}
			++edges;
		}
		return true;
	}

	/// Chains the stored edges into the face in plane i. Neighbouring faces have computed a common vertex each for itself: the nearest is it.
	POLYTOPE_INLINE bool closeCut(int i, int edges)
	{
		if (there_.vertices() + edges > vertices_ || there_.faces + 1 >= faces_) return whole_ = false;
		if (edges < 3) return true; // cut along an edge or at a vertex
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
			there_.add(edge_ + 6 * done);
		}
		there_.close(i);
		return true;
	}

	static POLYTOPE_INLINE R distance(const R* p, const R* q) { return abs(p[0] - q[0]) + abs(p[1] - q[1]) + abs(p[2] - q[2]); }

	const PairPlanes<R, 3>& planes_;
	R                       tolerance_; ///< a vertex less far beyond a plane is on it [m]
	int                     faces_;     ///< room for so many
	int                     vertices_;  ///< in all loops: three edges meet at a vertex, each edge is in two loops
	bool                    whole_ = true;
	FaceLoops<R>            here_, there_;
	R*                      value_; ///< of each vertex: beyond the cutting plane [m]
	R*                      edge_;  ///< of the new face, six numbers each
};

/// The loop of corners alone, cut by one line after the other.
template <class R> class Overlap<R, 2> {
public:
	POLYTOPE_INLINE Overlap(const PairPlanes<R, 2>& planes, R halfWidth, ContactWorkspace& workspace)
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
