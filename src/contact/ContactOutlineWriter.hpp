// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "contact/ContactFrame.hpp"
#include "contact/ContactTypes.hpp"

/// Takes the corners of a contact's outline (src/shear/ContactOutline.hpp) from the planes' frame to the axes around its normal in the world.
namespace polytope {

template <class R> class ContactOutlineWriter {
public:
	/// \param normal in world axes
	/// \param point  from which the corners are seen, in the planes' frame
	POLYTOPE_INLINE ContactOutlineWriter(const ContactFrame<R, 3>& f, const Vector3& normal, const R* point, R* numbers)
	        : point_ { point[0], point[1], point[2] }, numbers_(numbers)
	{
		const R              n[3] = { normal[0], normal[1], normal[2] };
		const Rotation<R, 3> axes = axesAround<R, 3>(n);
		for (int k = 0; k < 2; ++k)
			rotateBack<R, 3>(f.world, axes.m[k], axis_[k]);
	}

	POLYTOPE_INLINE void add(const R* p)
	{
		const R from[3]          = { p[0] - point_[0], p[1] - point_[1], p[2] - point_[2] };
		numbers_[2 * count_]     = dot<R, 3>(axis_[0], from);
		numbers_[2 * count_ + 1] = dot<R, 3>(axis_[1], from);
		++count_;
	}

	POLYTOPE_INLINE void publish(ContactResult& out) const { out.outlineCount = count_; }

private:
	R   point_[3], axis_[2][3];
	R*  numbers_;
	int count_ = 0;
};

} // namespace polytope
