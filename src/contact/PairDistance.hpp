// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "contact/PlacedPair.hpp"

namespace polytope {

/// The distance of two bodies that are apart; where they touch or overlap it is zero, without normal and points (contactQuery() has those).
struct PairDistance {
	Real    distance = 0;                                    ///< [m]
	Vector3 normal   = Vector3::Zero();                      ///< unit, world axes, from body 1 to body 2
	Vector3 point[2] = { Vector3::Zero(), Vector3::Zero() }; ///< nearest points of the bodies, world axes, from body 1's centre
};

/// The bodies have the same dimension and are not two half-spaces. Where several points are nearest, as of parallel
/// faces, they are a vertex of the faces' nearest part. Nothing throws or allocates.
///
/// The point of the difference of both bodies that is nearest to the origin, by Wolfe's iterations (P. Wolfe 1976, Finding the nearest
/// point in a polytope, Mathematical Programming 11:128-149) with one vertex of each body as a vertex of the difference. Error: some
/// roundings of the pair's size, of the normal this over the distance.
POLYTOPE_API PairDistance pairDistance(const PlacedPair& pair);

/// The distance of the convex hulls of two sets of points in space, points and nearest points in the same axes; zero, without normal and
/// points, where a set is empty.
POLYTOPE_API PairDistance pairDistance(const std::vector<Vector3>& points1, const std::vector<Vector3>& points2);

} // namespace polytope
