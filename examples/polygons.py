# SPDX-License-Identifier: GPL-2.0-or-later
"""Polygons (2-D): blocks slide out of a hopper; draws where they are after two seconds.

./run python examples/polygons.py          writes output/polygons.png
"""

from math import cos, pi, radians, sin
from random import Random

from yade import O, RockJointMat, polytope
from yade.polytope.pictures.still import picture

O.materials.append(RockJointMat(density=2600, normalStiffness=5e7, shearStiffness=3e7, stiffnessPerArea=False, frictionAngle=radians(25)))

# convex bodies only: the hopper is two slabs, the floor a third
slabs = [[(-3, 2.2), (-0.5, 0.6), (-0.5, 0.4), (-3, 2)], [(3, 2.2), (0.5, 0.6), (0.5, 0.4), (3, 2)]]
slabs.append([(-3, -1.4), (3, -1.4), (3, -1.2), (-3, -1.2)])
O.bodies.append([polytope.polygon(corners, fixed=True, color=(0.8, 0.8, 0.78)) for corners in slabs])
random = Random(1)
for k in range(72):
	corners, x, y = random.randint(3, 7), 0.25 * (k % 9) - 1, 0.25 * (k // 9) + 1.55
	angles = [2 * pi * (i + random.uniform(0, 0.4)) / corners for i in range(corners)]
	O.bodies.append(polytope.polygon([(x + 0.12 * cos(a), y + 0.12 * sin(a)) for a in angles]))

O.engines = polytope.engines()
polytope.run(until=2)
picture('output/polygons.png', colorBy='speed', legend='speed [m/s]')
