# SPDX-License-Identifier: GPL-2.0-or-later
"""Accuracy for speed in the paper's scenes: each setting's cost and the error of the answer that matters. The program behind `./run tradeoff`.

Scenes: pair (contact forces), B (peak load), C and D (critical friction angles), F (energy of collisions), rest (where F1's cube comes to
rest), A (a heap's coordination number). In each, one setting at a time of the paper's contact (boon2012) is changed from its default: contact point, contact model,
Newton tolerance, warm start, solver, arithmetic, time step, stiffness. Out of it come a table on screen and as CSV, a Pareto plot for
each scene, and one page, report.html. polytope.tradeoff() does the same for a scene of your own: examples/tradeoff.py.

	./run tradeoff                   # all: some 25 minutes
	./run tradeoff --quick           # fewer settings: four minutes
	./run tradeoff --only B pair     # these scenes
"""

import argparse
import json
import math
import os
import pathlib
import sys
import tempfile

here = pathlib.Path(__file__).resolve().parent
letters = ('pair', 'B', 'C', 'D', 'F', 'rest', 'A')


def options(arguments=None):
	parser = argparse.ArgumentParser(prog='./run tradeoff', description=__doc__.splitlines()[0])
	parser.add_argument('--quick', action='store_true', help='fewer settings, and each timed once')
	parser.add_argument('--only', nargs='+', choices=letters, default=letters, metavar='SCENE', help=f'of {", ".join(letters)}')
	parser.add_argument('--output', type=pathlib.Path, help='folder for all files (default: output/tradeoff, with --quick output/tradeoff-quick)')
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
sys.path.append(str(here.parents[2] / 'examples/paper'))  # boon2012

from boon2012.reporting.origin import origin
from boon2012.reporting.report import endOnTerm
from tradeoffAxes import allScenes, default, scatter
from tradeoffReport import notRun, reportScene, show, summary, writePage, writeSummary
from yade.polytope import tradeoff
from yade.polytope._builds import precisions


def printPrecisions(given):
	"""Those that the settings name. The quick run takes those that are already built."""
	scenes = {} if given.quick else {letter: scene for letter, scene in allScenes().items() if letter in given.only}
	named = {changes.get('precision', 'double') for scene in scenes.values() for changes in scene.settings.values()}
	print(end=''.join(f'{name}\n' for name in precisions if name in named - {'double'}))


def measured(scene, given):
	"""(TradeoffTable of one scene, setting with the finest arithmetic, whether it was interrupted); shows the table."""
	settings = scene.chosen(given.quick)
	finest = scene.numericalReference(settings)
	reference = scene.truth if scene.truth is not None else finest if finest and scene.letter != 'A' else default
	repeats = (1 if given.quick else 2) * (1 if scene.timedSeconds else 3)  # a run's own steps are few
	times = {'repeats': repeats, 'timedSeconds': scene.timedSeconds, 'timeLimit': 60 if given.quick else 240}
	print(f'\n{scene.letter}: {scene.title}, {len(settings)} settings', flush=True)
	interrupted = False
	try:
		table = tradeoff(scene.build, settings, scene.measure, reference, **times)
	except KeyboardInterrupt as interrupt:
		table, interrupted = interrupt.table, True
	mean = scatter(table)[0] if scene.letter == 'A' else math.nan
	if math.isfinite(mean):
		table = table.against(mean)
	if any(row.answer is not None for row in table.rows):
		table.show()
	return table, finest, interrupted


def main(given):
	scenes, began = allScenes(), origin()
	tables, parts, failed, interrupted = {}, [], False, False
	for letter in given.only:
		table, finest, interrupted = measured(scenes[letter], given)
		if any(row.answer is not None for row in table.rows):
			findings, _ = reportScene(scenes[letter], table, given.output / letter, finest)
			failed |= not findings.save()
			tables[letter] = table
			parts.append((scenes[letter], findings))
		if interrupted:
			break
	if interrupted:
		missing = [letter for letter in given.only if letter not in tables]
		print(f'\nInterrupted: what is measured is kept{", not run: " * bool(missing)}{", ".join(missing)}.', file=sys.stderr)
	if interrupted and not tables:
		return 130
	columns, rows = writeSummary(summary(tables, scenes), list(tables), given.output / 'summary.csv')
	about = {**began, 'quick': given.quick, 'interrupted': interrupted, 'scenes': list(tables)}
	(given.output / 'origin.json').write_text(json.dumps(about, indent='\t') + '\n')
	print(f'\nAll scenes: cost over the default\'s, and error of the answer ({notRun}: not run there)')
	show(columns, rows)
	writePage(given.output / 'report.html', parts, columns, rows, pathlib.Path(__file__), given.quick, interrupted)
	print(f'\nReport: {given.output / "report.html"}')
	return 130 if interrupted else 1 if failed else 0


if __name__ == '__main__':
	endOnTerm()
	sys.exit(printPrecisions(given) if given.precisions else main(given))
