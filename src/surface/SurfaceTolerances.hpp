// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "numbers/Tolerances.hpp"

/// Thresholds of the contact surface. Lengths are relative to the pair's size, the smaller of the two bodies' circumradii.
namespace polytope::tolerance {

/// × size: half the width of the square (2-D: of the interval) that is cut to a piece of the surface, about the foot of the frame's
/// origin on the piece's plane. The origin lies within √2 sizes of the smaller body's centre and so within 2.5 of all of the overlap.
constexpr Real pieceBox = 4;

/// Two planes whose normals differ by no more than this, and offsets by no more than this × size, are one plane: that is what is left of
/// coincident planes after they have been placed in one frame. Faces in line of blocks that were cut from one mass may be off by more, but
/// with a wider bound overlaps that are some roundings deep lose digits (ContactSurfaceTest.cpp). A force of the order of depth over size
/// comes and goes at the bound.
constexpr Real twinPlanes = 8 * rounding;

/// Sine of the angle between two lines below which their crossing is interpolated between the ends of the line that is cut: below, the
/// crossing loses more digits than the ends have.
constexpr Real crossingLines = 1e-3;

/// × extent of a piece: planes whose slack differs from the pressure by less than this all along an edge meet there, as far as rounding can
/// tell, and the surface may go on between any two of them. Pieces looked at in vain cost time alone, so that this is far above rounding.
constexpr Real meetingPlanes = 65536 * rounding;

/// × size and coordinates of a vertex of the feasible set: planes may be violated there by this, which rounding explains.
constexpr Real feasibleVertex = 8 * rounding;

/// Vertices of a feasible set, and planes that are tight in them, at the most. Pairs have a dozen mostly; where there are more, the surface
/// is walked (SurfaceWalk).
constexpr int feasibleVertices = 64, feasiblePlanes = 64;

/// Least volume of the parallelepiped of a vertex' planes over that of their lengths: below, they are too nearly parallel to say where they meet.
constexpr Real vertexVolume = 1e-8;

/// Volume of that parallelepiped over the product of the lengths below which it matters for the digits of a vertex which plane is
/// subtracted from the others.
constexpr Real sharpVertex = 1e-2;

/// × size: offsets of planes are changed by no more than this, each by its own part, to say which four of several planes that meet belong
/// together. Far above rounding, and far below what a contact can be seen in; no vertex has changed offsets.
constexpr Real splitPlanes = 65536 * rounding;

/// Length of the difference of two unit normals, of a plane of each body, below which the derivative of the piece between them is left out; and the part of the
/// pressure that may be on such pieces. Faces in line of two blocks have depth over size of it.
constexpr Real inLine = 0.1, leftOut = 1e-4;

/// Pivots to the vertex that is the optimum with the changed offsets, at the most: as many as there are planes that meet in it.
constexpr int splitPivots = 16;

/// Largest sum of the surface's area vectors over its area where it ought to be closed, and what is added to it × size over the overlap's
/// thickness: rounding leaves less, a piece that is missing more, unless it is so small that it is of no account.
constexpr Real openSurface = 1e-7, openThin = 64 * rounding;

/// Room for pieces: per plane, and at least. A convex polyhedron has three edges per face at the most, so that a surface has some
/// multiple of three pieces per plane that takes part in it.
constexpr int piecesPerPlane = 64, piecesAtLeast = 256;

/// Weight of a basis plane below which the simplex of the basis reaches too far to bound anything; and length of n below which there is no slab.
constexpr Real simplexWeight = 1e-4;

/// Rounding of a weight over the weight from which on the simplex is not certain; and factor by which it is enlarged for the rounding that is left.
constexpr Real simplexNoise = 1e-9 * finer, simplexRoom = 1.001;

/// By how much the planes of two bodies must differ in their direction along the normal to count as facing each other.
constexpr Real facing = 1e-9;

/// × size: a force whose line of action is farther than this from the centre of pressure is what is left of pressures that cancel. It has no place.
constexpr Real lineOfAction = 2;

/// Planes that are known to meet a piece from the one before it: that on the other side of their edge, and those at its ends.
constexpr int knownPlanes = 3;

/// Planes that meet in one edge of a piece of which all pairs are looked at; of more, those that are neighbours about the edge (MeetingPlanes.hpp).
constexpr int fewMeeting = 16;

/// × half the width of the square that is cut to a piece: two vertices of a polygon which has more than so many are one.
constexpr Real sameCorner = 2 * rounding;
constexpr int  fewCorners = 8;

/// Sine of the angle between two directions to normals of such planes below which rounding may have exchanged them: the polygon of 1e4 sides has 1e-4.
constexpr Real crossingPlanes = 1e-6;

} // namespace polytope::tolerance
