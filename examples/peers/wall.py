# SPDX-License-Identifier: GPL-2.0-or-later
"""After YADE's examples/polyhedra/wall.py: a ball is shot through a wall of cubes, once that stands."""

from yade import polytope

O.materials.append(RockJointMat(density=1000, normalStiffness=1e8, shearStiffness=1e8, frictionAngle=0.7))
size, number = 0.1, 10
for i in range(number):
	for j in range(number):
		O.bodies.append(polytope.cuboid((0, (i - number / 2 + 0.5) * size, (j + 0.5) * size), (size / 2, size / 2, size / 2)))
O.bodies.append(wall(0, axis=2, sense=1))
O.engines = polytope.engines(damping=0.5)
while O.iter < 200 or unbalancedForce() > 0.01:
	O.run(100, wait=True)
O.bodies.append(polytope.randomGrain(2 * size, vertices=40, center=(-2.5 * size, 0, 7 * size), velocity=(15, 0, 0), color=(0, 0, 0.9)))
shot = O.time
while O.time < shot + 0.3:
	O.run(100, wait=True)
polytope.picture('wall.png', view=(-1.5, -1, 0.5))
