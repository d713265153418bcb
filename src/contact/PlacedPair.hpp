// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "shape/ConvexShape.hpp"

namespace polytope {

/// Two bodies, and how the second lies to the first: what is asked about. It keeps pointers: make it in the call, or of what lasts longer. Scene
/// coordinates never enter, and periodic shifts are the caller's. In 2-D the rotations are about z and z of everything is ignored.
struct PlacedPair {
	const ConvexShape* shape[2];
	const Matrix3*     rotation[2]; ///< from a body's axes to world axes
	const Vector3*     centre2;     ///< from body 1's centre to body 2's, world axes [m]

	PlacedPair(const ConvexShape& shape1, const Matrix3& rotation1, const ConvexShape& shape2, const Matrix3& rotation2,
	        const Vector3& centre2_)
	        : shape { &shape1, &shape2 }, rotation { &rotation1, &rotation2 }, centre2(&centre2_)
	{
	}
	/// Of what two polygons share: the thinner one's [m].
	Real thickness() const
	{
		const Real one = shape[0]->thickness(), two = shape[1]->thickness();
		return one < two ? one : two;
	}
	/// The bodies exchanged; `centre1`: from body 2's centre to body 1's.
	PlacedPair exchanged(const Vector3& centre1) const { return { *shape[1], *rotation[1], *shape[0], *rotation[0], centre1 }; }
};

} // namespace polytope
