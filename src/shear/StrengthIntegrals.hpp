// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "shear/GaussLegendre.hpp"

/// The integrals (1) of ShearStrength.hpp, in three ways: at points, over the triangles between the edges and the centre of rotation, along
/// lines through a narrow outline. Several edges are summed at a time, with the machine's best instruction set. So all is in plain numbers:
/// functions of Eigen must not be compiled for one machine alone.
namespace polytope {

/// A strength τ, linear over an outline.
struct SpreadStrength {
	const Real* corners; ///< u, v of each, counter-clockwise, from −`shift`
	int         count;
	Real        shift[2];
	Real        atCentre, gradient[2]; ///< τ, at x = corner + shift
};

struct IntegralsAtPoints {
	Real all[9]; ///< ∫ τ d, its moment, and the six of how these change with the slip
};

/// At points in the triangles between the centre and the edges: the direction of slip changes little over the outline, so little that it is a
/// polynomial of low degree. `slip`: (s₁, s₂, φ) of the centre. `slope`: whether the last six are asked for.
IntegralsAtPoints strengthAtPoints(const SpreadStrength& of, const Real (&slip)[3], const GaussLegendre& rule, bool slope);

/// About the pole c, r = x − c.
struct IntegralsAboutPole {
	Real radial[2]; ///< ∫ τ r̂ dA
	Real distance;  ///< ∫ τ |r| dA
	Real tensor[3]; ///< ∫ τ r̂ r̂ᵀ/|r| dA
};

/// Over the triangles between the pole and the edges.
IntegralsAboutPole strengthOverTriangles(const SpreadStrength& of, const Real (&pole)[2]);

/// Along lines from end to end of a narrow outline, the parts of it between each edge and the long axis, those of `lines` across.
IntegralsAboutPole strengthAlongLines(const SpreadStrength& of, const Real (&axis)[2], const Real (&pole)[2], const GaussLegendre& lines);

} // namespace polytope
