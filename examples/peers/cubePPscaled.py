# SPDX-License-Identifier: GPL-2.0-or-later
"""After YADE's examples/PotentialParticles/cubePPscaled.py: as cubePBscaled.py, with the contact normal of rounded cubes.

The cubes stay sharp; the normal is that of the paper's inner potential particle, with the given radius at corners.
"""

from yade import polytope

O.materials.append(RockJointMat(normalStiffness=1e8, shearStiffness=1e7, frictionAngle=0, density=2000))
number = 100
cubes = [polytope.cuboid((0, 0, 0), (0.5, 0.5, 0.5), orientation=Quaternion(Vector3.Random(), 3), cornerRadius=0.05) for _ in range(number)]
O.bodies.append(polytope.cloud((-4.25, 0.5, -4.25), (4.25, 98, 4.25), cubes, seed=1))
lid = O.bodies.append([polytope.cuboid((x, 0, z), (1.5, 0.25, 1.5), fixed=True) for x in (-3, 0, 3) for z in (-3, 0, 3)])[4]
O.bodies.append(polytope.plates((-4.25, 0.25, -4.25), (4.25, 14, 4.25), thickness=0.5, without=('-y', '+y')))
contact = Ig2_Polytope_Polytope_PolytopeGeom(contactModel='boon2012')
O.engines = polytope.engines(gravity=(0, -9.81, 0), damping=0, geometry=contact)
while O.time < 10:
	O.run(500, wait=True)
	if O.time > 5 and O.bodies[lid]:
		O.bodies.erase(lid)
	for body in O.bodies:
		if body.state.pos[1] < -5 and body.dynamic:
			O.bodies.erase(body.id)
print(number - sum(body.dynamic for body in O.bodies), 'cubes have fallen out')
polytope.picture('cubePPscaled.png', fixed='wire')
