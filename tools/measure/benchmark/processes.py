# SPDX-License-Identifier: GPL-2.0-or-later
"""Time of a step on several processes (yade.polytope.mpi), with one worker and with more: `./run python tools/measure/benchmark/processes.py`.

Walls of cubes as in results.py, at rest, so that the number of contacts is the same in all runs. Each run has rank 0 beside its workers, and the
fixed ground is left out: what is measured is the workers' own time and what they exchange. Runs with different numbers of workers alternate, so that
they meet the same other work of the machine; the ratio is that of the fastest of each.
"""

import argparse
import json
import os
import subprocess
import sys
import time

import results

environment = {
	'OMP_NUM_THREADS': '1',
	'OMPI_ALLOW_RUN_AS_ROOT': '1',
	'OMPI_ALLOW_RUN_AS_ROOT_CONFIRM': '1',
	'OMPI_MCA_btl': 'self,sm',
	'OMPI_MCA_mpi_yield_when_idle': '1',
}


def measure(bodies, steps):
	"""On each rank: prints, on rank 0, seconds a step and what worker 1 spent on which message."""
	from yade import O, mpy
	from yade.polytope import mpi

	if mpi.rank() == 0:
		results.scene(bodies)
	mpi.divide(axis=0)
	mpi.run(2, merged=False)
	mpy.timing_comm.clear()
	mpy.comm.barrier()
	begin, worked = time.perf_counter(), time.process_time()
	mpi.run(steps, merged=False)
	mpy.comm.barrier()
	taken, worked = time.perf_counter() - begin, time.process_time() - worked
	messages = mpy.comm.gather({name: [calls, seconds / steps] for name, (calls, seconds) in mpy.timing_comm.timings.items()})
	processor = mpy.comm.gather(worked / steps)
	ghosts = mpy.comm.gather(sum(len(ids) for rank, ids in enumerate(O.subD.intersections) if rank not in (0, mpi.rank())))
	contacts = mpi.arrays()
	if mpi.rank() == 0:
		found = {'step': taken / steps, 'processor': processor, 'sent': ghosts, 'contacts': len(contacts.contacts.ids), 'messages': messages[1]}
		print('RESULT', json.dumps(found), flush=True)


def launch(workers, bodies, steps):
	command = ['mpirun', '--oversubscribe', '-np', str(workers + 1), sys.executable, __file__, '--rank', '--bodies', str(bodies), '--steps', str(steps)]
	done = subprocess.run(command, env={**os.environ, **environment}, capture_output=True, text=True, timeout=3600)
	lines = [line for line in done.stdout.splitlines() if line.startswith('RESULT ')]
	if done.returncode or not lines:
		raise SystemExit(f'{workers} workers: {(done.stdout + done.stderr)[-2000:]}')
	return json.loads(lines[-1][len('RESULT '):])


def main():
	parser = argparse.ArgumentParser(description='Time of a step on several processes of this machine, for each number of workers.')
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
	first = min(found['step'] for found in runs[options.workers[0]])
	firstWork = max(runs[options.workers[0]][0]['processor'][1:])
	print(f'{os.cpu_count()} cores, load {os.getloadavg()[0]:.1f}, {options.bodies} bodies, {runs[options.workers[0]][0]["contacts"]} contacts')
	for workers, found in runs.items():
		best = min(found, key=lambda run: run['step'])
		work = max(best['processor'][1:])
		print(f'{workers} workers: {best["step"] * 1e3:.1f} ms a step (ratio {first / best["step"]:.2f}); processor time of the busiest worker {work * 1e3:.1f} ms '
		      f'(ratio {firstWork / work:.2f}), of rank 0 {best["processor"][0] * 1e3:.1f} ms; states that workers send in a step: {sum(best["sent"])}')
		for name, (calls, seconds) in sorted(best['messages'].items(), key=lambda item: -item[1][1]):
			print(f'    worker 1: {name}: {calls} calls, {seconds * 1e3:.2f} ms a step, waiting included')


if __name__ == '__main__':
	main()
