// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact/ContactSizes.hpp"

#include <pkg/common/Sphere.hpp>

#include "host/PartsOfBodies.hpp"
#include "shape/Polytope.hpp"

namespace yade {
Real sizeOf(const Shape& shape)
{
	if (const auto* sphere = dynamic_cast<const Sphere*>(&shape)) return sphere->radius;
	const auto* polytope = dynamic_cast<const Polytope*>(&shape);
	if (!polytope || !polytope->convex()) return 0;
	const auto& convex = *polytope->convex();
	return convex.dimension() == 2 ? math::sqrt(convex.mass().volume / convex.thickness()) / 2 : math::cbrt(convex.mass().volume) / 2;
}

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
