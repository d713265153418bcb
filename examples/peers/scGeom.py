# SPDX-License-Identifier: GPL-2.0-or-later
"""After YADE's examples/polyhedra/tests/scGeom.py: two cubes collide, with YADE's FrictMat and law for ScGeom or with the plug-in's."""

from yade import polytope

scGeom = True
O.materials.append(FrictMat() if scGeom else RockJointMat())
O.bodies.append([polytope.cuboid((x, 0, 0), (1, 1, 1)) for x in (0, 3)])
O.bodies[1].state.vel = (-1, 0, 0)
O.engines = polytope.engines(gravity=(0, 0, 0))
while O.time < 2:
	O.run(100, wait=True)
print('speeds now:', [body.state.vel for body in O.bodies])
