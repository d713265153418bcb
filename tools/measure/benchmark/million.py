# SPDX-License-Identifier: GPL-2.0-or-later
"""A million polytopes of five kinds in a box: made, 200 steps, recorded, saved, loaded, continued.

./run python tools/measure/benchmark/million.py

Prints the time and memory of each part as it ends, and of a body's step with the share of each engine. The bodies, regular solids of 4, 6, 8, 12 and 20
faces in any orientation, start on a lattice on which they just do not touch, and fly in all directions: in 200 steps each has met some of its
neighbours. --number 100000 makes a tenth of them, for comparison; with --yades-collider YADE's InsertionSortCollider finds the pairs.
"""

import argparse
import json
import os
import random
import tempfile
import time

faces = (4, 6, 8, 12, 20)
radius, density, stiffness = 0.5, 2600, 1e8
speed = 5
"""Largest component of a body's velocity at the beginning [m/s]."""


def memory(field):
	"""VmRSS (now) or VmHWM (at most) of this process [GB]."""
	with open('/proc/self/status') as file:
		return next(int(line.split()[1]) / 1e6 for line in file if line.startswith(field))


class Parts:
	"""Prints what each part of the run took."""

	def __init__(self):
		self.begin = self.last = time.perf_counter()

	def done(self, name, more=''):
		now = time.perf_counter()
		print(f'{name:10} {now - self.last:8.1f} s   {memory("VmRSS"):6.2f} GB, at most {memory("VmHWM"):6.2f} GB   {more}', flush=True)
		self.last = now


def build(number, yadesCollider):
	from yade import (
		Bo1_Polytope_Aabb,
		InsertionSortCollider,
		Ip2_RockJointMat_RockJointMat_RockJointPhys,
		O,
		Quaternion,
		RockJointMat,
		polytope,
	)

	O.materials.append(RockJointMat(density=density, normalStiffness=stiffness, shearStiffness=stiffness, frictionAngle=0.5))
	chance, side = random.Random(1), round(number ** (1 / 3))
	width, height = side * 2 * radius, (number + side**2 - 1) // side**2 * 2 * radius
	middle = (width / 2, width / 2)
	O.bodies.append(polytope.cuboid((*middle, -1), (width / 2 + 2, width / 2 + 2, 1), fixed=True))
	for axis in (0, 1):
		for side_ in (-1, 1):
			centre, half = [*middle, height], [width / 2 + 2, width / 2 + 2, height]
			centre[axis] += side_ * (width / 2 + 1)
			half[axis] = 1
			O.bodies.append(polytope.cuboid(centre, half, fixed=True))
	for k in range(number):
		place = [radius * (2 * index + 1) for index in (k % side, k // side % side, k // side**2)]
		axis = [chance.gauss(0, 1) for _ in range(3)]
		body = polytope.regular(faces[chance.randrange(5)], radius, place, Quaternion(axis, chance.uniform(0, 3)))
		body.state.vel = [chance.uniform(-speed, speed) for _ in range(3)]
		O.bodies.append(body)
	O.engines = polytope.engines(timeStepper=False, physics=Ip2_RockJointMat_RockJointMat_RockJointPhys(stiffnessPerArea=False))
	if yadesCollider:
		reach = O.engines[1].verletDist
		O.engines = [O.engines[0], InsertionSortCollider([Bo1_Polytope_Aabb()], verletDist=reach), *O.engines[2:]]
	lightest = min(body.state.mass for body in O.bodies if body.dynamic)
	O.dt = 0.2 * (lightest / stiffness) ** 0.5


def run(steps, parts, name):
	"""Runs this number of steps, and notes how the time of a body's step divides among the engines."""
	from yade import O

	O.timingEnabled = True
	for engine in O.engines:
		engine.execTime = 0
	begin = time.perf_counter()
	O.run(steps, True)
	each = 1e6 * (time.perf_counter() - begin) / steps / len(O.bodies)
	shares = ', '.join(f'{type(engine).__name__} {1e-3 * engine.execTime / steps / len(O.bodies):.2f}' for engine in O.engines)
	pairs, contacts = len(O.interactions) / len(O.bodies), O.interactions.countReal() / len(O.bodies)
	parts.done(name, f'{each:.2f} µs a body and step ({shares}); {pairs:.1f} pairs and {contacts:.2f} contacts a body')
	return each


def main():
	parser = argparse.ArgumentParser(description=__doc__.split('\n\n')[0])
	parser.add_argument('--number', type=int, default=1000000, help='of bodies')
	parser.add_argument('--steps', type=int, default=200, help='before the state is saved; half as many after it is loaded')
	parser.add_argument('--yades-collider', action='store_true', help='in place of PolytopeCollider, for comparison')
	parser.add_argument('--folder', help='where the state is written, some GB (default: a temporary folder)')
	options = parser.parse_args()
	from yade import O, PolytopeVTKRecorder, polytope

	parts = Parts()
	build(options.number, options.yades_collider)
	parts.done('made', f'{len(O.bodies)} bodies, {O.numThreads} threads')
	run(1, parts, 'first step')
	before = run(options.steps, parts, f'{options.steps} steps')
	with tempfile.TemporaryDirectory(dir=options.folder) as folder:
		used = time.process_time()
		PolytopeVTKRecorder(fileName=folder + '/')()
		used = time.process_time() - used
		size = sum(os.path.getsize(f'{folder}/{name}') for name in os.listdir(folder))
		parts.done('snapshot', f'{size / 1e9:.2f} GB for ParaView, {used:.1f} s of the processor')
		engine = polytope.checkpoint(folder + '/million', iterPeriod=10**9, onSignal=False)
		engine.write()
		parts.done('saved', f'{os.path.getsize(folder + "/million.yade") / 1e9:.2f} GB')
		O.load(folder + '/million.yade', quiet=True)
		parts.done('loaded', f'{len(O.bodies)} bodies, step {O.iter}')
	run(1, parts, 'first step')
	after = run(max(1, options.steps // 2), parts, 'continued')
	seconds = time.perf_counter() - parts.begin
	print(f'in all {seconds:.0f} s; a body and step {before:.2f} µs, after loading {after:.2f} µs')
	found = {'bodies': options.number, 'seconds': seconds, 'gigabytes': memory('VmHWM'), 'before': before, 'after': after, 'snapshot': used}
	print('RESULT', json.dumps(found), flush=True)
	os._exit(0)  # YADE's own clean-up at exit is not measured


if __name__ == '__main__':
	main()
