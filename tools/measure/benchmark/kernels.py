# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs the program polytope_benchmark (Kernels.cpp) and reads what it measured."""

import dataclasses
import json
import os
import pathlib
import statistics
import subprocess


@dataclasses.dataclass
class Measurement:
	"""One method on one set of pairs. Times in µs a pair, one a repetition."""

	method: str
	set: str
	times: list
	wrong: int
	"""Wrong answers among the pairs of the set."""
	pairs: int
	pivots: float = 0
	iterations: float = 0
	contacts: float = 0
	"""Part of the pairs that have a contact force; 0 for peers."""

	@property
	def median(self):
		return statistics.median(self.times)

	@property
	def spread(self):
		"""Half the range of the middle half of the repetitions over the median."""
		low, _, high = statistics.quantiles(self.times, n=4) if len(self.times) > 1 else (self.times[0],) * 3
		return (high - low) / 2 / self.median


def run(folder, core, quick, output, heap):
	"""All kernels on one core, repeated in random order. Returns {(method, set): Measurement} and the program's
	context. *heap*: file with a heap's contacts."""
	pairs, repetitions = (200, 5) if quick else (1000, 9)
	raw = pathlib.Path(output) / 'kernels.json'
	command = [
		'taskset',
		'-c',
		str(core),
		str(pathlib.Path(folder) / 'polytope_benchmark'),
		f'--benchmark_repetitions={repetitions}',
		'--benchmark_enable_random_interleaving=true',
		f'--benchmark_min_time={0.005 if quick else 0.05}s',
		f'--benchmark_out={raw}',
		'--benchmark_out_format=json',
	]
	log = pathlib.Path(output) / 'kernels.log'
	with open(log, 'w') as file:
		result = subprocess.run(
			command,
			env=dict(os.environ, POLYTOPE_BENCHMARK_PAIRS=str(pairs), POLYTOPE_BENCHMARK_HEAP=str(heap)),
			stdout=file,
			stderr=subprocess.STDOUT,
		)
	if result.returncode:
		raise RuntimeError(f'polytope_benchmark ended with {result.returncode}; see {log}')
	with open(raw) as file:
		data = json.load(file)
	found = {}
	# in the order of registration; they ran in random order
	for entry in sorted(data['benchmarks'], key=lambda entry: entry['family_index']):
		if entry.get('run_type') == 'aggregate':
			continue
		method, name = entry['run_name'].removesuffix('/manual_time').split('/', 1)
		name = name.split('/repeats:')[0]
		if 'pair' not in entry:
			raise RuntimeError(f"{method} on {name}: {entry.get('error_message', 'no result')}")
		one = found.setdefault(
			(method, name),
			Measurement(
				method, name, [], int(entry['wrong']), pairs, entry.get('pivots', 0), entry.get('iterations', 0), entry.get('contacts', 0)
			),
		)
		one.times.append(1e6 * entry['pair'])
	return found, data['context']
