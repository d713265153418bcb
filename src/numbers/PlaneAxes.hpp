// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "numbers/Real.hpp"
#include "numbers/Rotation.hpp"

namespace polytope {

/// The two axes of the plane normal to a unit vector, those of axesAround(), along which outlines and footprints of contacts are told.
struct PlaneAxes {
	Vector3 u, v;

	explicit PlaneAxes(const Vector3& normal)
	{
		const Real n[3] = { normal[0], normal[1], normal[2] };
		const auto axes = axesAround<Real, 3>(n);
		u               = Vector3(axes.m[0][0], axes.m[0][1], axes.m[0][2]);
		v               = Vector3(axes.m[1][0], axes.m[1][1], axes.m[1][2]);
	}

	/// A place of the plane, from its origin.
	Vector3 inSpace(const Vector2& place) const { return place[0] * u + place[1] * v; }

	/// A symmetric tensor of the plane, by its uu, uv and vv.
	Matrix3 inSpace(const Real (&tensor)[3]) const
	{
		return tensor[0] * u * u.transpose() + tensor[1] * (u * v.transpose() + v * u.transpose()) + tensor[2] * v * v.transpose();
	}
};

} // namespace polytope
