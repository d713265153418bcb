# SPDX-License-Identifier: GPL-2.0-or-later
"""polytope.tradeoff: answers that do not count are never on the front, bad arguments are refused before anything runs, and scripts of
any shape work."""

import math
import os
import pathlib
import re
import subprocess
import sys

import numpy as np
import pytest
from yade import NewtonIntegrator, O, RockJointMat, polytope
from yade.polytope.tradeoff.plot import plotTradeoff
from yade.polytope.tradeoff.table import Row, TradeoffTable

here = pathlib.Path(__file__).resolve()


def tableOf(reference=1.0, **results):
	"""name → (cost, answer, energy)."""
	rows = [Row(name, {}) for name in results]
	for row, (cost, value, *energy) in zip(rows, results.values(), strict=True):
		times = {'stepMicroseconds': cost, 'contactMicroseconds': cost, 'contacts': 1, 'timeStep': 1, 'seconds': 1, 'fallbacks': 0, 'failures': 0}
		row.take({'values': {'x': repr(value)}, 'energy': energy[0] if energy else None, **times})
	return TradeoffTable(rows, reference)


@pytest.mark.parametrize('value', [math.nan, math.inf, -math.inf])
def testAnAnswerThatIsNoNumberIsNotOnTheFront(value, tmp_path):
	table = tableOf(good=(2, 1.5), diverged=(1, value), better=(3, 1.1))
	assert [row.name for row in table.front()] == ['good', 'better']
	assert table['diverged'].error is None and repr(value) in table['diverged'].note
	table.plot(tmp_path / 'plot.png')
	assert (tmp_path / 'plot.png').stat().st_size > 1000


def testASceneThatBlewUpIsNotOnTheFront():
	"""Kinetic energy without a source, and the energy available."""
	table = tableOf(calm=(2, 1.5, [-100, 100]), paper=(2, 1.2, [120, 100]), blown=(1, 0.03, [1800, 400]), lost=(1, 0.03, [math.inf, 100]))
	assert [row.name for row in table.front()] == ['paper']
	assert 'blew up' in table['blown'].note and 'blew up' in table['lost'].note and not table['paper'].note
	driven = tableOf(one=(2, 1.5, [1800, 0]), other=(1, 1.6, [2000, 0]))  # a motor does the same in both
	assert [row.name for row in driven.front()] == ['other', 'one']


def testAReferenceWithoutAnswerIsNamed():
	table = tableOf('lost', good=(2, 1.5), lost=(1, math.nan))
	columns, rows = table.cells()
	assert table['good'].error is None and "'lost'" in rows[0][columns.index('note')] and not table.front()
	assert "'lost'" in table.against('lost', ['good']).remark


@pytest.mark.parametrize('reference', [None, math.nan, [], 'none of them', {'x': 1}])
def testATableRefusesAReferenceThatIsNone(reference):
	with pytest.raises(ValueError, match='reference: '):
		tableOf(good=(2, 1.5)).against(reference)


@pytest.mark.parametrize('floor', [0, math.nan, -1, math.inf, '1e-9', None])
def testAPlotRefusesAFloorThatIsNone(floor, tmp_path):
	with pytest.raises(ValueError, match='floor: '):
		tableOf(good=(2, 1.5)).plot(tmp_path / 'plot.png', floor=floor)
	assert not list(tmp_path.iterdir())


def testEveryPointHasItsOwnNumber(tmp_path):
	names = {f'setting {k}': (1 + k * 1e-4, 1.1) for k in range(12)}
	drawn = []
	from matplotlib.text import Text  # its own box, without the line to the point
	from yade.polytope.tradeoff import plot as module

	class Kept(module.Figure):
		def savefig(self, path, **options):
			super().savefig(path, **options)
			drawn.extend((text.get_text(), Text.get_window_extent(text)) for text in self.axes[0].texts if text.get_text().isdigit())

	original, module.Figure = module.Figure, Kept
	try:
		plotTradeoff(tmp_path / 'plot.png', [('', tableOf(**names))])
	finally:
		module.Figure = original
	assert sorted(int(text) for text, _ in drawn) == list(range(1, 13))
	boxes = [box.shrunk(0.8, 0.6) for _, box in drawn]
	assert not any(one.overlaps(other) for k, one in enumerate(boxes) for other in boxes[:k])


def testACoarseNewtonToleranceIsNotInEffectAndTheReportSaysSo(monkeypatch, tmp_path):
	cubes = [polytope.cuboid((0.1 * k, 0.2 * k, 0.98 * k), (0.5, 0.5, 0.5), material=RockJointMat()) for k in range(2)]
	fine, coarse = (polytope.contact(*cubes, newtonTolerance=tolerance) for tolerance in (1e-10, 1e-2))
	assert fine.point == coarse.point and fine.newtonIterations == coarse.newtonIterations
	monkeypatch.syspath_prepend(str(here.parents[3] / 'tools/measure/tradeoff'))
	from tradeoffAxes import allScenes
	from tradeoffReport import notRun, reportScene, summary, writeSummary

	scenes, table = allScenes(), tableOf(**{'default': (1, 2.0), 'Newton tolerance 1e-2': (1, 2.0)})
	findings, _ = reportScene(scenes['B'], table, tmp_path, None)
	assert any('hardly in effect' in part['text'] for part in findings.content['parts'] if part['kind'] == 'text')
	tables = {'B': table, 'C': tableOf(default=(1, 2.0))}
	_, rows = writeSummary(summary(tables, scenes), 'BC', tmp_path / 'summary.csv')
	assert [row[-1] == notRun for row in rows] == [False, True]


def build(edge=1):
	O.reset()
	O.bodies.append(polytope.cuboid((0, 0, 0), (edge, 1, 1), material=RockJointMat(density=1000)))
	O.engines = [NewtonIntegrator(gravity=(0, 0, -10), damping=0)]
	O.dt = 1e-3


def measure():
	O.step()
	return [1.0, float(O.bodies[0].state.mass)]


def measureAndBlowUp():
	O.step()
	if O.dt > 2e-3:
		O.bodies[0].state.vel = (0, 0, 1e3)
	return 1.0


def measureAndDie():
	import signal

	os.kill(os.getpid(), signal.SIGKILL)


def measureAndExit():
	print('what happened')
	print('=====', flush=True)
	os._exit(3)


def measureNothing():
	(pathlib.Path(os.environ['POLYTOPE_TEST']) / str(os.getpid())).touch()
	return 1.0


def measureNone():
	O.step()


def measureNoAnswer():
	return {}


def measureVector():
	O.step()
	return O.bodies[0].state.pos


def measureAndReset():
	O.reset()
	return 1.0


def measureAndLeave():
	sys.exit('enough')


def buildWithoutStep():
	build()
	O.dt = 0


def run(settings, reference, function=measure, **options):
	return polytope.tradeoff(build, settings, function, reference, **{'timedSeconds': 0, **options})


def testEnergyOfARealScene():
	table = run({'a': {}, 'blown': {'timeStepFactor': 4}}, 1, measureAndBlowUp)
	assert 'blew up' in table['blown'].note and not table['a'].note


def testNumbersOfNumpyReachTheProcess():
	table = run({'a': {'edge': np.int64(2), 'timeStep': np.float64(2e-3)}}, [1, 16000])
	assert table['a'].error < 1e-12 and table['a'].timeStep == 2e-3


def testASignalIsNamed():
	assert 'SIGKILL' in run({'a': {}}, 1, measureAndDie)['a'].note
	assert run({'a': {}}, 1, measureAndExit)['a'].note == 'ended with exit code 3: what happened'


@pytest.mark.parametrize(
	('function', 'words'),
	[
		(measureNone, 'measure: must return a number.*None'),
		(measureNoAnswer, 'measure: .*without an answer'),
		(measureAndReset, 'measure: left no engines'),
		(measureAndLeave, "sys.exit.'enough'"),
	],
)
def testAMeasureWithoutAnswerIsNamed(function, words):
	row = run({'a': {}}, 1, function)['a']
	assert re.search(words, row.note) and row.error is None and '\n' not in row.note


def testAVectorOfYadesIsAnAnswer():
	assert run({'a': {}}, [0, 0, -1e-5], measureVector)['a'].error < 1e-9


def testASceneWithoutTimeStepIsNamed():
	row = polytope.tradeoff(buildWithoutStep, {'a': {}}, measure, [1, 1000], timedSeconds=0)['a']
	assert 'O.dt above 0' in row.note and row.cost is None


def buildPair(numbers=2):
	O.reset()
	O.engines, O.dt = [NewtonIntegrator()], 1e-3
	return numbers


def measureSome(numbers):
	return [1.0] * numbers


def testARowOfAnotherLengthThanTheReferenceRowIsNamed():
	table = polytope.tradeoff(buildPair, {'two': {}, 'three': {'numbers': 3}}, measureSome, 'two', timedSeconds=0)
	assert table['two'].error == 0 and not table['two'].note
	assert table['three'].error is None and '3 numbers' in table['three'].note and not table['three'].counts


def testALengthThatDoesNotFitIsRefusedAfterTheFirstRun(monkeypatch, tmp_path):
	monkeypatch.setenv('POLYTOPE_TEST', str(tmp_path))
	with pytest.raises(ValueError, match='reference: .*a single number.*3 numbers'):
		run({'a': {}, 'b': {}, 'c': {}}, [1, 2, 3], measureNothing)
	assert len(list(tmp_path.iterdir())) == 1


@pytest.mark.parametrize(
	('settings', 'reference', 'options', 'word'),
	[
		([{}], 1, {}, 'settings'),
		({'a': None}, 1, {}, "settings.'a'"),
		({1: {}}, 1, {}, 'settings'),
		({'a': {'warmStart': None}}, 1, {}, 'warmStart'),
		({'a': {'edge': object()}}, 1, {}, 'edge'),
		({'a': {'colour': 3}}, 1, {}, 'colour.*newtonTolerance'),
		({'a': {'timeStep': 1e-3, 'timeStepFactor': 2}}, 1, {}, 'both'),
		({'a': {'timeStep': 0}}, 1, {}, 'timeStep'),
		({'a': {'timeStep': None}}, 1, {}, 'timeStep'),
		({'a': {'timeStepFactor': math.nan}}, 1, {}, 'timeStepFactor'),
		({'a': {'timeStepFactor': -1}}, 1, {}, 'timeStepFactor'),
		({'a': {}}, None, {}, 'reference'),
		({'a': {}}, math.nan, {}, 'reference'),
		({'a': {}}, [], {}, 'reference'),
		({'a': {}}, {'x': 1}, {}, 'reference'),
		({'a': {}}, 1, {'repeats': 1.5}, 'repeats'),
		({'a': {}}, 1, {'repeats': 0}, 'repeats'),
		({'a': {}}, 1, {'timedSeconds': -1}, 'timedSeconds'),
		({'a': {}}, 1, {'timedSeconds': math.nan}, 'timedSeconds'),
		({'a': {}}, 1, {'timeLimit': -3}, 'timeLimit'),
		({'a': {}}, 1, {'timeLimit': math.nan}, 'timeLimit'),
	],
)
def testRefusedBeforeAnythingRuns(settings, reference, options, word, monkeypatch, tmp_path):
	monkeypatch.setenv('POLYTOPE_TEST', str(tmp_path))
	with pytest.raises(ValueError, match=word):
		run(settings, reference, measureNothing, **options)
	assert not list(tmp_path.iterdir())


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
	print('errors', [row.error for row in polytope.tradeoff(build, {{'a': {{}}, 'b': {{}}}}, measure, 1, timedSeconds=0).rows])
	print('done')
'''


@pytest.mark.parametrize(('before', 'condition'), [('', 'if True:'), ("isScript = __name__ == '__main__'", 'if isScript:')])
def testScriptsThatImportEverything(before, condition, tmp_path):
	"""What the docstring of tradeoff prescribes: after `from yade import *` __name__ is no longer '__main__'."""
	file = tmp_path / 'script.py'
	file.write_text(script.format(before=before, condition=condition))
	said = subprocess.run([sys.executable, str(file)], capture_output=True, text=True).stdout
	assert 'errors [0.0, 0.0]' in said and said.count('done') == 1, said
