# SPDX-License-Identifier: GPL-2.0-or-later
"""Ipopt as the solver of the contact point: the same scene as with Newton, with one thread and two; a build without it says so."""

import os
import subprocess
import sys

import pytest
from scenes import blockOnFloor, joint, loop
from yade import Ig2_Polytope_Polytope_PolytopeGeom, O, Quaternion, polytope

hasIpopt = polytope.buildInfo()['ipopt'] is not None
needsIpopt = pytest.mark.skipif(not hasIpopt, reason='this build has no Ipopt')
needsNone = pytest.mark.skipif(hasIpopt, reason='this build has Ipopt')


def functor():
	return O.engines[2].geomDispatcher.functors[0]


def testBuildInfoNamesTheVersion():
	version = polytope.buildInfo()['ipopt']
	assert version is None or int(version.split('.')[0]) >= 3


@needsIpopt
def testOneContactAgreesWithNewton():
	a = polytope.regular(12, circumradius=1.0)
	b = polytope.regular(20, circumradius=1.0, center=(0.3, 0.2, 1.4), orientation=Quaternion((1, 2, 3), 0.7))
	paper = {'contactModel': 'boon2012'}
	newton, ipopt = polytope.contact(a, b, **paper), polytope.contact(a, b, solver='ipopt', **paper)
	assert newton.inContact and newton.ipoptIterations == 0 < newton.newtonIterations
	assert ipopt.status == newton.status and ipopt.newtonIterations == 0 < ipopt.ipoptIterations
	assert (ipopt.point - newton.point).norm() < 1e-8 * newton.depth
	assert (ipopt.normal - newton.normal).norm() < 1e-8
	assert ipopt.depth == pytest.approx(newton.depth, rel=1e-8)


def tumblingBlock(solver):
	"""Centre and velocity of a block that has landed on its edge and slid; with the counters."""
	O.reset()
	material = joint(normalStiffness=1e6, shearStiffness=1e6)
	loop(gravity=(0, 0, -9.81), normalDamping=0.1, ig2=dict(solver=solver, contactModel='boon2012'))
	blockOnFloor(overlap=-0.01, half=(0.4, 0.3, 0.5), material=material)
	O.bodies[1].state.ori = Quaternion((1, 1, 0), 0.2)
	O.bodies[1].state.vel = (0.5, 0, -1)
	O.dt = 1e-4
	O.run(800, True)
	state = O.bodies[1].state
	return state.pos, state.vel, functor().stats()


@needsIpopt
def testSceneMovesAsWithNewton():
	position, velocity, stats = tumblingBlock('newton')
	assert stats['ipoptSolves'] == stats['ipoptIterations'] == stats['rescued'] == 0 < stats['newtonIterations']
	ipoptPosition, ipoptVelocity, ipoptStats = tumblingBlock('ipopt')
	assert ipoptStats['contacts'] == stats['contacts'] > 100
	assert ipoptStats['ipoptIterations'] > ipoptStats['ipoptSolves'] >= ipoptStats['contacts'] and ipoptStats['newtonIterations'] == 0
	assert ipoptStats['fallbacks'] == ipoptStats['failures'] == ipoptStats['rescued'] == 0
	assert (ipoptPosition - position).norm() < 1e-7 and (ipoptVelocity - velocity).norm() < 1e-6


# Nothing is written but by the script itself: neither by Ipopt nor by what it loads.
program = '''
import sys
sys.path.insert(0, sys.argv[1])
from yade import O, polytope
from scenes import joint, loop
loop(gravity=(0, 0, -9.81), normalDamping=.1, ig2=dict(solver='ipopt', contactModel='boon2012'))
material = joint(normalStiffness=1e6, shearStiffness=1e6)
O.bodies.append(polytope.cuboid((0, 0, -1), (9, 9, 1), fixed=True, material=material))
for i in range(6):
	O.bodies.append(polytope.cuboid((1.5 * i - 4, 0, .5), (.5, .5, .5), material=material))
	O.bodies.append(polytope.regular(8, circumradius=.6, center=(1.5 * i - 4, .05, 1.4), material=material))
O.dt = 1e-4
O.run(300, True)
stats = O.engines[2].geomDispatcher.functors[0].stats()
assert stats['ipoptSolves'] > 1000 and stats['fallbacks'] == stats['failures'] == 0, stats
print(O.numThreads, *(repr(x) for b in O.bodies for x in tuple(b.state.pos) + tuple(b.state.vel)))
'''


def run(threads):
	environment = dict(os.environ, OMP_NUM_THREADS=str(threads))
	command = [sys.executable, '-c', program, os.path.dirname(os.path.dirname(os.path.abspath(__file__)))]
	output = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=1800)
	assert output.returncode == 0, output.stderr
	return output.stdout, output.stderr


@needsIpopt
def testTwoThreadsAgreeAndNothingIsPrinted():
	one, two = run(1), run(2)
	assert one[1] == two[1] == ''
	states = []
	for (output, _), threads in ((one, '1'), (two, '2')):
		greeting, state = output.splitlines()
		assert greeting.startswith('Using python version')  # YADE's own
		assert state.split()[0] == threads
		states.append(state.split()[1:])
	assert states[0] == states[1]


def testUnknownSolverIsRefusedAndTheLastOneKept():
	geometry = Ig2_Polytope_Polytope_PolytopeGeom(contactModel='boon2012')
	with pytest.raises(ValueError, match="solver: must be 'newton' or 'ipopt', not 'mosek'"):
		geometry.solver = 'mosek'
	assert geometry.solver == 'newton'
	if hasIpopt:
		geometry.solver = 'ipopt'
		with pytest.raises(ValueError, match='solver'):
			geometry.solver = 'mosek'
		assert geometry.solver == 'ipopt'
	with pytest.raises(ValueError, match='solver'):
		polytope.contact(polytope.cuboid((0, 0, 0), (1, 1, 1)), polytope.cuboid((0, 0, 1), (1, 1, 1)), solver='mosek')


@needsNone
def testWithoutIpoptItIsRefusedWithTheRemedy():
	geometry = Ig2_Polytope_Polytope_PolytopeGeom(contactModel='boon2012')
	with pytest.raises(ValueError, match='solver: this build has no Ipopt.*coinor-libipopt-dev'):
		geometry.solver = 'ipopt'
	assert geometry.solver == 'newton'
	with pytest.raises(ValueError, match='solver: this build has no Ipopt.*coinor-libipopt-dev'):
		polytope.contact(polytope.cuboid((0, 0, 0), (1, 1, 1)), polytope.cuboid((0, 0, 1), (1, 1, 1)), solver='ipopt', contactModel='boon2012')
