# SPDX-License-Identifier: GPL-2.0-or-later
"""Simulation A of Boon, Houlsby & Utili (2012): 200 regular polyhedra fall onto a floor between four walls.

Runs one solid or all five and shows that they come to rest (the paper's Fig. 5) and the cost of the contact detection: µs
per contact problem against the number of planes of both bodies, for the linear program, the centre by Newton's method
and by Ipopt, warm-started from the last step's answer and cold (Fig. 6). Writes results, pictures, ParaView files and
findings.json. Expected: all particles inside, no query without an answer, kinetic energy below 5e-4 N m g L at the end.
Heaps are chaotic: other ranges are compared over several seeds. Ends with 1 if what must hold does not.

	./run demo                                 # all five solids, with pictures: a minute
	./run demo --shape cube --threads 2 --vtk-every 100   # ParaView files every 100 steps
	./run python examples/paper/a_falling_polyhedra.py --seeds 8   # as `./run paper` does: five minutes
	./run yade -n -x examples/paper/a_falling_polyhedra.py --quick

What the paper leaves open (sizes, stiffness, damping, time step) is set in boon2012.falling.scene.FallingPolyhedra.
"""

import argparse
import math
import os
import sys

os.environ.setdefault('OMP_NUM_THREADS', '1')
if __name__ == '__main__':  # --threads counts when YADE is loaded; within `yade` it is loaded already (yade -j)
	early = argparse.ArgumentParser(add_help=False)
	early.add_argument('--threads', default=os.environ['OMP_NUM_THREADS'])
	os.environ['OMP_NUM_THREADS'] = early.parse_known_args()[0].threads
	# `yade`, unlike `python`, does not search the script's folder for modules
	sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))

from boon2012.falling.costs import ContactCostReport
from boon2012.falling.report import FallingPolyhedraReport
from boon2012.falling.run import FallingRun, save
from boon2012.falling.scene import solids
from boon2012.falling.tables import showCosts, showOutcome, showStates
from boon2012.reporting.findings import Findings
from boon2012.reporting.options import contactModels, contactPoints, count, isReference, notNegative, number, paperParser, positive, shown
from boon2012.reporting.script import conclude
from yade import O

fullNumber, fullSteps = 200, 7000
expected = {
	'energyHalf': (1e-3, 2e-2),
	'energyEnd': (1e-6, 5e-4),
	'contacts': (373, 469),
	'meanHeight': (1.04, 1.23),
	'deepestOverlap': (0, 0.025),
	'overlap': (0, 0.005),
}
"""Results of an independent program of the paper's algorithm, one run of each solid with that number of particles and steps; lengths in L,
energies in N m g L. The ranges of contacts and mean height are those of the five runs; the others are bounds."""
scatter, scatterSeeds = {'contacts': (8.4, 11.1), 'meanHeight': (0.0104, 0.043)}, 24
"""Standard deviations between seeds of the least and the largest of the five solids, and of how many seeds, with these settings. They are
fixed: what a run must hold does not depend on how much it scatters itself."""
byChance = 'energyHalf', 'energyEnd', 'deepestOverlap'
"""Bounds that one body can exceed alone in a single run: the first two by toppling late, the third by a hard impact."""

paperFailures = 'no difficulty'
paperTimes = {'ipoptMicroseconds': 'a few ms', 'centreColdMicroseconds': 'tens of µs', 'lpColdMicroseconds': 'tens of µs'}
paperGrowth = {'lpColdMicroseconds': 'O(N)', 'ipoptMicroseconds': 'almost none'}
"""How the paper's times grow with N, the planes of both bodies."""
paperBands = (1e3, 1e4, 'paper: IPOPT, “a few ms”'), (1e1, 1e2, 'paper: LP and log-barrier centre, “tens of µs”')
"""The paper's times in Fig. 6: from, to [µs]."""
paperText = 'tens of µs (linear program by CPLEX, log-barrier centre) and a few ms (IPOPT)'

wholeNotNegative = number(least=0, whole=True)
parameters = {
	'size': (positive, 'L, edge of the cube of equal volume [m]'),
	'density': (positive, '[kg/m³]'),
	'normalStiffness': (positive, 'of each contact [N/m]'),
	'stiffnessRatio': (notNegative, 'shear over normal stiffness'),
	'frictionAngle': (number(least=0, below=90), '[degrees]'),
	'contactDamping': (notNegative, 'fraction of critical, of each contact'),
	'damping': (notNegative, 'of NewtonIntegrator'),
	'gravity': (notNegative, '[m/s²]'),
	'cornerFraction': (notNegative, 'corner radius over L'),
	'timeStepFraction': (positive, 'time step over sqrt(mass / normal stiffness)'),
}
"""Fields of FallingPolyhedra that are options."""


def options():
	parser = paperParser(__doc__, quick='fewer states to time, no ParaView files and no pictures of the heap')
	shapes = (*solids, 'mixed', 'all')
	parser.add_argument('--shape', choices=shapes, default='all', help='all: the five solids one after another; mixed: in one scene')
	parser.add_argument('--number', type=count, default=fullNumber, help='of particles')
	parser.add_argument('--steps', type=count, default=fullSteps)
	inSameState = 'one thread ends in the same state, to the last bit, every time'
	parser.add_argument('--threads', type=count, default=O.numThreads, help=inSameState)
	parser.add_argument('--seed', type=int, default=1, help='of the orientations')
	parser.add_argument('--seeds', type=count, default=1, help='so many runs of each solid, with this seed and the next ones')
	parser.add_argument(
		'--contact-model',
		choices=contactModels,
		default='boon2012',
		help='the others are those of a contact surface, which read no contact point',
	)
	parser.add_argument('--contact-point', choices=contactPoints, default='analyticCentre')
	for name, (kind, meaning) in parameters.items():
		option = ''.join('-' + letter.lower() if letter.isupper() else letter for letter in name)
		text = f'{meaning} (default: as in FallingPolyhedra)'
		parser.add_argument(f'--{option}', dest=name, type=kind, default=argparse.SUPPRESS, metavar='X', help=text)
	every = {'vtk': 'ParaView files every so many steps; 0: none', 'ipopt': 'time Ipopt on every so many of these; 0: not at all'}
	parser.add_argument('--vtk-every', type=wholeNotNegative, default=1000, metavar='STEPS', help=every['vtk'])
	parser.add_argument('--sample-every', type=count, default=100, metavar='STEPS', help='time cold starts every so many steps')
	parser.add_argument('--ipopt-every', type=wholeNotNegative, default=20, metavar='STATES', help=every['ipopt'])
	if parser.parse_args().quick:
		parser.set_defaults(vtk_every=0, sample_every=500, ipopt_every=7)
	given = parser.parse_args()
	if given.threads != O.numThreads:
		parser.error(f'--threads {given.threads}: within YADE threads are its own option: yade -j {given.threads} …')
	besides = 'shape', 'threads', 'seed', 'seeds', 'vtk_every', 'sample_every', 'ipopt_every'
	given.reference = isReference(parser, given, besides)
	given.parameters = {name: getattr(given, name) for name in parameters if hasattr(given, name)}
	if 'frictionAngle' in given.parameters:
		given.parameters['frictionAngle'] = math.radians(given.frictionAngle)
	return given


def comesToRest(report):
	report.inside()
	report.answered(paperFailures)
	for key in byChance:
		report.largest(key, chance=True)
	report.largest('overlap')
	report.extremes('contacts')
	report.extremes('meanHeight')
	report.singleRuns()
	report.seeds()


def costs(report):
	report.times(paperTimes)
	report.ipopt(paperFailures)
	report.growth(paperGrowth)
	report.figure(paperBands, paperText)
	report.howTimed('CPLEX, IPOPT')
	report.tables()


def main():
	given = options()
	names = solids if given.shape == 'all' else [given.shape]
	results = [FallingRun(name, seed, given).results() for name in names for seed in range(given.seed, given.seed + given.seeds)]
	save(results, given.output)
	firsts = [r for r in results if r['seed'] == given.seed]
	showCosts(firsts)
	showOutcome(
		firsts,
		expected if given.reference else {},
		f'{fullNumber} particles, {fullSteps} steps and the usual parameters',
		(*scatter, *byChance),
	)
	showStates(firsts)

	findings = Findings('A', 'Falling polyhedra', given.output, shown(given))
	report = FallingPolyhedraReport(findings, given, results, expected, scatter, scatterSeeds)
	comesToRest(report)
	costs(ContactCostReport(findings, given, report.firsts))
	report.figures()
	print('\nWhat is found')
	return conclude(findings)


if __name__ == '__main__':
	sys.exit(main())
