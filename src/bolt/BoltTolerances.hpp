// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Thresholds of bolts: meaning, scale, reason.
namespace polytope::tolerance {

/// Stiffness that grout keeps where it slips, as a part of its elastic stiffness: with it the place of a bolt that slides as a whole stays
/// unique. At a slip of a thousand times that at which slipping begins, it adds a millionth to the bond's strength.
constexpr double keptStiffness = 1e-9;

/// × the largest force in a bolt: residual of a node that counts as balanced. A thousand times what rounding of the displacements leaves.
constexpr double boltBalance = 1e-10;

/// Newton steps for the slips of a bolt: a step of a run takes one to three, a sudden slip of all of a bolt's grout some ten.
constexpr int mostNewtonSteps = 100;

/// Cuts of one such step: where grout slips and steel yields it may be a billion times too long; first it is cut to this part, until a part
/// is found that is too short, then the difference is halved.
constexpr double firstCut = 0.02;
constexpr int    mostCuts = 40;

/// Element length × √(grout stiffness/axial stiffness of the steel), below which lie the elements of a grouted bolt. While grout is elastic
/// they are exact at any length; slip begins all at once over one of them.
constexpr double elementOverTransfer = 0.2;

/// Element length × √(grout stiffness/axial stiffness of the steel) of the longest elements, where there cannot be enough of them: their
/// grout is then a ten-thousandth from rigid, and sinh stays finite.
constexpr double longestElement = 10;

/// Elements of the grouted part in one block: at least, so that slip can spread, and at most, for the time that a step takes.
constexpr int leastElements = 10, mostElements = 400;

/// Largest part of a bolt's length in a block that the free length at a joint takes at each end, so that the rest is grouted.
constexpr double mostOfPassage = 0.25;

/// × the bolt's length: shorter passages through a block are rounding where the bolt runs along a face or an edge. An anchor may lie so far
/// outside the last block.
constexpr double leastPassage = 1e-6;

/// Free length of steel at a joint over the bar's diameter, by default: two diameters on each side, over which grout is crushed (St. John &
/// Van Dillen 1983 give one to two).
constexpr double freeLengthOverDiameter = 4;

} // namespace polytope::tolerance
