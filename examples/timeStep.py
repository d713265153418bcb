# SPDX-License-Identifier: GPL-2.0-or-later
"""What a fraction of the safe time step does: heaps, a column and a jointed slope that come to rest under gravity; see docs/time-step.md.

	./run python examples/timeStep.py [heap|column|slope] [fraction …]

Each row: scene, contact model, timestepSafetyCoefficient (or 0.2 √(m/k), with which no engine sets the step), steps and seconds of the
machine for the simulated time, the unbalanced force ratio and the fastest body then.
"""

import math
import sys
import time

import numpy as np
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
	PolytopeTimeStepper,
	Quaternion,
	RockJointMat,
	Vector3,
	polytope,
	utils,
)

density = 2600


def engines(model, perArea, damping=0.2):
	O.engines = [
		ForceResetter(),
		PolytopeCollider([Bo1_Polytope_Aabb()], verletDist=0.02),
		InteractionLoop(
			[Ig2_Polytope_Polytope_PolytopeGeom(contactModel=model)],
			[Ip2_RockJointMat_RockJointMat_RockJointPhys(stiffnessPerArea=perArea)],
			[Law2_PolytopeGeom_RockJointPhys_MohrCoulomb(normalDamping=0.2, shearDamping=0.2)],
		),
		NewtonIntegrator(gravity=(0, 0, -9.81), damping=damping),
	]


def heap(model):
	"""200 cubes of 1 m fall into a heap on a floor; stiffness per contact. Returns the simulated time."""
	O.materials.append(RockJointMat(density=density, normalStiffness=1e8, shearStiffness=1e8, frictionAngle=0.6))
	engines(model, perArea=False, damping=0.4)
	O.bodies.append(polytope.cuboid((0, 0, -1), (30, 30, 1), fixed=True))
	random = np.random.default_rng(1)
	for k in range(200):
		place = 1.8 * np.array((k % 10 - 4.5, k // 10 % 5 - 2, k // 50 + 0.6)) + random.uniform(-0.1, 0.1, 3)
		axis = Vector3(*random.normal(size=3)).normalized()
		O.bodies.append(polytope.cuboid(tuple(place), (0.5, 0.5, 0.5), Quaternion(axis, random.uniform(0, 3))))
	return 6


def column(model):
	"""Ten courses of masonry; stiffness per area."""
	O.materials.append(RockJointMat(density=density, normalStiffness=1e10, shearStiffness=5e9, frictionAngle=0.6))
	engines(model, perArea=True)
	O.bodies.append(polytope.cuboid((0, 0, -0.5), (2, 2, 0.5), fixed=True))
	for k in range(10):
		O.bodies.append(polytope.cuboid((0.02 * (-1) ** k, 0, 0.1 + 0.2 * k), (0.3, 0.2, 0.1)))
	return 1


def slope(model):
	"""A small slope of jointed rock on bedding of 30°, friction 40°; stiffness per area."""
	O.materials.append(RockJointMat(density=density, normalStiffness=2e8, shearStiffness=1e8, frictionAngle=math.radians(40)))
	engines(model, perArea=True)
	face = math.radians(60)
	west, north, east = 3 * math.pi / 2, 0, math.pi / 2
	rock = polytope.jointedRock(
		[(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1), (-math.sin(face), 0, math.cos(face))],
		[12, 1, 4, 0, 7, 1, 0],
		[
			polytope.JointSet(math.radians(30), west, spacing=1.5),
			polytope.JointSet(math.radians(80), east, spacing=2),
			polytope.JointSet(math.radians(85), north, spacing=2),
		],
		smallest=0.2,
		seed=3,
	)
	for planes in rock.blocks:
		body = polytope.fromHalfSpaces(*planes)
		corners = np.array([body.state.pos + body.state.ori * v for v in body.shape.vertices], float)
		if corners[:, 2].min() < 1e-6 or corners[:, 0].max() > 12 - 1e-6:
			body.state.blockedDOFs = 'xyzXYZ'
		O.bodies.append(body)
	return 3


scenes = {'heap': heap, 'column': column, 'slope': slope}


def settle(name, model, fraction):
	"""One row; *fraction* None: 0.2 √(m/k) of the smallest body and the material's stiffness times 1 N/m or a metre squared."""
	O.reset()
	seconds = scenes[name](model)
	engine = PolytopeTimeStepper()
	if fraction:
		engine.timestepSafetyCoefficient = fraction
		O.engines = O.engines + [engine]
	else:
		O.dt = 0.2 * math.sqrt(min(float(b.state.mass) for b in O.bodies if b.dynamic and b.state.mass > 0) / O.materials[0].normalStiffness)
	began = time.perf_counter()
	limits = {}
	while O.time < seconds:
		O.run(100, wait=True)
		limits[engine.limitedBy] = limits.get(engine.limitedBy, 0) + 1
		if time.perf_counter() - began > 600:
			break
	took = time.perf_counter() - began
	moving = [body.state for body in O.bodies if body.dynamic]
	fastest = max(float(state.vel.norm()) for state in moving)
	height = float(np.mean([float(state.pos[2]) for state in moving]))
	label = f'{fraction:g}' if fraction else '0.2 √(m/k)'
	print(f'{name:7} {model:13} {label:>10} {O.iter:8} steps {took:7.1f} s  unbalanced {float(utils.unbalancedForce()):8.1e}  fastest {fastest:8.1e} m/s  '
	      f'mean height {height:.3f} m  dt {float(O.dt):.2e} s  {max(limits, key=limits.get)} {"" if O.time >= seconds else f"stopped at {O.time:.2f} s"}', flush=True)


if __name__ == '__main__':
	names = [word for word in sys.argv[1:] if word in scenes] or list(scenes)
	fractions = [float(word) for word in sys.argv[1:] if word not in scenes] or [None, 0.2, 0.3, 0.4, 0.6, 0.8, 1]
	for name in names:
		for model in ('paper', 'conservative'):
			for fraction in fractions:
				settle(name, model, fraction)
