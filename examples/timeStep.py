# SPDX-License-Identifier: GPL-2.0-or-later
"""Effect of the fraction of the safe time step: scenes that come to rest under gravity with PolytopeTimeStepper; see docs/time-step.md.

	./run python examples/timeStep.py [SCENE …] [boon2012|surface] [perContact|perArea] [FRACTION …]

Scenes: heap (60 cubes), largeHeap (200), column (ten courses of masonry), slope (of jointed rock), block (rocks on its base until it stands). A row
each, by contactModel and by what stiffnesses are per: timestepSafetyCoefficient, steps and the machine's seconds for the simulated time, the unbalanced force ratio at the end, the fastest
body and the mean height then, the last step, and what limited most steps. The last fraction may be sqrt, for O.dt = 0.2 √(m/k) without the
engine, m the smallest mass, k the material's stiffness (per area: times a square metre).
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


def engines(model, perArea, damping=0.2, rockingDamping=0):
	O.engines = [
		ForceResetter(),
		PolytopeCollider([Bo1_Polytope_Aabb()], verletDist=0.02),
		InteractionLoop(
			[Ig2_Polytope_Polytope_PolytopeGeom(contactModel=model)],
			[Ip2_RockJointMat_RockJointMat_RockJointPhys(stiffnessPerArea=perArea)],
			[Law2_PolytopeGeom_RockJointPhys_MohrCoulomb(normalDamping=0.2, shearDamping=0.2, rockingDamping=rockingDamping)],
		),
		NewtonIntegrator(gravity=(0, 0, -9.81), damping=damping),
	]


def heap(model, perArea, rows=4, layers=3, seconds=12):
	"""60 cubes of 1 m fall into a heap on a floor. Returns the simulated time."""
	O.materials.append(RockJointMat(density=density, normalStiffness=1e8, shearStiffness=1e8, frictionAngle=0.6))
	engines(model, perArea, damping=0.4, rockingDamping=0.3)
	O.bodies.append(polytope.cuboid((0, 0, -1), (30, 30, 1), fixed=True))
	random = np.random.default_rng(1)
	for k in range(5 * rows * layers):
		place = 1.8 * np.array((k % 5 - 2, k // 5 % rows - rows / 2, k // (5 * rows) + 0.6)) + random.uniform(-0.1, 0.1, 3)
		axis = Vector3(*random.normal(size=3)).normalized()
		O.bodies.append(polytope.cuboid(tuple(place), (0.5, 0.5, 0.5), Quaternion(axis, random.uniform(0, 3))))
	return seconds


def largeHeap(model, perArea):
	"""200 of them."""
	return heap(model, perArea, rows=10, layers=4, seconds=18)


def column(model, perArea):
	"""Ten courses of masonry, each of 0.24 m²."""
	stiffness = 1e10 if perArea else 2.4e9
	O.materials.append(RockJointMat(density=density, normalStiffness=stiffness, shearStiffness=stiffness / 2, frictionAngle=0.6))
	engines(model, perArea)
	O.bodies.append(polytope.cuboid((0, 0, -0.5), (2, 2, 0.5), fixed=True))
	for k in range(10):
		O.bodies.append(polytope.cuboid((0.02 * (-1) ** k, 0, 0.1 + 0.2 * k), (0.3, 0.2, 0.1)))
	return 1


def slope(model, perArea):
	"""A small slope of jointed rock on bedding of 30°, friction 40°."""
	O.materials.append(RockJointMat(density=density, normalStiffness=2e8, shearStiffness=1e8, frictionAngle=math.radians(40)))
	engines(model, perArea)
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


def block(model, perArea):
	"""A slender block, tilted by 5°, rocks on its base until it stands."""
	O.materials.append(RockJointMat(density=density, normalStiffness=1e9, shearStiffness=5e8, frictionAngle=0.8))
	engines(model, perArea, damping=0, rockingDamping=0.3)
	O.bodies.append(polytope.cuboid((0, 0, -0.5), (3, 3, 0.5), fixed=True))
	tilt, half = math.radians(5), (0.25, 0.25, 0.75)
	height = half[0] * math.sin(tilt) + half[2] * math.cos(tilt)
	O.bodies.append(polytope.cuboid((0, 0, height), half, Quaternion((0, 1, 0), tilt)))
	return 10


scenes = {'heap': heap, 'largeHeap': largeHeap, 'column': column, 'slope': slope, 'block': block}
models = ('surface', 'boon2012')
rules = {'perContact': False, 'perArea': True}
patience = 600
"""Longest run [s of the machine]."""


def settle(name, model, rule, fraction):
	"""One row; *fraction* 'sqrt': no engine, 0.2 √(m/k)."""
	O.reset()
	seconds = scenes[name](model, rules[rule])
	engine = PolytopeTimeStepper()
	if fraction == 'sqrt':
		O.dt = 0.2 * math.sqrt(
			min(float(b.state.mass) for b in O.bodies if b.dynamic and b.state.mass > 0) / O.materials[0].normalStiffness
		)
	else:
		engine.timestepSafetyCoefficient = fraction
		O.engines = O.engines + [engine]
	began = time.perf_counter()
	limits = {}
	while O.time < seconds and time.perf_counter() - began < patience:
		for _ in range(100):  # O.run(100, wait=True) sleeps some hundredths of a second
			O.step()
		limits[engine.limitedBy] = limits.get(engine.limitedBy, 0) + 1
	took = time.perf_counter() - began
	moving = [body.state for body in O.bodies if body.dynamic]
	fastest = max(float(state.vel.norm()) for state in moving)
	height = float(np.mean([float(state.pos[2]) for state in moving]))
	label = fraction if fraction == 'sqrt' else f'{fraction:g}'
	stopped = '' if O.time >= seconds else f', stopped at {O.time:.2f} s'
	print(
		f'{name:9} {model:12} {rule:10} {label:>4} {O.iter:8} steps {took:6.1f} s  unbalanced {float(utils.unbalancedForce()):7.1e}  '
		f'fastest {fastest:7.1e} m/s  mean height {height:.3f} m  dt {float(O.dt):.2e} s  {max(limits, key=limits.get)}{stopped}',
		flush=True,
	)


def chosen(words, all):
	return [word for word in words if word in all] or list(all)


if __name__ == '__main__':
	words = sys.argv[1:]
	fractions = [word if word == 'sqrt' else float(word) for word in words if word not in {*scenes, *models, *rules}]
	for name in chosen(words, scenes):
		for model in chosen(words, models):
			for rule in chosen(words, rules):
				for fraction in fractions or [0.2, 0.4, 0.6, 0.8, 1, 'sqrt']:
					settle(name, model, rule, fraction)
