// SPDX-License-Identifier: GPL-2.0-or-later
#include "shape/FamilyBound.hpp"

#include "shape/ShapeFamily.hpp"

#include <core/Aabb.hpp>
#include <core/Scene.hpp>

namespace yade {

POLYTOPE_CLASSES((PolytopeFamilyBound));

void PolytopeFamilyBound::go(const shared_ptr<Shape>& shape, shared_ptr<Bound>& bound, const Se3r& se3, const Body*)
{
	if (!bound) bound = shared_ptr<Bound>(new Aabb);
	// the collider of a periodic cell works in unsheared coordinates
	const Matrix3r unshear = scene->isPeriodic ? scene->cell->getUnshearTrsf() : Matrix3r(Matrix3r::Identity());
	const Vector3r centre  = unshear * se3.position;
	const Vector3r half    = familyOf(*shape).boundingRadius(*shape) * unshear.rowwise().norm();
	bound->min             = centre - half;
	bound->max             = centre + half;
}

} // namespace yade
