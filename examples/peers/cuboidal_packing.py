# SPDX-License-Identifier: GPL-2.0-or-later
"""After YADE's examples/PotentialBlocks/cuboidal_packing.py: 200 regular polyhedra fall in a box. Here with icosahedra."""

import random

from yade import polytope

O.materials.append(RockJointMat(normalStiffness=1e8, shearStiffness=2e8 / 3, frictionAngle=atan(0.5), density=2000))
lower, upper = (-1, -1, -1), (1, 1, 1)
O.bodies.append(polytope.plates(lower, upper))
number = 200
solids = [polytope.regular(random.choice([4, 6, 8, 12, 20]), 0.05, orientation=Quaternion(Vector3.Random(), 3)) for _ in range(number)]
O.bodies.append(polytope.cloud(lower, upper, solids, seed=1))
O.engines = polytope.engines(damping=0)
while O.time < 3:
	O.run(1000, wait=True)
polytope.picture('cuboidal_packing.png', fixed='wire')
