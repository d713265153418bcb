// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "pairs/BoxRoom.hpp"
#include "pairs/PairSearch.hpp"

#include <pkg/common/InsertionSortCollider.hpp>

namespace yade {

class PolytopeCollider : public InsertionSortCollider {
public:
	bool isActivated() override;
	void action() override;

	/// Ids of the bodies whose boxes meet this one, as InsertionSortCollider's function of this name returns them.
	vector<Body::id_t> probeBoundingVolume(const Bound& bound) override;

	// clang-format off
	YADE_CLASS_BASE_DOC(PolytopeCollider, InsertionSortCollider,
	R"""(Collider for scenes with :yref:`Polytopes<Polytope>`. Used in place of :yref:`InsertionSortCollider`, with the same attributes, but other methods:

It takes account of rotations, so that polytopes get tight boxes: a box is enlarged for the rotation of the next
:yref:`targetInterv<InsertionSortCollider.targetInterv>` steps, up to a displacement of :yref:`verletDist<InsertionSortCollider.verletDist>` at its
farthest vertex, and made anew before the body has turned farther than that. A body that turns so far in four steps gets the box of its circumscribed
ball, which contains it in every orientation. Boxes, facets and other shapes of YADE's get new boxes in each step in which they turn.

It finds boxes that overlap by a grid, with all threads, in a time that grows as the number of bodies. When some bodies have moved out of their boxes,
these alone get new ones, and partners; all do after :yref:`targetInterv<InsertionSortCollider.targetInterv>` steps. Two free polytopes whose boxes
overlap, but which stay apart while they are in them (their linear program says so), have no :yref:`Interaction` until then. Two fixed polytopes without
velocity that are apart or lie flush (the largest ball in both is smaller than 1e-9 of the larger body, or than what rounding leaves of their places) have
none until one of them is freed, gets a velocity or is put elsewhere. Nor have two fixed facets, boxes or walls. In periodic cells, and with a
:yref:`verletDist<InsertionSortCollider.verletDist>` of zero, pairs are those of InsertionSortCollider, and in the former found by it.

Where bodies were added or freed since a :yref:`PolytopeTimeStepper` has found the time step, it is called first, so that they do not move with a step that
was not made for them.)""");
	// clang-format on

private:
	/// Whether all boxes have to be made anew.
	bool            mustRunForAll() const;
	void            adaptTimeStep();
	BoxRoom::Limits limits() const;
	/// Boxes whose sizes the bodies' functors know, room for rotation included.
	template <class Make> void withRooms(const Make& make);
	void                       prepareBoxes();
	void                       findVerletDist();
	void                       findNewton();
	void                       searchAll();
	void                       searchSome();

	// not saved: after loading the first step makes all boxes anew
	BoxRoom                 room_;
	PairSearch              pairs_ { room_ };
	std::vector<Body::id_t> outside_;             ///< bodies that are out of their boxes, as isActivated() has found them
	bool                    hasSearched_ = false; ///< for all
	long                    searchedAt_  = 0;     ///< step in which it has
	bool                    divided_     = false; ///< the scene is one of several processes': all of them search together
	std::size_t             bodies_      = 0;     ///< length of the list of bodies then
};
REGISTER_SERIALIZABLE(PolytopeCollider);

} // namespace yade
