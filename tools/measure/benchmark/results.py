# SPDX-License-Identifier: GPL-2.0-or-later
"""Time of polytope.arrays(), O.save, O.load and a checkpoint of a large scene.

As a program (bench.py runs it in a process of its own) it prints what it measured as JSON. Walls of cubes, four contacts a cube as in a
heap, made in random order, so that bodies and contacts lie in memory as in a heap, too.
"""
import os
import random
import statistics
import tempfile
import time

import oneProcess

numbers = {'quick': 10000, 'full': 100000}
"""Bodies."""


def scene(number):
	from yade import O, RockJointMat, polytope

	O.materials.append(RockJointMat(density=2600, normalStiffness=1e8, shearStiffness=1e8, frictionAngle=0.5))
	side = round(number ** (1 / 3))
	places = [(k % side, k // side % side, k // side**2) for k in range(number)]
	random.Random(1).shuffle(places)
	O.bodies.append([polytope.cuboid((0.999 * place[0], 1.01 * place[1], 0.999 * place[2]), (0.5, 0.5, 0.5)) for place in places])
	O.engines = polytope.engines(timeStepper=False)
	O.dt = 1e-6
	for _ in range(2):
		O.step()


def median(call, repeats):
	"""Of the time of a call [s]."""
	times = []
	for _ in range(repeats):
		start = time.perf_counter()
		call()
		times.append(time.perf_counter() - start)
	return statistics.median(times)


def measure(quick):
	from yade import O, polytope

	scene(numbers['quick' if quick else 'full'])
	found = {'bodies': len(O.bodies), 'contacts': len(polytope.arrays().contacts.ids), 'arrays': median(polytope.arrays, 10)}
	with tempfile.TemporaryDirectory() as folder:
		engine = polytope.checkpoint(f'{folder}/run', iterPeriod=1, onSignal=False)
		found['save'] = median(lambda: O.save(f'{folder}/scene.yade', quiet=True), 1)
		found['checkpoint'] = median(engine.write, 1)
		found['bytes'] = os.path.getsize(f'{folder}/scene.yade')
		found['load'] = median(lambda: O.load(f'{folder}/scene.yade', quiet=True), 1)
	return found


def run(core, quick):
	"""measure() in a process of its own on one core."""
	return oneProcess.run(__file__, core, quick)


if __name__ == '__main__':
	oneProcess.report(measure)
