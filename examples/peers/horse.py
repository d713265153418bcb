# SPDX-License-Identifier: GPL-2.0-or-later
"""After YADE's examples/polyhedra/horse.py: a horse of spheres falls onto one of tetrahedra. The files of both come with YADE."""

import gts
import numpy as np
from yade import pack, polytope

folder = '/usr/share/doc/yade/examples/polyhedra/'
O.materials.append(FrictMat())
horse = pack.inGtsSurface(gts.read(open(folder + 'horse.coarse.gts')))
lower, upper = horse.aabb()
radius = (upper[0] - lower[0]) / 40
O.bodies.append(pack.regularHexa(horse, radius=radius, gap=radius / 4))
points = np.loadtxt(folder + 'horse.node', skiprows=1, usecols=(1, 2, 3)) - (0, 0, upper[2] - lower[2])
for corners in np.loadtxt(folder + 'horse.ele', skiprows=1, usecols=(1, 2, 3, 4), dtype=int):
	O.bodies.append(polytope.fromVertices(points[corners - 1], color=(0, 1, 1), fixed=True, mask=3))
geometry = [Ig2_Sphere_Sphere_ScGeom(), Ig2_Sphere_Polytope_PolytopeGeom()]
O.engines = polytope.engines(gravity=(0, 0, -5000), damping=0.1, geometry=geometry)
O.engines[1].avoidSelfInteractionMask = 2  # tetrahedra are no pairs
O.trackEnergy = True
while O.time < 0.01:
	O.run(50, wait=True)
	print(O.iter, 'energy', O.energy.total(), dict(O.energy))
polytope.picture('horse.png', fixed='solid')
