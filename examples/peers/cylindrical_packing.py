# SPDX-License-Identifier: GPL-2.0-or-later
"""After YADE's examples/PotentialBlocks/cylindrical_packing.py: regular polyhedra fall in a cylinder of plates. Here with icosahedra."""

import random

from yade import polytope

O.materials.append(RockJointMat(normalStiffness=1e8, shearStiffness=2e8 / 3, frictionAngle=atan(0.5), density=2000))
radius, height, size = 0.5, 1, 0.05
O.bodies.append(polytope.tube(radius, height, number=12, thickness=0.05, center=(0, 0, height / 2)))
O.bodies.append(polytope.cuboid((0, 0, -0.025), (0.6, 0.6, 0.025), fixed=True))
number = 200
solids = [polytope.regular(random.choice([4, 6, 8, 12, 20]), size, orientation=Quaternion(Vector3.Random(), 3)) for _ in range(number)]
placed = polytope.cloud((-radius, -radius, 0), (radius, radius, height), solids, seed=1)
O.bodies.append([body for body in placed if hypot(body.state.pos[0], body.state.pos[1]) < radius - size])
O.engines = polytope.engines(damping=0)
while O.time < 2:
	O.run(1000, wait=True)
polytope.picture('cylindrical_packing.png', fixed='wire')
