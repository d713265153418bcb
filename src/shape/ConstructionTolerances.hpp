// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "numbers/Real.hpp"

#include <limits>

/// Every threshold of shape construction (half-spaces, hulls, mass properties): meaning, scale, reason. All are pure
/// numbers times a size the shape itself gives, never a length: a crystal of 1e-9 m and a block of 1e4 m are treated alike.
///
/// "Size" is the larger of two lengths: the shape's extent about an inner point, and that point's distance from the
/// origin. The first bounds what a rounded normal moves within the shape, the second what a rounded offset moves: a
/// 1 mm cube at coordinate 1e6 is defined by its offsets to 1e-10 m, whatever its extent.
/// (The contact path has its own thresholds in Tolerances.hpp.)
namespace polytope::construction {

inline const Real rounding = std::numeric_limits<Real>::epsilon();

/// × sum of the products' sizes in a determinant of three differences: bound of its rounding, (7 + 56 ε) ε with ε half of
/// `rounding` (Shewchuk 1997, Fig. 21). Beyond, the sign is exact.
inline const Real volumeRounding = Real(3.5) * rounding * (1 + 64 * rounding);

/// Largest error of that determinant by underflow, for differences below a third of 1 / `rounding`: six products, each off by half of
/// the smallest number there is, which is `rounding` × this, times a difference.
inline const Real volumeUnderflow = std::numeric_limits<Real>::min();

/// Bound of the rounding in a triple product of unit vectors: three terms of a product and a difference of products each.
inline const Real minorRounding = 16 * rounding;

/// Triple product of three planes' normals from which on Cramer's rule finds where they meet; sharper corners are found by
/// orthogonal elimination. One correction then has all digits: the rule itself loses no more than three.
inline const Real sharpCorner = 1e-3;

/// Twice a triangle's area over its longest edge's square from which on a cross product of edges gives its normal: it loses no more
/// than three digits. Below, the normal comes from a singular value decomposition.
inline const Real sliver = 1e-3;

/// × largest offset: an inscribed ball of at least this radius is found in Real: the linear program's violations are eight
/// roundings of its artificial planes' distance, a thousandth of this. Exact arithmetic decides whether there is a smaller one.
inline const Real sureInradius = 1048576 * rounding;

/// × largest offset: where that program's artificial planes stand. A ball farther out is left to exact arithmetic.
inline const Real ballReach = 64;

/// × size: planes that all pass within this distance of one point make one vertex; points within this distance of one
/// plane make one facet. 6e-14 in double. A script's plane carries some ten roundings (normalise, rotate, n·p); twenty
/// times that is still far below the shortest edge promised, 1e-9 of the extent, unless the planes at its two ends turn
/// by less than about 1e-4.
inline const Real coincidence = 256 * rounding;

/// × the tolerance of a fit: how far the body may reach beyond the fitted plane or point. A least-squares fit leaves up to
/// one tolerance at its own corners; the rest is for a narrow facet's noise, carried on to its neighbours.
inline const Real support = 4;

/// × half of a body's least width: facets whose corners miss a common plane by more are never joined, whatever a caller allows. The two
/// faces of a plate that is thinner than this allows for would be one facet, and no body would be left.
inline const Real thinnestFacets = 1.0 / 64;

/// × size: two neighbouring planes this close over the whole shape are one plane (the first is kept). It has to exceed
/// twice `coincidence`: between the two, the vertices of one face could join either of two planes and split it.
inline const Real coplanarity = 4 * coincidence;

/// × size: a set whose inscribed sphere is smaller has no interior. 9e-13 in double: sixteen times `coincidence`, so that
/// merging can never close a shape that is let through. Plates and needles of aspect 1e8 pass with four digits to spare.
inline const Real flatness = 16 * coincidence;

/// A unit direction y with n·y at most this for every plane is a direction in which the set is unbounded. 1.4e-14 in
/// double: the walls of a tube, rounded, close at 1e15 times its width, which is not meant. Kept below `flatness`, so a
/// double cone of aspect 1e-12 is refused as flat and not as open.
inline const Real recession = 64 * rounding;

/// × inradius: a vertex farther than this, or one that planes added at `horizon` cut, makes construction check `recession`
/// exactly (six small linear programs); nearer ones certainly do not mean an open set.
inline const Real farVertex = 1e6;

/// × inradius: where the closing planes stand. Beyond any vertex of a set that is not `recession`-open.
inline const Real horizon = 1 / (rounding * rounding);

/// Two unit normals (per component) and two offsets (× the larger of both, or the set's median offset where both are
/// smaller) are the same plane. A plane written twice in different ways (other length, other order) differs by a few roundings.
inline const Real duplicate = 16 * rounding;

/// Lengths [m] that bodies and coordinates may have, in any usual unit. Beyond, the fifth power of a length (inertia)
/// leaves the range of double, and the contact path treats a plane at 1e60 as absent.
inline const Real smallestLength = 1e-50;
inline const Real largestLength  = 1e50;

/// A normal this near unit length is not changed, so that normalising twice changes no bit.
inline const Real unitLength = 4 * rounding;

/// 2-D: a normal's z, or (× extent) a point's z, up to this is rounding (of a rotation, of a computed point) and is set to zero.
inline const Real outOfPlane = 64 * rounding;

/// × the whole rock's radius: a joint that passes no farther inside a block than this follows a face or a corner and does not cut. Joints that
/// were meant to meet there are apart by rounding of the whole rock. One length for all blocks, so that what follows a face is known afterwards.
inline const Real touching = 1e-9;

/// Difference of two unit normals, and × extent of two offsets: joints whose planes differ by less may cover a face together, where they pass it
/// within `touching`. Triangles of one flat face in a file with eight digits do; with fewer digits, they cut each other.
inline const Real nearPlane = 1e-6;

/// Sides of the regular polygon that stands for a disc where several joints in one plane cover a face together: it is larger than the disc by
/// 0.08 % of its area, less than the least bridge of rock that counts (py/polytope/rock/jointedRock.py).
inline constexpr int discSides = 64;

/// × extent: a centroid this near to the origin is the origin; it was computed with some ten roundings of the extent, and planes that
/// were given about it stay as they are.
inline const Real centred = 64 * rounding;

/// × extent: how far a body's position, rounded, may be from its centroid before the planes are taken about the centroid itself and
/// the body shifted by the difference: a hundredth of `bodyFrame`.
inline const Real wellCentred = 1e-8;

/// × bounding radius (centroid), and × trace of the inertia (its products): how far a body's frame may be off before its shape is refused. Loose
/// enough for planes typed with six digits, far below what affects a simulation.
inline const Real bodyFrame = 1e-6;

/// × volume of the axis-parallel box: a shape with less volume than this is turned before its moments are summed. The sum's
/// rounding is that of the box, so three digits are lost at most; a plate that lies along the axes is never turned.
inline const Real slender = 1e-3;

/// × largest moment: off-diagonal terms up to this are rounding, and the tensor's own axes are kept. 9e-13 in double.
/// Vertices within `coincidence` of their planes move a product of inertia by several times 6e-14.
inline const Real diagonal = 4096 * rounding;

} // namespace polytope::construction
