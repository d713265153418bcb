# SPDX-License-Identifier: GPL-2.0-or-later
"""Time of a step on several processes (yade.polytope.mpi), with one worker and with more: `./run python tools/measure/benchmark/processes.py`.

Walls of cubes as in results.py, at rest, so that the number of contacts is the same in all runs. Each run has rank 0 beside its workers, and the
fixed ground is left out: what is measured is the workers' own time and what they exchange. Runs with different numbers of workers alternate, so that
they meet the same other work of the machine; the ratio is that of the fastest of each.
"""

import argparse
import json
import math
import os
import pickle
import subprocess
import sys
import time

import results
from tabulate import tabulate

stateBytes = 13 * 8
"""Bytes of a body's state that are sent in each step: position, velocity, angular velocity, orientation."""
perWorker = 10000
"""Bodies on each worker where the number of bodies grows with that of the workers."""


def timed(call):
	begin = time.perf_counter()
	call()
	return time.perf_counter() - begin


def measure(bodies, steps):
	"""On each rank: prints, on rank 0, what a step, handing the scene out and merging it take [s], what is sent [bytes], and worker 1's messages."""
	from yade import O, mpy
	from yade.polytope import mpi

	comm = mpy.comm
	if mpi.rank() == 0:
		results.scene(bodies)
	found = {'scene': len(O.sceneToString()) if mpi.rank() == 0 else 0}
	mpi.divide(axis=0)
	comm.barrier()
	found['handOut'] = timed(lambda: mpi.run(2, merged=False))
	mpy.timing_comm.clear()
	comm.barrier()
	worked = time.process_time()
	found['step'] = timed(lambda: (mpi.run(steps, merged=False), comm.barrier())) / steps
	processor = comm.gather((time.process_time() - worked) / steps)
	messages = comm.gather({name: [calls, seconds / steps] for name, (calls, seconds) in mpy.timing_comm.timings.items()})
	ghosts = comm.gather(sum(len(ids) for rank, ids in enumerate(O.subD.intersections) if rank not in (0, mpi.rank())))
	forces = comm.gather(len(pickle.dumps([[k, O.forces.f(k), O.forces.t(k)] for k in O.subD.mirrorIntersections[0]])) if mpi.rank() else 0)
	fields = mpi.arrays()
	found['together'] = timed(lambda: [(comm.barrier(), comm.allreduce(1), comm.allreduce(1.0)) for _ in range(200)]) / 200
	found['merge'] = timed(mpi.merge)
	if mpi.rank() == 0:
		found |= {
			'processor': processor,
			'sent': ghosts,
			'forces': max(forces),
			'contacts': len(fields.contacts.ids),
			'messages': messages[1],
		}
		print('RESULT', json.dumps(found), flush=True)


def launch(workers, bodies, steps):
	command = [
		'mpirun',
		'--oversubscribe',
		'-np',
		str(workers + 1),
		sys.executable,
		__file__,
		'--rank',
		'--bodies',
		str(bodies),
		'--steps',
		str(steps),
	]
	done = subprocess.run(command, env={**os.environ, 'OMP_NUM_THREADS': '1'}, capture_output=True, text=True, timeout=3600)
	lines = [line for line in done.stdout.splitlines() if line.startswith('RESULT ')]
	if done.returncode or not lines:
		raise SystemExit(f'{workers} workers: {(done.stdout + done.stderr)[-2000:]}')
	return json.loads(lines[-1][len('RESULT ') :])


class Model:
	"""Time of a step on many machines, one worker a core, from what one and two workers took here.

	A worker computes its own bodies and their contacts, the contacts that it shares with its neighbours, and copies the states of the bodies on
	both sides of its borders; then all meet, which takes as many messages one after the other as the number of ranks has binary digits.
	"""

	def __init__(self, bodies, best):
		one, two = (max(best[workers]['processor'][1:]) for workers in (1, 2))
		self.body = one / bodies
		"""Time of a body with its contacts [s]."""
		self.ghost = max(two - one / 2, 0) / max(best[2]['sent'][1:])
		"""Time of a body that another worker has too [s]."""
		self.message = best[1]['together']  # two ranks: one message each way
		self.handOut, self.merge, self.scene = (best[1][name] / bodies for name in ('handOut', 'merge', 'scene'))

	def step(self, workers, bodies, blocks):
		"""Slabs along one axis (polytope.mpi.divide) or blocks (mpy.DOMAIN_DECOMPOSITION) of a cube of bodies."""
		own = bodies / workers
		if workers == 1:
			ghosts = 0
		elif blocks:
			ghosts = min(6, 2 * math.log2(workers)) * own ** (2 / 3)
		else:
			ghosts = min(2, workers - 1) * bodies ** (2 / 3)
		return self.body * own + self.ghost * ghosts + self.message * math.ceil(math.log2(workers + 1))

	def table(self, bodies):
		"""Speed-up with a fixed number of bodies, and efficiency with a fixed number on each worker."""
		rows = []
		for workers in (1, 2, 4, 8, 16, 32, 64, 128, 256, 512, 1000):
			row = [workers]
			for blocks in (False, True):
				row += [
					self.step(1, bodies, blocks) / self.step(workers, bodies, blocks),
					self.step(1, perWorker, blocks) / self.step(workers, workers * perWorker, blocks),
				]
			rows.append([*row, self.handOut * perWorker * workers, self.scene * perWorker * workers * 1e-9])
		heads = ['workers', 'slabs: speed-up', 'slabs: efficiency', 'blocks: speed-up', 'blocks: efficiency', 'hand out [s]', 'scene [GB]']
		return tabulate(rows, heads, floatfmt='.3g')


def report(bodies, runs):
	"""Prints what was measured, and the model beside it."""
	best = {workers: min(found, key=lambda run: run['step']) for workers, found in runs.items()}
	first = best[min(best)]
	print(f'{os.cpu_count()} cores, load {os.getloadavg()[0]:.1f}, {bodies} bodies, {first["contacts"]} contacts')
	model = Model(bodies, best) if {1, 2} <= best.keys() else None
	rows = []
	for workers, run in best.items():
		work = max(run['processor'][1:])
		told = model.step(workers, bodies, False) * 1e3 if model else None
		rows.append(
			[
				workers,
				run['step'] * 1e3,
				first['step'] / run['step'],
				work * 1e3,
				max(first['processor'][1:]) / work,
				told,
				max(run['sent'][1:]),
				stateBytes * max(run['sent'][1:]),
				run['forces'],
				run['together'] * 1e6,
				run['handOut'],
				run['merge'],
			]
		)
	heads = [
		'workers',
		'step [ms]',
		'ratio',
		'busiest worker [ms]',
		'ratio',
		'model [ms]',
		'states sent',
		'bytes',
		'forces to rank 0 [bytes]',
		'ranks meet [µs]',
		'hand out [s]',
		'merge [s]',
	]
	print(tabulate(rows, heads, floatfmt='.3g'))
	for workers, run in best.items():
		for name, (calls, seconds) in sorted(run['messages'].items(), key=lambda item: -item[1][1]):
			print(f'    {workers} workers, worker 1: {name}: {calls} calls, {seconds * 1e3:.2f} ms a step, waiting included')
	if model:
		print(
			f'\nModel: {model.body * 1e6:.2f} µs a body, {model.ghost * 1e6:.2f} µs a body that two workers have, {model.message * 1e6:.1f} µs a message;'
		)
		print(
			f'handing out {model.handOut * 1e6:.0f} µs and {model.scene:.0f} bytes a body, on each rank; merging {model.merge * 1e6:.0f} µs a body.'
		)
		print(f'Speed-up with a million bodies; efficiency, time to hand out and size of the scene with {perWorker} bodies on each worker:')
		print(model.table(1_000_000))


def main():
	parser = argparse.ArgumentParser(
		description='Time of a step on several processes of this machine, for each number of workers; with 1 and 2, a model of more.'
	)
	parser.add_argument('--bodies', type=int, default=20000)
	parser.add_argument('--steps', type=int, default=30)
	parser.add_argument('--workers', type=int, nargs='+', default=[1, 2])
	parser.add_argument('--repeats', type=int, default=2)
	parser.add_argument('--rank', action='store_true', help=argparse.SUPPRESS)
	options = parser.parse_args()
	if options.rank:
		measure(options.bodies, options.steps)
		return
	runs = {workers: [] for workers in options.workers}
	for _ in range(options.repeats):
		for workers, found in runs.items():
			found.append(launch(workers, options.bodies, options.steps))
	report(options.bodies, runs)


if __name__ == '__main__':
	main()
