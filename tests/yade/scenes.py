# SPDX-License-Identifier: GPL-2.0-or-later
"""Small scenes that several physics tests share."""

import time
from math import sqrt

from yade import (
	Bo1_Box_Aabb,
	Bo1_Facet_Aabb,
	Bo1_Polytope_Aabb,
	Bo1_Sphere_Aabb,
	Bo1_Wall_Aabb,
	ForceResetter,
	Ig2_Box_Polytope_PolytopeGeom,
	Ig2_Facet_Polytope_PolytopeGeom,
	Ig2_Polytope_Polytope_PolytopeGeom,
	Ig2_Sphere_Polytope_PolytopeGeom,
	Ig2_Wall_Polytope_PolytopeGeom,
	InsertionSortCollider,
	InteractionLoop,
	Ip2_RockJointMat_RockJointMat_RockJointPhys,
	Law2_PolytopeGeom_RockJointPhys_MohrCoulomb,
	NewtonIntegrator,
	O,
	PolytopeTimeStepper,
	Quaternion,
	RockJointMat,
	Vector3,
	polytope,
	utils,
)

gravity = 9.81
density = 2600.0

bounds = (Bo1_Polytope_Aabb, Bo1_Sphere_Aabb, Bo1_Wall_Aabb, Bo1_Facet_Aabb, Bo1_Box_Aabb)
"""Bound functors of all shapes that touch polytopes; withPolytopes: their contact functors; supports: one of each for a block to stand on,
with its functor."""
withPolytopes = (
	Ig2_Polytope_Polytope_PolytopeGeom,
	Ig2_Sphere_Polytope_PolytopeGeom,
	Ig2_Wall_Polytope_PolytopeGeom,
	Ig2_Facet_Polytope_PolytopeGeom,
	Ig2_Box_Polytope_PolytopeGeom,
)
supports = {
	'wall': (Ig2_Wall_Polytope_PolytopeGeom, lambda: utils.wall(0, 2)),
	'box': (Ig2_Box_Polytope_PolytopeGeom, lambda: utils.box((0, 0, -1), (5, 5, 1), fixed=True)),
	'facet': (Ig2_Facet_Polytope_PolytopeGeom, lambda: utils.facet([(-5, -5, 0), (5, -5, 0), (0, 5, 0)], fixed=True)),
	'sphere': (Ig2_Sphere_Polytope_PolytopeGeom, lambda: utils.sphere((0, 0, -5), 5, fixed=True)),
}


def joint(**attributes):
	"""Adds a RockJointMat with the test's usual values, which the arguments replace."""
	values = dict(density=density, normalStiffness=1e8, shearStiffness=1e8, frictionAngle=0.5)
	values.update(attributes)
	return O.materials.append(RockJointMat(**values))


def runInBackground(steps=10**9):
	"""O.run() without waiting for its end, once it has made a step: YADE's O.reset() and O.load() free a run that has not begun, and the
	thread that then begins it crashes."""
	before = O.iter
	O.run(steps)
	while O.running and O.iter == before:
		time.sleep(1e-3)


def loop(perArea=False, normalDamping=0.0, shearDamping=0.0, rockingDamping=0.0, gravity=(0, 0, 0), damping=0.0, ip2={}, ig2={}):
	"""Engines with the plug-in's law. Returns the NewtonIntegrator.

	verletDist=0: pairs are searched for in each step. With a Verlet distance YADE searches again when a body has moved by it, and does not
	count turning: a corner may be found inside another body some steps late, which is not what these tests are about.
	"""
	newton = NewtonIntegrator(gravity=gravity, damping=damping)
	O.engines = [
		ForceResetter(),
		InsertionSortCollider([Bo1_Polytope_Aabb()], verletDist=0),
		InteractionLoop(
			[Ig2_Polytope_Polytope_PolytopeGeom(**ig2)],
			[Ip2_RockJointMat_RockJointMat_RockJointPhys(stiffnessPerArea=perArea, **ip2)],
			[
				Law2_PolytopeGeom_RockJointPhys_MohrCoulomb(
					normalDamping=normalDamping, shearDamping=shearDamping, rockingDamping=rockingDamping
				)
			],
		),
		newton,
	]
	return newton


def contactOf(model, perArea):
	"""Attributes of geometry functors: *model* 'boon2012', or 'surface' for the one whose force is the gradient of an energy with such
	stiffnesses."""
	return {'contactModel': model if model == 'boon2012' else 'foundation' if perArea else 'spring'}


def stepper(**attributes):
	"""Puts a PolytopeTimeStepper at the end of the engines there are; returns it."""
	engine = PolytopeTimeStepper(**attributes)
	O.engines = O.engines + [engine]
	return engine


def stepUntil(seconds, watch=None, every=20):
	"""Steps to this time; *watch* is called every so many. (O.run(…, wait=True) sleeps some hundredths of a second each time.)"""
	while O.time < seconds:
		for _ in range(every):
			O.step()
		if watch:
			watch()


def law():
	return O.engines[2].lawDispatcher.functors[0]


def blockOnFloor(overlap=0.0, half=(0.5, 0.5, 0.5), turn=Quaternion.Identity, **block):
	"""A block on a large fixed one, pressed into it by *overlap*; both turned about the origin, the contact. Returns (floor, block)."""
	floor = polytope.cuboid(turn * Vector3(0, 0, -1), (5, 5, 1), turn, fixed=True)
	top = polytope.cuboid(turn * Vector3(0, 0, half[2] - overlap), half, turn, **block)
	O.bodies.append([floor, top])
	return floor, top


def kineticEnergy(state):
	"""Of a body's velocities, which YADE's integrator has half a step before its positions."""
	spin = state.ori.conjugate() * state.angVel
	return (state.mass * state.vel.squaredNorm() + sum(state.inertia[k] * spin[k] ** 2 for k in range(3))) / 2


def driven(body, velocity=(0, 0, 0), angularVelocity=(0, 0, 0)):
	"""Prescribes the body's motion from now on, whatever the forces."""
	body.state.blockedDOFs = 'xyzXYZ'
	body.state.vel = velocity
	body.state.angVel = angularVelocity


def contact(body1, body2):
	return O.interactions[body1.id, body2.id]


def period(mass, stiffness):
	"""1/ω of a mass on a spring."""
	return sqrt(mass / stiffness)


def rowInAPeriodicCell():
	"""Three blocks in a row that press on each other, the last one on the image of the first; after two steps."""
	O.periodic = True
	O.cell.setBox(3, 5, 5)
	O.bodies.append([polytope.cuboid((k + 0.5, 2, 2), (0.5001, 0.4, 0.5)) for k in range(3)])
	O.engines = polytope.engines(gravity=(0, 0, 0))
	O.step()
	O.step()
