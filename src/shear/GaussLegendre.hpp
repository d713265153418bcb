// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "shear/ShearTolerances.hpp"

#include <cmath>

namespace polytope {

/// Places and weights of Gauss-Legendre quadrature on 0 … 1.
struct GaussLegendre {
	int  points;
	Real place[5], weight[5];

	static const GaussLegendre& two()
	{
		static const Real          root = sqrt(Real(3)) / 6, half = Real(0.5);
		static const GaussLegendre rule { 2, { half - root, half + root }, { half, half } };
		return rule;
	}
	static const GaussLegendre& three()
	{
		static const Real          root = sqrt(Real(15)) / 10, half = Real(0.5);
		static const GaussLegendre rule { 3, { half - root, half, half + root }, { Real(5) / 18, Real(8) / 18, Real(5) / 18 } };
		return rule;
	}
	static const GaussLegendre& five()
	{
		static const Real inner = sqrt(5 - 2 * sqrt(Real(10) / 7)) / 6, outer = sqrt(5 + 2 * sqrt(Real(10) / 7)) / 6,
		                  half = Real(0.5), light = (322 - 13 * sqrt(Real(70))) / 1800, heavy = (322 + 13 * sqrt(Real(70))) / 1800;
		static const GaussLegendre rule { 5, { half - outer, half - inner, half, half + inner, half + outer },
			{ light, heavy, Real(64) / 225, heavy, light } };
		return rule;
	}
	/// The rule with the fewest points that is exact to rounding on a line whose distance from the centre of rotation is so many times its length.
	static const GaussLegendre& seenFrom(const Real& lengths)
	{
		return lengths > Real(tolerance::shearTwoPoints) ? two() : lengths > Real(tolerance::shearThreePoints) ? three() : five();
	}
};

} // namespace polytope
