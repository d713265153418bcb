// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "Polytope.hpp"

#include <pkg/common/InsertionSortCollider.hpp>

namespace yade {

class PolytopeCollider : public InsertionSortCollider {
public:
	bool isActivated() override { return InsertionSortCollider::isActivated() || turnedOutOfBox(); }
	void action() override;

	// clang-format off
	YADE_CLASS_BASE_DOC(PolytopeCollider, InsertionSortCollider,
	R"""(:yref:`InsertionSortCollider` that also takes account of rotations, so that :yref:`Polytopes<Polytope>` get tight boxes: fewer pairs whose boxes overlap though they are apart (two of five fewer in a settled heap of cubes). Used in place of the other, with the same attributes. A box is enlarged for twice the rotation between the collider's last two runs, up to a displacement of :yref:`verletDist<InsertionSortCollider.verletDist>` at its farthest vertex; the collider runs again before the body has turned farther than that. A body that turns faster than that gets the box of its circumscribed ball, which contains it in every orientation. Bodies of other shapes are treated as by InsertionSortCollider, which takes account of translation only.)""");
	// clang-format on

private:
	/// Orientation from which a polytope's rotation is measured.
	struct Turn {
		Quaternionr from   = Quaternionr::Identity(); ///< orientation when the box was made
		Real        radius = 0;                       ///< of the circumscribed ball; 0: no polytope
	};

	/// Displacement of the farthest vertex by the rotation (the chord).
	static Real way(const Turn& turn, const Body& body);

	const Body* bodyOf(std::size_t id) const;

	void makeRoom();
	bool turnedOutOfBox() const;

	// by body id; not saved: after loading the first step makes all boxes anew
	std::vector<Turn> turns_;
	std::vector<Real> rooms_;       ///< displacement of the farthest vertex that the box allows for
	long              madeAt_ = -1; ///< step in which they were made
};
REGISTER_SERIALIZABLE(PolytopeCollider);

} // namespace yade
