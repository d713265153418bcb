// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "pairs/BoxRoom.hpp"

#include <pkg/common/Collider.hpp>

#include <src/neighbours/BoxGrid.hpp>

namespace yade {

/// Gives an Interaction to each pair of bodies that may touch while they are in their boxes, and takes it from those that may not.
///
/// Boxes that overlap are found by a grid (BoxGrid.hpp), in parallel. When the grid of all boxes is made anew in a run, all pairs are put
/// into the order of its cells: the InteractionLoop then meets neighbours one after the other, and has their bodies in the cache. The order
/// is the same with any number of threads. When only some bodies have got new boxes, these bodies leave the grid of all for a second,
/// smaller one, and only their pairs are searched for. When the second grid has become too large, the first is made anew.
///
/// Where the boxes of two polytopes overlap, the linear program finds whether they stay apart as long as both are in their boxes: such a
/// pair gets no Interaction, which would cost memory, and time in each step. Two fixed polytopes without velocity that are apart or lie
/// flush, such as pieces of a ground, get none either, nor do two of YADE's facets, boxes and walls, whether a script moves them or not.
/// Two fixed polytopes that pierce each other do get one, so that a script can look at their contact. A piece of a rigid support (a fixed
/// body, a member of a clump) and a body that moves always have
/// theirs: internal faces are searched for among the pieces that a body may touch.
class PairSearch {
public:
	explicit PairSearch(const BoxRoom& room) : room_(room) { }

	/// Finds the pairs of all bodies. `judge`: by the linear program, too. `sort`: unless contacts shall keep the order that they were saved
	/// in, and with it the last digits of sums.
	void ofAll(Scene& scene, Collider& collider, bool judge, bool sort);
	/// Finds the pairs of these bodies, whose boxes are new.
	void ofSome(Scene& scene, Collider& collider, const std::vector<Body::id_t>& ids);

	/// Whether so many new boxes are better searched for with all others.
	bool areMany(std::size_t newBoxes) const { return newBoxes * part > places_.size(); }

	/// Bodies whose boxes, where they are now, overlap with this one.
	std::vector<Body::id_t> overlapping(const Bound& bound, const Scene& scene) const;

	/// For InteractionContainer: whether a pair without a contact need not be kept.
	bool shouldBeErased(Body::id_t id1, Body::id_t id2, Scene* scene) const;

private:
	using Pairs = std::vector<std::pair<Body::id_t, Body::id_t>>;

	/// One of so many bodies may be in the second grid: beyond, both grids are slower together than one that is made anew.
	static constexpr std::size_t part = 4;

	void makeGrid(const Scene& scene);
	void sortPairs(Scene& scene) const;
	void move(const Scene& scene, const std::vector<Body::id_t>& ids);
	void erasePairsOf(Scene& scene, const std::vector<Body::id_t>& ids) const;
	bool staysApart(const Body& one, const Body& other) const;
	bool isNew(Scene& scene, Collider& collider, const Body& one, const Body& other) const;
	/// Pairs that `find(k, add)` adds for k from 0 on, in parallel.
	template <class Find> void insertFound(Scene& scene, long number, const Find& find) const;

	const BoxRoom&             room_;
	bool                       judge_ = false;
	polytope::BoxGrid          grid_, moved_;
	std::vector<std::uint32_t> places_;   ///< by body id, in grid_
	std::vector<Body::id_t>    movedIds_; ///< ascending
};

} // namespace yade
