// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "numbers/Real.hpp"

namespace polytope {

/// ∫ dV, ∫ x dV and ∫ x xᵀ dV of a solid, summed over its parts.
struct SolidMoments {
	Real    zeroth = 0;
	Vector3 first  = Vector3::Zero();
	Matrix3 second = Matrix3::Zero();

	void add(const Real& volume, const Vector3& moment, const Matrix3& tensor)
	{
		zeroth += volume;
		first += moment;
		second += tensor;
	}
};

} // namespace polytope
