// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact/ContactSizes.hpp"

#include "host/PartsOfBodies.hpp"
#include "shape/ShapeFamily.hpp"

namespace yade {

Real sizeOf(const Shape& shape) { return familyOf(shape).size(shape); }

Real sizeIfMoved(const Body& body, const Scene& scene) { return isMovedByForces(moverOf(body, scene)) ? sizeOf(*body.shape) : Real(0); }

ContactSizes contactSizes(const Body& body1, const Body& body2, const Scene& scene)
{
	ContactSizes sizes { sizeIfMoved(body1, scene), sizeIfMoved(body2, scene) };
	if (!(sizes.first > 0 || sizes.second > 0)) sizes = { sizeOf(*body1.shape), sizeOf(*body2.shape) };
	if (!(sizes.first > 0)) sizes.first = sizes.second;
	if (!(sizes.second > 0)) sizes.second = sizes.first;
	return sizes;
}

} // namespace yade
