# SPDX-License-Identifier: GPL-2.0-or-later
"""A tunnel of a horseshoe's outline through jointed rock 100 m below ground: it is cut out of the stressed blocks, and their stress fades from its outline.

Prints what was cut and how far the outline has moved; writes output/tunnel.png, displacements in colour.

	./run python examples/tunnel.py
"""

from math import cos, pi, radians, sin

import numpy as np
from yade import O, RockJointMat, polytope

depth, density, size, thick = 100, 2600, 8, 0.75
O.materials.append(RockJointMat(density=density, normalStiffness=2e10, shearStiffness=1e10, frictionAngle=radians(38), cohesion=2e5))
sides = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
east, west = radians(90), radians(270)
joints = [polytope.JointSet(radians(60), east, 2.3), polytope.JointSet(radians(25), west, 2.1)]
polytope.jointedRock(sides, [size, size, thick, thick, size, size], joints, seed=2).append()
for centre, half in (
	((size + 1, 0, 0), (1, thick, size)),
	((0, thick + 1, 0), (size + 2, 1, size)),
	((0, 0, size + 1), (size + 2, thick + 2, 1)),
):
	for side in (-1, 1):  # plates all around
		O.bodies.append(polytope.cuboid(side * np.array(centre), half, fixed=True))
O.engines = polytope.engines()
k = density * 9.81 * np.diag((0.6, 0.6, 1))
polytope.inSitu(-depth * k, gradient=[0 * k, 0 * k, k])
polytope.settle(elastic=False)

# floor, walls and an arch of 12 planes about (0, 0, 0)
arch = [(cos(a), 0, sin(a)) for a in np.linspace(0, pi, 13)]
blocks = len(O.bodies)
gone = polytope.excavate(normals=[*arch, (0, 0, -1)], offsets=[2.5] * 13 + [2], over=3000)
cut = {old: left for old, left in gone.items() if left}
print(
	f'{blocks - 6} blocks: {len(gone) - len(cut)} taken whole, {len(cut)} cut by the outline, of which {sum(map(len, cut.values()))} are left'
)
polytope.settle(elastic=False)
ids = [left for several in cut.values() for left in several]
moved = max((float((O.bodies[k].state.pos - O.bodies[k].state.refPos).norm()), k) for k in ids)
print(f'what is left of them has moved by up to {1e3 * moved[0]:.2f} mm (block {moved[1]})')
polytope.picture('output/tunnel.png', colorBy='displacement', legend='displacement [m]', fixed='hidden', view=(0.2, -1, 0.15))
