#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Speed of the contact query and of whole scenes beside other libraries and YADE's own shapes (`./run bench`).

Prints one table with target, ours, peer, ratio, and whether the target is met; writes raw results and pictures. Every ratio
is of two measurements of this run, on one pinned core, medians of repetitions in random order. Absolute times mean
something on a machine that does nothing else.
"""

import argparse
import csv
import dataclasses
import datetime
import json
import math
import os
import pathlib
import platform
import statistics
import subprocess
import sys

import beside
import kernels
import memory
import plots
import results
import scale
import scenes
import shapes
import targets
from tabulate import tabulate

here = pathlib.Path(__file__).resolve().parent
groups = ('kernels', 'shapes', 'results', 'scenes', 'sizes', 'scale', 'growth', 'threads')
outputs = (
	'results.json',
	'results.txt',
	'targets.csv',
	'heaps.csv',
	'kernels.csv',
	'kernels.json',
	'kernels.log',
	'heap-contacts.csv',
	'cost-against-planes.png',
)


def arguments():
	parser = argparse.ArgumentParser(prog='./run bench', description=__doc__.split('\n\n')[1].replace('\n', ' '))
	parser.add_argument('--quick', action='store_true', help='smaller heaps, fewer pairs and repetitions: some minutes')
	parser.add_argument('--large', action='store_true', help='settled heaps of 100 000 bodies, and a million bodies, as well: some hours')
	parser.add_argument('--only', choices=groups, help='one group of measurements alone')
	parser.add_argument(
		'--beside',
		metavar='FOLDER',
		type=pathlib.Path,
		help='only whole steps of settled heaps and of a slope, beside another checkout that is built: an hour',
	)
	parser.add_argument('--output', metavar='DIR', help='where results and pictures go (default: output/bench, -quick, -GROUP, -beside)')
	parser.add_argument('--check', action='store_true', help=argparse.SUPPRESS)  # ./run's: only check the options
	parser.add_argument('--programs', required=True, help=argparse.SUPPRESS)  # ./run gives it: folder of what was built
	options = parser.parse_args()
	group = 'beside' if options.beside else options.only
	options.output = options.output or 'output/bench' + '-quick' * options.quick + (f'-{group}' if group else '')
	if options.beside:
		if options.only:
			parser.error('--beside measures a group of its own: leave out --only')
		options.beside = options.beside.resolve()
		try:
			beside.overlayOf(options.beside)
		except ValueError as error:
			parser.error(str(error))
	try:
		pathlib.Path(options.output).mkdir(parents=True, exist_ok=True)
	except OSError as error:
		parser.error(f'--output: cannot make the folder: {error}')
	return options


def output(*command):
	result = subprocess.run(command, capture_output=True, text=True)
	return result.stdout.strip() if result.returncode == 0 else ''


def gitOf(checkout):
	return ('git', '-c', f'safe.directory={checkout}', '-C', str(checkout))


def machine(programs):
	"""Machine, compiler and revision that the results belong to."""
	with open('/proc/cpuinfo') as file:
		models = [line.split(':', 1)[1].strip() for line in file if line.startswith('model name')]
	git = gitOf(here.parents[2])
	built = pathlib.Path(programs).parents[2]
	with open(built / 'compile_commands.json') as file:
		flags = [
			entry['command'].split(' -o ')[0] for entry in json.load(file) if entry['file'].endswith(('/ContactQuery.cpp', '/Kernels.cpp'))
		]
	return {
		'date': datetime.datetime.now(datetime.UTC).isoformat(timespec='seconds'),
		'revision': output(*git, 'rev-parse', 'HEAD'),
		'changed': bool(output(*git, 'status', '--porcelain', '--untracked-files=no')),
		'revisionDate': output(*git, 'show', '-s', '--format=%cI', 'HEAD'),
		'processor': models[0] if models else platform.processor(),
		'cores': os.cpu_count(),
		'system': platform.platform(),
		'compiler': output('c++', '--version').split('\n')[0],
		'flags': flags,
		'loadAverage': os.getloadavg(),
		'python': platform.python_version(),
	}


def writeCsv(path, rows):
	if rows:
		with open(path, 'w', newline='') as file:
			writer = csv.DictWriter(file, rows[0].keys())
			writer.writeheader()
			writer.writerows(rows)


def kernelGroup(run):
	heap = run.scenes.contactsOfHeap(run.output / 'heap-contacts.csv')
	found, context = kernels.run(run.programs, run.core, run.quick, run.output, heap)
	run.results['kernels'] = {
		'context': context,
		'measurements': [dict(dataclasses.asdict(one), median=one.median, spread=one.spread) for one in found.values()],
	}
	run.results['machine']['instructionSet'] = context['instruction set']
	writeCsv(
		run.output / 'kernels.csv',
		[
			{
				'method': one.method,
				'set': one.set,
				'µs': one.median,
				'spread': one.spread,
				'wrong': one.wrong,
				'pairs': one.pairs,
				'pivots': one.pivots,
				'iterations': one.iterations,
				'contacts': one.contacts,
			}
			for one in found.values()
		],
	)
	methods = list(dict.fromkeys(one.method for one in found.values()))
	sets = list(dict.fromkeys(one.set for one in found.values()))
	show = [method for method in methods if not any(word in method for word in ('centroid', 'Chebyshev', 'outline', 'energy'))]

	def cell(method, name):
		one = found.get((method, name))
		return '' if one is None else f'{one.median:.3f} ±{100 * one.spread:.0f}%' + (f' ({one.wrong} wrong)' if one.wrong else '')

	pairs = next(iter(found.values())).pairs
	run.say(f'µs a pair, median ± half the quartiles\' range of the repetitions; wrong answers of {pairs} pairs in brackets:\n')
	run.say(tabulate([[name] + [cell(method, name) for method in show] for name in sets], ['', *show]) + '\n')
	if not any(method.startswith('coal') for method in methods):
		run.note('coal could not be fetched from PyPI: its rows are missing.')
	for name in ('cube', 'icosahedron', 'hull 50'):
		floor = found['one pass', name].median
		text = ', '.join(f'{part} {1000 * cost:.0f} ns ({cost / floor:.1f} passes)' for part, cost in plots.parts(found, name).items())
		run.say(f'{name}: one pass {1000 * floor:.0f} ns; {text}')
	flat, solid = found['ours warm', 'squares, 2-D'].median, found['ours warm', 'cube'].median
	run.say(f'two dimensions instead of three: squares {1000 * flat:.0f} ns, cubes {1000 * solid:.0f} ns, warm\n')
	plots.costAgainstPlanes(found, run.output / 'cost-against-planes.png')
	return targets.kernelRows(found)


def shapeGroup(run):
	found = shapes.run(run.core, run.quick)
	run.results['shapes'] = found
	run.say(
		tabulate([[name, cost] for name, cost in found['microseconds'].items()], ['bodies made, blocks cut', 'µs each'], floatfmt='.1f')
		+ '\n'
	)
	return targets.shapeRows(found)


def resultGroup(run):
	found = results.run(run.core, run.quick)
	run.results['results'] = found
	run.say(
		f"{found['bodies']} bodies, {found['contacts']} contacts among {found['pairs']} pairs, saved in {found['bytes'] / 1e6:.0f} MB, "
		f"by a checkpoint in {found['checkpointBytes'] / 1e6:.0f} MB; {found['spheres']['contacts']} contacts of spheres\n"
	)
	names = ('arrays', 'snapshot', 'bodySnapshot', 'picture', 'save', 'load', 'checkpoint', 'loadCheckpoint')
	rows = [[name, found[name]['processor'], found[name]['clock']] for name in names]
	run.say(tabulate(rows, ['', 'processor, s', 'clock, s'], floatfmt='.3f') + '\n')
	used = memory.run(run.core, run.quick)
	run.results['memory'] = used
	return targets.resultRows(found) + targets.memoryRows(used)


def describe(run, heaps):
	"""Table of heaps: pairs, contacts, µs."""

	def row(name, one):
		low, high = min(one['perPair']), max(one['perPair'])
		return [
			name,
			one['request']['method'] + (' with area' if one['request']['area'] else ''),
			one['bodies'],
			one['threads'],
			one['pairs'],
			one['contacts'],
			1e6 * scenes.median(one['perPair']),
			f'{1e6 * low:.3f} … {1e6 * high:.3f}',
			1e6 * scenes.median(one['perContact']),
			1e6 * scenes.median(one['perBody']),
		]

	head = ['', 'method', 'bodies', 'threads', 'pairs', 'contacts', 'µs/pair', 'range', 'µs/contact', 'µs/body and step']
	run.say(tabulate([row(name, one) for name, one in heaps if one], head, floatfmt='.3f') + '\n')


def sceneGroup(run):
	heaps = run.scenes.solids()
	settled = run.scenes.settledCubes()
	describe(
		run,
		[(name, one) for name, methods in heaps.items() for one in methods.values()]
		+ [('settled cubes, spheres', one) for one in settled.values()],
	)
	showExtras(run)
	return targets.sceneRows(heaps) + targets.settledRows(settled)


def showExtras(run):
	"""Features that are off cost nothing; their cost where they are on."""
	found = run.scenes.extras()
	costs = {name: 1e6 * scenes.meanStep(one) for name, one in found.items()}
	without = costs['nothing']
	run.results['features'] = {'bodies': found['nothing']['bodies'], 'microseconds': costs}
	rows = [
		[name, found[name]['pairs'], found[name]['linear'], cost, cost - without, 100 * (cost / without - 1)] for name, cost in costs.items()
	]
	head = [f"asked for ({found['nothing']['bodies']} settled cubes)", 'pairs', 'followed', 'µs/step', 'more', '%']
	run.say(tabulate(rows, head, floatfmt=('', '', '.2f', '.0f', '+.0f', '+.1f')) + '\n')


def sizeGroup(run):
	settled, loaded = run.scenes.sizes(run.large)
	for name, found in (('', settled), (', loaded', loaded)):
		describe(run, [(method + name, one) for methods in found.values() for method, one in methods.items()])
		run.say(engineTable('settled bodies' + name, found) + '\n')
	if not run.large:
		run.note('sizes without --large: heaps of 100 000 are left out.')
	return targets.sizeRows(settled, loaded)


def engineTable(title, found):
	"""What each engine takes, {number: {method: result}}."""
	rows = []
	for number, methods in found.items():
		each = {
			method: {name: [row['engines'][name] for row in one['rows']] for name in one['rows'][0]['engines']}
			for method, one in methods.items()
		}
		# ours first; the collider of the spheres is YADE's own
		for (name, ours), (peer, spheres) in zip(each['ours'].items(), each['spheres'].items(), strict=True):
			cost = [1e6 * statistics.fmean(times) / methods[method]['bodies'] for method, times in (('ours', ours), ('spheres', spheres))]
			# a collider that had nothing to do took no time
			rows.append([number, name if name == peer else f'{name}, {peer}', *cost, cost[0] / cost[1] if cost[1] else None])
	return tabulate(rows, [title, 'engine', 'cubes, µs/body and step', 'spheres', 'ratio'], floatfmt='.3f')


def scaleGroup(run):
	found = scale.measure(run.quick, run.large)
	run.results['scale'] = found
	for one in found['bodies']:
		run.say(
			f"{one['bodies']} flying bodies: {one['before']:.2f} µs a body and step, {one['after']:.2f} after loading; {one['seconds']:.0f} s and {one['gigabytes']:.2f} GB in all"
		)
	for workers, seconds in found['workers'].items():
		run.say(f"{found['cubes']} cubes, {workers} worker processes and rank 0: {1e3 * seconds:.1f} ms a step")
	run.say('')
	if not run.large:
		run.note('scale without --large: a million bodies are left out.')
	return targets.scaleRows(found)


def growthGroup(run):
	found, memory = run.scenes.growth()
	describe(run, [('cubes', one) for one in found.values()])
	for name, one in memory.items():
		if one:
			run.say(f'memory, 2000 cubes, {name}: {scenes.memoryPerBody(one):.0f} B a body, {scenes.memoryPerContact(one):.0f} B a contact')
	run.say('')
	if run.quick:
		run.note('--quick leaves out heaps of 20 000 and 100 000: those are what growth is about.')
	return targets.growthRows(found, memory)


def threadGroup(run):
	found = run.scenes.threads()
	describe(run, [('cubes', one) for one in found.values()])
	return targets.threadRows(found)


def besideGroup(run):
	found = []
	try:
		for one in beside.measure(run.beside, run.core, run.quick):
			found.append(one)
	except KeyboardInterrupt:
		run.note('interrupted: scenes that were not measured are left out.')
	except scenes.SceneFailed as error:
		run.note(f'not all scenes were measured: {error}')
	revision = output(*gitOf(run.beside), 'rev-parse', 'HEAD')[:8]
	run.results['beside'] = {'revision': revision, 'scenes': found}
	rows = [
		[name, both['other']['perBody'], both['ours']['perBody'], both['other']['contacts'], both['ours']['contacts']] for name, both in found
	]
	head = ['µs a body and step', revision, 'this revision', 'contacts there', 'here']
	run.say(tabulate(rows, head, floatfmt=('', '.3f', '.3f', '.0f', '.0f')) + '\n')
	return targets.besideRows(found, revision)


class Run:
	"""State of one run: options, messages, results."""

	def __init__(self, options):
		self.programs, self.quick, self.large, self.core = options.programs, options.quick, options.large, os.cpu_count() - 1
		self.output, self.beside = pathlib.Path(options.output).resolve(), options.beside
		for name in outputs:  # of an earlier run, which may have measured more
			(self.output / name).unlink(missing_ok=True)
		self.text, self.notes = [], []
		self.results = {'quick': options.quick, 'machine': machine(options.programs), 'heaps': []}
		self.scenes = scenes.Scenes(options.programs, self.core, options.quick, self.results['heaps'], self.note)

	def say(self, text):
		print(text, flush=True)
		self.text.append(text)

	def note(self, text):
		self.notes.append(text)


def main():
	options = arguments()
	if options.check:
		return 0
	run = Run(options)
	about = run.results['machine']
	run.say(
		f"{about['processor']}, {about['cores']} cores; {about['compiler']}; revision {about['revision'][:12]}{' with changes' if about['changed'] else ''}"
	)
	load = about['loadAverage'][0]
	if load > 0.5:
		run.note(
			f'the machine was busy when this began (load {load:.1f} on {about["cores"]} cores): absolute times are unsure, ratios noisy.'
		)
	rows, measured, interrupted = [], [], False
	everyGroup = (kernelGroup, shapeGroup, resultGroup, sceneGroup, sizeGroup, scaleGroup, growthGroup, threadGroup)
	chosen = [('beside', besideGroup)] if options.beside else zip(groups, everyGroup, strict=True)
	for name, group in chosen:
		if options.beside or options.only in (None, name):
			print(f'\n{name}', flush=True)
			try:
				rows += [dict(group=name, **dataclasses.asdict(row)) for row in group(run)]
				measured.append(name)
			except KeyboardInterrupt:
				interrupted = True
				run.note(f'interrupted in {name}: the results are those of what was measured before.')
				break
	table = [
		[
			row['measure'],
			row['target'],
			row['ours'],
			row['peer'],
			'' if math.isnan(row['ratio']) else f"{row['ratio']:.3g}",
			{True: 'yes', False: 'NO', None: ''}[row['met']],
		]
		for row in rows
	]
	run.say(tabulate(table, ['measure', 'target', 'ours', 'peer', 'ratio', 'met'], disable_numparse=True))
	judged = [row for row in rows if row['met'] is not None]
	run.say(f'\n{sum(row["met"] for row in judged)} of {len(judged)} targets met')
	for note in run.notes:
		run.say('Note: ' + note)
	run.results.update(groups=measured, targets=rows, notes=run.notes)
	(run.output / 'results.json').write_text(json.dumps(run.results, indent='\t', ensure_ascii=False, default=float).replace('NaN', 'null'))
	(run.output / 'results.txt').write_text('\n'.join(run.text) + '\n')
	writeCsv(run.output / 'targets.csv', rows)
	writeCsv(
		run.output / 'heaps.csv',
		[
			{
				**{key: value for key, value in one['request'].items() if key not in ('save', 'load', 'pairs')},
				'threads': one['threads'],
				**{key: value for key, value in row.items() if key != 'engines'},
				'bodies': one['bodies'],
				'largestSpeed': one['largestSpeed'],
				'bytesPerBody': scenes.memoryPerBody(one),
				'bytesPerContact': scenes.memoryPerContact(one),
			}
			for one in run.results['heaps']
			for row in one['rows']
		],
	)
	print(f'Results and pictures: {run.output}')
	return 130 if interrupted else 0


if __name__ == '__main__':
	sys.exit(main())
