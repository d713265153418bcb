# SPDX-License-Identifier: GPL-2.0-or-later
"""After YADE's examples/polyhedra/clump.py: the mass of a clump of two bodies, and its fall onto a plate."""

from yade import polytope

O.materials.append(RockJointMat(density=2600, normalStiffness=1e8, shearStiffness=1e8, frictionAngle=0.6))
shapes = [[(x, y, z) for x in (0, w) for y in (0, 1) for z in (low, low + 1)] for w, low in ((1, 0), (2, 1))]

light, body = (polytope.fromVertices(points) for points in shapes)
light.state.mass, light.state.inertia = 1e-12, (1e-12, 1e-12, 1e-12)
body.state.ori, body.state.pos = Quaternion((1, 2, 3), 1), (sqrt(2), 0.5, -sqrt(2))
number, _ = O.bodies.appendClumped([light, body])
clump = O.bodies[number].state
# beside one of almost no mass the other body's properties are the clump's
print(clump.pos, body.state.pos, clump.mass, body.state.mass, clump.inertia, body.state.inertia)

O.bodies.clear()
O.bodies.append(polytope.cuboid((0, 0, -0.5), (5, 5, 0.5), fixed=True, color=(0, 1, 1)))
number, _ = O.bodies.appendClumped([polytope.fromVertices(points, color=(0, 1, 0)) for points in shapes])
O.bodies[number].state.pos, O.bodies[number].state.ori = (0, 0, 5), Quaternion((1, 1, 0.3), 1.5)
O.engines = polytope.engines()
while O.time < 2:
	O.run(500, wait=True)
polytope.picture('clump.png')
