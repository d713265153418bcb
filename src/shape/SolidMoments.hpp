// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "numbers/Real.hpp"

namespace polytope {

/// ∫ dV, ∫ x dV and ∫ x xᵀ dV of a solid, or the same of a surface, over its area; summed over the parts.
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

	/// Adds the moments of the tetrahedron that the origin spans with a triangle: positive where the triangle is counter-clockwise seen from outside.
	void addTetrahedron(const Vector3& a, const Vector3& b, const Vector3& c)
	{
		const Real    volume = a.dot(b.cross(c)) / 6;
		const Vector3 sum    = a + b + c;
		add(volume, volume / 4 * sum,
		        volume / 20 * (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose()));
	}

	/// Adds the moments of a triangle: positive where it is counter-clockwise about the normal.
	void addTriangle(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& normal)
	{
		const Real    area = (b - a).cross(c - a).dot(normal) / 2;
		const Vector3 sum  = a + b + c;
		add(area, area / 3 * sum, area / 12 * (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose()));
	}
};

} // namespace polytope
