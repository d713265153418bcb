# SPDX-License-Identifier: GPL-2.0-or-later
"""`polytope.run`: the steps of O.run, in parts. What it shows in a terminal is in test_progress.py."""

import math
import subprocess
import sys
import warnings

import pytest
import yade
from conftest import startRun
from scenes import runInBackground
from yade import O, PyRunner, RockJointMat, polytope
from yade.polytope.scene import running


@pytest.fixture
def falling():
	"""A cube that falls onto a floor; its id."""
	O.materials.append(RockJointMat(density=2600, normalStiffness=1e7, shearStiffness=1e7, frictionAngle=0.5))
	O.bodies.append(polytope.cuboid((0, 0, -0.5), (2, 2, 0.5), fixed=True))
	cube = O.bodies.append(polytope.cuboid((0, 0, 0.6), (0.2, 0.2, 0.2), orientation=yade.Quaternion((1, 2, 0), 0.2)))
	O.engines = polytope.engines()
	return cube


def state(cube):
	return O.iter, O.time, *O.bodies[cube].state.pos, *O.bodies[cube].state.vel


def testATimeIsReachedInTheStepThatReachesIt(falling, monkeypatch):
	"""Bit for bit as step by step, however short the parts are; a height of free fall; nothing to do the second time."""
	monkeypatch.setattr(running, 'heard', 1e-9)
	O.saveTmp()
	assert polytope.run(until=0.1) is True
	ours = state(falling)
	assert 0.1 <= O.time < 0.1 + 1.01 * O.dt and O.stopAtTime <= 0
	assert polytope.run(until=0.1) is True and polytope.run(until=0) is True and O.iter == ours[0]
	O.reload()
	while O.time < 0.1:
		O.step()
	assert state(falling) == ours
	# YADE's damping takes a part of the weight from a body that falls
	assert O.bodies[falling].state.pos[2] == pytest.approx(0.6 - 0.5 * 0.8 * 9.81 * 0.1**2, abs=9.81 * 0.1 * O.dt)


def testSoManySteps(falling):
	assert polytope.run(0) is True and O.iter == 0
	assert polytope.run(7) is True and O.iter == 7
	assert polytope.run(steps=1234) is True and O.iter == 1241 and not O.running
	assert polytope.run(5, until=1000) is False and O.iter == 1246 and O.stopAtTime <= 0


def testAFunctionIsAskedEverySoManySteps(falling):
	seen = []

	def low():
		seen.append(O.iter)
		return O.bodies[falling].state.pos[2] < 0.55

	assert polytope.run(until=low, every=20) is True
	assert seen == list(range(0, O.iter + 1, 20)) and O.iter > 20 and O.bodies[falling].state.pos[2] < 0.55
	now = O.iter
	assert polytope.run(until=low) is True and O.iter == now, 'it holds already'
	assert polytope.run(until=lambda: False, steps=30, every=20) is False and O.iter == now + 30
	with pytest.raises(ZeroDivisionError):
		polytope.run(until=lambda: 1 / 0)
	assert not O.running


def testAnEngineThatPausesEndsIt(falling):
	"""Such an engine ends the run as it ends O.run; a later run does not end where this one would have."""
	O.engines += [PyRunner(command='O.pause()', iterPeriod=50)]
	for call in (dict(steps=10**6), dict(until=100), dict(until=lambda: False)):
		begin = O.iter
		assert polytope.run(**call) is False and begin < O.iter <= begin + 51 and not O.running
		assert O.stopAtIter <= 0 and O.stopAtTime <= 0


def testTheScenesOwnStopHolds(falling):
	O.stopAtTime = 0.02
	assert polytope.run(until=0.01) is True and O.stopAtTime == 0.02
	assert polytope.run(until=0.05) is False and 0.02 <= O.time < 0.03 and O.stopAtTime <= 0
	assert polytope.run(until=0.05) is True


def testWhatAnEngineRaisesArrives(falling, monkeypatch):
	monkeypatch.setattr(type(O), 'run', startRun)  # YADE's own, which the other tests do without
	O.engines += [PyRunner(command='1 / 0', iterPeriod=1, iterLast=O.iter)]
	with pytest.raises(RuntimeError):
		polytope.run(until=0.1)
	assert O.stopAtTime <= 0 and not O.running


@pytest.mark.parametrize(
	'named, argument',
	[
		(dict(), 'until'),
		*((dict(until=value), 'until') for value in (-1, math.nan, math.inf, True, '2')),
		*((dict(steps=value), 'steps') for value in (-1, 1.5, True, '9')),
		*((dict(until=1, every=value), 'every') for value in (0, 2.5)),
	],
)
def testNonsenseIsRefused(falling, named, argument):
	with pytest.raises(ValueError, match=f'^{argument}: '):
		polytope.run(**named)
	assert O.iter == 0 and O.stopAtTime <= 0


def testScenesThatCannotRunAreRefused(falling):
	O.dt = 0
	engines = [engine for engine in O.engines if not isinstance(engine, yade.PolytopeTimeStepper)]
	O.engines = []
	with pytest.raises(ValueError, match='^O.engines: there are none'):
		polytope.run(10)
	O.engines = engines
	with pytest.raises(ValueError, match='^O.dt: 0 s'):
		polytope.run(until=1)
	O.dt = 1e-5
	runInBackground()
	with pytest.raises(RuntimeError, match='^O: is running'):
		polytope.run(10)
	O.pause()
	O.wait()


interrupted = """
import os, signal, threading, time
from yade import O, RockJointMat, polytope
O.materials.append(RockJointMat(density=2600, normalStiffness=1e7, shearStiffness=1e7, frictionAngle=0.5))
O.bodies.append(polytope.cuboid((0, 0, 0), (0.2, 0.2, 0.2)))
O.engines = polytope.engines()

def press():
	while O.iter < 100:
		time.sleep(0.01)
	os.kill(os.getpid(), signal.SIGINT)

threading.Thread(target=press).start()
try:
	polytope.run(10**12)
except KeyboardInterrupt:
	begin = O.iter
	print('heard', 100 <= begin, O.running, polytope.run(10), O.iter - begin)
"""


def testCtrlCIsHeard():
	"""The run would take years; the scene goes on afterwards."""
	start = 'import signal; signal.signal(signal.SIGINT, signal.default_int_handler)\n'  # a shell's programs in the background ignore it
	done = subprocess.run([sys.executable, '-c', start + interrupted], capture_output=True, text=True, timeout=300)
	assert done.returncode == 0, done.stderr
	assert done.stdout.split('heard')[1].split() == ['True', 'False', 'True', '10'], done.stdout


def testATimeFarAwayInAStepThatNothingLimitsIsTold():
	"""YADE's own step is 1e-8 s: a scene without a body that moves went on for minutes, without a word."""
	O.materials.append(RockJointMat(density=2600, normalStiffness=1e7, shearStiffness=1e7, frictionAngle=0.5))
	O.bodies.append(polytope.cuboid((0, 0, -0.5), (2, 2, 0.5), fixed=True))
	O.engines = polytope.engines()
	O.dt = 1e-8
	with pytest.warns(UserWarning, match='^until: .* nothing limits the time step: .* set O.dt'):
		assert polytope.run(10, until=1) is False
	assert O.iter == 10
	O.dt = 1e-3
	with warnings.catch_warnings():
		warnings.simplefilter('error')
		assert polytope.run(until=0.1) is True


def testATimeFarAwayInALimitedStepIsNotTold(falling):
	O.dt = 1e-9  # until the stepper has looked
	with warnings.catch_warnings():
		warnings.simplefilter('error')
		assert polytope.run(3, until=10) is False
	assert O.iter == 3


@pytest.mark.parametrize('how', [{'steps': 2}, {'until': 1e-3}, {'until': lambda: O.iter > 3}])
def testABodyThatIsNoLongerAnywhereIsTold(falling, how):
	O.bodies[falling].state.vel = (math.nan, 0, 0)
	with pytest.warns(UserWarning, match=f'^run: position or velocity of body {falling} is not a number'):
		polytope.run(**how)
