// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "shape/ConstructionTolerances.hpp"
#include "shape/ConvexHull.hpp"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <utility>
#include <vector>

/// Finds which triangles of a hull of rounded points belong to one facet.
///
/// Neighbouring triangles are joined while the misfit of all their corners together (the distance by which they miss a
/// common plane) stays within a tolerance. The corners may be points (hullOf: joined triangles are a facet) or the polar
/// duals of planes (polyhedron: joined triangles are a vertex in which many planes meet, and the misfit is how far these
/// planes would have to move to meet in a point). The misfit is a backward error: it measures what the input's rounding
/// can have done, whereas distances between nearby vertices grow without limit at a blunt or a sharp vertex.
///
/// A fit alone is not enough: corners that coincide or lie on a line fit planes of any direction, also planes that cut through
/// the body. So what was fitted must also leave the whole body on one side.
namespace polytope {

using Indices = std::vector<int>;

/// The directed edges of a closed surface of triangles, and the triangle on the left of each.
class Edges {
public:
	struct Edge {
		int from, to, left;
	};

	explicit Edges(const Triangles& triangles)
	{
		int corners = 0;
		for (const Triangle& t : triangles)
			corners = std::max({ corners, t[0] + 1, t[1] + 1, t[2] + 1 });
		begin_.assign(std::size_t(corners) + 1, 0);
		for (const Triangle& t : triangles)
			for (int corner : t)
				++begin_[std::size_t(corner) + 1];
		std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
		edges_.resize(3 * triangles.size());
		Indices place = begin_;
		for (std::size_t t = 0; t < triangles.size(); ++t)
			for (std::size_t k = 0; k < 3; ++k) {
				const int from                                  = triangles[t][k];
				edges_[std::size_t(place[std::size_t(from)]++)] = { from, triangles[t][(k + 1) % 3], int(t) };
			}
		for (std::size_t corner = 0; corner + 1 < begin_.size(); ++corner)
			std::sort(edges_.begin() + begin_[corner], edges_.begin() + begin_[corner + 1],
			        [](const Edge& a, const Edge& b) { return a.to < b.to; });
	}

	/// The edges, in ascending order of (from, to).
	std::vector<Edge>::const_iterator begin() const { return edges_.begin(); }
	std::vector<Edge>::const_iterator end() const { return edges_.end(); }

	/// The triangle on the left of an edge that is there.
	int left(int from, int to) const
	{
		const auto first = edges_.begin() + begin_[std::size_t(from)], last = edges_.begin() + begin_[std::size_t(from) + 1];
		return std::lower_bound(first, last, to, [](const Edge& edge, int corner) { return edge.to < corner; })->left;
	}

private:
	Indices           begin_; ///< corner → its first edge
	std::vector<Edge> edges_;
};

struct Clusters {
	Indices              of;      ///< triangle → the number of its cluster
	std::vector<Indices> members; ///< cluster → its corners, ascending; empty for numbers not in use

	/// Begins with each triangle on its own.
	explicit Clusters(const Triangles& triangles) : of(triangles.size())
	{
		std::iota(of.begin(), of.end(), 0);
		members.reserve(triangles.size());
		for (Triangle triangle : triangles) {
			std::sort(triangle.begin(), triangle.end());
			members.emplace_back(triangle.begin(), triangle.end());
		}
	}

	int root(int t) const
	{
		while (of[std::size_t(t)] != t)
			t = of[std::size_t(t)];
		return t;
	}

	Indices together(int a, int b) const
	{
		const Indices &first = members[std::size_t(a)], &second = members[std::size_t(b)];
		Indices        both;
		both.reserve(first.size() + second.size());
		std::set_union(first.begin(), first.end(), second.begin(), second.end(), std::back_inserter(both));
		return both;
	}
};

/// Neighbours that fit together, the best first. apart(left triangle, right triangle): whether their corners certainly miss
/// the tolerance, which costs less than the misfit.
template <class Apart, class Misfit>
std::vector<std::pair<int, int>> fittingPairs(
        const Clusters& single, const Edges& edges, const Apart& apart, const Misfit& misfit, const Real& tolerance)
{
	std::vector<std::pair<Real, std::pair<int, int>>> pairs;
	for (const Edges::Edge& edge : edges) {
		if (edge.from > edge.to) continue;
		const int right = edges.left(edge.to, edge.from);
		if (apart(edge.left, right)) continue;
		const Real error = misfit(single.together(edge.left, right));
		if (error <= tolerance) pairs.push_back({ error, { edge.left, right } });
	}
	std::sort(pairs.begin(), pairs.end());
	std::vector<std::pair<int, int>> result;
	for (const auto& pair : pairs)
		result.push_back(pair.second);
	return result;
}

/// Joins neighbours where misfit(corners) ≤ tolerance and outside(corners) ≤ construction::support × tolerance: how far
/// the body reaches beyond what fits these corners best.
template <class Apart, class Misfit, class Outside>
Clusters cluster(const Triangles& triangles, const Edges& edges, const Apart& apart, const Misfit& misfit, const Outside& outside,
        const Real& tolerance)
{
	Clusters   result(triangles);
	const auto pairs = fittingPairs(result, edges, apart, misfit, tolerance);
	// again while anything changes: a sliver, whose own normal is arbitrary, fits once its neighbour has grown
	for (bool changed = true; changed;) {
		changed = false;
		for (const auto& pair : pairs) {
			int a = result.root(pair.first), b = result.root(pair.second);
			if (a == b) continue;
			if (result.members[std::size_t(a)].size() < result.members[std::size_t(b)].size())
				std::swap(a, b); // keeps paths short
			Indices both = result.together(a, b);
			if (misfit(both) > tolerance || outside(both) > construction::support * tolerance) continue;
			result.members[std::size_t(a)] = std::move(both);
			result.members[std::size_t(b)].clear();
			result.of[std::size_t(b)] = a;
			changed                   = true;
		}
	}
	for (std::size_t t = 0; t < triangles.size(); ++t)
		result.of[t] = result.root(int(t));
	return result;
}

} // namespace polytope
