# SPDX-License-Identifier: GPL-2.0-or-later
"""polytope.requirements: what it times, and how; scenes in which there is nothing to time."""

import contextlib
import json
import math
import pathlib
import sys
import tempfile

import pytest
from boon2012.runWatch import stateHash
from boon2012.solverTimes import hasSolver
from requirementsScenes import row
from yade import O, PyRunner, polytope
from yade.polytope.requirements import costs as requirementsCosts
from yade.polytope.requirements import worker as requirementsWorker

needsIpopt = pytest.mark.skipif(not hasSolver('ipopt'), reason='this build has no Ipopt')


def testMeasuringTouchesNothing(tmp_path):
	row(number=5, computeArea=True, timing=True)
	O.engines = [*O.engines, PyRunner(command='raise SystemExit', iterPeriod=1000, firstIterRun=10**6)]
	functor = O.engines[2].geomDispatcher.functors[0]

	def everything(name):
		O.save(str(tmp_path / name), quiet=True)
		return (tmp_path / name).read_bytes(), stateHash(), functor.stats(), O.iter, O.time, O.timingEnabled, O.engines[2].execTime

	before = everything('before.yade.bin')
	found = polytope.requirements(O)
	assert everything('after.yade.bin') == before
	assert found.stepMicroseconds > 0
	assert {'clocks', 'warm start'} <= {finding.what for finding in found.findings if finding.cost is not None}
	assert 'contact area' in repr(found) and 'saves' in repr(found)
	O.step()  # and goes on


@needsIpopt
def testContactPointIsTimedWithTheSolverThatIsAdvised():
	row(contactModel='boon2012', contactPoint='chebyshevCentre', solver='ipopt')
	found = polytope.requirements(O)
	solver, point = found['solver'], found['contact point']
	assert solver.seen.startswith('ipopt, not in use') and 'newton' in solver.advice
	assert "solver = 'newton' first" in point.advice
	assert found.findings.index(solver) < found.findings.index(point)
	for finding in (solver, point):  # Ipopt for the analytic centre takes a hundred times the step
		assert abs(finding.cost) < 10 * found.stepMicroseconds
	assert 'with all advice that was timed' in repr(found)


@needsIpopt
def testSolverInUseIsBlamed():
	row(solver='ipopt', contactModel='boon2012')
	found = polytope.requirements(O)
	assert found['solver'].seen == 'ipopt for every contact'
	assert found['solver'].cost > 0.5 * found.stepMicroseconds
	assert 'Ipopt' in dict(found.notSeen)['Newton tolerance']


@pytest.mark.parametrize('settings', [{'contactModel': 'boon2012', 'contactPoint': 'centroid'}, {'contactModel': 'spring'}])
def testSolverWithoutACentreToSolveFor(settings):
	row(**settings)
	found = polytope.requirements(O, measure=False)['solver']
	assert found.seen.startswith('newton, not in use') and not found.advice
	if hasSolver('ipopt'):
		O.engines[2].geomDispatcher.functors[0].solver = 'ipopt'
		found = polytope.requirements(O, measure=False)['solver']
		assert found.seen.startswith('ipopt, not in use') and bool(found.advice) == ('contactPoint' in settings)


def testContactModelIsTimedAfterWhatItMakesIdle():
	row(contactModel='boon2012', contactPoint='chebyshevCentre')
	O.engines[2].lawDispatcher.functors[0].normalDamping = O.engines[3].damping = 0
	found = polytope.requirements(O, measure=False)
	assert found.findings.index(found['contact point']) < found.findings.index(found['damping and energy'])
	assert 'neither contactPoint nor solver' in found['damping and energy'].advice


def testPermanentForcesActWhereTimesAreMeasured(tmp_path, monkeypatch):
	"""A scene's file does not hold them."""
	row()
	O.forces.setPermF(2, (0, 0, 3e4))  # lifts the block
	start = O.bodies[2].state.pos[2]
	heights = []
	monkeypatch.setattr(requirementsWorker, 'timed', lambda seconds: (heights.append(O.bodies[2].state.pos[2]), 1.0)[1:])
	monkeypatch.setattr(requirementsWorker, 'warmUp', 50)
	monkeypatch.setattr(requirementsCosts.subprocess, 'run', lambda command, **how: requirementsWorker.stepTimes(command[4], **json.loads(pathlib.Path(command[5]).read_text())))
	requirementsCosts.stepTimes(O, [])
	assert len(heights) == 2 and min(heights) > start + 1e-3


def testCostsAddUp(monkeypatch):
	"""Each change is timed with the advised ones before it in force, but for those that do not run."""
	times = {(): 10, ('a',): 7, ('a', 'b'): math.inf, ('a', 'c'): 8, ('a', 'c', 'd'): 9}
	monkeypatch.setattr(requirementsWorker, 'stepTime', lambda scene, loads, changes: times[tuple(name for name, _ in changes)])
	trials = [('a', 1, True), ('b', 1, True), ('c', 1, True), ('d', 1, False)]
	assert requirementsWorker.stepTimes('', trials) == {'': 10, 'a': 7, 'c': 8, 'd': 9}

	row(computeArea=True, timing=True)
	answer = {'': 10, 'timing': 5, 'warmStart': 8}
	monkeypatch.setitem(polytope.requirements.__globals__, 'stepTimes', lambda O, trials: (answer, ''))
	found = polytope.requirements(O)
	assert [found[name].cost for name in ('clocks', 'warm start')] == [5, -3]
	assert 'a step takes 10 µs, 5 µs with all advice' in repr(found)


def blownApart(**functor):
	row(**functor)
	for body in O.bodies:
		if body.dynamic:
			body.state.pos += (0, 0, 5 * body.id)
	O.step()
	O.step()


def testWhatCannotBeLookedAtIsNamed():
	blownApart()
	found = polytope.requirements(O, measure=False)
	missing = dict(found.notSeen)
	assert {'time step', 'corner radius', 'Newton tolerance'} <= set(missing) and 'no contact' in missing['time step']
	assert 'time step: no contact' in repr(found)
	with pytest.raises(KeyError, match='no contact'):
		found['time step']


def testWithoutContactsNothingIsSaidOfTheirCost():
	blownApart(computeArea=True, timing=True, warmStart=False, contactPoint='chebyshevCentre')
	O.engines[1].verletDist = 0
	found = polytope.requirements(O)
	assert repr(found).startswith('No polytopes are in contact now') and 'O.dt' in repr(found).split('\n')[0]
	assert {finding.what for finding in found.findings if finding.cost is not None} == {'verletDist'}
	assert {'contact area', 'cohesion', 'corner radius'} <= set(dict(found.notSeen))
	row()
	assert 'No polytopes' not in repr(polytope.requirements(O, measure=False))


@pytest.mark.parametrize('part', ['folder', 'file'])
def testFolderThatCannotBeWritten(monkeypatch, tmp_path, part):
	row()
	before = stateHash()
	if part == 'folder':
		monkeypatch.setattr(tempfile, 'tempdir', str(tmp_path / 'gone'))
	else:
		monkeypatch.setattr(
			requirementsCosts.tempfile, 'TemporaryDirectory', lambda **how: named(str(tmp_path / 'gone'))
		)
	with pytest.raises(OSError, match='measure: cannot write .*gone.*TMPDIR'):
		polytope.requirements(O)
	assert stateHash() == before
	assert polytope.requirements(O, measure=False).findings


def named(name):
	folder = contextlib.nullcontext()
	folder.name = name
	return folder


def testProcessThatEndsWithoutAnAnswer(monkeypatch):
	row()
	monkeypatch.setattr(sys, 'executable', '/bin/false')
	found = polytope.requirements(O)
	assert found.stepMicroseconds is None and 'ended without' in dict(found.notSeen)['costs']
