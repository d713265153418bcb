# SPDX-License-Identifier: GPL-2.0-or-later
"""Simulation E of Boon, Houlsby & Utili (2012): a slope whose joints do not daylight fails as its outer layer turns backward (Fig. 11).

Blocks between bedding that dips as the face and cross joints that dip into the slope; base and back are fixed. No block can slide out,
even without friction. The script settles the slope, lowers the friction angle until a block has moved by more than 0.1 m, and finds
the angle at which that happens; it then lets the slope fail and counts the types of contacts on the way. Beside it stands a limit
analysis (static theorem, linear program) with its mechanism: 19.75° for the geometry given here, the outer layer alone, its
lower five blocks turning backward as one. Expected: a failure between 19° and 22.5°, by the same mechanism.
Ends with 1 if the angle, the mode or the analysis is not as expected, or a contact query had no answer.

	./run python examples/paper/e_slumping_slope.py            # two minutes, most of them for the table of other settings
	./run python examples/paper/e_slumping_slope.py --quick    # coarser steps, no table; half a minute
	./run python examples/paper/e_slumping_slope.py --geometry other.json --corner-radius 0.01 --steps 1 0.2 --output other

A geometry file has corners of polygons: {"free": [[[x, y], …], …], "fixed": […], "params": {"delta": dip [°], "s": bedding spacing [m]}}.
The toe must be on the left, and the face must point to the left.
"""

import math
import os
import sys

os.environ.setdefault('OMP_NUM_THREADS', '1')  # read when YADE is loaded; thirty bodies are too few for more
if __name__ == '__main__':  # `yade`, unlike `python`, does not search the script's folder for modules
	sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))

from boon2012.reporting.findings import Findings
from boon2012.reporting.options import (
	Decreasing,
	angle,
	contactPoints,
	count,
	fraction,
	isReference,
	notNegative,
	paperParser,
	positive,
	refusing,
	shown,
)
from boon2012.reporting.script import conclude
from boon2012.slope.plots import drawBlocks, plotMechanism, sideBySide
from boon2012.slope.scene import readSlope
from boon2012.slope.study import Failure, SlopeReport, SlopeRun

start, quickStart = 40.0, 26.0
steps, quickSteps = [1.0, 0.1], [1.0, 0.25]
physical = (
	'density',
	'normal_stiffness',
	'shear_stiffness',
	'stiffness_per_contact',
	'gravity',
	'contact_damping',
	'damping',
	'corner_radius',
)
numerical = ('time_step', 'contact_point', 'start', 'steps', 'failed_distance', 'stable_speed', 'most_steps')


def options():
	parser = paperParser(
		__doc__,
		quick=f'start at {quickStart:g}°, steps {quickSteps}, no table of other settings',
		geometry='e_slope.json',
		noPictures='no pictures of the blocks (plots are made)',
	)
	parser.add_argument('--density', type=positive, default=2500.0, help='[kg/m³]')
	parser.add_argument('--normal-stiffness', type=positive, default=1e9, help='of the joints [Pa/m]')
	parser.add_argument('--shear-stiffness', type=positive, default=1e9, help='of the joints [Pa/m]')
	parser.add_argument('--stiffness-per-contact', action='store_true', help='stiffnesses are [N/m] for each contact, whatever its area')
	parser.add_argument('--gravity', type=positive, default=10.0, help='[m/s²]')
	parser.add_argument('--contact-damping', type=notNegative, default=0.1, help='fraction of critical, normal and shear')
	parser.add_argument('--damping', type=fraction, default=0.3, help="YADE's own (NewtonIntegrator.damping)")
	parser.add_argument('--corner-radius', type=positive, default=0.05, help='of all blocks, and tolerance of the contact types [m]')
	parser.add_argument('--time-step', type=positive, default=1e-4, help='[s]')
	parser.add_argument('--contact-point', choices=contactPoints, default='analyticCentre')
	parser.add_argument('--start', type=angle, default=start, help='friction angle to settle at [°]')
	parser.add_argument('--steps', type=positive, nargs='+', action=Decreasing, default=steps, help='reductions of the friction angle [°]')
	parser.add_argument('--failed-distance', type=positive, default=0.1, help='motion of a block that counts as failure [m]')
	parser.add_argument('--stable-speed', type=positive, default=1e-6, help='below it at three consecutive checks a state is stable [m/s]')
	parser.add_argument('--most-steps', type=count, default=100000, help='of one friction angle; not at rest by then counts as failure')
	given = parser.parse_args()
	given.reference = isReference(parser, given, besides=(*physical, *numerical))
	if given.quick:
		given.start = quickStart if given.start == start else given.start
		given.steps = quickSteps if given.steps == steps else given.steps
	with refusing(parser, '--geometry'):
		given.slope = readSlope(given.geometry)
	with refusing(parser, '--geometry, --corner-radius'):
		given.run = SlopeRun(given, 'friction reduction')
	if given.time_step > given.run.longestTimeStep:
		parser.error(f'--time-step: at most 0.3 sqrt(least mass / normal stiffness), {given.run.longestTimeStep:.2g} s here')
	return given


def otherSettings(given):
	"""Runs for the table of settings, all with the coarser steps of --quick."""
	radius, step = given.corner_radius, given.time_step
	stiffer = {'normalStiffness': 2 * given.normal_stiffness, 'shearStiffness': 2 * given.shear_stiffness, 'timeStep': step / math.sqrt(2)}
	cases = {
		'as given': {},
		**{f'corner radius {factor * radius:g} m': {'cornerRadius': factor * radius} for factor in (0.2, 0.4, 2)},
		'half the time step': {'timeStep': step / 2},
		'twice the stiffness': stiffer,
		**{f'contact point {point}': {'contactPoint': point} for point in contactPoints if point != given.contact_point},
		'stiffness of each contact, whatever its area': {'stiffnessPerArea': False},
		'YADE damping 0.7': {'damping': 0.7},
		'YADE damping 0, contact damping 0.3': {'damping': 0.0, 'contactDamping': 0.3},
		'failure at a fifth of the distance': {'protocol': {'failedDistance': given.failed_distance / 5}},
		'friction steps 0.5° and 0.25°': {'protocol': {'steps': [math.radians(0.5), math.radians(0.25)]}},
	}
	coarse = {'steps': [math.radians(step) for step in quickSteps]}
	runs = []
	for label, changes in cases.items():
		protocol = coarse | changes.pop('protocol', {})
		runs.append(SlopeRun(given, label, protocol, **changes).reduce())
	return runs


def fail(given, run):
	"""Lets the slope fail; returns the Failure and the pictures {path: title}."""
	pictures, folder = {}, given.output
	if not given.no_pictures:
		drawBlocks(folder / 'stable.png', run.scene)
		pictures[folder / 'stable.png'] = f'{math.degrees(run.result.stable):.2f}°: stands'
	failure = Failure(run)
	if not given.no_pictures:
		drawBlocks(folder / 'collapsed.png', run.scene)
		moved = failure.displacement[-1].max()
		pictures[folder / 'collapsed.png'] = f'{math.degrees(failure.angle[-1]):.2f}°: a block has moved by {moved:.2f} m'
		turned = dict(zip(run.scene.freeIds, (-failure.rotation[-1]).tolist(), strict=True))
		scale = {'valueRange': (0, max(*turned.values(), 1e-3)), 'legend': 'backward rotation [°]'}
		drawBlocks(folder / 'rotations.png', run.scene, colorBy=lambda body: turned[body.id], **scale)
		pictures[folder / 'rotations.png'] = 'the same, by rotation'
	return failure, pictures


def main():
	given = options()
	run = given.run
	findings = Findings('E', 'Slope with joints that do not daylight', given.output, shown(given))
	report = SlopeReport(findings, given, run.scene.layers())
	report.introduction()
	try:
		report.limitAnalysis()
	except ValueError as error:
		print(error, file=sys.stderr)
		return 1
	run.reduce()
	if run.result is None:
		print(run.remark, file=sys.stderr)
		return 1
	run.reduction.restore()
	failure, pictures = fail(given, run)
	report.criticalAngle(run)
	report.mode(failure)
	report.failedQueries('contact queries without an answer', run.failedQueries + failure.failedQueries)
	report.contacts(failure)
	if pictures:
		sideBySide(given.output / 'failure.png', pictures)
		findings.figure(
			'failure.png',
			'Fig. 11 of the paper redrawn from our data: before and after failure; colours are layers, on the right rotations.',
		)
	plotMechanism(given.output / 'mechanism.png', given.slope, report.limit, failure.motion[failure.failed])
	findings.figure(
		'mechanism.png',
		'The mechanism: dual of the linear program, and motion of the blocks when the slope has failed. Blue: blocks that turn.',
	)
	report.tables(run, failure)
	if not given.quick:
		others = otherSettings(given)
		report.settings(others)
		report.failedQueries('contact queries without an answer, other settings', sum(other.failedQueries for other in others))
	return conclude(findings)


if __name__ == '__main__':
	sys.exit(main())
