# SPDX-License-Identifier: GPL-2.0-or-later
"""Simulation D of Boon, Houlsby & Utili (2012): a wedge between three joints in a roof falls as friction goes down.

The joints dip 60° at 30°, 150° and 270°; the wedge is 1 m high; σ_h = 0.05 MPa both ways. Way 1: the stress field's normal and shear
forces are set on the joints, the blocks around are fixed. Way 2: stress on the boundary closes the joints, then the blocks are fixed.
Then the friction angle goes down from 70° until the wedge falls. Expected: φ = α + atan(W/ΣH) with α = 30° and the horizontal forces ΣH
on the wedge, which gives 34.402° (34.319° with g = 9.81 m/s²), within 0.02° both ways. Last, the cause of the paper's 34.81° with
boundary stress: blocks that touch each other around the wedge and take a part of the stress. Beside it a prism between two joints only, which
nothing but moments about their normals keeps from turning. Ends with 1 if what must hold does not.

	./run python examples/paper/d_roof_wedge.py                  # half a minute
	./run python examples/paper/d_roof_wedge.py --quick          # some seconds
	./run yade -n -x examples/paper/d_roof_wedge.py --quick      # the same in YADE
	./run python examples/paper/d_roof_wedge.py --gravity 9.81 --horizontal-stress 8e4 --shear-stiffness 5e6
"""

import os
import sys

os.environ.setdefault('OMP_NUM_THREADS', '1')  # read when YADE is loaded; four bodies are too few for more
if __name__ == '__main__':  # `yade`, unlike `python`, does not search the script's folder for modules
	sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))

from boon2012.reporting.findings import Findings
from boon2012.reporting.options import positive, refusing, shown
from boon2012.reporting.script import conclude, scriptFile
from boon2012.roofWedge.scene import RoofWedge
from boon2012.roofWedge.study import RoofWedgeCase, RoofWedgeReport, areEvenlySpread, frontView, plotStressShare, touchingCases
from boon2012.wedges.blockGeometry import BlockGeometry
from boon2012.wedges.study import parseWedge, plotReduction, wedgeParser
from tqdm import tqdm

ways = {1: 'way 1, joint forces set', 2: 'way 2, boundary stress'}
paperPressed = 34.81
papers = {1: '34.41, 34.37', 2: paperPressed}
"""Critical friction angles of the paper [°]; the tangents of the first two, 0.685 and 0.684, have three digits."""
closedForm = {10: 34.4019, 9.81: 34.3186}
"""α + atan(W/ΣH) by gravity [m/s²]."""
constantNormal = (34.215, 5e-4)
"""What a constant normal force would give [°], and how exactly that is known."""
tolerance, shareTolerance = 0.02, 1e-3
fall = 0.25
"""How far the wedge has fallen in the second picture [m]."""
steps, quickSteps = (1.0, 0.1, 0.02, 0.005), (8.0, 1.0, 0.1, 0.02, 0.005)
prismLabel = 'prism between two joints, default contact'
"""Joints of the wedge's dip, 1 m high and long."""
sideShares, quickSideShares = (0.05, 0.25, 0.5, 1, 2), (0.5,)
"""A_v/A: joints between blocks that touch each other over those with the wedge."""

mustNotCount = 'time step halved', 'stiffness doubled'


def options():
	parser = wedgeParser(__doc__, 'd_roof_wedge.json', steps)
	parser.add_argument('--horizontal-stress', type=positive, default=5e4, help='σ_h, both ways [Pa]')
	given = parseWedge(parser, quickSteps)
	with refusing(parser, '--geometry'):
		given.blocks = BlockGeometry.read(given.geometry)
		if not given.blocks.faceBlocks or given.blocks.edgeBlocks:
			raise ValueError('each block around the wedge must share just one plane with it')
		RoofWedge(given.blocks).build()  # refuses what is no block
	return given


def settings(given):
	"""What is varied, one thing at a time: label → arguments of RoofWedgeCase."""
	normal, shear, fraction = given.normal_stiffness, given.shear_stiffness, given.time_step_fraction
	quick = {
		'time step halved': {'timeStepFraction': fraction / 2},
		'stiffness doubled': {'normalStiffness': 2 * normal, 'shearStiffness': 2 * shear},
	}
	if given.quick:
		return quick
	return quick | {
		'time step doubled': {'timeStepFraction': fraction * 2},
		'stiffness halved': {'normalStiffness': normal / 2, 'shearStiffness': shear / 2},
		'stiffness tenfold': {'normalStiffness': 10 * normal, 'shearStiffness': 10 * shear},
		'shear stiffness halved': {'shearStiffness': shear / 2},
		'friction steps 8, 1, 0.1, 0.02': {'steps': (8, 1, 0.1, 0.02)},
		'friction steps 1, 0.02': {'steps': (1, 0.02)},
		'start at 40°': {'start': 40},
		'damping 0.9': {'damping': 0.9},
		'damping 0.3': {'damping': 0.3},
		'no damping, contact damping 0.3': {'damping': 0, 'contactDamping': 0.3},
		'stiffness times present contact section': {'stiffnessTimes': 'section'},
		'all contacts 1e7 N/m, whatever their area': {'stiffnessTimes': 'contact', 'normalStiffness': 1e7, 'shearStiffness': 1e7},
		'contact point: centroid of the overlap': {'contactPoint': 'centroid'},
	}


def bothWays(given, progress):
	"""Cases as given, both ways; for the reference with g = 10 and 9.81 m/s². Draws the first one."""
	cases = []
	gravities = list(closedForm) if given.reference else [given.gravity]
	progress.total += len(ways) * len(gravities)
	for gravity in gravities:
		for way, name in ways.items():
			label = f'{name}, g = {gravity:g} m/s²' if given.reference else name
			cases.append(RoofWedgeCase(given, label, way, progress, gravity=gravity))
			if len(cases) == 1 and not given.no_pictures:
				draw(given, cases[0])
	return cases


def draw(given, case):
	case.drawFailure(given.output, fall, **frontView(case, fall))
	plotReduction(given.output / 'reduction.png', case, case.closedForm if areEvenlySpread(case.scene.joints) else None, 'roof wedge')


def search(given):
	"""All cases: both ways; other settings; blocks that touch each other."""
	varied = settings(given)
	with tqdm(total=len(varied), unit=' searches', disable=None) as progress:
		both = bothWays(given, progress)
		cases = [RoofWedgeCase(given, label, 1, progress, **changes) for label, changes in varied.items()]
		touching = []
		joints = both[0].scene.joints
		if len(joints) == 3 and areEvenlySpread(joints):
			shares = quickSideShares if given.quick else sideShares
			touching = touchingCases(given, both[0], paperPressed if given.reference else None, shares, progress)
		between = None
		if given.reference:
			progress.total += 1
			between = RoofWedgeCase(
				given,
				prismLabel,
				1,
				progress,
				blocks=BlockGeometry.read(scriptFile().parent / 'geometry' / 'd_roof_prism.json'),
				contactModel='surface',
			)
	return both, cases, touching, between


def main():
	given = options()
	findings = Findings('D', 'Roof wedge', given.output, shown(given))
	try:
		both, cases, touching, between = search(given)
	except RuntimeError as error:
		print(f'No critical friction angle: {error}', file=sys.stderr)
		return 1

	report = RoofWedgeReport(findings, given, both, cases, touching, tolerance)
	report.criticalAngles(papers, closedForm)
	if between:
		report.prism(between)
	report.jointForces()
	report.constantNormal(constantNormal)
	report.closure()
	report.independence(mustNotCount)
	report.touchingBlocks(paperPressed, shareTolerance)
	report.failedQueries()
	report.settings()
	if touching and given.reference:
		report.explainPaper(paperPressed)
	if touching:
		report.touchingTable()
		if not given.no_pictures:
			plotStressShare(given.output / 'touching.png', touching, paperPressed)
	if not given.no_pictures:
		report.figures(fall)
	return conclude(findings)


if __name__ == '__main__':
	sys.exit(main())
