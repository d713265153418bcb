# SPDX-License-Identifier: GPL-2.0-or-later
"""A mass of blocks between oblique joints under gravity with k₀: the stress of each block. Page: docs/verification-in-situ.md."""

from math import radians

import numpy as np
from yade import O, RockJointMat, polytope

size, depth, weight = 6.0, 100.0, 2600 * 9.81  # of the mass; of its top below ground [m]; ρ g
O.materials.append(RockJointMat(density=2600, normalStiffness=2e10, shearStiffness=1e10, frictionAngle=radians(35)))
sides = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
joints = [
	polytope.JointSet(radians(dip), radians(direction), spacing)
	for dip, direction, spacing in ((50, 80, 1.3), (70, 200, 1.5), (20, 310, 1.6))
]
mass = polytope.jointedRock(sides, [size / 2] * 6, joints)
for k, made in zip(mass.append(), mass.faces, strict=True):
	O.bodies[k].dynamic = not (made < 0).any()  # blocks at the boundary are the fixed ones
O.engines = polytope.engines()
k0 = weight * np.diag((0.6, 0.8, 1))
polytope.inSitu(-(depth + size / 2) * k0, gradient=[0 * k0, 0 * k0, k0])
polytope.settle(elastic=False)
worst = 0.0
for k, found in polytope.bodyStress().items():
	if O.bodies[k].dynamic:
		asked = (float(O.bodies[k].state.pos[2]) - depth - size / 2) * k0
		worst = max(worst, float(np.abs(found - asked).max() / np.abs(asked).max()))
print(f'{sum(body.dynamic for body in O.bodies)} blocks, stress asked for off by {100 * worst:.1g} % at most')
