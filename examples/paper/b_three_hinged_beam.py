# SPDX-License-Identifier: GPL-2.0-or-later
"""Simulation B of Boon, Houlsby & Utili (2012): the load a three-hinged beam carries while its two half-beams turn (Fig. 8), in true 2-D.

Two half-beams, 138 mm × 46 mm, between fixed abutments; contacts of 100 MN/m at the abutments and 50 MN/m at midspan. The rotation
is imposed, so that the curve goes on beyond its peak; the load is the moment of the contact forces over L₁/2. Shown beside Appendix A
of the paper (closed form) and Goodman's criterion, for the contact point at the centroid of the overlap and at the analytic centre
(by Newton's method, and by Ipopt where the build has it); then the effect of the abutments' size, contact normals, time step, stiffness and
load control.

Expected: with the centroid, the closed form itself, to rounding: peak 37 027.3 N at 6.7469°. With the analytic centre and abutments
of three block heights 31 278 N at 6.37°. The load imposed instead reaches the peak and snaps through. Ends with 1 if not.

	./run python examples/paper/b_three_hinged_beam.py              # a quarter of a minute (longer with Ipopt)
	./run python examples/paper/b_three_hinged_beam.py --quick      # some seconds
	./run yade -n -x examples/paper/b_three_hinged_beam.py --quick  # the same in YADE
	./run python examples/paper/b_three_hinged_beam.py --length 0.2 --abutment-height 5 --midspan-stiffness 100e6 --contact-point centroid
"""

import os
import sys
from itertools import product

os.environ.setdefault('OMP_NUM_THREADS', '1')  # read when YADE is loaded; four bodies are too few for more
if __name__ == '__main__':  # `yade`, unlike `python`, does not search the script's folder for modules
	sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))

import numpy as np
from boon2012.beam.limits import BeamLimits
from boon2012.beam.report import BeamReport, noIpopt
from boon2012.beam.study import BeamStudy, solverNames
from boon2012.beam.theory import BeamBetweenWalls
from boon2012.reporting.findings import Findings
from boon2012.reporting.options import angle, contactPoints, fraction, number, paperParser, positive, refusing, shown
from boon2012.reporting.script import conclude
from boon2012.solverTimes import hasSolver
from tqdm import tqdm

length, height = 0.138, 0.046
"""The paper's half-beams [m]."""
abutmentStiffness, midspanStiffness = 100e6, 50e6
"""The paper's [N/m]."""
tolerances = {'centroid': 0.005, 'analyticCentre': 0.01}
"""Tolerances on loads and rotations against theory, and on their change with time step and stiffness."""
solverTolerance = 1e-6
"""Tolerance on the difference of Newton's and Ipopt's loads, over the peak."""
pushes = {'as given': {}, 'time step halved': {'timeStep': 0.5}, 'stiffness doubled': {'stiffness': 2}}
drives = pushes | {'rate halved': {'rate': 0.5}}
"""Runs of BeamStudy.pushed() and driven(); changes against the first one must be small."""
pushPrecision, quickPushPrecision = 2e-4, 1e-3
"""Weight's last increment over the weight held."""
points, quickPoints = 119, 31
driveSteps, quickDriveSteps = 30000, 8000
heights, quickHeights = (1, 1.2, 1.5, 2, 3, 5, 10, 20), (1, 1.5, 3, 10)
"""Heights of the abutments in the study of their size [block heights]."""
lengthFactors, quickLengthFactors = (1, 3), (1,)
"""The abutments' lengths there, over --abutment-length."""
normalWeights, radiusFactors = (0.9, 0.75, 0.5), (1, 2)
"""Values in the study of normals: weights besides --normal-weight, radii over --corner-radius."""


def options():
	parser = paperParser(__doc__, quick='fewer points, steps and sizes, with the same tolerances')
	show, block, weight = parser.add_argument, number(least=1), number(least=0.5, most=1)
	solvers = [name for name in solverNames if hasSolver(name)]
	show('--length', type=positive, default=length, help='L1 of each half-beam [m]')
	show('--height', type=positive, default=height, help='L2 of the half-beams, the "block height" below [m]')
	show('--abutment-height', type=block, default=3.0, help='[block heights], at least 1')
	show('--abutment-length', type=positive, default=1.0, help='away from the beam [block heights]')
	show('--abutment-heights', type=block, nargs='+', help=f'in the study of size [block heights]; None: {heights}, quick {quickHeights}')
	show('--abutment-stiffness', type=positive, default=abutmentStiffness, help='of each contact at an abutment [N/m]')
	show('--midspan-stiffness', type=positive, default=midspanStiffness, help='of the contact at midspan [N/m]')
	show('--normal-weight', type=weight, default=1.0, help="of the abutment's face in the normal: 0.5 (equal) to 1 (rigid: horizontal)")
	show('--corner-radius', type=positive, help='[block heights], not below the overlaps; None: 0.1, or the largest overlap')
	rules = *contactPoints, 'spring'
	show(
		'--contact-point',
		choices=rules,
		nargs='+',
		default=['centroid', 'analyticCentre'],
		help='or the contact model spring; each by itself',
	)
	show('--solver', choices=solvers, nargs='+', default=solvers, help='of the analytic centre; newton is always run')
	show('--rotations', type=positive, nargs=2, metavar=('FIRST', 'LAST'), help='[°]; None: 0.25, and 0.81366 of alignment, here 15')
	show('--points', type=number(least=5, whole=True), help=f'of each curve; None: {points}, quick {quickPoints}')
	ofDrives = f'time steps of a rotation at a constant rate; None: {driveSteps}, quick {quickDriveSteps}'
	show('--drive-steps', type=number(least=1000, whole=True), help=ofDrives)
	ofTime = 'in dynamics: over sqrt(mass / stiffness at the abutment)'
	show('--time-step-fraction', type=number(above=0, below=0.5), default=0.1, help=ofTime)
	show('--damping', type=fraction, default=0.7, help="in dynamics: YADE's own, of NewtonIntegrator")
	show('--friction-angle', type=angle, help='in dynamics: enough for no slip at the abutments [°]; None: 45, or more')
	given = parser.parse_args()

	given.points = given.points or (quickPoints if given.quick else points)
	given.drive_steps = given.drive_steps or (quickDriveSteps if given.quick else driveSteps)
	given.abutment_heights = sorted(set(given.abutment_heights or (quickHeights if given.quick else heights)))
	beam = BeamBetweenWalls(given.length, given.height, given.abutment_stiffness, given.midspan_stiffness)
	with refusing(parser, '--rotations'):
		given.limits = BeamLimits(beam, given.rotations)
		given.rotations = list(given.limits.rotations)
	with refusing(parser, '--corner-radius'):
		given.corner_radius = given.limits.cornerRadius(given.abutment_length, given.corner_radius)
	with refusing(parser, '--friction-angle'):
		given.friction_angle = given.limits.frictionAngle(given.friction_angle)
	return given


def each(cases, doing):
	return tqdm(list(cases), doing, unit=' runs', leave=False, disable=None)


def curves(study, given):
	"""Rotation imposed, statics."""
	cases = [(point, 'newton') for point in given.contact_point]
	if 'analyticCentre' in given.contact_point and 'ipopt' in given.solver:
		cases.append(('analyticCentre', 'ipopt'))
	rotations = np.linspace(study.first, study.last, given.points)
	return [study.curve(*case, rotations) for case in each(cases, 'rotation imposed')]


def dynamics(study, given):
	"""Rotation imposed at a rate; weight imposed: for the contact points that have a theory."""
	judged = [point for point in given.contact_point if point in study.theory]
	precision = quickPushPrecision if given.quick else pushPrecision
	driven = [study.driven(point, run, **drives[run]) for point, run in each(product(judged, drives), 'turned at a rate')]
	pushed = [study.pushed(point, run, precision, **pushes[run]) for point, run in each(product(judged, pushes), 'load imposed')]
	return driven, pushed


def abutmentSizes(study, given):
	if 'analyticCentre' not in given.contact_point:
		return []
	wide = [times * given.abutment_length for times in (quickLengthFactors if given.quick else lengthFactors)]
	return [study.abutment(*size) for size in each(product(given.abutment_heights, wide), 'abutments')]


def tiltedNormals(study, given):
	weights = dict.fromkeys([given.normal_weight, *normalWeights])
	_, limit = given.limits.cornerRadii(given.abutment_length)
	radii = [times * given.corner_radius for times in radiusFactors if times * given.corner_radius < limit]
	return [study.tilted(*case) for case in each(product(given.contact_point, weights, radii), 'contact normals')]


def main():
	given = options()
	findings = Findings('B', 'Three-hinged beam', given.output, shown(given))
	study = BeamStudy(given)
	holds = given.limits.isAppendixA(given.abutment_height, given.normal_weight, given.corner_radius)
	report = BeamReport(findings, study, holds, tolerances)
	report.curves(curves(study, given), solverTolerance)
	report.dynamics(*dynamics(study, given))
	report.abutments(abutmentSizes(study, given))
	report.normals(tiltedNormals(study, given))
	report.failedQueries()
	if not given.no_pictures:
		report.figures()
	report.explain()
	if not hasSolver('ipopt'):
		print(noIpopt, end='\n\n')
	return conclude(findings)


if __name__ == '__main__':
	sys.exit(main())
