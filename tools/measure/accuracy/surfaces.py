# SPDX-License-Identifier: GPL-2.0-or-later
"""Bodies on floors made of flush pieces: whether they slide, stop, accelerate and rest as on one smooth floor.

All floors, bodies, contacts and both stiffness rules, other speeds, joints at an angle, friction, steps, gaps, impacts, rolling.
Ends with 1 if the default contact misses a limit; the paper's is shown beside it. With --floor one crossing alone, in one line.

	./run python tools/measure/accuracy/surfaces.py             # a quarter of an hour
	./run python tools/measure/accuracy/surfaces.py --quick     # fewer floors, bodies and speeds: two minutes
	./run python tools/measure/accuracy/surfaces.py --floor plates --body cube --speed 1
	./run python tools/measure/accuracy/surfaces.py --floor facets --contact contactModel=boon2012 --per-area
"""

import argparse
import dataclasses
import os
import pathlib
import sys
import time

os.environ.setdefault('OMP_NUM_THREADS', '1')  # read when YADE is loaded; one body is too few for more

sys.path.append(str(pathlib.Path(__file__).resolve().parents[3] / 'examples/paper'))  # boon2012
from boon2012.reporting.findings import Findings
from boon2012.reporting.options import count, number, positive, writableFolder
from boon2012.reporting.script import conclude
from surfaceStudy.flatBodies import bodyKinds
from surfaceStudy.floors import floorKinds
from surfaceStudy.measures import cross
from surfaceTables import SurfaceStudy


def attribute(text):
	"""NAME=VALUE of a contact functor."""
	name, found, value = text.partition('=')
	if not found:
		raise argparse.ArgumentTypeError(f'must be NAME=VALUE, got {text!r}')
	try:
		return name, float(value)
	except ValueError:
		return name, {'True': True, 'False': False}.get(value, value)


def options(arguments=None):
	parser = argparse.ArgumentParser(description=__doc__.splitlines()[0], formatter_class=argparse.ArgumentDefaultsHelpFormatter)
	parser.add_argument('--quick', action='store_true', help='fewer floors, bodies and speeds')
	parser.add_argument('--output', type=writableFolder, default=pathlib.Path('output/accuracy/surfaces'), help='folder for all files')
	one = parser.add_argument_group('one crossing')
	one.add_argument('--floor', choices=list(floorKinds), default=None, help='only this crossing; the options below are its own')
	one.add_argument('--body', choices=list(bodyKinds), default='cube')
	one.add_argument('--contact', type=attribute, nargs='*', default=[], metavar='NAME=VALUE', help='attributes of the contact functors')
	one.add_argument('--per-area', action='store_true', help='stiffness per area instead of per contact')
	one.add_argument('--speed', type=positive, default=1.0, help='[m/s]')
	one.add_argument('--seams', type=count, default=3)
	one.add_argument('--spacing', type=positive, default=1.0, help='of the joints [m]')
	one.add_argument('--angle', type=number(above=0, most=90), default=90.0, help='between joints and motion [°]')
	one.add_argument('--edge', choices=('front', 'back'), help='this edge of the body crosses the first joint, no more (for low speeds)')
	return parser.parse_args(arguments)


def oneCrossing(given):
	begun = time.time()
	result = cross(
		given.floor, given.body, dict(given.contact), given.per_area, given.speed, given.seams, given.spacing, given.angle, given.edge
	)
	words = ' '.join(f'{name} {value:.5g}' for name, value in dataclasses.asdict(result).items())
	rule = 'per area' if given.per_area else 'per contact'
	print(f'{given.floor} {given.body} {dict(given.contact)} {rule}: {words} ({time.time() - begun:.1f} s)')
	return 0


def main(arguments=None):
	given = options(arguments)
	if given.floor:
		return oneCrossing(given)
	findings = Findings('surfaces', 'Floors made of flush pieces', given.output, {'quick': given.quick})
	study = SurfaceStudy(findings, given.quick)
	study.crossings()
	study.others()
	return conclude(findings)


if __name__ == '__main__':
	sys.exit(main())
