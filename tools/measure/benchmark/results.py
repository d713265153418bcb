# SPDX-License-Identifier: GPL-2.0-or-later
"""Time of polytope.arrays(), a snapshot, a picture, O.save, O.load and a checkpoint of a large scene; YADE's spheres beside it.

As a program (bench.py runs it in a process of its own) it prints what it measured as JSON. Walls of cubes, four contacts a cube as in a
heap, made in random order, so that bodies and contacts lie in memory as in a heap, too. Times are those of the processor in this process and
those it starts, with one thread each: other programs do not count, nor does waiting for the disk. Those of the clock are beside them.
"""

import os
import random
import statistics
import tempfile
import time

import memory
import oneProcess

numbers = {'quick': 10000, 'full': 100000}
"""Bodies."""


def places(number):
	side = round(number ** (1 / 3))
	lattice = [(k % side, k // side % side, k // side**2) for k in range(number)]
	random.Random(1).shuffle(lattice)
	return [(0.999 * x, 1.01 * y, 0.999 * z) for x, y, z in lattice]


def scene(number):
	from yade import O, RockJointMat, polytope

	O.materials.append(RockJointMat(density=2600, normalStiffness=1e8, shearStiffness=1e8, frictionAngle=0.5))
	O.bodies.append([polytope.cuboid(place, (0.5, 0.5, 0.5)) for place in places(number)])
	O.engines = polytope.engines(timeStepper=False)
	O.dt = 1e-6
	for _ in range(2):
		O.step()


def spheres(number):
	"""YADE's own at the same places, four contacts each."""
	from yade import O

	memory.spheres(places(number))
	for _ in range(2):
		O.step()


def used():
	"""Processor time of this process and of those that it has started and that have ended [s]."""
	return sum(os.times()[:4])


def median(call, repeats):
	"""Median times of a call: 'processor' time and time by the 'clock' [s]."""
	times = {'processor': [], 'clock': []}
	for _ in range(repeats):
		begin, beginUsed = time.perf_counter(), used()
		call()
		times['processor'].append(used() - beginUsed)
		times['clock'].append(time.perf_counter() - begin)
	return {name: statistics.median(those) for name, those in times.items()}


def mean(call, repeats):
	"""Mean times of a call that is short against the hundredths of a second in which the system counts."""

	def many():
		for _ in range(repeats):
			call()

	together = median(many, 1)
	return {name: seconds / repeats for name, seconds in together.items()}


def ofSpheres(number, folder):
	from yade import O, VTKRecorder

	spheres(number)
	fields = ['spheres', 'id', 'velocity', 'mass', 'mask']
	recorder = VTKRecorder(fileName=f'{folder}/spheres-', recorders=fields, compress=True, iterPeriod=1)
	return {
		'contacts': O.interactions.countReal(),
		'bodySnapshot': median(recorder, 3),
		'save': median(lambda: O.save(f'{folder}/spheres.yade', quiet=True), 1),
		'load': median(lambda: O.load(f'{folder}/spheres.yade', quiet=True), 1),
	}


def measure(quick):
	from yade import O, PolytopeVTKRecorder, polytope

	number = numbers['quick' if quick else 'full']
	scene(number)
	found = {'bodies': len(O.bodies), 'contacts': len(polytope.arrays().contacts.ids), 'pairs': len(O.interactions)}
	found['arrays'] = mean(polytope.arrays, 20)
	with tempfile.TemporaryDirectory() as folder:
		found['snapshot'] = median(PolytopeVTKRecorder(fileName=f'{folder}/', recorders=['bodies', 'contacts'], iterPeriod=1), 3)
		found['bodySnapshot'] = median(PolytopeVTKRecorder(fileName=f'{folder}/', recorders=['bodies'], iterPeriod=1), 3)
		found['picture'] = median(lambda: polytope.picture(f'{folder}/picture.png'), 1)
		engine = polytope.checkpoint(f'{folder}/run', iterPeriod=1, onSignal=False)
		found['save'] = median(lambda: O.save(f'{folder}/scene.yade', quiet=True), 1)
		found['checkpoint'] = median(engine.write, 1)
		found['bytes'] = os.path.getsize(f'{folder}/scene.yade')
		found['checkpointBytes'] = os.path.getsize(f'{folder}/run.yade')
		found['load'] = median(lambda: O.load(f'{folder}/scene.yade', quiet=True), 1)
		found['loadCheckpoint'] = median(lambda: O.load(f'{folder}/run.yade', quiet=True), 1)
		found['spheres'] = ofSpheres(number, folder)
	return found


def run(core, quick):
	"""measure() in a process of its own on one core."""
	return oneProcess.run(__file__, core, quick)


if __name__ == '__main__':
	oneProcess.report(measure)
