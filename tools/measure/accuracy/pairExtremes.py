# SPDX-License-Identifier: GPL-2.0-or-later
"""Pairs varied along thirteen axes from easy to extreme: error and status in double against exact arithmetic.

The program polytope_extremes (PairExtremes.cpp) makes the pairs at random (seeded), runs the contact kernel with the paper's model, and
compares its answers with the linear program in rational arithmetic and centre, normal and depth in 150 digits. Here the samples
become one table and one plot per axis. Ends with 1 if an answer is not a number, unbounded, a missed or false contact, or in error beyond
rounding without a status that says so; or if an error is above the limit that docs/accuracy.md states.

	./run python tools/measure/accuracy/pairExtremes.py --quick
	./run python tools/measure/accuracy/pairExtremes.py --axes depth aspect --samples 50
"""

import argparse
import collections
import concurrent.futures
import csv
import os
import pathlib
import subprocess
import sys

import yade
from tqdm import tqdm

sys.path.append(str(pathlib.Path(__file__).resolve().parents[3] / 'examples/paper'))  # boon2012
from boon2012.reporting.findings import Findings
from boon2012.reporting.options import count, existingFile, writableFolder
from boon2012.reporting.script import conclude
from pairAxes import axes
from pairTables import faults, readSamples, summary, summaryColumns, unjudged, worst

# of the build whose plug-in is loaded; `./run` removes it where the sources have changed since
program = pathlib.Path(yade.config.prefix).parent / 'tools/measure/accuracy/polytope_extremes'


def options(arguments=None):
	parser = argparse.ArgumentParser(description=__doc__.splitlines()[0], formatter_class=argparse.ArgumentDefaultsHelpFormatter)
	parser.add_argument('--quick', action='store_true', help='two samples a point, none of bodies with very many planes')
	parser.add_argument('--samples', type=count, help='pairs of each kind at each value (default: 10, with --quick 2)')
	parser.add_argument('--axes', nargs='+', choices=list(axes), default=list(axes), metavar='AXIS', help=f'of {", ".join(axes)}')
	parser.add_argument('--jobs', type=count, default=len(os.sched_getaffinity(0)), help='axes at a time')
	parser.add_argument(
		'--program', type=existingFile, default=program, help='polytope_extremes, as built by ./run build polytope_extremes'
	)
	parser.add_argument('--output', type=writableFolder, default=pathlib.Path('output/pairExtremes'), help='folder for all files')
	given = parser.parse_args(arguments)
	given.samples = given.samples or (2 if given.quick else 10)
	return given


def sampled(given):
	"""{axis: samples}; the CSV files of the program stay in the folder."""
	folder = given.output / 'samples'
	folder.mkdir(parents=True, exist_ok=True)

	def sample(name):
		command = [given.program, *(['--quick'] if given.quick else []), str(given.samples), name]
		with open(folder / f'{name}.csv', 'w') as file:
			subprocess.run(command, stdout=file, check=True)
		return name, readSamples(folder / f'{name}.csv')

	with concurrent.futures.ThreadPoolExecutor(given.jobs) as pool:
		waiting = [pool.submit(sample, name) for name in given.axes]
		done = dict(future.result() for future in tqdm(concurrent.futures.as_completed(waiting), total=len(waiting)))
	return {name: done[name] for name in given.axes}


def report(findings, name, samples):
	"""One axis: rows, table."""
	axis = axes[name]
	found = faults(samples)
	worstOf = '; '.join(
		f'{what}: {len(bad)}, such as {bad[0].kind} {bad[0].value:g} #{bad[0].sample:g}' for what, bad in found.items() if bad
	)
	findings.row(
		f'{axis.title}: answers that are wrong without a status',
		sum(map(len, found.values())),
		f'of {len(samples)}',
		accept=(0, 0),
		note=worstOf or 'no NaN, nothing unbounded, missed, false or beyond rounding',
	)
	unseen = collections.Counter(s.status for s in unjudged(samples))
	findings.row(
		f'{axis.title}: share of answers whose errors are not judged',
		sum(unseen.values()) / len(samples),
		accept=(0, axis.unjudged),
		note='; '.join(f'{count} {what}' for what, count in unseen.items()),
	)
	for limit in axis.limits:
		most, least = worst(samples, limit)
		if limit.least:
			findings.row(f'{axis.title}: {limit.text}', least, accept=(limit.least, limit.most))
		else:
			findings.row(f'{axis.title}: {limit.text}, worst', most, accept=(0, limit.most))
	findings.text(f'{axis.title}. {axis.note}')
	findings.table(
		name,
		f'{axis.title}; value: {axis.label}; errors of point over the overlap’s own size, of lengths over the size',
		summaryColumns,
		summary(samples),
	)


def transitions(findings, given):
	"""Jumps where a pair is pressed in deeper than its corner radius: the status changes there."""
	path = given.output / 'samples' / 'transitions.csv'
	with open(path, 'w') as file:
		subprocess.run([given.program, '--transitions', str(given.samples)], stdout=file, check=True)
	with open(path, newline='') as file:
		found = list(csv.DictReader(file))
	groups = collections.defaultdict(list)
	for row in found:
		groups[row['kind'], row['from'], row['to']].append(row)

	def largest(name, rows=found):
		return max(float(row[name]) for row in rows)

	title = 'Status changes at the corner radius (paper)'
	findings.row(f'{title}: jump of the contact point over the size', largest('point'), accept=(0, 1e-13))
	findings.row(
		f'{title}: turn of the normal (chord of the unit vectors)', largest('normal'), note='the model’s own: deep points lack a normal'
	)
	findings.row(f'{title}: change of depth, relative', largest('depth'))
	findings.table(
		'transitions',
		'Body 2 pressed into body 1: largest jumps where the status changes (bisected to rounding)',
		[
			'pair',
			'from',
			'to',
			'times',
			'from overlap over corner radius',
			'to',
			'turn of the normal',
			'change of depth',
			'way of the point',
		],
		[
			[*key, len(rows), *(f'{pick(float(row["overlap"]) for row in rows):.3g}' for pick in (min, max))]
			+ [f'{largest(name, rows):.3g}' for name in ('normal', 'depth', 'point')]
			for key, rows in groups.items()
		],
	)


def main(arguments=None):
	given = options(arguments)
	findings = Findings('pairs', 'Pairs at the extremes', given.output, {'samples': given.samples, 'quick': given.quick})
	findings.text(
		'Each mark stands for all samples of a kind of pair in random orientations. The references take the input’s doubles as they stand: the '
		'linear program is solved in rational arithmetic, the centre, the normal and the depth '
		'in 150 digits. Lengths are over the size, the smaller circumradius; the contact point’s error is in the local norm of the '
		'barrier, where 1 is about the overlap’s own size in that direction.'
	)
	for name, samples in sampled(given).items():
		report(findings, name, samples)
		if name == 'deep':
			transitions(findings, given)
	return conclude(findings)


if __name__ == '__main__':
	sys.exit(main())
