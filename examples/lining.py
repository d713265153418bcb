# SPDX-License-Identifier: GPL-2.0-or-later
"""A shotcrete arch on a tunnel's contour bears a block that comes loose in its roof; its section forces, as a table and as output/lining.png.

./run python examples/lining.py
"""

import os
from math import cos, pi, radians, sin

import matplotlib
import numpy as np
from yade import O, RockJointMat, polytope

matplotlib.use('Agg')
from matplotlib import pyplot  # noqa: E402

radius, number, key = 3.0, 16, (7, 8)
O.materials.append(RockJointMat(density=2600, normalStiffness=1e10, shearStiffness=5e9, frictionAngle=radians(35)))
contour = [(radius * cos(a), radius * sin(a)) for a in np.linspace(0, pi, number + 1)]
# wedges around the tunnel; the two in the middle of the roof are narrower above, and loose
for k, (a, b) in enumerate(zip(contour, contour[1:], strict=False)):
	outer = [(1.5 * x, 1.5 * y) for x, y in (a, b)] if k not in key else [(0.9 * x, y + 1.4) for x, y in (a, b)]
	O.bodies.append(polytope.polygon([a, b, *outer], fixed=k not in key))
O.engines = polytope.engines(gravity=(0, -9.81, 0))
concrete = RockJointMat(density=2400, normalStiffness=1e10, shearStiffness=5e9, frictionAngle=radians(35))
arch = polytope.lining(contour, thickness=0.2, youngsModulus=3e10, material=concrete, adhesion=polytope.Adhesion(5e5, 1e6))
polytope.settle()

forces = arch.forces
print('  x [m]   y [m]  N [kN]  Q [kN]  M [kN m]')
for point, n, q, m in zip(forces.points, forces.normal, forces.shear, forces.moment, strict=True):
	print(f'{point[0]:7.2f} {point[1]:7.2f} {n / 1e3:7.2f} {q / 1e3:7.2f} {m / 1e3:9.3f}')
weight = sum(float(O.bodies[k].state.mass) for k in key) * 9.81
lifted = sum(one.force[1] * (1 if one.id2 in key else -1) for one in arch.adhesion if one.id1 in key or one.id2 in key)
print(f'loose blocks: {weight / 1e3:.2f} kN, of which the lining bears {lifted / 1e3:.2f} kN')
os.makedirs('output', exist_ok=True)
pyplot.plot(forces.distances, forces.moment / 1e3)
pyplot.xlabel('along the lining [m]')
pyplot.ylabel('M [kN m]')
pyplot.savefig('output/lining.png')
