# SPDX-License-Identifier: GPL-2.0-or-later
"""Simulation C of Boon, Houlsby & Utili (2012): a rock wedge on two joints, 40°/130° and 60°/220°, slides when friction goes down.

The wedge settles at a friction angle of 70°; from there the angle goes down by 1° until the wedge fails (moves by more than 20 mm), and,
from the last stable state, by finer steps. Stable is what becomes slower than 2e-7 m/s. What is shown: the critical angle beside limit
equilibrium (33.357°), the paper (33.23°) and 3DEC (33.19°); the transverse shear locked into the joints, which explains the difference;
and how far the answer depends on friction steps, time step, damping, stiffness and contact point. Expected: 33.23° ± 0.05°, asserted for
the settings below; another shape of wedge, or another path to failure, gives 33.0° to 33.4°. Ends with 1 if what must hold does not.

	./run python examples/paper/c_sliding_wedge.py                  # half a minute
	./run python examples/paper/c_sliding_wedge.py --quick          # some seconds
	./run yade -n -x examples/paper/c_sliding_wedge.py --quick      # the same in YADE
	./run python examples/paper/c_sliding_wedge.py --geometry wedge.json --stiffness-times contact --start 60 --steps 1 0.05
"""

import math
import os
import sys

os.environ.setdefault('OMP_NUM_THREADS', '1')  # read when YADE is loaded; four bodies are too few for more
if __name__ == '__main__':  # `yade`, unlike `python`, does not search the script's folder for modules
	sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))

from boon2012.reporting.findings import Findings
from boon2012.reporting.options import positive, refusing, shown
from boon2012.reporting.script import conclude
from boon2012.slidingWedge.study import SlidingWedgeCase, SlidingWedgeReport, limitEquilibrium, plotLockedShear
from boon2012.wedges.blockGeometry import BlockGeometry
from boon2012.wedges.scene import WedgeScene
from boon2012.wedges.study import parseWedge, plotReduction, wedgeParser
from tqdm import tqdm

paperAngle, paperTheory, angleOf3dec = 33.23, 33.36, 33.19
"""Critical friction angle: the paper's DEM, its limit equilibrium, and 3DEC [°]."""
expected, tolerance = 33.23, 0.05
wideBand = (33.0, 33.4)
closedForm = {
	'friction angle': (33.35722, 1e-5),
	'plunge of the line of intersection': (37.0583, 1e-4),
	'its trend': (155.848, 1e-3),
	'R_A/W': (0.673312, 1e-6),
	'R_B/W': (0.242106, 1e-6),
}
"""Results of limit equilibrium: values [°, -], and how exactly they are known."""
lowestAngle = (31.07, 0.01)
"""Lowest angle of any statically admissible state [°], and how exactly it is known."""
mostEdgeForce = 1e-3
"""Largest force of the back edge over the wedge's weight, where stiffness goes by area."""
angleWithEdge = 33.96
"""Critical angle by an independent program of the paper's algorithm, whose back edge has 1e7 N/m [°]."""
slide = 0.3
"""How far the wedge has slid in the second picture [m]."""
steps, quickSteps = (1.0, 0.1, 0.02), (8.0, 1.0, 0.1, 0.02)

mustNotCount = 'time step halved', 'stiffness doubled'
stiffEdge = 'back edge with 1e7 N/m, not by its area'


def options():
	parser = wedgeParser(__doc__, 'c_sliding_wedge.json', steps)
	ofEdges = 'of contacts along an edge, normal and shear, whatever their area; None: as --stiffness-times says'
	parser.add_argument('--edge-stiffness', type=positive, metavar='N/m', help=ofEdges)
	given = parseWedge(parser, quickSteps)
	with refusing(parser, '--geometry'):
		given.blocks = BlockGeometry.read(given.geometry)
		given.theory = limitEquilibrium(given.blocks)
		WedgeScene(given.blocks).build()  # refuses what is no block
	return given


def settings(given):
	"""What is varied, one thing at a time: label → arguments of SlidingWedgeCase."""
	normal, shear, fraction = given.normal_stiffness, given.shear_stiffness, given.time_step_fraction
	quick = {
		'time step halved': {'timeStepFraction': fraction / 2},
		'stiffness doubled': {'normalStiffness': 2 * normal, 'shearStiffness': 2 * shear},
	}
	edge = {stiffEdge: {'edgeStiffness': 1e7}}
	if given.quick:
		return quick | edge
	full = {
		'time step doubled': {'timeStepFraction': fraction * 2},
		'stiffness halved': {'normalStiffness': normal / 2, 'shearStiffness': shear / 2},
		'stiffness tenfold': {'normalStiffness': 10 * normal, 'shearStiffness': 10 * shear},
		'shear stiffness halved': {'shearStiffness': shear / 2},
		'friction steps 8, 1, 0.1, 0.02': {'steps': (8, 1, 0.1, 0.02)},
		'friction steps 1, 0.02': {'steps': (1, 0.02)},
		'friction steps 1, 0.1, 0.005': {'steps': (1, 0.1, 0.005)},
		'start at 45°': {'start': 45},
		'start at 40°': {'start': 40},
		'start at 36°': {'start': 36},
		'damping 0.9': {'damping': 0.9},
		'damping 0.5': {'damping': 0.5},
		'damping 0.3': {'damping': 0.3},
		'damping 0.3, friction steps 1, 0.02': {'damping': 0.3, 'steps': (1, 0.02)},
		'damping 0.3, rocking damping 1': {'damping': 0.3, 'rockingDamping': 1},
		'no damping, contact damping 0.3': {'damping': 0, 'contactDamping': 0.3},
		'stiffness times present contact section': {'stiffnessTimes': 'section'},
		'all contacts 1e7 N/m, whatever their area': {'stiffnessTimes': 'contact', 'normalStiffness': 1e7, 'shearStiffness': 1e7},
	}
	last = {
		'contact point: centroid of the overlap': {'contactPoint': 'centroid'},
		"contact point: LP's own (Chebyshev centre)": {'contactPoint': 'chebyshevCentre'},
		'rotation blocked': {'turning': False},
	}
	return quick | full | edge | last


def draw(folder, base):
	base.drawFailure(folder, slide, fixed='solid')
	plotReduction(folder / 'reduction.png', base, math.degrees(base.given.theory.frictionAngle()), 'sliding wedge')
	plotLockedShear(folder / 'shear.png', base)


def main():
	given = options()
	varied = settings(given)
	findings = Findings('C', 'Sliding wedge', given.output, shown(given))
	with tqdm(total=1 + len(varied), unit=' searches', disable=None) as progress:
		base = SlidingWedgeCase(given, 'as given', progress)
		if base.failure:
			print(f'No critical friction angle: {base.failure}', file=sys.stderr)
			return 1
		if not given.no_pictures:
			draw(given.output, base)
		cases = [SlidingWedgeCase(given, label, progress, **changes) for label, changes in varied.items()]

	report = SlidingWedgeReport(findings, given, base, cases)
	others = f'Asserted for the reference geometry and settings; other shapes and paths: {wideBand[0]}° … {wideBand[1]}°'
	report.criticalAngle(paperAngle, expected, tolerance, f'3DEC {angleOf3dec}°. {others}' if given.reference else '')
	report.limitEquilibrium(paperTheory, closedForm, lowestAngle)
	report.lockedShear(margin=0.02)
	report.backEdge(mostEdgeForce)
	report.independence(mustNotCount, tolerance)
	independent = f'an independent program of the paper\'s algorithm gave {angleWithEdge}' if given.reference else ''
	report.stiffBackEdge('critical angle with a back edge of 1e7 N/m', stiffEdge, independent)
	report.failedQueries()
	report.settings()
	if given.reference and not given.quick:
		report.explainSettings()
	if not given.no_pictures:
		report.figures(slide)
	return conclude(findings)


if __name__ == '__main__':
	sys.exit(main())
