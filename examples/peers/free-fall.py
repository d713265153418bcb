# SPDX-License-Identifier: GPL-2.0-or-later
"""After YADE's examples/polyhedra/free-fall.py: grains fall onto a plate and off it."""

import random

from yade import polytope

O.materials.append(RockJointMat(density=2600, normalStiffness=1e8, shearStiffness=1e8, frictionAngle=pi / 4))
O.bodies.append(polytope.cuboid((0.15, 0.15, -0.025), (0.15, 0.15, 0.025), fixed=True, color=(0.35, 0.35, 0.35)))
number = 150
gravel = [polytope.randomGrain(random.uniform(0.025, 0.05), seed=k) for k in range(number)]
O.bodies.append(polytope.cloud((0, 0, 0), (0.3, 0.3, 0.3), gravel, seed=4))
O.engines = polytope.engines(damping=0.3)
while O.time < 0.5:
	O.run(500, wait=True)
	print(f'step {O.iter}, time step {O.dt:.5e}, unbalanced force {unbalancedForce():.5f}')
polytope.picture('free-fall.png')
