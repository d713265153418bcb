# SPDX-License-Identifier: GPL-2.0-or-later
"""Time of polytope.arrays() and of a saved state: `./run python tools/measure/benchmark/arrays.py [BODIES]`.

A block of cubes in contact with each other, moved at random so that bodies and contacts lie in memory as in a heap; median of ten calls.
"""

import os
import random
import statistics
import sys
import tempfile
import time

from yade import (
	Bo1_Polytope_Aabb,
	ForceResetter,
	Ig2_Polytope_Polytope_PolytopeGeom,
	InteractionLoop,
	Ip2_RockJointMat_RockJointMat_RockJointPhys,
	Law2_PolytopeGeom_RockJointPhys_MohrCoulomb,
	NewtonIntegrator,
	O,
	PolytopeCollider,
	RockJointMat,
	polytope,
)


def scene(number):
	O.materials.append(RockJointMat(density=2600, normalStiffness=1e8, shearStiffness=1e8, frictionAngle=0.5))
	side = round(number ** (1 / 3))
	places = [(k % side, k // side % side, k // side**2) for k in range(number)]
	random.Random(1).shuffle(places)
	O.bodies.append([polytope.cuboid(tuple(0.999 * x for x in place), (0.5, 0.5, 0.5)) for place in places])
	O.engines = [
		ForceResetter(),
		PolytopeCollider([Bo1_Polytope_Aabb()]),
		InteractionLoop(
			[Ig2_Polytope_Polytope_PolytopeGeom()],
			[Ip2_RockJointMat_RockJointMat_RockJointPhys()],
			[Law2_PolytopeGeom_RockJointPhys_MohrCoulomb()],
		),
		NewtonIntegrator(),
	]
	O.dt = 1e-6
	for _ in range(2):
		O.step()


def milliseconds(call, repeats=10):
	times = []
	for _ in range(repeats):
		start = time.perf_counter()
		call()
		times.append(time.perf_counter() - start)
	return 1e3 * statistics.median(times)


def main():
	number = int(sys.argv[1]) if len(sys.argv) > 1 else 100000
	scene(number)
	contacts = len(polytope.arrays().contacts.ids)
	print(f'{len(O.bodies)} bodies, {contacts} contacts')
	print(f'polytope.arrays()  {milliseconds(polytope.arrays):8.1f} ms')
	with tempfile.TemporaryDirectory() as folder:
		engine = polytope.checkpoint(f'{folder}/run', iterPeriod=1, onSignal=False)
		print(f'checkpoint         {milliseconds(engine.write, 3):8.1f} ms, {os.path.getsize(f"{folder}/run.yade") / 1e6:.0f} MB')


main()
