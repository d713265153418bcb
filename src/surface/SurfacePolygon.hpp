// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "surface/SurfacePiece.hpp"

/// A piece of the surface in 3-D, cut to where no other plane has a smaller slack and none is negative: a convex polygon. Each edge carries the
/// number of the plane that has the same slack there.
///
/// It begins as a square. Planes that are known to meet it cut first, which leaves little more than the piece; the others are compared with
/// all vertices together, and few of them cut. No plane cuts twice. A new vertex is the crossing of two lines, not a point between two
/// vertices: a polygon a thousand million times smaller than the square keeps its digits.
namespace polytope {

template <class R, int D, int W> class SurfaceCut;

template <class R, int W> class SurfaceCut<R, 3, W> {
public:
	/// The polygon of the piece whose planes are in the buffers' rows; it uses these rows up. `reach`: half the square's width; `deepest`: the
	/// largest p; `known`: planes that meet the piece, as far as is known.
	POLYTOPE_INLINE SurfaceCut(const SurfaceBuffers<R, 3>& buffers, R reach, R deepest, const int* known)
	        : buffers_(buffers), reach_(reach), deepest_(deepest)
	{
		square(reach);
		for (int k = 0; k < tolerance::knownPlanes && count_ > 2; ++k)
			if (known[k] >= 0) cut(known[k]);
		for (int k = 0; k < buffers.length && count_ > 2; k += W) {
			const V slack = leastSlack(k);
			if (!(horizontalMin<R, W>(slack) > close_)) cutByEach(k, slack);
		}
		if (count_ < 3) count_ = 0;
	}

	/// Vertices, and edges, of which one begins at each vertex. Zero: nothing is left.
	int                  count() const { return count_; }
	POLYTOPE_INLINE void vertex(int t, R* uv) const
	{
		uv[0] = at(U, t);
		uv[1] = at(Y, t);
	}
	/// Plane of edge t, or −1: it is an edge of the square.
	int tag(int t) const { return buffers_.lineTag[buffers_.edge[now_][t]]; }

	/// Unit vector across edge t.
	POLYTOPE_INLINE void across(int t, R* uv) const
	{
		const int line = buffers_.edge[now_][t];
		const R   a = buffers_.line[0][line], b = buffers_.line[1][line], length = sqrt(a * a + b * b);
		uv[0] = length > 0 ? a / length : R(1);
		uv[1] = length > 0 ? b / length : R(0);
	}

	/// Whether edge t is no longer than where planes meet is certain.
	POLYTOPE_INLINE bool isPoint(int t) const
	{
		const int next = t + 1 < count_ ? t + 1 : 0;
		return abs(at(U, next) - at(U, t)) + abs(at(Y, next) - at(Y, t)) <= close_;
	}

	/// Writes the planes other than i, j and the edge's own that meet in edge t; the plane of no pressure counts as one. Returns how many.
	POLYTOPE_INLINE int meeting(int t, int* found, int room) const { return touched_ ? meetingAt(t, found, room) : 0; }

private:
	using V = typename Lanes<R, W>::Type;
	enum Row { U, Y, Slack };

	POLYTOPE_INLINE R& at(Row row, int v) { return buffers_.vertex[now_][row][v]; }
	POLYTOPE_INLINE R  at(Row row, int v) const { return buffers_.vertex[now_][row][v]; }

	POLYTOPE_INLINE void square(R reach)
	{
		const R corner[4][2] = { { -reach, -reach }, { reach, -reach }, { reach, reach }, { -reach, reach } };
		const R inward[4][2] = { { 0, 1 }, { -1, 0 }, { 0, -1 }, { 1, 0 } };
		count_ = lines_ = 4;
		for (int t = 0; t < 4; ++t) {
			at(U, t)               = corner[t][0];
			at(Y, t)               = corner[t][1];
			buffers_.line[0][t]    = inward[t][0];
			buffers_.line[1][t]    = inward[t][1];
			buffers_.line[2][t]    = reach;
			buffers_.lineTag[t]    = -1;
			buffers_.edge[now_][t] = t;
		}
		setCloseness();
	}

	/// Sets the slack within which a plane meets a vertex.
	void setCloseness()
	{
		const R *u = buffers_.vertex[now_][U], *v = buffers_.vertex[now_][Y];
		R        extent = deepest_;
		for (int t = 0; t < count_; ++t)
			extent = maxOf<R>(extent, abs(u[t]) + abs(v[t]));
		close_ = R(tolerance::meetingPlanes) * extent;
	}

	/// Least slack of planes k … k + W − 1, less the pressure, at any vertex.
	POLYTOPE_INLINE V leastSlack(int k) const
	{
		const R *u = buffers_.vertex[now_][U], *v = buffers_.vertex[now_][Y];
		const V  rest = load<R, W>(buffers_.rest + k), rateU = load<R, W>(buffers_.rate[0] + k),
		        rateV = load<R, W>(buffers_.rate[1] + k);
		V least       = broadcast<R, W>(R(padOffset));
		for (int t = 0; t < count_; ++t)
			least = minOf(least, V(rest + rateU * broadcast<R, W>(u[t]) + rateV * broadcast<R, W>(v[t])));
		return least;
	}

	POLYTOPE_INLINE void cutByEach(int first, const V& slack)
	{
		R each[W];
		store<R, W>(each, slack);
		for (int lane = 0; lane < W && count_ > 2; ++lane)
			if (!(each[lane] > close_)) cut(first + lane);
	}

	/// The plane's row becomes a line; on its own edge rounding would have it violated again.
	int makeLine(int plane)
	{
		buffers_.line[0][lines_] = buffers_.rate[0][plane];
		buffers_.line[1][lines_] = buffers_.rate[1][plane];
		buffers_.line[2][lines_] = buffers_.rest[plane];
		buffers_.lineTag[lines_] = plane;
		buffers_.rate[0][plane] = buffers_.rate[1][plane] = 0;
		buffers_.rest[plane]                              = R(padOffset);
		return lines_++;
	}

	R slackOfLine(int line, int t) const
	{
		return buffers_.line[2][line] + buffers_.line[0][line] * at(U, t) + buffers_.line[1][line] * at(Y, t);
	}

	/// Takes off what lies beyond the plane.
	POLYTOPE_APART void cut(int plane)
	{
		const R   rateU = buffers_.rate[0][plane], rateV = buffers_.rate[1][plane], rest = buffers_.rest[plane];
		const R * u = buffers_.vertex[now_][U], *v = buffers_.vertex[now_][Y];
		R*        slack = buffers_.vertex[now_][Slack];
		R         least = R(padOffset);
		const int count = count_;
		for (int t = 0; t < count; ++t) {
			const R here = rest + rateU * u[t] + rateV * v[t];
			slack[t]     = here;
			least        = minOf<R>(least, here);
		}
		if (least > close_) return;
		int near = 0;
		for (int t = 0; t < count; ++t)
			near += abs(slack[t]) <= close_;
		touched_ = touched_ || near > 1;
		if (least < 0 && lines_ < buffers_.room) split(makeLine(plane));
	}

	/// Splits the polygon by the line, whose slacks at the vertices are known. A convex polygon is left and entered once, and so it is here: where many planes
	/// meet in a vertex, rounding makes several of it, and signs of their slacks change to and fro. Of very many no more are made.
	void split(int line)
	{
		const int      count = count_;
		const R *const u = buffers_.vertex[now_][U], *const v = buffers_.vertex[now_][Y],
		               *const slack = buffers_.vertex[now_][Slack];
		const int* const      edge  = buffers_.edge[now_];
		R *const toU = buffers_.vertex[1 - now_][U], *const toV = buffers_.vertex[1 - now_][Y];
		int* const toEdge = buffers_.edge[1 - now_];
		const auto after  = [count](int t) { return t + 1 < count ? t + 1 : 0; };
		const auto before = [count](int t) { return t > 0 ? t - 1 : count - 1; };
		int        first  = 0;
		for (int t = 1; t < count; ++t)
			if (slack[t] < slack[first]) first = t;
		int beyond = 1, last = first; // vertices beyond the line, one after the other about the farthest
		for (; beyond < count && slack[after(last)] < 0; ++beyond)
			last = after(last);
		for (; beyond < count && slack[before(first)] < 0; ++beyond)
			first = before(first);
		R out[2], in[2];
		if (beyond < count) {
			crossing(before(first), line, out);
			crossing(last, line, in);
			if (beyond == 1 && count > tolerance::fewCorners && isSame(first, out) && isSame(first, in)) return;
		}
		int kept = 0;
		for (int t = after(last), left = count - beyond; left > 0; t = after(t), --left) {
			toU[kept]      = u[t];
			toV[kept]      = v[t];
			toEdge[kept++] = edge[t];
		}
		if (kept > 0) {
			toU[kept]      = out[0];
			toV[kept]      = out[1];
			toEdge[kept++] = line;
			toU[kept]      = in[0];
			toV[kept]      = in[1];
			toEdge[kept++] = edge[last];
		}
		now_   = 1 - now_;
		count_ = kept;
		setCloseness();
	}

	/// Where edge t, whose ends are on both sides of the line, crosses it.
	void crossing(int t, int line, R* uv) const
	{
		if (!cross(buffers_.edge[now_][t], line, R(tolerance::crossingLines), uv)) {
			const int next = t + 1 < count_ ? t + 1 : 0;
			const R   here = buffers_.vertex[now_][Slack][t], there = buffers_.vertex[now_][Slack][next],
			        part = here == there ? R(0) : minOf<R>(R(1), maxOf<R>(R(0), here / (here - there)));
			uv[0]        = at(U, t) + part * (at(U, next) - at(U, t));
			uv[1]        = at(Y, t) + part * (at(Y, next) - at(Y, t));
		}
	}

	/// Whether a place is that of vertex t but for rounding.
	bool isSame(int t, const R* uv) const { return abs(uv[0] - at(U, t)) + abs(uv[1] - at(Y, t)) <= R(tolerance::sameCorner) * reach_; }

	/// Where two lines cross; false where the sine of the angle between them is less than `sharp`.
	bool cross(int first, int second, R sharp, R* uv) const
	{
		R* const* const line = buffers_.line;
		const R         a = line[0][first], b = line[1][first], c = line[2][first];
		const R         p = line[0][second], q = line[1][second], r = line[2][second];
		const R         sine = a * q - p * b;
		if (!(sine * sine > sharp * sharp * (a * a + b * b) * (p * p + q * q))) return false;
		const R inverse = 1 / sine;
		uv[0]           = (b * r - q * c) * inverse;
		uv[1]           = (p * c - a * r) * inverse;
		return true;
	}

	POLYTOPE_APART int meetingAt(int t, int* found, int room) const
	{
		const int  next = t + 1 < count_ ? t + 1 : 0, own = buffers_.edge[now_][t];
		int        count = 0;
		const auto slack
		        = [&](int k, int v) { return buffers_.rest[k] + buffers_.rate[0][k] * at(U, v) + buffers_.rate[1][k] * at(Y, v); };
		for (int k = 0; k <= buffers_.planes && count < room; ++k)
			if (abs(slack(k, t)) <= close_ && abs(slack(k, next)) <= close_) found[count++] = k;
		for (int line = 4; line < lines_ && count < room; ++line)
			if (line != own && abs(slackOfLine(line, t)) <= close_ && abs(slackOfLine(line, next)) <= close_)
				found[count++] = buffers_.lineTag[line];
		return count;
	}

	const SurfaceBuffers<R, 3>& buffers_;
	R                           reach_, deepest_, close_ = 0;
	int                         count_ = 0, lines_ = 0, now_ = 0;
	bool                        touched_ = false; ///< a plane met two vertices
};

} // namespace polytope
