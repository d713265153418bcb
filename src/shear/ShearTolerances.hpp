// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "numbers/Tolerances.hpp"

/// Thresholds of the shear bed, as Tolerances.hpp has those of the contact path: meaning, scale, reason.
namespace polytope::tolerance {

/// Ratio of the smaller to the larger principal second moment of an outline below which the outline is a line: how its strength varies
/// across it is not known. This is the square of the smallest ratio of width to length at which the moments keep half of their digits.
constexpr double shearSliver = 1e-14;

/// Distance of a centre of rotation from an edge's line, as a part of the edge's length, below which it sees no triangle between them.
constexpr double shearPole = 1e-14;

/// Distance of a centre of rotation, over the outline's size, beyond which the resistance is summed at points, since the sums over edges
/// lose digits with the fourth power of the distance. Here both agree to 1e-10 of the strength; if they differed by more, motions that
/// differ by rounding would part here.
constexpr double shearPoleFar = 16;

/// Distance of a centre of rotation, over the outline's size, beyond which three points take the place of five; their error falls with the
/// third power of the distance.
constexpr double shearPoleFarther = 500;

/// Distance of a centre of rotation, over an outline's half width, beyond which the sums over edges lose digits with the square of distance
/// over width, and five points of Gauss-Legendre across are exact to 1e-14 (their error falls with the tenth power).
constexpr double shearNarrow = 12;

/// Distance, over a line's length, beyond which five points of Gauss-Legendre along the line are exact to 1e-15, while its closed form
/// loses digits with the square of distance over length.
constexpr double shearShort = 8;

/// Distances, over a line's length or an outline's half width, beyond which three points of Gauss-Legendre (their error falls with the
/// fifth power of the distance), or two (third power), are exact to 1e-14.
constexpr double shearThreePoints = 200;
constexpr double shearTwoPoints   = 10000;

/// Length of a Newton step, as a part of the slip and measured by the energy, that counts as short: a step of this length leaves what
/// rounding leaves, except where the centre of rotation lies on the outline.
constexpr double shearReturn = 1e-9;

/// Distance between the load that stays and the limit surface, as a part of the load and measured by the energy, that a short Newton step
/// may leave; more calls for another step. It is some times the rounding of the sums over edges.
constexpr double shearOff = 1e-13;

/// Precision to which the least work of the strength in a motion is found, as a part of that work, when it is compared with the work of the
/// load. A load that is beyond the limit surface by less is taken as within it.
constexpr double shearMotion = 1e-12;

/// Rounding of the sums for the work of a slip, as a part of that work.
constexpr Real sumsOfWork = 100 * rounding;

/// Newton steps of the return to the limit surface; five are usual, more where the centre of rotation lies on a corner.
constexpr int shearReturnSteps = 40;

/// Halvings of a Newton step whose energy rises.
constexpr int shearHalvings = 30;

/// Relative difference of two areas up to which they are the same: the rounding of sums over layers.
constexpr Real sameArea = 1000 * rounding;

/// Layers in which a bed remembers when its springs came under load. Two hold a load cycle, more hold cycles within cycles; at four, a block shaken
/// for 40 cycles on its edges creeps less than a micrometre a cycle.
constexpr int shearLayers = 4;

/// × reach of the bed: layers whose middles are nearer by less than this to where area is lost count as equally near, and the last of them loses it.
constexpr double sameRim = 0.1;

/// × the bed's polar second moment: that of its layers' middles is no more, for each layer has an extent of its own.
constexpr double mostSpread = 0.95;

} // namespace polytope::tolerance
