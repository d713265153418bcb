# SPDX-License-Identifier: GPL-2.0-or-later
"""A grain is pressed between two plates and breaks into smaller and stronger ones; prints the forces at which, draws it.

./run python examples/crushedGrain.py
"""

from math import radians

from yade import O, RockJointMat, polytope

O.materials.append(RockJointMat(density=2600, normalStiffness=1e12, shearStiffness=5e11, frictionAngle=radians(35)))
O.bodies.append(polytope.cuboid((0, 0, -0.004), (0.02, 0.02, 0.004), fixed=True, color=(0.8, 0.8, 0.78)))
grain = polytope.regular(12, 0.015)
low = min((grain.state.ori * corner)[2] for corner in grain.shape.vertices)
grain.state.pos = (0, 0, -low)
O.bodies.append(grain)
plate = O.bodies.append(polytope.cuboid((0, 0, -2 * low + 0.004), (0.02, 0.02, 0.004), fixed=True))
O.bodies[plate].state.vel = (0, 0, -0.02)
volume = grain.shape.volume
forces = []

O.engines = polytope.engines()
while len(forces) < 3 and O.time < 0.1:
	for _ in range(20):
		O.step()
	force = O.forces.f(plate)[2]
	# octahedral shear stress against a strength that falls with size; splits along the load
	forces += [force] * len(polytope.breakGrains(octahedral=1e6, volume=volume, modulus=5))

pieces = [body for body in O.bodies if body is not None and body.dynamic]
print(f'{len(pieces)} pieces; broken at', ', '.join(f'{force:.0f} N' for force in forces))
print(f'volume of the pieces over that of the grain: {sum(piece.shape.volume for piece in pieces) / volume:.12f}')
for piece, color in zip(pieces, ((0.85, 0.45, 0.3), (0.35, 0.6, 0.75), (0.95, 0.8, 0.45), (0.5, 0.7, 0.45)), strict=False):
	piece.shape.color = color
polytope.picture('output/crushedGrain.png', view=(-0.5, -1, 0.3))
