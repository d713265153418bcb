# SPDX-License-Identifier: GPL-2.0-or-later
"""Simulation F of Boon, Houlsby & Utili (2012): a cube falls on a floor vertex first (Fig. 12), another on a cube edge first (Fig. 13).

F1: vertex on face; the cube tips over an edge and comes to rest on its face −z, at the height ½ − m g/kₙ. F2: edge on edge; the upper
cube turns off the lower one, slides down its side and leaves. The script records every step and shows: the sequence of contact types,
the largest jumps of contact point, normal and force through each change of type, the budgets of momentum and energy, and every rise of
energy with its cause (the paper's normal, an average, is no gradient of an energy). The paper shows pictures only; all numbers are ours.
Ends with 1 if a budget does not close, a free flight does not conserve energy, or the cube does not come to rest as it must.

	./run python examples/paper/f_collisions.py              # three minutes
	./run python examples/paper/f_collisions.py --quick      # without the table of other settings; one minute
	./run python examples/paper/f_collisions.py --contact-point centroid --time-step 4e-5 --output other

The two collisions are in geometry/f_collisions.json; --geometry takes another file of the same form.
"""

import argparse
import math
import os
import sys

os.environ.setdefault('OMP_NUM_THREADS', '1')  # read when YADE is loaded; two bodies are too few for more
if __name__ == '__main__':  # `yade`, unlike `python`, does not search the script's folder for modules
	sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))

from boon2012.collisions.plots import drawSequence, plotOverview
from boon2012.collisions.scene import readBlocks
from boon2012.collisions.study import CollisionReport, CollisionRun, labels
from boon2012.reporting.findings import Findings
from boon2012.reporting.options import contactPoints, fraction, isReference, notNegative, paperParser, positive, refusing, shown
from boon2012.reporting.script import conclude

paperFigures = {'vertexFace': 'Fig. 12', 'edgeEdge': 'Fig. 13'}


def options():
	parser = paperParser(
		__doc__,
		quick='without the table of other settings',
		geometry='f_collisions.json',
		noPictures='no pictures of the blocks (plots are made)',
	)
	parser.add_argument('--collision', choices=(*labels, 'both'), default='both')
	parser.add_argument('--density', type=positive, default=2000.0, help='[kg/m³]')
	parser.add_argument('--normal-stiffness', type=positive, default=1e8, help='of the contact [N/m]')
	parser.add_argument('--shear-stiffness', type=positive, default=1e8, help='of the contact [N/m]')
	parser.add_argument('--friction', type=notNegative, default=1.0, help='coefficient, tan of the friction angle')
	parser.add_argument('--contact-damping', type=notNegative, default=1.0, help='fraction of critical, normal and shear')
	parser.add_argument('--damping', type=fraction, default=0.3, help="YADE's own (NewtonIntegrator.damping)")
	parser.add_argument(
		'--damp-gravity',
		action=argparse.BooleanOptionalAction,
		default=True,
		help="whether YADE's damping acts on gravity too, so on free flight",
	)
	parser.add_argument('--gravity', type=positive, default=9.81, help='[m/s²]')
	parser.add_argument('--corner-radius', type=positive, default=0.05, help='of both blocks, and tolerance of the contact types [m]')
	parser.add_argument('--time-step', type=positive, default=8.944e-5, help='[s]')
	parser.add_argument('--contact-point', choices=contactPoints, default='analyticCentre')
	given = parser.parse_args()
	given.names = list(labels) if given.collision == 'both' else [given.collision]
	given.reference = isReference(parser, given, besides=('collision', 'names'))
	with refusing(parser, '--geometry'):
		blocks = [readBlocks(given.geometry, name) for name in given.names]
	narrowest = min(min(block.halfLengths) for pair in blocks for block in pair)
	if given.corner_radius >= narrowest:
		parser.error(f'--corner-radius: must be below the least half-length, {narrowest:g} m')
	lightest = given.density * min(8 * math.prod(free.halfLengths) for _, free in blocks)
	longest = 0.1 * math.sqrt(lightest / given.normal_stiffness)
	if given.time_step > longest:
		parser.error(f'--time-step: a contact would pass in too few steps; at most 0.1 sqrt(mass / normal stiffness), {longest:.2g} s here')
	return given


def otherSettings(given, runs):
	"""The runs as given, and others for the table of settings."""
	changes = [
		{'timeStep': given.time_step / 2},
		{'dampGravity': not given.damp_gravity},
		{'shearDamping': 0.0},
		*({'contactPoint': point} for point in contactPoints if point != given.contact_point),
	]
	return [*runs, *(CollisionRun(given, name, **change) for change in changes for name in given.names)]


def figures(findings, given, run):
	label, folder = run.label, given.output
	if not given.no_pictures:
		drawSequence(folder / f'{label}_sequence.png', run)
		findings.figure(f'{label}_sequence.png', f'{paperFigures[run.name]} of the paper redrawn from our data.')
	plotOverview(folder / f'{label}_overview.png', run)
	findings.figure(
		f'{label}_overview.png',
		f'{label} over time; the background is the contact type. The last panel shows the energy balance since the start.',
	)


def main():
	given = options()
	findings = Findings('F', 'Vertex–face and edge–edge collisions', given.output, shown(given, without=('output', 'reference', 'names')))
	report = CollisionReport(findings, given)
	report.introduction()
	runs, undamped = [], []
	for name in given.names:
		undamped.append(CollisionRun(given, name, damping=0.0))
		run = CollisionRun(given, name)
		runs.append(run)
		report.sequence(run)
		if name == 'vertexFace':
			report.atRest(run)
		else:
			report.parting(run)
		report.budgets(run)
		report.budgets(undamped[-1], ', YADE damping 0')
		report.jumps(run)
		figures(findings, given, run)
	if given.reference and 'edgeEdge' in given.names:
		undamped.append(CollisionRun(given, 'edgeEdge', damping=0.0, shearDamping=0.0))
		report.besideIndependent(undamped[-1])
	report.failures(runs + undamped)
	report.transitionTable(runs)
	report.energyRises(runs)
	if not given.quick:
		report.settings(otherSettings(given, runs))
	return conclude(findings)


if __name__ == '__main__':
	sys.exit(main())
