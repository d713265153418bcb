# SPDX-License-Identifier: GPL-2.0-or-later
"""After YADE's examples/polyhedra/splitter.py: three equal grains of different strength are crushed between walls."""

from yade import polytope

O.materials.append(RockJointMat(density=1000, normalStiffness=1e10, shearStiffness=1e10, frictionAngle=0.5))
d = 0.05
grains = O.bodies.append([polytope.randomGrain(d, seed=1, center=(2 * k * d, 0, 0)) for k in range(3)])
for side in (1, -1):
	O.bodies.append(wall(0.035 * side, axis=1, sense=-side))
	O.bodies[-1].state.vel = (0, -0.5 * side, 0)
volume = O.bodies[0].shape.volume
pieces = {strength: [grain] for strength, grain in zip((1e6, 2e6, 4e6), grains, strict=True)}
O.engines = polytope.engines(gravity=(0, 0, 0))
while O.time < 0.03:
	for _ in range(100):
		O.step()
	for strength, ids in pieces.items():
		for k, parts in polytope.breakGrains(vonMises=strength, volume=volume, modulus=3, ids=ids, smallest=0.002).items():
			ids.remove(k)
			ids += parts
print({strength: len(ids) for strength, ids in pieces.items()}, 'pieces')
polytope.picture('splitter.png')
