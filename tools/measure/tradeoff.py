# SPDX-License-Identifier: GPL-2.0-or-later
"""Accuracy for speed in the paper's scenes: what contact model, time step, stiffness and arithmetic cost, and the error of the answer that matters.

The program behind `./run tradeoff`. Scenes: pair (contact forces, against the finest arithmetic), B (peak load), C and D (critical friction angles),
F (energy after collisions), rest (where a cube comes to rest), A (a heap's coordination number, against the mean over seeds). With each contact model one
setting at a time is changed. Out of it come a table on screen, summary.csv and a table for each scene.

	./run tradeoff                   # all: some 25 minutes
	./run tradeoff --quick           # fewer settings: some minutes
	./run tradeoff --only B pair     # these scenes
"""

import argparse
import csv
import dataclasses
import json
import math
import os
import pathlib
import sys
import tempfile

letters = ('pair', 'B', 'C', 'D', 'F', 'rest', 'A')


def options(arguments=None):
	parser = argparse.ArgumentParser(prog='./run tradeoff', description=__doc__.splitlines()[0])
	parser.add_argument('--quick', action='store_true', help='fewer settings, and no other arithmetic than double')
	parser.add_argument('--only', nargs='+', choices=letters, default=letters, metavar='SCENE', help=f'of {", ".join(letters)}')
	parser.add_argument(
		'--output', type=pathlib.Path, help='folder for all files (default: output/tradeoff, with --quick output/tradeoff-quick)'
	)
	# for ./run: only reads the options; prints the builds that this run asks for
	parser.add_argument('--check', action='store_true', help=argparse.SUPPRESS)
	parser.add_argument('--precisions', action='store_true', help=argparse.SUPPRESS)
	given = parser.parse_args(arguments)
	given.output = (given.output or pathlib.Path('output/tradeoff-quick' if given.quick else 'output/tradeoff')).resolve()
	try:
		given.output.mkdir(parents=True, exist_ok=True)
		tempfile.TemporaryFile(dir=given.output).close()
	except OSError as error:
		parser.error(f'--output: cannot write to {given.output}: {error.strerror}; name a folder that files can be written to')
	return given


if __name__ == '__main__':  # before YADE is loaded, or even built
	given = options()
	if given.check:
		sys.exit()

os.environ.setdefault('OMP_NUM_THREADS', '1')  # read when YADE is loaded, here and in the processes

import numpy as np
import tradeoffScenes as scenes  # from where boon2012 is found
from boon2012.beam.theory import BeamBetweenWalls
from boon2012.reporting.origin import origin
from boon2012.reporting.report import endOnTerm
from boon2012.slidingWedge.study import limitEquilibrium
from tabulate import tabulate
from tradeoffScenes import models
from yade.polytope import _builds, tradeoff

wide = tuple(name for name in _builds.precisions if name != 'double')
leftOutWhenQuick = ('× 0.5', '× 0.1', *wide, 'seed 4', 'seed 5', 'seed 6')


@dataclasses.dataclass
class Scene:
	"""*answer*: what is measured. *truth*: the closed form; None: there is none. *varied*: name → change. *timedSeconds*: of polytope.tradeoff."""

	title: str
	build: object
	measure: object
	varied: dict
	answer: str
	truth: float = None
	timedSeconds: float = 0.3

	def settings(self, quick):
		"""Each contact model as it is and with one thing changed; wider arithmetic where it is built."""
		varied = {name: change for name, change in self.varied.items() if name not in wide or _builds.available(name)}
		if quick:
			varied = {name: change for name, change in varied.items() if not name.endswith(leftOutWhenQuick)}
		each = {
			f'{model}{", " * bool(name)}{name}': {'model': model, **change}
			for model in models
			for name, change in {'': {}, **varied}.items()
		}
		return {name: change for name, change in each.items() if 'seed' not in change or change['model'] == models[0]}


arithmetic = {name: {'precision': name} for name in wide}
steps = {f'time step × {factor:g}': {'timeStepFactor': factor} for factor in (0.5, 2, 4)}
dynamics = {**steps, **{f'stiffness × {factor:g}': {'stiffness': factor} for factor in (0.1, 10)}}
seeds = {f'seed {seed}': {'seed': seed} for seed in range(2, 7)}


def allScenes():
	"""letter → Scene."""
	wedge = math.degrees(limitEquilibrium(scenes.block('c_sliding_wedge.json')).frictionAngle())
	angle, height = 'critical friction angle [°]', 'height at rest + m g/kₙ [m]'
	return {
		'pair': Scene('Overlapping pairs', scenes.buildPairs, scenes.measurePairs, arithmetic, 'forces of 60 contacts'),
		'B': Scene('Three-hinged beam', scenes.buildBeam, scenes.measureBeam, arithmetic, 'peak load [N]', BeamBetweenWalls().peak()[0]),
		'C': Scene('Sliding wedge', scenes.buildSlidingWedge, scenes.measureSlidingWedge, dynamics, angle, wedge),
		'D': Scene('Roof wedge', scenes.buildRoofWedge, scenes.measureRoofWedge, dynamics, angle, scenes.roofAngle()),
		# afterwards the blocks are apart: the times are those of the run itself
		'F': Scene(
			'Collisions without loss',
			scenes.buildCollision,
			scenes.measureCollision,
			dynamics,
			'energy over that of the fall',
			1.0,
			timedSeconds=0,
		),
		'rest': Scene('Cube at rest (F1)', scenes.buildRest, scenes.measureRest, dynamics, height, 0.5),
		'A': Scene('Heap of 96 solids', scenes.buildHeap, scenes.measureHeap, {**dynamics, **seeds}, 'coordination number'),
	}


def measured(letter, scene, quick):
	"""TradeoffTable of one scene, with errors against the closed form; else of each model against its finest arithmetic, or the mean over seeds."""
	settings = scene.settings(quick)
	table = tradeoff(scene.build, settings, scene.measure, models[0] if scene.truth is None else scene.truth, scene.timedSeconds)
	if letter == 'A':
		answers = [row.answer for row in table if row.answer is not None and (row.name == models[0] or 'seed' in row.name)]
		mean = np.mean(answers)
		print(f'over seeds {mean:.3f} ± {np.std(answers, ddof=1):.3f}: an error below {np.std(answers, ddof=1) / mean:.2g} means nothing')
	for row in table:
		if scene.truth is None and row.answer is not None:
			finest = [other for other in table if other.answer is not None and other.name.startswith(row.name.partition(',')[0])][-1].answer
			true = mean if letter == 'A' else finest
			row.error = float(np.linalg.norm(np.subtract(row.answer, true)) / np.linalg.norm(true))
	return table


def summary(tables):
	"""Rows of the table over all scenes: setting; least, median and largest cost over that of the first setting; error, or why there is
	none, of each scene."""
	names = dict.fromkeys(row.name for table in tables.values() for row in table if 'seed' not in row.name)
	for name in sorted(names, key=lambda name: models.index(name.partition(',')[0])):
		rows = {letter: next((row for row in table if row.name == name), None) for letter, table in tables.items()}
		costs = [row.cost / tables[letter][0].cost for letter, row in rows.items() if row and row.cost]
		cells = [
			'' if row is None else 'blew up' if 'blew up' in row.note else row.note.partition(':')[0] or row.error for row in rows.values()
		]
		yield [name, *((min(costs), float(np.median(costs)), max(costs)) if costs else ('', '', '')), *cells]


def main(given):
	about, known, tables = {**origin(), 'quick': given.quick, 'interrupted': False, 'scenes': list(given.only)}, allScenes(), {}
	for letter in given.only:
		if letter == 'pair' and not any(name.partition(', ')[2] in wide for name in known[letter].settings(given.quick)):
			print('\npair: left out, there is no finer arithmetic than double to compare with')
			continue
		print(f'\n{letter}: {known[letter].title}, {known[letter].answer}', flush=True)
		tables[letter] = measured(letter, known[letter], given.quick)
		tables[letter].show()
		tables[letter].csv(given.output / f'{letter}.csv')
	columns, rows = ['setting', 'cost: least', 'median', 'most', *(f'error {letter}' for letter in tables)], list(summary(tables))
	with open(given.output / 'summary.csv', 'w', newline='') as file:
		csv.writer(file).writerows([columns, *rows])
	(given.output / 'origin.json').write_text(json.dumps({**about, 'scenes': list(tables)}, indent='\t') + '\n')
	print('\nAll scenes: cost over that of the first setting, and error of the answer')
	print(tabulate([[f'{cell:.2g}' if isinstance(cell, float) else cell for cell in row] for row in rows], columns, disable_numparse=True))
	return 1 if any(row.failures for table in tables.values() for row in table) else 0


if __name__ == '__main__':
	endOnTerm()
	if given.precisions:
		print(end=''.join(f'{name}\n' for name in wide if not given.quick and {'pair', 'B'} & set(given.only)))
	else:
		sys.exit(main(given))
