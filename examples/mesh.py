# SPDX-License-Identifier: GPL-2.0-or-later
"""A mesh file as particle: twenty pebbles of one OBJ file fall into a tray; draws them. (Particles are the meshes' convex hulls.)

./run python examples/mesh.py          writes output/pebbles.png
"""

import os
from math import radians

from yade import O, RockJointMat, polytope
from yade.polytope.pictures.still import picture

pebble = os.path.join(os.path.dirname(os.path.abspath(__file__)), 'pebble.obj')  # in centimetres
O.materials.append(RockJointMat(density=2600, normalStiffness=1e6, shearStiffness=7e5, stiffnessPerArea=False, frictionAngle=radians(30)))

tray = [((0, 0, -0.01), (0.16, 0.16, 0.01)), ((-0.15, 0, 0.06), (0.01, 0.16, 0.06)), ((0.15, 0, 0.06), (0.01, 0.16, 0.06))]
tray += [((0, -0.15, 0.06), (0.14, 0.01, 0.06)), ((0, 0.15, 0.06), (0.14, 0.01, 0.06))]
O.bodies.append([polytope.cuboid(center, extents, fixed=True, color=(0.8, 0.8, 0.78)) for center, extents in tray])
for k in range(20):
	place = (0.12 * (k % 2) - 0.06, 0.12 * (k // 2 % 2) - 0.06, 0.05 + 0.07 * (k // 4))
	O.bodies.append(polytope.fromMesh(pebble, scale=0.007 + 0.0002 * k, center=place, color=(0.80, 0.70 - 0.015 * k, 0.55 - 0.02 * k)))

O.engines = polytope.engines()
polytope.run(until=1.5)
print('volume of the smallest pebble:', O.bodies[5].shape.volume, 'm³, with', len(O.bodies[5].shape.normals), 'planes')
picture('output/pebbles.png', view=(-0.5, -1, 1.1))
