// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "numbers/Tolerances.hpp"

/// Thresholds of the shear bed, as Tolerances.hpp has those of the contact path: meaning, scale, reason.
namespace polytope::tolerance {

/// Of the larger principal second moment of an outline: below this the outline is a line, and how its strength varies across it is not known. The square
/// of the least width over length whose moments keep half of their digits.
constexpr double shearSliver = 1e-14;

/// Of an edge's length: a centre of rotation nearer to the edge's line sees no triangle between them.
constexpr double shearPole = 1e-14;

/// Times the outline's size: for a centre of rotation farther than this the resistance is summed at points, since the sums over edges lose digits with the
/// fourth power of the distance. Here both agree to 1e-10 of the strength; what jumped by more would have motions that differ by rounding part.
constexpr double shearPoleFar = 16;

/// Times the outline's size: for a centre of rotation farther than this three points do in place of five; their error falls with the third power of the
/// distance.
constexpr double shearPoleFarther = 500;

/// Times an outline's half width: from a centre of rotation farther than this the sums over edges lose digits with the square of distance over width, and
/// five points of Gauss-Legendre across are exact to 1e-14 (their error falls with the tenth power).
constexpr double shearNarrow = 12;

/// Times a line's length: seen from farther than this, five points of Gauss-Legendre along it are exact to 1e-15, and its closed form loses digits with the
/// square of distance over length.
constexpr double shearShort = 8;

/// Times a line's length, or an outline's half width: seen from farther than this, three points of Gauss-Legendre (their error falls with the fifth power of
/// the distance), or two (third power), are exact to 1e-14.
constexpr double shearThreePoints = 200;
constexpr double shearTwoPoints   = 10000;

/// Of the slip, by the energy: a step of Newton's method from this near leaves what rounding leaves, but where the centre of rotation lies on the outline.
constexpr double shearReturn = 1e-9;

/// Of the load, by the energy: what a step from that near may leave between the load that stays and the limit surface; more calls for another step. Some times
/// what sums over edges round.
constexpr double shearOff = 1e-13;

/// Of the least work that the strength takes in a motion: whether the load gives more is known to this. A load that is beyond the limit surface by less
/// is taken as within it.
constexpr double shearMotion = 1e-12;

/// Of the work of a slip: what its sums round.
constexpr Real sumsOfWork = 100 * rounding;

/// Newton steps of the return to the limit surface; five are usual, more where the centre of rotation lies on a corner.
constexpr int shearReturnSteps = 40;

/// Halvings of a Newton step whose energy rises.
constexpr int shearHalvings = 30;

/// Of an area: one that differs by less is the same; what sums of layers round.
constexpr Real sameArea = 1000 * rounding;

/// Layers in which a bed remembers when its springs came under load. Two hold a load cycle, more hold cycles within cycles; at four, a block shaken
/// for 40 cycles on its edges creeps less than a micrometre a cycle.
constexpr int shearLayers = 4;

} // namespace polytope::tolerance
