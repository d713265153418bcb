# SPDX-License-Identifier: GPL-2.0-or-later
"""Heaps in YADE: ours beside YADE's PotentialBlock, Polyhedra and spheres, growth with the number of bodies, and threads."""

import json
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile

from tqdm import tqdm

here = pathlib.Path(__file__).resolve().parent
solids = {'tetrahedron': 4, 'cube': 6, 'octahedron': 8, 'dodecahedron': 12, 'icosahedron': 20}
peers = {'potentialBlock': 'PotentialBlock', 'polyhedra': 'Polyhedra'}


class SceneFailed(Exception):
	"""A process of heap.py ended without a result; what it printed last says why."""


def resultOf(command, environment, limit=None):
	"""What a process prints after RESULT, within so many seconds."""
	try:
		output = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=limit)
	except subprocess.TimeoutExpired:
		raise SceneFailed(f'no result after {limit} s') from None
	lines = [line for line in output.stdout.splitlines() if line.startswith('RESULT ')]
	if output.returncode or not lines:
		raise SceneFailed(f'exit code {output.returncode}: ' + ' '.join((output.stderr or output.stdout).split('\n')[-4:]))
	return json.loads(lines[-1][len('RESULT ') :])


class Scenes:
	"""Runs heap.py, one process a heap, on one core (two with two threads). A peer that fails is named once, and left out.

	:param plugins: folder with libyadepeer_*.so
	:param quick: fewer bodies and steps
	"""

	def __init__(self, plugins, core, quick, results, note):
		self.plugins, self.core, self.quick, self.results, self.note = pathlib.Path(plugins), core, quick, results, note
		self.steps = 100 if quick else 400

	def run(self, threads=1, **request):
		"""One heap: its measurements, with medians added, also appended to the results."""
		# one thread: pinned
		command = ['taskset', '-c', str(self.core)] if threads == 1 else []
		command += [sys.executable, str(here / 'heap.py'), json.dumps(request)]
		environment = dict(os.environ, OMP_NUM_THREADS=str(threads), YADE_PREFIX=str(self.overlay(request.get('method', 'ours'))))
		limit = 600 if self.quick else 4 * 3600 if request.get('number', 0) >= 1e5 else 3600
		result = resultOf(command, environment, limit)
		rows = result['rows']
		result['perPair'] = [row['loop'] / row['pairs'] for row in rows if row['pairs']]
		result['perContact'] = [row['loop'] / row['contacts'] for row in rows if row['contacts']]
		result['perBody'] = [row['step'] / result['bodies'] for row in rows]
		self.results.append(result)
		return result

	def overlay(self, method):
		"""YADE's library folder as links, as the project's own overlay, with the peer's plug-in in it."""
		prefix = pathlib.Path(os.environ['YADE_PREFIX'])
		library = self.plugins / f'libyadepeer_{method.lower()}.so'
		if method not in peers:
			return prefix
		if not library.exists():
			raise SceneFailed(f'{library.name} was not built')
		overlay = self.plugins / f'overlay-{method}'
		for folder in prefix.glob('lib/**/yade-double'):
			to = overlay / folder.relative_to(prefix)
			to.mkdir(parents=True, exist_ok=True)
			for entry in [*folder.iterdir(), library]:
				link = to / entry.name
				link.unlink(missing_ok=True)
				link.symlink_to(entry.readlink() if entry.is_symlink() else entry)
		return overlay

	def peer(self, method, **request):
		"""Gives what run() gives; None, and a note why, where the peer cannot do it."""
		try:
			return self.run(method=method, **request)
		except SceneFailed as error:
			self.note(f"{peers[method]}, faces {request.get('faces')}, {request.get('number')} bodies: {error}")
			return None

	# ------------------------------------------------------------------------------------------------------------ groups

	def solids(self):
		"""A heap of 200 of each solid, in motion among the walls: {solid: {method: result}}."""
		found = {}
		with tempfile.TemporaryDirectory() as folder:
			for name, faces in tqdm(solids.items(), desc='heaps of 200'):
				state = f'{folder}/{name}.npz'
				heap = {'faces': [faces], 'number': 200, 'steps': self.steps}
				found[name] = {'ours': self.run(settle=2500, save=state, **heap)}
				found[name]['ours, with area'] = self.run(settle=20, load=state, area=True, **heap)
				for method in peers:
					found[name][method] = self.peer(method, settle=20, load=state, **heap)
		return found

	def contactsOfHeap(self, path):
		"""Writes the contacts of a settled heap of all five solids, for the kernels."""
		self.run(faces=list(solids.values()), number=300, columns=7, settle=4000, steps=10, pairs=str(path))
		return path

	@property
	def untilAtRest(self):
		"""Steps until a heap of some thousand cubes rests: after 8000 many contacts still slide, after 17 000 almost all are followed (the
		result's *linear*). Spheres rest earlier."""
		return 8000 if self.quick else 17000

	def settledCubes(self):
		"""Settled cubes, and YADE's spheres of the same volume: {method: result}."""
		number, columns = (500, 9) if self.quick else (10000, 30)
		heap = {
			'faces': [6],
			'number': number,
			'columns': columns,
			'compact': True,
			'settle': self.untilAtRest,
			'steps': self.steps,
		}
		return {method: self.run(method=method, **heap) for method in tqdm(('ours', 'spheres'), desc=f'settled heap of {number}')}

	def sizes(self, large):
		"""Settled cubes, and YADE's spheres of the same volume, all engines: {number: {method: result}} twice. First in the run in which
		they have settled: contacts that came and went lie anywhere in memory. Then loaded by a new process, where they lie one after the
		other."""
		numbers = (500,) if self.quick else (2000, 20000, 100000) if large else (2000, 20000)
		settled, loaded = {}, {}
		with tempfile.TemporaryDirectory() as folder:
			for number in tqdm(numbers, desc='settled heaps by size'):
				heap = {'faces': [6], 'number': number, 'columns': round((number / 5.6) ** 0.5), 'compact': True, 'steps': 100}
				states = {method: f'{folder}/{number}-{method}.npz' for method in ('ours', 'spheres')}
				settled[number] = {method: self.run(method=method, settle=self.untilAtRest, save=state, **heap) for method, state in states.items()}
				# 300 steps: joints and pairs find what a saved state has not
				loaded[number] = {method: self.run(method=method, settle=300, load=state, **heap) for method, state in states.items()}
		return settled, loaded

	def extras(self):
		"""The settled cubes once more from the same state, with optional features: {what: result}."""
		number, columns = (500, 9) if self.quick else (2000, 18)
		with tempfile.TemporaryDirectory() as folder:
			state = f'{folder}/settled.npz'
			heap = {'faces': [6], 'number': number, 'columns': columns, 'compact': True, 'steps': self.steps}
			self.run(settle=self.untilAtRest // 2, save=state, **dict(heap, steps=10))
			asked = {
				'nothing': {},
				'contact area': {'area': True},
				'stiffness per area': {'perArea': True},
				'energies (O.trackEnergy)': {'energy': True},
				"boxes of balls (YADE's own collider)": {'ballBoxes': True},
				'recorder every 100 steps': {'recorder': f'{folder}/vtk-'},
			}
			# the saved state has no shear forces: the cubes slide again until they have
			return {
				name: self.run(settle=self.untilAtRest // 2, load=state, **request, **heap)
				for name, request in tqdm(asked.items(), desc='what is asked for')
			}

	def growth(self):
		"""Heaps of as many layers on ever larger floors: {number: result}; and Polyhedra's memory, {number: result}."""
		numbers = (200, 2000) if self.quick else (200, 2000, 20000, 100000)
		found, memory = {}, {}
		with tempfile.TemporaryDirectory() as folder:
			for number in tqdm(numbers, desc='growth'):
				heap = {
					'faces': [6],
					'number': number,
					'columns': round((number / 5.6) ** 0.5),
					'compact': True,
					'steps': 100 if number < 1e5 else 50,
				}
				state = f'{folder}/{number}.npz'
				# small heaps are over in milliseconds, and processes differ by a third there: the middle one of five
				runs = [self.run(settle=2500, save=state, **heap) for _ in range(5 if number < 10000 else 1)]
				found[number] = sorted(runs, key=lambda run: median(run['perBody']))[len(runs) // 2]
				if number == 2000:
					memory = {
						method: self.run(load=state, settle=1, **dict(heap, steps=10))
						if method == 'ours'
						else self.peer(method, load=state, settle=1, **dict(heap, steps=10))
						for method in ('ours', *peers)
					}
		return found, memory

	def threads(self):
		"""One heap with one thread and with two: {threads: result}."""
		number, columns = (2000, 19) if self.quick else (10000, 42)
		with tempfile.TemporaryDirectory() as folder:
			heap = {'faces': [6], 'number': number, 'columns': columns, 'compact': True, 'steps': self.steps}
			state = f'{folder}/heap.npz'
			self.run(settle=2500, save=state, **dict(heap, steps=10))
			return {threads: self.run(threads=threads, load=state, settle=20, **heap) for threads in tqdm((1, 2), desc='threads')}


def median(values):
	return statistics.median(values) if values else float('nan')


def meanStep(result):
	"""All engines' time of a step [s]; the mean, for what happens in some steps only."""
	return statistics.fmean(row['step'] for row in result['rows'])


def memoryPerBody(result):
	return (result['bodiesBytes'] - result['emptyBytes']) / result['bodies']


def memoryPerContact(result):
	return (result['endBytes'] - result['bodiesBytes']) / max(1, result['contacts'])
