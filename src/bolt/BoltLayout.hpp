// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "bolt/BoltChain.hpp"
#include "shape/PlacedShape.hpp"

#include <optional>

/// Which part of a bolt lies in which block, and the stations and elements that follow from it. Places on a bolt are distances from its head [m].
namespace polytope {

/// Part of a bolt within a block.
struct BoltPassage {
	int  block = -1; ///< number that the caller gives
	Real from = 0, to = 0;
};

/// What of the line from head to head + length·direction lies in the body; none where it does not meet it.
std::optional<BoltPassage> passageThrough(
        const PlacedShape& body, int block, const Vector3& head, const Vector3& direction, const Real& length);

/// The passages in their order from the head. Where two overlap, each gets half of what they share; what is shorter than `least`, or lies
/// within another one, is left out; neighbours of one block are one.
std::vector<BoltPassage> inOrder(std::vector<BoltPassage> passages, const Real& least);

struct BoltDesign {
	Real axialStiffness = 0;                                     ///< EA [N]
	Real yieldForce     = std::numeric_limits<Real>::infinity(); ///< [N]
	Real ruptureStrain  = std::numeric_limits<Real>::infinity();
	bool plate          = true;
	Real groutStiffness = 0;                                     ///< per metre [N/m²]; 0: no grout, an anchor at the end
	Real groutStrength  = std::numeric_limits<Real>::infinity(); ///< per metre [N/m]
	Real groutedFrom    = 0;                                     ///< [m]
	Real freeLength     = 0;                                     ///< of steel at a joint [m]
};

/// Where a bolt goes over from one block that holds it to the next.
struct BoltCrossing {
	std::size_t element = 0; ///< of the chain
	int         block1 = -1, block2 = -1;
	Real        from = 0, to = 0; ///< ends of what is free of grout between them
	bool        atJoint = false;  ///< of two neighbours, grouted on both sides: the bolt acts as a dowel there
};

struct BoltLayout {
	BoltChain                 chain;
	std::vector<BoltCrossing> crossings;
	Real                      firstStation = 0; ///< its place; element e lies between stations e and e + 1
};

/// The chain of a bolt with these passages; while all is elastic it is as stiff as steel in grout that is not divided into elements. One
/// block alone, or none, has no crossings.
BoltLayout layOut(const std::vector<BoltPassage>& passages, const BoltDesign& design, const Real& length);

} // namespace polytope
