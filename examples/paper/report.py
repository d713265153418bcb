# SPDX-License-Identifier: GPL-2.0-or-later
"""The six simulations of Boon, Houlsby & Utili (2012), and one report of the results: the program behind `./run paper`.

Each script of this folder runs as a program of its own and leaves its findings (boon2012.reporting.findings) in a folder of its
own. Out of these come report.html, with all figures and tables, and results.csv, with all rows paper / closed form / ours.
A simulation that is complete, of the same source and with the same options, is not run again: an interrupted call goes on
where it stopped. Ends with 1, and says why, if a row that must hold was missed or a script failed.

	./run paper                      # all six
	./run paper --quick              # short variants with the same tolerances
	./run paper --only AC --fresh    # these two, anew
"""

import argparse
import os
import pathlib
import sys

os.environ.setdefault('OMP_NUM_THREADS', '1')  # read when YADE is loaded, here and in the scripts

from boon2012.reporting.options import count
from boon2012.reporting.report import endOnTerm, outputFolder, report
from boon2012.reporting.runs import Run, sourceHash

here = scripts = pathlib.Path(__file__).resolve().parent

simulations = {
	'A': ('a_falling_polyhedra', 'Falling polyhedra', ('--seeds', '8')),
	'B': ('b_three_hinged_beam', 'Three-hinged beam', ()),
	'C': ('c_sliding_wedge', 'Sliding wedge', ()),
	'D': ('d_roof_wedge', 'Roof wedge', ()),
	'E': ('e_slumping_slope', 'Slope with non-daylighting joints', ()),
	'F': ('f_collisions', 'Vertex–face and edge–edge collisions', ()),
}
"""Letter: script, title, options of the full run besides --output; the quick one's are --quick alone."""

ofTheReport = [pathlib.Path('examples/paper') / name for name in ('report.py', 'report.html.jinja')]
ofTheReport += [pathlib.Path('examples/paper/boon2012/reporting') / name for name in ('page.py', 'runs.py', 'report.py')]
"""What no simulation depends on."""


def options(arguments=None):
	parser = argparse.ArgumentParser(prog='./run paper', description=__doc__.splitlines()[0])
	parser.add_argument('--quick', action='store_true', help='short variants, with the same tolerances')
	parser.add_argument('--only', metavar='LETTERS', default=''.join(simulations), help='of the simulations to run and report, e.g. ACF')
	parser.add_argument('--fresh', action='store_true', help='run again what is complete already')
	parser.add_argument('--output', type=pathlib.Path, help='folder for all files (default: output/paper, with --quick output/paper-quick)')
	parser.add_argument('--jobs', type=count, default=1, help='simulations at a time (default: 1); more disturb the times that A measures')
	given = parser.parse_args(arguments)
	given.only = given.only.upper()
	unknown = sorted(set(given.only) - set(simulations))
	if unknown or not given.only:
		parser.error(f'--only {given.only!r}: the simulations are {", ".join(simulations)}')
	given.output = outputFolder(parser, given.output or ('output/paper-quick' if given.quick else 'output/paper'))
	return given


def plannedRuns(given):
	source = sourceHash(here.parents[1], ofTheReport)
	runs = []
	for letter, (name, title, extra) in simulations.items():
		chosen = ['--quick'] if given.quick else [*extra]
		runs.append(Run(letter, title, scripts / f'{name}.py', given.output / name, chosen, source))
	return runs


def main(arguments=None):
	given = options(arguments)
	return report(plannedRuns(given), given, here / 'report.html.jinja')


if __name__ == '__main__':
	endOnTerm()
	sys.exit(main())
