# SPDX-License-Identifier: GPL-2.0-or-later
"""A grain is pressed between two plates and breaks into smaller and stronger ones; prints the forces at which, draws it.

	./run python examples/crushedGrain.py
"""
from math import radians

import numpy as np
from yade import O, RockJointMat, polytope

O.materials.append(RockJointMat(density=2600, normalStiffness=1e12, shearStiffness=5e11, frictionAngle=radians(35)))
O.bodies.append(polytope.cuboid((0, 0, -0.01), (0.05, 0.05, 0.01), fixed=True))
grain = polytope.regular(12, 0.015)
low = min((grain.state.ori * corner)[2] for corner in grain.shape.vertices)
grain.state.pos = (0, 0, -low)
O.bodies.append(grain)
plate = O.bodies.append(polytope.cuboid((0, 0, -2 * low + 0.01), (0.05, 0.05, 0.01), fixed=True))
O.bodies[plate].state.vel = (0, 0, -0.02)
volume = grain.shape.volume
forces = []


def breakGrains(strength=1e6, m=5):
	"""Splits grains whose octahedral shear stress exceeds a strength that falls with size, along the load."""
	force = O.forces.f(plate)[2]
	for k, stress in polytope.bodyStress().items():
		values, axes = np.linalg.eigh((stress + stress.T) / 2)  # ascending; tension positive
		q = np.sqrt(((values - np.roll(values, 1)) ** 2).sum()) / 3
		if q > strength * (volume / O.bodies[k].shape.volume) ** (1 / m):
			forces.append(force)
			polytope.split(k, normal=axes[:, 2])


O.engines = polytope.engines()
while len(forces) < 3 and O.time < 0.1:
	for _ in range(20):
		O.step()
	breakGrains()

pieces = [body for body in O.bodies if body is not None and body.dynamic]
print(f'{len(pieces)} pieces; broken at', ', '.join(f'{force:.0f} N' for force in forces))
print(f'volume of the pieces over that of the grain: {sum(piece.shape.volume for piece in pieces) / volume:.12f}')
polytope.picture('crushedGrain.png')
