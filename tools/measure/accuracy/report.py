# SPDX-License-Identifier: GPL-2.0-or-later
"""Studies of accuracy, and one report of the results: the program behind `./run accuracy`.

Each script of this folder runs as a program of its own and leaves its findings (boon2012.reporting.findings) in a folder of its own. Out of
these come report.html, with all figures and tables, and results.csv. A study that is complete, of the same source and with the same
options, is not run again; the report shows it whether it was asked for or not. Ends with 1, and says why, if a limit was missed or a script
failed.

	./run accuracy                        # all studies
	./run accuracy --quick                # fewer samples and steps
	./run accuracy --only pairs scenes    # these two
"""

import argparse
import os
import pathlib
import sys

os.environ.setdefault('OMP_NUM_THREADS', '1')  # read when YADE is loaded, here and in the scripts
sys.path.append(str(pathlib.Path(__file__).resolve().parents[3] / 'examples/paper'))  # boon2012

from boon2012.reporting.options import count
from boon2012.reporting.report import endOnTerm, outputFolder, report
from boon2012.reporting.runs import Run, sourceHash

here = scripts = pathlib.Path(__file__).resolve().parent
project = here.parents[2]

studies = {
	'pairs': ('pairExtremes', 'Pairs at the extremes', ('--jobs', '1')),
	'scenes': ('sceneExtremes', 'Scenes at the extremes', ()),
	'path': ('contactPath', 'Path of the contact', ()),
	'surfaces': ('surfaces', 'Floors made of flush pieces', ()),
	'collisions': ('collisionEnergy', 'Energy of collisions', ()),
	'joints': ('joints', 'Blocks and grains with a closed form', ()),
}
"""Name: script, title, options besides --quick and --output."""


def present():
	"""The studies whose scripts are there."""
	return {name: study for name, study in studies.items() if (scripts / f'{study[0]}.py').is_file()}


def options(arguments=None):
	parser = argparse.ArgumentParser(prog='./run accuracy', description=__doc__.splitlines()[0])
	parser.add_argument('--quick', action='store_true', help='fewer samples and steps: minutes')
	parser.add_argument(
		'--only', nargs='+', choices=list(present()), default=list(present()), metavar='NAME', help=f'of {", ".join(present())}'
	)
	parser.add_argument('--fresh', action='store_true', help='run again what is complete already')
	parser.add_argument(
		'--output', type=pathlib.Path, help='folder for all files (default: output/accuracy, with --quick output/accuracy-quick)'
	)
	parser.add_argument('--jobs', type=count, default=len(os.sched_getaffinity(0)), help='studies at a time (default: one a processor)')
	given = parser.parse_args(arguments)
	given.output = outputFolder(parser, given.output or ('output/accuracy-quick' if given.quick else 'output/accuracy'))
	return given


def plannedRuns(given):
	source = sourceHash(project, folders=('src', 'pkg', 'py', 'tests/core', 'tools/measure/accuracy', 'examples/paper/boon2012'))
	quick = ['--quick'] if given.quick else []
	return [
		Run(name, title, scripts / f'{script}.py', given.output / script, [*quick, *extra], source)
		for name, (script, title, extra) in present().items()
	]


def main(arguments=None):
	given = options(arguments)
	return report(plannedRuns(given), given, here / 'accuracy.html.jinja', base=project / 'examples/paper')


if __name__ == '__main__':
	endOnTerm()
	sys.exit(main())
