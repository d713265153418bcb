// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "numbers/Real.hpp"

#include <limits>

/// Every threshold of the contact path: meaning, scale, reason. Lengths are relative to the pair's size, the
/// smaller of the two bodies' circumradii; weights and decrements are pure numbers. (Shape construction has its own in ConstructionTolerances.hpp.)
///
/// In wider arithmetic than double a threshold that rounding sets is finer by as much as rounding is; one that says what is
/// modelled (gapSkin) or which of two ways is shorter stays, so that all precisions solve the same problem.
namespace polytope::tolerance {

/// Within this namespace: thresholds need no digits, only their exponent, and a double has one for every precision of YADE's.
using Real = double;

/// 2 to this power.
constexpr Real powerOfTwo(int exponent)
{
	return exponent < 0 ? powerOfTwo(exponent + 1) / 2 : exponent > 0 ? powerOfTwo(exponent - 1) * 2 : 1;
}

/// Significant bits of polytope::Real.
constexpr int digits = std::numeric_limits<polytope::Real>::digits;

/// Distance from 1 to the next number.
constexpr Real rounding = powerOfTwo(1 - digits);

/// Rounding over double's: one in double.
constexpr Real finer = rounding / std::numeric_limits<double>::epsilon();

/// Default of `tolerance` (× size): a pair touches when s* < −tolerance. A plane moved into the contact frame is rounded
/// by about 4 × rounding × size; below ten times that the sign of s* is not decided by the input.
constexpr Real contact = 45 * rounding;

/// × size: a plane counts as violated by the LP's point beyond this. Evaluating a·x − d near the contact costs a few
/// roundings of the size; a smaller value would pivot on rounding errors.
constexpr Real violation = 8 * rounding;

/// × both sizes: how far the bounds of s* from above and below may be apart at the optimum. With a few roundings of the
/// bounds themselves that is the accuracy stated for s*, 8 roundings of the pair's reach; a smaller value would solve again,
/// with more digits, where a weight that is zero has come out as −1e-15.
constexpr Real certain = 6 * rounding;

/// A basis with a weight λ below −this is not dual feasible and is repaired or refused (λ sum to 1). A quarter of the
/// digits: a basis of nearly parallel planes carries weights this noisy, and the final test is on s*, not on λ.
constexpr Real weight = 1024 * rounding;

/// × LpBasis::noise: an entering column's components, and weights, below this have no sign. The sums behind them have
/// four terms of three roundings each.
constexpr Real noise = 16;

/// Noise (rounding × length of an inverse row) from which a basis counts as singular: two normals nearer than 256 roundings
/// are one normal to the simplex, of which the basis takes one.
constexpr Real singularBasis = Real(1) / 256;

/// Volume of three (area of two) differences of normals over the product of their lengths: from the first on they are
/// chosen anew, so that nearly parallel normals are subtracted from each other; the second is no volume but rounding.
constexpr Real smallVolume = 1e-3;
constexpr Real noVolume    = 4 * rounding;

/// The linear program with twice the digits (WideLp.hpp): volume of differences of normals, over their lengths, that is
/// rounding there; and part of a rounding × size by which a plane may be violated at its optimum.
constexpr Real wideVolume = 64 * rounding * rounding;
constexpr Real wideRest   = Real(1) / 16;

/// Noise from which weights and point are refined (below it the inverse is as good), until what is corrected is below
/// `refined`. Each refinement gains two digits at the least, or the basis is no good; some end on a residual of a few more
/// roundings: up to `refinedLast` that is let pass.
constexpr Real refinedBasis = 64 * rounding;
constexpr Real refined      = 4 * rounding;
constexpr Real refinedLast  = 16 * rounding;
constexpr int  refinements  = 8 * digits / 53;

/// A contact is taken from its last full computation to first order (contact/LinearContact.hpp) until its bodies have moved by the first × depth (−s*) along
/// the normal, anywhere on the surface, or by the second × its width along it (where that is more than the first). What the former leaves out is of
/// second order, 1e-5 of the force and 1e-8 of the energy at the most (LinearContactTest.cpp); the latter is by how much the outline over which
/// friction acts may be off. And for how many steps it must be expected to be good: the derivative takes time, too, and by differences
/// (contact/LinearByDifferences.hpp) as long as twelve full computations. Those are not followed where they leave out more than linearLeftOut of the
/// force on all pieces: a corner, whose force grows with the cube of its depth, leaves out 3 linearAcross².
constexpr Real linearAcross = 5e-3, linearAlong = 3e-5, linearLeftOut = 4 * linearAcross * linearAcross;
constexpr int  linearSteps = 4, linearStepsByDifferences = 32;

/// Steps in a row that do not raise s after which the simplex changes to Bland's rule, which cannot cycle.
constexpr int stalledPivots = 12;

/// Pivots after which the LP is ended without an optimum, per plane: 20 × the largest count seen in the fuzz set (2 per plane).
constexpr int pivotsPerPlane = 40;
constexpr int pivotsAtLeast  = 200;

/// × size: an overlap whose inscribed ball is smaller is thin. In a frame not made for it the Hessian loses 1/thin² of its
/// digits and its planes 1/thin, so it gets a frame of its own; a thicker one does not need it.
constexpr Real thin = 1e-3;

/// Weight of a basis plane from which on it bounds the first guess of the analytic centre.
constexpr Real leastShare = 1e-3;

/// Default of `newtonTolerance`: the analytic centre is accepted when the step that follows is predicted shorter than
/// this in the local (Dikin) norm, that is, as a fraction of the overlap's own size in each direction.
constexpr Real newton = 1e-10 * finer;

/// Range of `newtonTolerance` that a script may set: from `rounding`, since no centre can be finer, to this. A coarser one is
/// anywhere in the overlap.
constexpr Real coarsestNewton = 0.1;

/// × size: how far the depth may be off for a centre not yet reached. The remaining step, in the local norm, is kept
/// below this over |s*|; it binds in overlaps deeper than 2e-4 × size alone.
constexpr Real depth = 2e-14 * finer;

/// Determinant over the diagonal's product from which on a 3×3 Hessian may be inverted by cofactors, which lose the digits
/// of both eliminations together.
constexpr Real wellScaled = 1e-2;

/// Part of a diagonal element of the Hessian that elimination must leave. Below the square root of rounding the centre
/// loses more than a relative 1e-12 of the overlap's size along that axis.
constexpr Real cancellation = 1e-8 * powerOfTwo((53 - digits) / 2);

/// Number of times the axes are turned to the overlap's own before Newton counts as not converged.
constexpr int turns = 2;

/// Newton decrement below which the full step is taken and convergence is quadratic (theory: any value < 0.38 for a
/// self-concordant barrier); above it the step length comes from a line search.
constexpr Real fullStep = 0.25;

/// A full step that does not halve the decrement is dominated by rounding: the centre is as accurate as the planes. Accepted as
/// `RoundingLimited` when the decrement is below this; above it the solve has failed.
constexpr Real stagnation = 0.1;

constexpr int newtonIterations = 100;

/// A step that would use up more than this part of the nearest plane's slack needs no line search.
constexpr Real nearPole = 0.5;

/// Line search stops when the slope has fallen to this fraction of its start: a crude search suffices, since
/// evaluating the next Hessian gains more.
constexpr Real lineSearchSlope = 0.1;
constexpr int  lineSearchSteps = 30;

/// Ipopt's `tol` (it computes in double only), on numbers that are about one (see IpoptCentre.cpp).
constexpr double ipopt           = 1e-12;
constexpr int    ipoptIterations = 15;

/// Ipopt's centre is accepted when solving once more, scaled anew, moves it by less than this in the local norm: a tenth of
/// the 1e-8 in which it agrees with Newton's. The first round comes near, the second refines, the third confirms.
constexpr Real ipoptMove   = 1e-9;
constexpr int  ipoptRounds = 20;

/// Faces, and vertices of one face, that an overlap may have (OverlapPolyhedron.hpp): buffers are this large squared. The overlap of two smooth
/// bodies of ten thousand faces has some hundred where they touch; one with more is taken as a contact at one point.
constexpr int overlapFaces = 512;

/// × reach of the pair: distances below this are rounding of the vertices' places, and the bodies touch; and steps of the distance's
/// iterations that gain less than this end them (PairDistance.hpp). Places of vertices are rounded by 4 × rounding.
constexpr Real distance = 16 * rounding;

/// Steps of those iterations, at the most, per vertex and at least. A step that gains enters a vertex that no earlier set of vertices had,
/// so that they end by themselves; they have taken less than one per vertex.
constexpr int distanceSteps = 4, distanceStepsAtLeast = 64;

/// Rotation matrices, and unit normals, that are given: how far products of their columns, or the normal's square, may be from those of
/// unit vectors (Preconditions.hpp). Orientations that an integrator turns and normalises stay within some roundings; what is farther off
/// is a mistake.
constexpr double orthogonal = 1e-6;

/// Planes up to which sorting by insertion is faster than std::sort.
constexpr int fewPlanes = 64;

/// × size: how far apart two bodies may have carried the last contact point and still be followed to it. Steps of DEM move
/// bodies against each other by a ten-thousandth.
constexpr Real samePoint = 0.05;

/// × thickness of the overlap over the size: the tangent of the angle up to which it may be oblique in the frame. Across it the
/// Hessian then loses no more than three digits, and its gradient none that the planes have.
constexpr Real lean = 30;

/// × −s: a carried point with this much slack to every plane is a good enough start of Newton's iterations as it is.
constexpr Real carriedRoom = 0.25;

/// A carried starting point may go at most this fraction of the way from the LP's point to the nearest plane.
constexpr Real interiorStep = 0.9;

/// × size: below this the two turned gradients, or the dual's direction, cancel and give no direction.
constexpr Real direction = 64 * rounding;

/// × the larger body's circumradius: faces of two pieces count as one face if one is not higher than this. What rounding of poses leaves of
/// pieces that lie flush.
constexpr Real flush = 1e-9;

/// × radius of the overlap's ball: nor if it is higher than this, a fortieth of the depth of a face on a face. What digits of a file or settling
/// leave of pieces that are meant to lie flush; a higher step lifts a body, and so has to take its share of the body's speed. Where a face of the
/// overlap has its corners, neighbours must cover it this part of the way to its middle: of a flush face as deep.
constexpr Real flushOfDepth = 0.05;

/// × radius of the overlap's ball: how far outside of a face of a piece a neighbour that covers it is looked for. Close by, so that a point beside
/// an oblique face is not above the neighbour; at a joint that is a little open; and beyond a gap that is as wide as the ball.
constexpr Real closeBy[] = { 1e-3, 0.03, 2 };

/// × what rounding of poses leaves between two pieces: a point is looked at no nearer to a face than this, and a face of their overlap that is
/// no wider than the second number is none.
constexpr Real offFace = 2, thinFace = 4;

/// × extent of the overlap of two solids: planes of other pieces that are as near to it may bound it before the next search for internal faces,
/// and are known; those up to the second number are known with them.
constexpr Real endsNear = 0.02, endsKnown = 0.2;

/// × thickness of the overlap of two pieces: that of their solids is no thicker, unless the pieces meet in a sliver, where the middle of that of
/// the solids must be in them.
constexpr Real grownOut = 4;

/// Searches for internal faces in the overlap as it grows over the pieces, at the most: from one piece to the next.
constexpr int piecesOnTheWay = 64;

/// × extent of the overlap of two solids: distance of the simplex that its program begins with. No farther from the frame's origin, which is in
/// the overlap, than twice the extent is any of its points.
constexpr Real simplexAround = 2.5;

/// × largest coordinate of two bodies: what rounding of their places and of their planes there leaves of an overlap where they lie flush.
constexpr Real flushPlaces = 8 * rounding;

/// × the inscribed radius of a shape's core: how deep a shape with a margin may be in one of several pieces that share its contact.
constexpr Real thinContact = 0.1;

/// One minus the cosine between normals of one body that count as one direction.
constexpr Real parallel = 1e-4;

/// Least part of a stiffness that one of several pieces has. Any small number will do: zero would mean no contact.
constexpr Real leastShareOfSupport = 1e-9;

/// × extent of the overlap of two solids: planes of their other pieces that were there before, and are no farther from these, are the same. They
/// turn with their body, and so differ by rounding.
constexpr Real endOfSupport = 1e-9;

/// Change of the overlap with a piece, as the area times the radius of its ball, over what it was when internal faces were searched for, after
/// which they are again: in every step of an impact, and of a face that sinks in, after a twentieth of its depth. A smaller number costs more
/// searches where bodies move, and does nothing for the energy of collisions.
constexpr Real overlapChanged = 0.05;

/// Steps between two searches for internal faces of a pair that touched before: between two of them, a body at
/// 1 m/s moves by a hundredth of its size at most.
constexpr int internalFacesEvery = 16;
/// The same of a contact that is followed: between two of them its bodies move by a twelfth of the overlap's depth at most (linearAcross,
/// linearSteps). A search takes much longer than such a contact's step, and a mass that rests on fixed blocks has many of them.
constexpr int internalFacesEveryFollowed = 64;
/// Way of a pair's contact point on one body against that on the other since the last step, over the smaller circumradius, above which a body was put
/// elsewhere, and its internal faces are looked for at once.
constexpr Real putElsewhere = 0.01;

/// Difference of two orientations that counts as no rotation (length of the vector part of one quaternion times the other's conjugate).
/// YADE normalises an orientation in each step, which changes its four numbers by a rounding error each, of either sign; their product
/// adds as many again. What stays below moves no vertex by more than a few roundings of the body's size.
constexpr Real noTurn = 8 * rounding;

/// Widths of a box grid's levels below the middle one, in halves: boxes a million times smaller than most share cells.
constexpr int boxLevels = 20;

/// Coordinate over the width of a cell from which on boxes have no cell: their numbers in double differ by 2⁻¹² of a width there.
constexpr double farthestCell = powerOfTwo(40);

/// × width of a cell: how far below a box the lowest corners may be of boxes that overlap with it, rounding up to `farthestCell` included.
constexpr double cellRoom = 1 + powerOfTwo(-10);

/// × size: how far a separated pair that still needs geometry (a real interaction whose law has not ended it) is grown
/// into overlap, so that its point is an analytic centre that continues the touching one's.
constexpr Real gapSkin = 1e-6;

/// × size: largest length by which bodies are grown for a contact surface; otherwise they are grown by their distance. For joints that
/// dilation holds open that is more than enough.
constexpr Real widestSkin = 0.1;

} // namespace polytope::tolerance
