# SPDX-License-Identifier: GPL-2.0-or-later
"""polytope.tradeoff: rows against known values of a block on a floor; what cannot count is said, and bad arguments are refused before anything runs."""

import csv
import math
import os
import pathlib
import signal
import subprocess
import sys
import time

import numpy as np
import pytest
from yade import (
	Ig2_Polytope_Polytope_PolytopeGeom,
	Ip2_RockJointMat_RockJointMat_RockJointPhys,
	Law2_PolytopeGeom_RockJointPhys_MohrCoulomb,
	NewtonIntegrator,
	O,
	RockJointMat,
	polytope,
)
from yade.polytope import _builds

weight, stiffness = 8 * 1000 * 10.0, 1e8


def build(density=1000):
	"""A cube of edge 2 m on a floor."""
	O.reset()
	O.materials.append(RockJointMat(normalStiffness=stiffness, shearStiffness=stiffness, frictionAngle=0.5, density=density))
	O.bodies.append(polytope.cuboid((0, 0, -1), (3, 3, 1), fixed=True))
	O.bodies.append(polytope.cuboid((0, 0, 1), (1, 1, 1)))
	O.engines = polytope.engines(
		gravity=(0, 0, -10),
		geometry=Ig2_Polytope_Polytope_PolytopeGeom(contactModel='boon2012'),  # a face's depth is its force over the stiffness
		physics=Ip2_RockJointMat_RockJointMat_RockJointPhys(stiffnessPerArea=False),
		law=Law2_PolytopeGeom_RockJointPhys_MohrCoulomb(normalDamping=1),
		timeStepper=False,
	)
	O.dt = 1e-3
	O.saveTmp()


def buildPlain(edge=1, answers=1):
	"""A body alone."""
	O.reset()
	O.bodies.append(polytope.cuboid((0, 0, 0), (edge, 1, 1), material=RockJointMat(density=1000)))
	O.engines, O.dt, O.tags['id'] = [NewtonIntegrator(gravity=(0, 0, -10), damping=0)], 1e-3, str(answers)


def measure():
	while O.time < 0.5:
		O.step()
	return 1 - O.bodies[1].state.pos[2]


def measurePlace():
	O.step()
	return O.bodies[0].state.pos


def measureMass():
	touch('ran')
	return [float(O.bodies[0].state.mass)] * int(O.tags['id'])


def measureAgain():
	O.loadTmp()
	O.step()
	return O.bodies[1].state.pos[2]


def measureWithItsOwnStep():
	O.dt = 0.5e-3
	O.step()
	return 1.0


def measureNothing():
	O.step()


def measureNan():
	return math.nan


def measureWrongly():
	raise ArithmeticError('no such thing')


def measureAndDie():
	os.kill(os.getpid(), signal.SIGKILL)


def measureAndExit():
	sys.exit('enough')


def measureAndInterrupt():
	touch(f'process-{os.getpid()}')
	os.kill(os.getppid(), signal.SIGINT)
	time.sleep(3600)


def touch(name):
	if 'POLYTOPE_TEST' in os.environ:
		(pathlib.Path(os.environ['POLYTOPE_TEST']) / name).touch()


def run(settings, reference=weight / stiffness, function=measure, make=build, timedSeconds=0):
	return polytope.tradeoff(make, settings, function, reference, timedSeconds)


def testRowsTellWhatChanged(tmp_path, capsys):
	here = O.bodies.append(polytope.cuboid((0, 0, 0), (1, 1, 1), material=RockJointMat()))
	settings = {
		'as it is': {},
		'half step': {'timeStepFactor': 0.5},
		'step': {'timeStep': np.float64(2e-3)},
		'heavy': {'density': np.int64(2000)},
	}
	table = run(settings, timedSeconds=0.02)
	assert len(O.bodies) == 1 and O.bodies[here].state.pos[2] == 0  # the scene of this process is as it was
	for name in ('as it is', 'half step', 'step'):
		assert table[name].error < 1e-6 and table[name].failures == 0 and not table[name].note
	assert table['heavy'].error == pytest.approx(1, abs=1e-6)
	assert [row.timeStep for row in table] == [1e-3, 5e-4, 2e-3, 1e-3]
	for row in table:
		assert row.cost == pytest.approx(row.stepMicroseconds * 1e-3 / row.timeStep)
	table.show()
	assert 'µs per step' in capsys.readouterr().out
	table.csv(tmp_path / 'table.csv')
	with open(tmp_path / 'table.csv') as file:
		rows = list(csv.DictReader(file))
	assert [row['setting'] for row in rows] == list(settings) and float(rows[3]['answer']) == table['heavy'].answer
	assert float(rows[1]['cost']) == pytest.approx(table['half step'].cost / table['as it is'].cost)


def testARenewedSceneLosesItsSettings():
	"""The scene that build() has saved has neither attribute nor time step of the setting."""
	settings = {
		'as it is': {},
		'model': {'contactModel': 'spring', 'warmStart': False},
		'longer': {'timeStepFactor': 2},
		'named': {'warmStart': True},
	}
	table = run(settings, 'as it is', measureAgain)
	assert table['model'].note.startswith('contactModel, warmStart not in effect') and table['longer'].note.startswith(
		'timeStepFactor not in effect'
	)
	assert [table[name].answer is None for name in settings] == [False, True, True, False]
	assert table.front() == [table['as it is']] or table.front() == [table['named']]


def testATimeStepOfMeasure():
	table = run({'as it is': {}, 'step': {'timeStep': 2e-3}}, 1, measureWithItsOwnStep)
	assert table['as it is'].timeStep == 0.5e-3 and 'timeStep not in effect' in table['step'].note


def testAttributesThatNothingTakes():
	table = run({'as it is': {}, 'Ipopt': {'solver': 'ipopt'}}, [8000], measureMass, buildPlain)
	assert 'which solver would be set in' in table['Ipopt'].note and table['Ipopt'].cost is None and not table['as it is'].note


def testVectors():
	table = run({'a': {}}, [0, 0, -2e-5], measurePlace, buildPlain)
	assert table['a'].error == pytest.approx(0.5, abs=1e-9) and table['a'].stepMicroseconds > 0


def testAnswersThatDoNotFitTheReference():
	table = run({'two': {'answers': 2}, 'three': {'answers': 3}}, 'two', measureMass, buildPlain)
	assert table['two'].error == 0 and table['three'].error is None and 'not as many numbers' in table['three'].note


@pytest.mark.parametrize(
	('function', 'words'),
	[
		(measureNothing, "NoneType"),
		(measureNan, 'not a finite number'),
		(measureWrongly, 'ArithmeticError: no such thing'),
		(measureAndExit, 'SystemExit: enough'),
		(measureAndDie, 'exit code -9'),
	],
)
def testWhatGoesWrongIsSaid(function, words):
	table = run({'a': {}}, 1, function, buildPlain)
	assert words in table['a'].note and table['a'].error is None and not table.front()


def testPrecisionsThatAreNotBuilt():
	missing = [name for name in _builds.precisions if not _builds.available(name)]
	if not missing:
		pytest.skip('every precision is built')
	table = run({'a': {}, 'b': {'precision': missing[0]}}, [1000], measureMass, buildPlain)
	assert table['b'].note == f'not built for {missing[0]}: YADE_POLYTOPE_PRECISION={missing[0]} ./run build' and table['a'].error == 7


def testFrontHoldsWhatNothingBeats():
	from yade.polytope.tradeoff import Row, TradeoffTable

	given = (
		('first', 2, 1.5),
		('worse and dearer', 3, 1.9),
		('cheap', 1, 3),
		('best', 8, 1),
		('none', None, None),
		('hardly better', 9, 1.04),
	)
	table = TradeoffTable([Row(name, {}, value, None, 1, time) for name, time, value in given], 1)
	assert [row.name for row in table.front()] == ['cheap', 'first', 'best'] and table['best'].error == 0


def testAnInterruptEndsTheProcess(monkeypatch, tmp_path):
	monkeypatch.setenv('POLYTOPE_TEST', str(tmp_path))
	with pytest.raises(KeyboardInterrupt):
		run({'a': {}}, 1, measureAndInterrupt, buildPlain)
	(number,) = (path.name.partition('-')[2] for path in tmp_path.iterdir())
	end = time.monotonic() + 300  # of 3600 s that it sleeps
	while runs(number) and time.monotonic() < end:
		time.sleep(0.01)
	assert not runs(number)


def runs(process):
	try:
		return pathlib.Path(f'/proc/{process}/stat').read_text().rpartition(')')[2].split()[0] not in 'ZX'  # ended, not yet waited for
	except FileNotFoundError:
		return False


@pytest.mark.parametrize(
	('settings', 'reference', 'seconds', 'word'),
	[
		([{}], 1, 0, 'settings'),
		({}, 1, 0, 'settings'),
		({'a': None}, 1, 0, "settings.'a'"),
		({'a': {'edge': object()}}, 1, 0, "settings.'a'"),
		({'a': {'colour': 3}}, 1, 0, 'colour.*newtonTolerance'),
		({'a': {'timeStep': 0}}, 1, 0, 'timeStep'),
		({'a': {'timeStep': None}}, 1, 0, 'timeStep'),
		({'a': {'timeStepFactor': math.nan}}, 1, 0, 'timeStepFactor'),
		({'a': {'precision': 'single'}}, 1, 0, 'precision'),
		({'a': {}}, None, 0, 'reference'),
		({'a': {}}, 'b', 0, 'reference'),
		({'a': {}}, math.nan, 0, 'reference'),
		({'a': {}}, [], 0, 'reference'),
		({'a': {}}, {'x': 1}, 0, 'reference'),
		({'a': {}}, 1, -1, 'timedSeconds'),
	],
)
def testRefusedBeforeAnythingRuns(settings, reference, seconds, word, monkeypatch, tmp_path):
	monkeypatch.setenv('POLYTOPE_TEST', str(tmp_path))
	with pytest.raises(ValueError, match=word):
		run(settings, reference, measureMass, buildPlain, seconds)
	assert not list(tmp_path.iterdir())


def testFunctionsThatAnotherProcessCannotFind():
	def within():
		pass

	for make, function, word in ((lambda: None, measureMass, 'build'), (buildPlain, within, 'measure'), (buildPlain, 'measure', 'measure')):
		with pytest.raises(ValueError, match=f'{word}: must be a function'):
			run({'a': {}}, 1, function, make)


script = '''
{before}
from yade import *
from yade import polytope
def build():
	O.bodies.append(polytope.cuboid((0, 0, 0), (1, 1, 1), material=RockJointMat()))
	O.engines, O.dt = [NewtonIntegrator()], 1e-3
def measure():
	O.step()
	return len(O.bodies)
{condition}
	print('errors', [row.error for row in polytope.tradeoff(build, {{'a': {{}}, 'b': {{}}}}, measure, 1, timedSeconds=0)])
	print('done')
'''


@pytest.mark.parametrize(('before', 'condition'), [('', 'if True:'), ("isScript = __name__ == '__main__'", 'if isScript:')])
def testScriptsThatImportEverything(before, condition, tmp_path):
	"""After `from yade import *` __name__ is no longer '__main__'. Without a condition the process reads up to the call, no further."""
	file = tmp_path / 'script.py'
	file.write_text(script.format(before=before, condition=condition))
	said = subprocess.run([sys.executable, str(file)], capture_output=True, text=True).stdout
	assert 'errors [0.0, 0.0]' in said and said.count('done') == 1, said
