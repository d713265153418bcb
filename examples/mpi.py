# SPDX-License-Identifier: GPL-2.0-or-later
"""A heap of polyhedra falls into a box on several processes, and is measured as one scene: `./run mpi 3 examples/mpi.py [SECONDS [NUMBER]]`.

Rank 0 makes the scene and has the walls, the others compute an equal share of the solids each. On one process it runs as well.
"""

import random
import sys

from yade import *
from yade import O, Quaternion, polytope
from yade.polytope import mpi

seconds = float(sys.argv[1]) if len(sys.argv) > 1 else 0.4
number = int(sys.argv[2]) if len(sys.argv) > 2 else 96
report = min(seconds, 0.1)

if mpi.rank() == 0:
	random.seed(1)
	O.materials.append(RockJointMat(density=2600, normalStiffness=1e8, shearStiffness=1e8, frictionAngle=0.5))
	O.bodies.append(polytope.plates((-2, -0.8, 0), (2, 0.8, 3)))
	for k in range(number):
		place = (-1.65 + 0.66 * (k % 6) + random.uniform(-0.02, 0.02), -0.45 + 0.45 * (k // 6 % 3), 0.25 + 0.45 * (k // 18))
		O.bodies.append(polytope.regular((4, 6, 8, 12, 20)[k % 5], 0.2, place, Quaternion((1, k, 2), k)))
	O.engines = polytope.engines()
mpi.divide(axis=0)

while O.time < seconds:
	end = O.time + report
	while O.time < end:
		mpi.run(100, merged=False)
	fields = mpi.arrays()  # of all ranks; rank 0 gets them
	if mpi.rank() == 0:
		bodies = fields.bodies
		energy = (bodies.masses[:, None] * bodies.velocities**2).sum() / 2
		print(f'{O.time:.2f} s: mean height {bodies.positions[-number:, 2].mean():.4f} m, energy of translation {energy:.1f} J', flush=True)
	mpi.divide(axis=0)  # by where the solids are now
