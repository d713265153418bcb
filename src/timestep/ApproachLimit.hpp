// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "numbers/Real.hpp"

#include <functional>
#include <limits>
#include <vector>

/// Time in which two bodies that may meet move towards or past each other by a fraction of the smaller one's inscribed radius.
///
/// Problem: a contact must not begin deep in a body, so what bodies move against each other in a step has to be small. Only of those that
/// can meet until the step is chosen anew: what has left a scene and falls for ever, or is carried along on what moves as fast, does not
/// count. The pairs are found by a tree of boxes with the range of their velocities: two branches that cannot meet, or whose velocities
/// differ too little to limit anything, are left out as a whole.
///
/// SI units; world axes.
namespace polytope {

struct MovingBox {
	Vector3 low, high; ///< corners; may be infinite
	Vector3 velocity;
	Real    spin   = 0;     ///< speed of its farthest point by rotation
	Real    radius = 0;     ///< of its inscribed ball; infinite for one without a size
	bool    free   = false; ///< is moved by forces; two others have no contact
	int     id     = -1;
};

struct ApproachLimit {
	Real step = std::numeric_limits<Real>::infinity();
	int  id   = -1; ///< of the free body of the pair, of two free ones of the smaller one
};

/// The limit of two bodies with these ids [s].
using LimitOfTwo = std::function<Real(int id1, int id2)>;

/// \param fraction   of the smaller inscribed radius
/// \param horizon    until then [s]
/// \param change     by which a relative velocity may change until then, as by gravity [m/s]
/// \param below      longer limits need not be found [s]
/// \param limitOfTwo takes the place of the fraction over the speed, for two bodies that may come nearer by the fraction within `below`, the change of
///                   their velocities included
ApproachLimit approachLimit(std::vector<MovingBox> bodies, const Real& fraction, const Real& horizon, const Real& change, const Real& below,
        const LimitOfTwo& limitOfTwo = {});

} // namespace polytope
