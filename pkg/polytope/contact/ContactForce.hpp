// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "host/PeriodOfPair.hpp"
#include "shape/ShapeFamily.hpp"

#include <core/Scene.hpp>
#include <pkg/dem/FrictPhys.hpp>
#include <pkg/dem/ScGeom.hpp>

/// Steps of a law functor that an extension writes: what it need not write anew. The normal force is its own.
namespace yade {

/// Shear force of a spring with Coulomb's friction: that of the last step, turned with the contact, less \c ks times the motion along it,
/// and at most the friction of the normal force. For geometries of which the functor computes what has moved, as all derived from
/// PolytopeGeom.
inline void followShear(ScGeom& geom, FrictPhys& phys)
{
	geom.rotate(phys.shearForce);
	phys.shearForce -= phys.ks * geom.shearIncrement();
	const Real most = phys.normalForce.norm() * phys.tangensOfFrictionAngle, shear = phys.shearForce.norm();
	if (shear > most) phys.shearForce *= most / shear;
}

/// Adds normal and shear force to both bodies, as their families say (ShapeFamily::addForce): to body 2, and against it to body 1.
inline void addContactForce(const ScGeom& geom, const NormShearPhys& phys, const Interaction& contact, Scene& scene)
{
	const Vector3r force = phys.normalForce + phys.shearForce;
	const Vector3r shift = placeByCells(scene, contact.cellDist);
	const Body &   body1 = *(*scene.bodies)[contact.getId1()], &body2 = *(*scene.bodies)[contact.getId2()];
	familyOf(*body1.shape).addForce(body1, geom.contactPoint, -force, scene.forces);
	familyOf(*body2.shape).addForce(body2, geom.contactPoint - shift, force, scene.forces);
}

} // namespace yade
