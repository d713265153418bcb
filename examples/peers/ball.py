# SPDX-License-Identifier: GPL-2.0-or-later
"""After YADE's examples/polyhedra/ball.py: a polyhedron of 100 points on a sphere falls onto a wall."""

from yade import polytope

O.materials.append(RockJointMat(density=2600, normalStiffness=1e7, shearStiffness=1e7, frictionAngle=0.6))
O.bodies.append(wall(0, axis=2, sense=1))
O.bodies.append(polytope.randomGrain(0.05, vertices=100, center=(0, 0, 0.5)))
O.engines = polytope.engines(damping=0.5)
while O.time < 1:
	O.run(500, wait=True)
	print(f'unbalanced force {unbalancedForce():.5f}, position', O.bodies[1].state.pos)
