// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "numbers/Tolerances.hpp"

/// Thresholds of distances from segments and planes, as numbers/Tolerances.hpp has those of the contact path: meaning, scale, reason.
namespace polytope::tolerance {

/// × the segment's length: how much farther than the nearest a place of a segment that lies along a face may be and still count as near.
/// The place found is the middle of those: a beam on a face that rounding tilts does not jump to one of its ends. Beyond the face's edge
/// the distance grows with the square, so that the place is off by up to a millionth.
constexpr double alongSegment = 1e-12;

/// Thirds, and halves, by which that place is found: the last is 3e-11 of the segment.
constexpr int segmentSteps = 60;

/// Square of the sine of the angle below which two segments are parallel: their nearest places are then the middle of where they lie beside
/// each other.
constexpr double parallelSegments = 1e-12;

/// × an edge's length: where no more of it is left beside other edges from the same vertex, it is rounding of the vertices' places, and has no
/// direction of its own (contact/PairDistance.cpp).
constexpr Real edgeOfOthers = 4 * rounding;

/// Sine of the angle from which on two faces, an edge and a face, or two edges of bodies with margins count as not parallel: their force
/// then acts at the nearest points (contact/SpreadContact.hpp). A face that lies on another one parts from it on one side at a tilt of
/// about the overlap over its width, a hundredth at the most; the angle is ten times that, and less than that between neighbouring faces of
/// most polyhedra.
constexpr double parallelFeatures = 0.1;

/// Sides of the polygon around the section of a body with a margin (contact/RoundedSection.hpp), a multiple of four. Shares of pieces are
/// parts of its area, so they add up to one with any number. With 16 it goes up to 2 % beyond a disc's rim: no farther than the overlap,
/// whose rim is 41 % wider than that of the section half as deep.
constexpr int sectionDirections = 16;

/// Halvings of the vertices between two of those sides at which the core's own sides are found: more than any face has in a sixteenth of a turn.
constexpr int sectionSides = 6;

/// Halvings of the angle to one place of it, at the most: then it is known to a rounding. Most places take as many as separate two vertices, a few.
constexpr int sectionSteps = 50;

/// × the depth of two cores in each other: as far as one is moved along the contact's normal until they are apart, and the way back is
/// known. The depth is a mean over the overlap, of a corner a third of what leads out of it.
constexpr double farthestOut = 16;

/// × the body's radius: how far corners of a face may be from a side of a piece of water (WaterPressure.hpp) on which the face lies. Above the
/// rounding of turns and of places some thousand radii from the origin. The pressure is the same on both sides, so that it does not matter to which
/// one a face in between is given.
constexpr double onSide = 1e-9;

} // namespace polytope::tolerance
