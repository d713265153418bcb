// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "surface/SurfacePiece.hpp"

/// A piece of the surface in 3-D, cut to where no other plane has a smaller slack and none is negative: a convex polygon. Each edge carries the
/// number of the plane that has the same slack there.
///
/// It begins as a square. The plane that is violated most at any vertex cuts next, so that few planes cut, and none twice. A new vertex is the
/// crossing of two lines, not a point between two vertices: a polygon a thousand million times smaller than the square
/// keeps its digits.
namespace polytope {

template <class R, int D, int W> class SurfaceCut;

template <class R, int W> class SurfaceCut<R, 3, W> {
public:
	/// Of the piece whose planes are in the buffers' rows, which do not outlast it. `reach`: half the square's width; `deepest`: the largest p.
	POLYTOPE_INLINE SurfaceCut(const SurfaceBuffers<R, 3>& buffers, R reach, R deepest) : buffers_(buffers), deepest_(deepest)
	{
		square(reach);
		for (int plane = mostViolated(); plane >= 0 && lines_ < buffers.room; plane = mostViolated())
			cut(plane);
		if (count_ < 3) count_ = 0;
	}

	/// Vertices, and edges, of which one begins at each vertex. Zero: nothing is left.
	int                  count() const { return count_; }
	POLYTOPE_INLINE void vertex(int t, R* uv) const
	{
		uv[0] = at(U, t);
		uv[1] = at(Y, t);
	}
	/// Plane of edge t, or −1: of the square.
	int tag(int t) const { return buffers_.lineTag[buffers_.edge[now_][t]]; }

	/// Writes the planes other than i, j and the edge's own that meet in edge t; the plane of no pressure counts as one. Returns how many.
	POLYTOPE_INLINE int meeting(int t, int* found, int room) const
	{
		const int next = t + 1 < count_ ? t + 1 : 0;
		if (!touched_ && (buffers_.near[now_][t] == 0 || buffers_.near[now_][next] == 0)) return 0;
		return meetingAt(t, next, found, room);
	}

private:
	using V = typename Lanes<R, W>::Type;
	enum Row { U, Y, Least };

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
			measure(now_, t);
		}
	}

	/// Within which slack a plane meets a vertex.
	POLYTOPE_INLINE R nearness(R u, R v) const { return R(tolerance::meetingPlanes) * (abs(u) + abs(v) + deepest_); }

	/// Least slack of the planes that have not cut, less the pressure, at a vertex, and how many meet there.
	POLYTOPE_INLINE void measure(int side, int t)
	{
		R* const* const row = buffers_.vertex[side];
		const R         u = row[U][t], v = row[Y][t];
		const V         allU = broadcast<R, W>(u), allV = broadcast<R, W>(v), close = broadcast<R, W>(nearness(u, v)),
		        one = broadcast<R, W>(1), zero = one - one, step = broadcast<R, W>(R(W));
		V least = broadcast<R, W>(R(padOffset)), worst = zero, meet = zero, index = firstIndices<R, W>();
		for (int k = 0; k < buffers_.length; k += W) {
			const V slack = load<R, W>(buffers_.rest + k) + load<R, W>(buffers_.rate[0] + k) * allU
			        + load<R, W>(buffers_.rate[1] + k) * allV;
			worst = slack < least ? index : worst;
			least = minOf(slack, least);
			meet += absolute(slack) <= close ? one : zero;
			index += step;
		}
		if constexpr (W == 1) {
			row[Least][t]           = least;
			buffers_.worst[side][t] = int(worst);
		} else {
			int lane = 0;
			for (int l = 1; l < W; ++l)
				if (least[l] < least[lane]) lane = l;
			row[Least][t]           = least[lane];
			buffers_.worst[side][t] = int(worst[lane]);
		}
		buffers_.near[side][t] = int(horizontalSum<R, W>(meet));
	}

	/// The plane by which any vertex is violated most, −1 if none is.
	POLYTOPE_INLINE int mostViolated() const
	{
		int plane = -1;
		R   most  = 0;
		for (int t = 0; t < count_; ++t) {
			if (!(at(Least, t) < most)) continue;
			plane = buffers_.worst[now_][t];
			most  = at(Least, t);
		}
		return plane;
	}

	/// The plane's row becomes a line; on its own edge rounding would have it violated again.
	POLYTOPE_INLINE int makeLine(int plane)
	{
		buffers_.line[0][lines_] = buffers_.rate[0][plane];
		buffers_.line[1][lines_] = buffers_.rate[1][plane];
		buffers_.line[2][lines_] = buffers_.rest[plane];
		buffers_.lineTag[lines_] = plane;
		buffers_.rate[0][plane] = buffers_.rate[1][plane] = 0;
		buffers_.rest[plane]                              = R(padOffset);
		return lines_++;
	}

	POLYTOPE_INLINE R slackOfLine(int line, int t) const
	{
		return buffers_.line[2][line] + buffers_.line[0][line] * at(U, t) + buffers_.line[1][line] * at(Y, t);
	}

	/// Takes off what lies beyond the plane.
	POLYTOPE_INLINE void cut(int plane)
	{
		const int line = makeLine(plane), then = 1 - now_;
		int       kept = 0;
		R         here = slackOfLine(line, 0);
		for (int t = 0; t < count_; ++t) {
			const int  next  = t + 1 < count_ ? t + 1 : 0;
			const R    there = slackOfLine(line, next);
			const bool in = here >= 0, nextIn = there >= 0;
			touched_ = touched_ || abs(here) <= nearness(at(U, t), at(Y, t));
			if (in && kept < buffers_.room) keep(t, then, kept++);
			if (in != nextIn && kept < buffers_.room) {
				const int own = buffers_.edge[now_][t];
				cross(own, line, t, next, here / (here - there), then, kept);
				// going out, the new edge begins; coming in, the old one goes on
				buffers_.edge[then][kept] = in ? line : own;
				measure(then, kept++);
			}
			here = there;
		}
		now_   = then;
		count_ = kept;
	}

	POLYTOPE_INLINE void keep(int t, int then, int place)
	{
		for (int row = 0; row < SurfaceBuffers<R, 3>::vertexRows; ++row)
			buffers_.vertex[then][row][place] = buffers_.vertex[now_][row][t];
		buffers_.edge[then][place]  = buffers_.edge[now_][t];
		buffers_.worst[then][place] = buffers_.worst[now_][t];
		buffers_.near[then][place]  = buffers_.near[now_][t];
	}

	/// Where two lines cross, the first of which is the edge from vertex t to `next`; `part`: of the way there, by their slacks.
	POLYTOPE_INLINE void cross(int first, int second, int t, int next, R part, int then, int place)
	{
		R* const* const line = buffers_.line;
		R* const* const row  = buffers_.vertex[then];
		const R         a = line[0][first], b = line[1][first], c = line[2][first];
		const R         p = line[0][second], q = line[1][second], r = line[2][second];
		const R         sine = a * q - p * b, sharp = R(tolerance::crossingLines);
		if (sine * sine > sharp * sharp * (a * a + b * b) * (p * p + q * q)) {
			const R inverse = 1 / sine;
			row[U][place]   = (b * r - q * c) * inverse;
			row[Y][place]   = (p * c - a * r) * inverse;
			return;
		}
		row[U][place] = at(U, t) + part * (at(U, next) - at(U, t));
		row[Y][place] = at(Y, t) + part * (at(Y, next) - at(Y, t));
	}

	POLYTOPE_APART int meetingAt(int t, int next, int* found, int room) const
	{
		const R    close[2] = { nearness(at(U, t), at(Y, t)), nearness(at(U, next), at(Y, next)) };
		const int  own      = buffers_.edge[now_][t];
		int        count    = 0;
		const auto slack
		        = [&](int k, int v) { return buffers_.rest[k] + buffers_.rate[0][k] * at(U, v) + buffers_.rate[1][k] * at(Y, v); };
		for (int k = 0; k <= buffers_.planes && count < room; ++k)
			if (abs(slack(k, t)) <= close[0] && abs(slack(k, next)) <= close[1]) found[count++] = k;
		for (int line = 4; line < lines_ && count < room; ++line)
			if (line != own && abs(slackOfLine(line, t)) <= close[0] && abs(slackOfLine(line, next)) <= close[1])
				found[count++] = buffers_.lineTag[line];
		return count;
	}

	const SurfaceBuffers<R, 3>& buffers_;
	R                           deepest_;
	int                         count_ = 0, lines_ = 0, now_ = 0;
	bool                        touched_ = false; ///< a plane that cut met a vertex
};

} // namespace polytope
