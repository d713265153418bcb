# SPDX-License-Identifier: GPL-2.0-or-later
"""After YADE's examples/PotentialBlocks/cubePBscaled.py and cubePBscaled_potential_utils.py: cubes fall into a box; its floor opens."""

from yade import plot, polytope

O.materials.append(RockJointMat(normalStiffness=1e8, shearStiffness=1e7, frictionAngle=0, density=2000))
base, height, thick = 9, 14, 0.5
number = 100
cubes = [polytope.cuboid((0, 0, 0), (0.5, 0.5, 0.5), orientation=Quaternion(Vector3.Random(), 3)) for _ in range(number)]
O.bodies.append(polytope.cloud((-4.25, 0.5, -4.25), (4.25, 7 * height, 4.25), cubes, seed=1))
floor = [polytope.cuboid((x, 0, z), (base / 6, thick / 2, base / 6), fixed=True) for x in (-3, 0, 3) for z in (-3, 0, 3)]
lid = O.bodies.append(floor)[4]
walls = polytope.plates((-4.25, thick / 2, -4.25), (4.25, height, 4.25), thickness=thick, without=('-y', '+y'))
O.bodies.append(walls)
fallen = 0


def record():
	global fallen
	for body in O.bodies:
		if body.state.pos[1] < -5 and body.dynamic:
			fallen += 1
			O.bodies.erase(body.id)
	plot.addData(time=O.time, unbalancedForce=unbalancedForce(), kineticEnergy=kineticEnergy(), fallen=fallen)


plot.plots = {'time': ('unbalancedForce', None, 'fallen')}
O.engines = polytope.engines(gravity=(0, -9.81, 0), damping=0) + [PyRunner(command='record()', iterPeriod=10)]
while O.time < 10:
	O.run(500, wait=True)
	if O.time > 5 and O.bodies[lid]:
		O.bodies.erase(lid)
polytope.picture('cubePBscaled.png', fixed='wire')
