# SPDX-License-Identifier: GPL-2.0-or-later
"""Scenes of clumps for mpiScenes.py."""

import random

from mpiSceneState import folder, master, material, settling, solids, state
from yade import O, Quaternion, Vector3, polytope
from yade.polytope import mpi

partsOfClumps = (
	((20, 0.13, (-0.07, 0, 0)), (12, 0.13, (0.07, 0, 0))),
	((8, 0.13, (0, 0, 0)), (20, 0.11, (0.17, 0, 0)), (12, 0.11, (0, 0.15, 0))),
	((12, 0.11, (0.1, 0, 0)), (8, 0.12, (-0.1, 0, 0)), (20, 0.11, (0, 0.12, 0)), (12, 0.11, (0, 0, 0.12))),
)
"""Faces, radii and centres of regular polyhedra, which overlap."""


def clumpOf(kind, place, turn, **body):
	parts = [
		polytope.regular(faces, size, Vector3(place) + turn * Vector3(offset), turn, **body) for faces, size, offset in partsOfClumps[kind]
	]
	return polytope.clump(parts)[0]


def startClumps():
	"""A heap at rest in a box: clumps of two to four parts, single bodies between them, and two fixed clumps in the middle, where ranks meet."""
	O.reset()
	random.seed(2)
	material()
	O.bodies.append(polytope.plates((-1, -0.5, 0), (1, 0.5, 2)))
	for k in range(2):
		clumpOf(2 * k, (0.2 * k - 0.1, 0.4 * k - 0.2, 0.26), Quaternion((1, k, 2), 1), fixed=True)
	for k in range(solids):
		place = (-0.75 + 0.5 * (k % 4) + random.uniform(-0.02, 0.02), -0.24 + 0.48 * (k // 4 % 2), 0.75 + 0.45 * (k // 8))
		turn = Quaternion((1, k, 2), k)
		if k % 4 == k // 8:
			O.bodies.append(polytope.regular(12, 0.15, place, turn))
		else:
			clumpOf(k % 3, place, turn)
	O.engines = polytope.engines()
	O.run(6 * settling, wait=True)
	for contact in list(O.interactions):
		if contact.isReal and contact.geom.penetrationDepth < 0:  # an open joint that two ranks forget (docs/mpi.md)
			O.interactions.erase(contact.id1, contact.id2)
	O.save(f'{folder}/startClumps.yade', quiet=True)


def clumpedSliding():
	"""Clumps that run after each other over a fixed one, and from one rank's part to the other's."""
	mpi.merge()
	O.reset()
	if master:
		material()
		polytope.clump([polytope.cuboid((0, 0, -0.5), (6, 1, 0.5), fixed=True), polytope.cuboid((5.5, 0, 0.5), (0.5, 1, 0.7), fixed=True)])
		for k in range(8):
			number = clumpOf(k % 3, (0.5 * k - 3, 0, 0.13), Quaternion((0, 0, 1), 0.4 * k))
			O.bodies[number].state.vel = (4.0 - 0.5 * k, 0.1, 0)
		O.engines = polytope.engines(timeStepper=False)
		O.dt = 2e-4
	mpi.divide()
	mpi.run(600)
	return state()


def carried():
	"""Blocks and clumps on a fixed clump that rises and moves sideways, and a plate that pushes the first of them."""
	mpi.merge()
	O.reset()
	if master:
		material()
		floor, _ = polytope.clump(
			[polytope.cuboid((0, 0, -0.5), (3, 1, 0.5), fixed=True), polytope.cuboid((2.5, 0, 0.5), (0.5, 1, 0.7), fixed=True)]
		)
		O.bodies[floor].state.vel = (0.3, 0, 0.1)
		O.bodies.append(polytope.cuboid((-2, 0, 0.3), (0.1, 0.5, 0.2), fixed=True))
		O.bodies[-1].state.vel = (1, 0, 0)
		for k in range(3):
			O.bodies.append(polytope.cuboid((1.2 * k - 1.65, 0, 0.2), (0.2, 0.2, 0.2)))
			clumpOf(k, (1.2 * k - 1, 0, 0.14), Quaternion((0, 0, 1), k))
		O.engines = polytope.engines(timeStepper=False)
		O.dt = 2e-4
	mpi.divide()
	mpi.run(500)
	return state()
