# SPDX-License-Identifier: GPL-2.0-or-later
"""Rows of `./run bench --only scale`: a million bodies against a tenth of them (million.py), two worker processes against one (processes.py)."""

import json
import os
import pathlib
import subprocess
import sys

import processes
from tqdm import tqdm

here = pathlib.Path(__file__).resolve().parent
cubes = 20000
"""Number of cubes on several processes."""
repeats = 2
"""Number of runs with each number of processes; the fastest counts, for they meet other work of the machine."""


def bodies(number, steps=200):
	"""What million.py has found with so many bodies, with a thread for each core."""
	command = [sys.executable, str(here / 'million.py'), '--number', str(number), '--steps', str(steps)]
	environment = dict(os.environ, OMP_NUM_THREADS=str(os.cpu_count()))
	output = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=3 * 3600)
	lines = [line for line in output.stdout.splitlines() if line.startswith('RESULT ')]
	if output.returncode or not lines:
		raise RuntimeError('million.py: ' + ' '.join((output.stderr or output.stdout).split('\n')[-4:]))
	return json.loads(lines[-1][len('RESULT ') :])


def measure(quick, large):
	"""{'bodies': [of each number, ascending], 'workers': {number: seconds a step}}; a million bodies only if *large*."""
	numbers = (2000, 20000) if quick else (100000, 1000000) if large else (100000,)
	found = [bodies(number, 20 if quick else 200) for number in tqdm(numbers, desc='bodies in a box')]
	steps = {workers: [] for workers in (1, 2)}
	for _ in tqdm(range(repeats), desc='several processes'):
		for workers, one in steps.items():
			one.append(processes.launch(workers, 2000 if quick else cubes, 10 if quick else 30)['step'])
	return {'bodies': found, 'cubes': 2000 if quick else cubes, 'workers': {workers: min(one) for workers, one in steps.items()}}
