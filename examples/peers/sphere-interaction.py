# SPDX-License-Identifier: GPL-2.0-or-later
"""After YADE's examples/polyhedra/sphere-interaction.py: three spheres fly against a fixed grain."""

import random

from yade import polytope

O.materials.append(FrictMat(young=1e9, poisson=0.2))
grain = O.bodies.append(polytope.randomGrain(2, elongation=2 / 3, flatness=0.5, fixed=True))
spheres = O.bodies.append([sphere(center, 0.5) for center in ((2, 2, 2), (-3, 0, 0), (0, -3, 0))])
for k in spheres:
	O.bodies[k].state.vel = -10 * (O.bodies[k].state.pos + Vector3(random.random(), random.random(), random.random()))
O.engines = polytope.engines(gravity=(0, 0, 0))
while O.time < 0.2:
	O.run(100, wait=True)
print('speeds now:', [O.bodies[k].state.vel for k in spheres])
