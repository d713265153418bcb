# SPDX-License-Identifier: GPL-2.0-or-later
"""A cube of bonded Voronoi cells falls onto a floor and breaks; prints what is left of its bonds, draws it.

./run python examples/bondedCube.py
"""

from math import radians

from yade import O, RockJointMat, Vector3, polytope

O.materials.append(RockJointMat(density=2600, normalStiffness=1e10, shearStiffness=5e9, frictionAngle=radians(35)))
floor = O.bodies.append(polytope.cuboid((0.5, 0.5, -0.1), (1.5, 1.5, 0.1), fixed=True, color=(0.8, 0.8, 0.78)))
cells = O.bodies.append([polytope.fromHalfSpaces(*block) for block in polytope.voronoi(((0, 0, 0.01), (1, 1, 1.01)), 40, seed=1).blocks])
for number in cells:
	O.bodies[number].state.vel = Vector3(0, 0, -6)

O.engines = polytope.engines()
made = polytope.bond(ids=cells, tensileStrength=2e6, cohesion=4e6)
polytope.run(until=0.15)

failures = [bond.failure for bond in polytope.bonds().bonds]
print(
	made,
	'bonds:',
	polytope.bonds().intactCount,
	'intact,',
	failures.count('tension'),
	'failed in tension,',
	failures.count('shear'),
	'in shear',
)
polytope.picture('output/bondedCube.png')
