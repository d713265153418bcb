// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "contact/SpreadContact.hpp"

#include <array>
#include <vector>

/// What of a core with a margin another one may lie on: a face, an edge, or a corner.
namespace polytope {

/// How parallel two features are: 1 to 0. `slopeSquared`: square of the sine of the angle between them. Returns its derivative by that in `change`.
Real parallelism(const Real& slopeSquared, Real& change);

/// A weight, and how it changes as its body turns while the normal stays.
struct FeatureWeight {
	Real    value = 0;
	Vector3 turn  = Vector3::Zero();
};

/// The face and the edge of a core that look most along a direction.
struct CoreFeatures {
	FeatureWeight            face, edge;
	std::vector<FaceCorners> faces; ///< the face, or its parts in several pieces; none: it has no bounds
	Vector3                  faceNormal = Vector3::Zero(), onFace = Vector3::Zero();
	std::array<Vector3, 2>   ends { { Vector3::Zero(), Vector3::Zero() } };

	CoreFeatures(const CoreInPlace& core, const Vector3& outward);

private:
	void takeFace(const CoreInPlace& core, const Vector3& outward);
	void takeEdge(const CoreInPlace& core, const Vector3& outward);
	void weighEdge(const Vector3& outward);
};

} // namespace polytope
