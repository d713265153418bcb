// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "contact/ContactTypes.hpp"
#include "contact/OverlapSums.hpp"
#include "numbers/Rotation.hpp"
#include "numbers/Tolerances.hpp"
#include "program/PairPlanes.hpp"

#include <algorithm>

/// The overlap of two polyhedra as a polyhedron: volume, centroid, faces, and what is seen of it along a direction.
///
/// A box that holds it is cut by one plane after the other, the nearest first. Each face is a loop of vertices, counter-clockwise seen from outside,
/// which neighbouring faces share; what a cut leaves open is closed by a face of its own, from the vertices that the cut made. Most planes cut
/// nothing: they cost one product with each vertex, or nothing if they are farther than any vertex. With an inner point x, and over the faces i
/// with area A_i, centroid c_i and slack σ_i = d_i − a_i·x, the cones from x give
///
///     V = Σ A_i σ_i / 3,      centroid = x + Σ A_i σ_i (c_i − x) / (4 V).
namespace polytope {

/// A closed surface: vertices, and faces as loops of them.
template <class R> struct FaceLoops {
	R*   at[3];        ///< components of the vertices; a free place holds a point inside
	int  vertices = 0; ///< places in use or free
	int* corner;       ///< vertices of each face, in places of equal length: face f's begin at f × room
	int* count;        ///< of a face's vertices; 0: it was cut away
	int* plane;        ///< of each face; −1: of the box that is cut
	int  faces = 0;
	int  room  = 0;

	void get(int vertex, R* p) const
	{
		for (int k = 0; k < 3; ++k)
			p[k] = at[k][vertex];
	}
	void set(int vertex, const R* p)
	{
		for (int k = 0; k < 3; ++k)
			at[k][vertex] = p[k];
	}
};

template <class R, int W> class Overlap<R, 3, W> {
public:
	/// The space inside all planes, and within `halfWidth` of the frame's origin along each axis. x: a point inside.
	POLYTOPE_INLINE Overlap(const PairPlanes<R, 3>& planes, const R* x, R halfWidth, ContactWorkspace& workspace)
	        : Overlap(planes, halfWidth, x, workspace)
	{
		box(halfWidth);
		const int count = findPlanes(0, planes.total);
		if (count > 0) cut(nearest_[0]);
		cutByOthers(count);
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
			const R    height = d - dot<R, 3>(a, x);
			const int* corner = loops_.corner + face * room_;
			R          first[3], last[3], arm[3] = {}, area = 0;
			loops_.get(corner[0], first);
			for (int v = 1; v < count; ++v) {
				R next[3];
				loops_.get(corner[v], next);
				for (int k = 0; k < 3; ++k)
					next[k] -= first[k];
				if (v > 1) {
					const R twice = triple(a, last, next);
					area += twice;
					for (int k = 0; k < 3; ++k)
						arm[k] += twice * (last[k] + next[k]);
				}
				for (int k = 0; k < 3; ++k)
					last[k] = next[k];
			}
			area_[face] = area / 2;
			result.volume += area * height;
			for (int k = 0; k < 3; ++k)
				moment[k] += height * (3 * area * (first[k] - x[k]) + arm[k]);
		}
		if (!(result.volume > 0)) return false;
		for (int k = 0; k < 3; ++k)
			result.centroid[k]
			        = x[k] + moment[k] / (4 * result.volume); // the volume is six times its value yet, the moment 24 times
		result.volume /= 6;
		return true;
	}

	/// Calls visit(plane, how many corners, gives the k-th one) for the faces; false if they are not all known.
	template <class Visit> bool forFaces(const Visit& visit) const
	{
		for (int face = 0; face < loops_.faces && whole_; ++face)
			if (loops_.count[face] >= 3)
				visit(loops_.plane[face], loops_.count[face],
				        [&](int k, R* p) { loops_.get(loops_.corner[face * room_ + k], p); });
		return whole_;
	}

	/// The overlap's footprint along n: a sum over the faces that are turned to n. The moments are those about p of all faces together; ringArea()
	/// has the first ones of a single ring.
	POLYTOPE_INLINE Footprint<R> footprint(const R* p, const R* n) const
	{
		const Rotation<R, 3> axes = axesAround<R, 3>(n);
		Footprint<R>         result;
		for (int face = 0; face < loops_.faces; ++face) {
			if (loops_.count[face] < 3 || loops_.plane[face] < 0) continue;
			R a[3], d;
			planes_.plane(loops_.plane[face], a, d);
			if (!(dot<R, 3>(a, n) > 0)) continue;
			const int* corner = loops_.corner + face * room_;
			R          first[2], last[2];
			project(corner[0], p, axes, first);
			project(corner[1], p, axes, last);
			for (int v = 2; v < loops_.count[face]; ++v) {
				R next[2];
				project(corner[v], p, axes, next);
				const R twice  = (last[0] - first[0]) * (next[1] - first[1]) - (last[1] - first[1]) * (next[0] - first[0]);
				const R sum[2] = { first[0] + last[0] + next[0], first[1] + last[1] + next[1] };
				result.area += twice;
				for (int k = 0; k < 3; ++k) {
					const int i = k / 2, j = (k + 1) / 2;
					result.second[k]
					        += twice * (first[i] * first[j] + last[i] * last[j] + next[i] * next[j] + sum[i] * sum[j]);
				}
				last[0] = next[0];
				last[1] = next[1];
			}
		}
		result.area /= 2;
		for (R& second : result.second)
			second /= 24;
		return result;
	}

private:
	using V = typename Lanes<R, W>::Type;

	POLYTOPE_INLINE Overlap(const PairPlanes<R, 3>& planes, R extent, const R* x, ContactWorkspace& workspace)
	        : planes_(planes), x_ { x[0], x[1], x[2] }, tolerance_(R(tolerance::violation) * extent),
	          room_(planes.total + 7 < tolerance::overlapFaces ? planes.total + 7 : tolerance::overlapFaces), vertexRoom_(4 * room_ + 8)
	{
		// as many vertices as a polyhedron of so many faces has, and as many again that are made before others are given up; a face has less
		// vertices than there are other faces
		R* numbers = workspace.polygons(4 * vertexRoom_ + planes.total + room_);
		for (R*& component : loops_.at) {
			component = numbers;
			numbers += vertexRoom_;
		}
		value_        = numbers;
		slack_        = value_ + vertexRoom_;
		area_         = slack_ + planes.total;
		loops_.room   = room_;
		loops_.count  = workspace.indices(room_ * room_ + 6 * room_ + 2 * vertexRoom_ + planes.total);
		loops_.plane  = loops_.count + room_;
		left_         = loops_.plane + room_;
		inner_        = left_ + room_;
		outer_        = inner_ + room_;
		made_         = outer_ + room_;
		next_         = made_ + room_;
		free_         = next_ + vertexRoom_;
		nearest_      = free_ + vertexRoom_;
		loops_.corner = nearest_ + planes.total;
	}

	/// Vertex k has the sign of bit i of k along axis i.
	POLYTOPE_APART void box(R halfWidth)
	{
		for (int v = 0; v < 8; ++v) {
			const R p[3] = { v & 1 ? halfWidth : -halfWidth, v & 2 ? halfWidth : -halfWidth, v & 4 ? halfWidth : -halfWidth };
			loops_.set(newPlace(), p);
		}
		for (int axis = 0; axis < 3; ++axis)
			for (int side = 0; side < 2; ++side) {
				const int u = 1 << (axis + 1) % 3, v = 1 << (axis + 2) % 3, here = side << axis;
				const int loop[4] = { here, here + (side == 1 ? u : v), here + u + v, here + (side == 1 ? v : u) };
				for (int k = 0; k < 4; ++k)
					loops_.corner[loops_.faces * room_ + k] = loop[k];
				loops_.count[loops_.faces]   = 4;
				loops_.plane[loops_.faces++] = -1;
			}
	}

	/// A place for a vertex; those up to whole lanes hold the inner point.
	POLYTOPE_INLINE int newPlace()
	{
		if (loops_.vertices % W == 0)
			for (int v = loops_.vertices; v < loops_.vertices + W; ++v)
				loops_.set(v, x_);
		return loops_.vertices++;
	}

	/// Writes planes begin … end − 1 to nearest_, without those of padding, the nearest first. Returns how many.
	POLYTOPE_INLINE int findPlanes(int begin, int end)
	{
		int count = 0;
		for (int i = begin; i < end; ++i) {
			R a[3], d;
			planes_.plane(i, a, d);
			if (d >= R(padOffset) / 2) continue;
			slack_[i]         = d - dot<R, 3>(a, x_);
			nearest_[count++] = i;
			if (slack_[i] < slack_[nearest_[0]]) {
				nearest_[count - 1] = nearest_[0];
				nearest_[0]         = i;
			}
		}
		return count;
	}

	/// Cuts by the planes behind the first, from the nearest to the farthest: near ones leave little for the others to cut, and what is farther than any
	/// vertex cuts nothing.
	POLYTOPE_INLINE void cutByOthers(int count)
	{
		R reach = reachFromInside();
		count   = sortBySlack(count, reach);
		for (int k = 0; k < count && whole_ && slack_[nearest_[k]] < reach; ++k)
			if (cut(nearest_[k])) reach = reachFromInside();
	}

	/// Leaves those nearer than `reach`, without the first. Returns how many.
	POLYTOPE_APART int sortBySlack(int found, R reach)
	{
		int count = 0;
		for (int k = 1; k < found; ++k)
			if (slack_[nearest_[k]] < reach) nearest_[count++] = nearest_[k];
		const R*   slack  = slack_;
		const auto nearer = [slack](int i, int j) { return slack[i] < slack[j] || (slack[i] == slack[j] && i < j); };
		if (count > tolerance::fewPlanes) std::sort(nearest_, nearest_ + count, nearer);
		else
			for (int next = 1; next < count; ++next) {
				const int own = nearest_[next];
				int       k   = next;
				for (; k > 0 && nearer(own, nearest_[k - 1]); --k)
					nearest_[k] = nearest_[k - 1];
				nearest_[k] = own;
			}
		return count;
	}

	/// Distance of the farthest vertex.
	POLYTOPE_INLINE R reachFromInside() const
	{
		V farthest = broadcast<R, W>(0);
		for (int v = 0; v < loops_.vertices; v += W) {
			V square = broadcast<R, W>(0);
			for (int k = 0; k < 3; ++k) {
				const V from = load<R, W>(loops_.at[k] + v) - broadcast<R, W>(x_[k]);
				square += from * from;
			}
			farthest = maxOf(farthest, square);
		}
		return sqrt(-horizontalMin<R, W>(V(-farthest)));
	}

	/// a·(u × v)
	static POLYTOPE_INLINE R triple(const R* a, const R* u, const R* v)
	{
		return a[0] * (u[1] * v[2] - u[2] * v[1]) + a[1] * (u[2] * v[0] - u[0] * v[2]) + a[2] * (u[0] * v[1] - u[1] * v[0]);
	}

	/// A vertex in the plane through p of both axes.
	POLYTOPE_INLINE void project(int vertex, const R* p, const Rotation<R, 3>& axes, R* uv) const
	{
		R from[3];
		loops_.get(vertex, from);
		for (int k = 0; k < 3; ++k)
			from[k] -= p[k];
		for (int k = 0; k < 2; ++k)
			uv[k] = dot<R, 3>(axes.m[k], from);
	}

	POLYTOPE_INLINE bool beyond(int vertex) const { return value_[vertex] > tolerance_; }

	/// Writes to value_ how far the vertices lie beyond plane i; whether any does.
	POLYTOPE_INLINE bool measureBeyond(int i)
	{
		V farthest = broadcast<R, W>(0);
		for (int v = 0; v < loops_.vertices; v += W) {
			V value = broadcast<R, W>(-planes_.offset[i]);
			for (int k = 0; k < 3; ++k)
				value += broadcast<R, W>(planes_.normal[k][i]) * load<R, W>(loops_.at[k] + v);
			store<R, W>(value_ + v, value);
			farthest = maxOf(farthest, value);
		}
		return -horizontalMin<R, W>(V(-farthest)) > tolerance_;
	}

	/// Removes what lies beyond plane i; false if nothing does.
	POLYTOPE_INLINE bool cut(int i)
	{
		if (!measureBeyond(i)) return false;
		cutFaces(i);
		return true;
	}

	/// Takes off each face what lies beyond plane i, as measured.
	POLYTOPE_APART void cutFaces(int i)
	{
		const int vertices = loops_.vertices;
		for (int face = 0; face < loops_.faces && whole_; ++face)
			takeFace(face);
		close(i, vertices);
	}

	/// The vertex where the edge from the inner to the outer one meets the plane; both faces that share the edge have it.
	POLYTOPE_INLINE int meeting(int inner, int outer)
	{
		for (int k = 0; k < cutVertices_; ++k)
			if (inner_[k] == inner && outer_[k] == outer) return made_[k];
		if (cutVertices_ == room_ || (freePlaces_ == 0 && loops_.vertices == vertexRoom_)) {
			whole_ = false;
			return inner;
		}
		const int vertex = freePlaces_ > 0 ? free_[--freePlaces_] : newPlace();
		const R   t = maxOf<R>(0, value_[inner] / (value_[inner] - value_[outer])); // the inner one may lie beyond it by rounding
		for (int k = 0; k < 3; ++k)
			loops_.at[k][vertex] = loops_.at[k][inner] + t * (loops_.at[k][outer] - loops_.at[k][inner]);
		inner_[cutVertices_]  = inner;
		outer_[cutVertices_]  = outer;
		made_[cutVertices_++] = vertex;
		next_[vertex]         = -1;
		return vertex;
	}

	/// Leaves of a loop what is inside, and notes the edges along which it was cut: where it comes in again, the new face runs back to where
	/// it had left.
	POLYTOPE_INLINE void takeFace(int face)
	{
		int*      loop    = loops_.corner + face * room_;
		const int count   = loops_.count[face];
		int       outside = 0;
		for (int k = 0; k < count; ++k)
			outside += beyond(loop[k]);
		if (outside == count) loops_.count[face] = 0;
		if (outside == count || outside == 0) return;
		int kept = 0, exit = -1, firstEntry = -1, last = loop[count - 1];
		for (int k = 0; k < count && whole_; last = loop[k++]) {
			const int v = loop[k];
			if (kept + 2 > room_) whole_ = false;
			else if (!beyond(last) && beyond(v)) left_[kept++] = exit = meeting(last, v);
			else if (beyond(last) && !beyond(v)) {
				const int entry = left_[kept++] = meeting(v, last);
				if (exit < 0) firstEntry = entry;
				else next_[entry] = exit;
			}
			if (whole_ && !beyond(v)) left_[kept++] = v;
		}
		if (firstEntry >= 0) next_[firstEntry] = exit;
		loops_.count[face] = kept;
		for (int k = 0; k < kept; ++k)
			loop[k] = left_[k];
	}

	/// Chains the vertices of the cut into the face in plane i, and gives up those of `vertices` that were cut away. By rounding there may be more
	/// than one such face. Two vertices make none: their faces meet at an edge.
	POLYTOPE_INLINE void close(int i, int vertices)
	{
		for (int k = 0; k < cutVertices_ && whole_; ++k) {
			if (next_[made_[k]] < 0) continue;
			if (loops_.faces == room_) {
				whole_ = false;
				return;
			}
			int* loop  = loops_.corner + loops_.faces * room_;
			int  count = 0;
			for (int v = made_[k]; next_[v] >= 0;) {
				const int after = next_[v];
				next_[v]        = -1;
				loop[count++]   = v;
				v               = after;
			}
			if (count < 3) continue;
			loops_.count[loops_.faces]   = count;
			loops_.plane[loops_.faces++] = i;
		}
		cutVertices_ = 0;
		for (int v = 0; v < vertices; ++v)
			if (beyond(v)) {
				loops_.set(v, x_);
				free_[freePlaces_++] = v;
			}
	}

	const PairPlanes<R, 3>& planes_;
	R                       x_[3];      ///< a point inside
	R                       tolerance_; ///< a vertex less far beyond a plane is on it [m]
	int                     room_;      ///< for faces, for vertices of a face, and for those of a cut
	int                     vertexRoom_;
	bool                    whole_ = true;
	FaceLoops<R>            loops_;
	R*                      value_;           ///< of each vertex: beyond the cutting plane [m]
	R*                      slack_;           ///< of each plane, at x [m]
	R*                      area_;            ///< of each face, by mass() [m²]
	int*                    nearest_;         ///< planes to cut by
	int*                    left_;            ///< vertices of a face after a cut
	int *                   inner_, *outer_;  ///< ends of the edges that a cut meets
	int*                    made_;            ///< vertices where a cut meets edges
	int                     cutVertices_ = 0; ///< how many vertices a cut has made so far
	int*                    next_;            ///< of a vertex that the cut made: the one after it in the new face
	int*                    free_;            ///< places of vertices that were cut away
	int                     freePlaces_ = 0;
};

} // namespace polytope
