# SPDX-License-Identifier: GPL-2.0-or-later
"""Scenes that polytope.requirements checks in tests."""

from yade import (
	Bo1_Polytope_Aabb,
	ForceResetter,
	Ig2_Polytope_Polytope_PolytopeGeom,
	InteractionLoop,
	Ip2_RockJointMat_RockJointMat_RockJointPhys,
	Law2_PolytopeGeom_RockJointPhys_MohrCoulomb,
	NewtonIntegrator,
	O,
	PolytopeCollider,
	RockJointMat,
	polytope,
)


def row(number=3, steps=50, spin=0.01, cornerRadius=0.02, material=None, **functor):
	"""Blocks on a floor, at rest but for the first steps; without a fault unless the arguments add one."""
	law, newton = {'normalDamping': 0.3}, {'damping': 0.2}
	O.reset()
	O.materials.append(RockJointMat(**{'normalStiffness': 1e7, 'shearStiffness': 1e7, 'frictionAngle': 0.5, 'density': 1000, **(material or {})}))
	O.bodies.append(polytope.cuboid((0, 0, -0.5), (5, 5, 0.5), fixed=True, cornerRadius=cornerRadius))
	for k in range(number):
		ids = O.bodies.append(polytope.cuboid((1.5 * k, 0, 0.4995), (0.5, 0.4, 0.5), cornerRadius=cornerRadius))
		O.bodies[ids].state.angVel = (spin, 0, 0)
	O.engines = [
		ForceResetter(),
		PolytopeCollider([Bo1_Polytope_Aabb()], verletDist=0.04),
		InteractionLoop(
			[Ig2_Polytope_Polytope_PolytopeGeom(**functor)],
			[Ip2_RockJointMat_RockJointMat_RockJointPhys(stiffnessPerArea=False)],
			[Law2_PolytopeGeom_RockJointPhys_MohrCoulomb(**law)],
		),
		NewtonIntegrator(gravity=(0, 0, -10), **newton),
	]
	O.dt = 5e-4
	for _ in range(steps):
		O.step()


def advised(measure=False):
	return {finding.what for finding in polytope.requirements(O, measure=measure).advice}
