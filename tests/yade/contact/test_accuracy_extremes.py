# SPDX-License-Identifier: GPL-2.0-or-later
"""`./run accuracy`: its quick variants hold the limits that docs/accuracy.md states, and a fault would be detected."""

import csv
import importlib.util
import json
import os
import pathlib
import re
import subprocess
import sys

import pytest
from yade import Quaternion, Vector3, polytope

folder = pathlib.Path(__file__).resolve().parents[3] / 'tools/measure/accuracy'

import pairTables
from pairAxes import axes
from pairExtremes import program

# by its path: `./run paper` has a report.py, too
specification = importlib.util.spec_from_file_location('accuracyReport', folder / 'report.py')
report = importlib.util.module_from_spec(specification)
specification.loader.exec_module(report)


def run(script, where, *options):
	done = subprocess.run(
		[sys.executable, folder / f'{script}.py', '--output', where, *options],
		env={**os.environ, 'OMP_NUM_THREADS': '1'},
		capture_output=True,
		text=True,
		timeout=3600,
	)
	assert (where / 'findings.json').is_file(), done.stderr
	return done.returncode, json.loads((where / 'findings.json').read_text())


@pytest.mark.skipif(not program.is_file(), reason='polytope_extremes is not built')
def testPairsHoldTheStatedLimits(tmp_path):
	code, findings = run('pairExtremes', tmp_path, '--quick', '--samples', '1')
	print('\n'.join(f"{row['quantity']}: {row['ours']}" for row in findings['rows']))
	assert not [row for row in findings['rows'] if row['good'] is False]  # None: reported only
	assert code == 0 and len(findings['rows']) > 50
	assert len(list(tmp_path.glob('*.csv'))) == 14  # thirteen axes, and the transitions
	assert len(list((tmp_path / 'samples').glob('*.csv'))) == 14  # also the transitions of the deep axis


def stated(axis):
	"""What docs/accuracy.md states of an axis, without its first column."""
	(line,) = re.findall(rf'^\| {re.escape(axis)} \| (.*) \|$', (folder.parents[2] / 'docs/accuracy.md').read_text(), re.MULTILINE)
	return line


ofPairs = {
	'depth': (
		'overlap depth',
		{'s* over': 's* to 1e-14', 'depth over': 'depth to 2e-14', 'down to 1e-6': 'to 3e-9 of the overlap', 'down to 1e-14': '5e-15'},
	),
	'aspect': ('aspect ratio', {'s* over': 's* to 1e-14', 'depth × normal': 'depth to 1e-12', 'up to 1e8': 'to 1e-4 of the overlap'}),
	'size': ('size ratio of the pair', {'s* over': 's* to 1e-14', 'depth over': 'depth to 2e-14'}),
	'angle': ('nearly parallel faces, twin planes', {'s* over': 's* to 1e-14', 'depth over': 'depth to 2e-14'}),
	'twins': ('nearly parallel faces, twin planes', {'s* over': 's* to 1e-14', 'depth over': 'depth to 2e-14'}),
	'planes': (
		'planes per body; redundant, duplicated',
		{'s* over': 's* to 1e-14', 'depth over': 'depth 2e-14', 'contact point': 'point 1e-8'},
	),
	'units': ('units', {'scaled': 'scaled answer to 1e-11'}),
}
"""Axis of the pairs → row of the table in docs/accuracy.md, and what is in a limit's text → what is in that row, which ends with the limit
or its unit."""


@pytest.mark.parametrize('axis', ofPairs)
def testLimitsOfPairsAreThoseOfTheDocumentation(axis):
	row, limits = ofPairs[axis]
	for text, said in limits.items():
		limit = next(one for one in axes[axis].limits if text in one.text)
		assert said in stated(row)
		assert limit.most == float(re.findall(r'\d[\d.e-]*', said.removesuffix(' of the overlap').replace('s*', ''))[-1]), limit.text


ofScenes = {
	'Stiffness ratio: normal forces at rest, worst relative error': ('stiffness ratio 1e6, mass ratio 1e9', 'forces to 1e-7'),
	'Mass ratio: heavy block left on a light one (surface), worst relative error of a force': (
		'stiffness ratio 1e6, mass ratio 1e9',
		'forces to 1e-7',
	),
	'Mass ratio: momentum after a collision, worst relative change': ('stiffness ratio 1e6, mass ratio 1e9', 'momentum to 1e-14'),
	'Tower of 50 blocks: worst relative error of a normal force (surface)': (
		'tower of 50 blocks; 1e6 steps at rest; slide of 1e6 steps',
		'forces to 5e-5',
	),
	'Tower of 50 blocks: worst relative error of a normal force (boon2012)': (
		'tower of 50 blocks; 1e6 steps at rest; slide of 1e6 steps',
		'forces to 5e-5',
	),
	'Steps at rest: way of a block of 1 m in 1000000 steps': ('tower of 50 blocks; 1e6 steps at rest; slide of 1e6 steps', '; 1e-11'),
	'Steps at rest: its turn': ('tower of 50 blocks; 1e6 steps at rest; slide of 1e6 steps', 'm, 1e-10'),
	'Slide: distance after 1000000 steps, worst relative error': (
		'tower of 50 blocks; 1e6 steps at rest; slide of 1e6 steps',
		'distance to 1e-5',
	),
}
"""Row of the findings → row of the table in docs/accuracy.md, and what is in it; ends with the limit."""


def testScenesHoldTheStatedLimits(tmp_path):
	"""The short run, with the limits and the numbers of steps of the whole one."""
	code, findings = run('sceneExtremes', tmp_path, '--quick')
	print('\n'.join(f"{row['quantity']}: {row['ours']}" for row in findings['rows']))
	assert not [row for row in findings['rows'] if row['good'] is False]  # None: reported only
	assert code == 0 and {path.stem for path in tmp_path.glob('*.csv')} == {
		'stiffness',
		'mass',
		'massStacks',
		'timeStep',
		'tower',
		'rest',
		'slide',
	}
	accept = {row['quantity']: row['accept'] for row in findings['rows']}
	for quantity, (row, said) in ofScenes.items():
		assert said in stated(row)
		assert accept[quantity] == [0, float(said.split()[-1])], quantity


def sample(**changes):
	"""A good contact as a line of the CSV, with changes."""
	good = dict(
		axis='depth',
		kind='face on face',
		value=0.1,
		sample=0,
		status='contact',
		inContact=1,
		touches=1,
		within=0,
		size=1,
		infeasibility=-0.1,
		infeasibilityError=1e-16,
		infeasibilityRounding=4e-15,
		depthError=1e-16,
		depthRounding=1e-15,
		forceError=1e-16,
		centreError=1e-12,
		centreRounding=2e-9,
		normalError=1e-16,
		normalRounding=1e-14,
		compared=1,
		finite=1,
		bounded=1,
		free=1,
		refusal='',
	)
	return pairTables.Sample({name: str(value) for name, value in {**good, **changes}.items()})


@pytest.mark.parametrize(
	'fault, changes',
	[
		('not a number', dict(finite=0)),
		('unbounded', dict(bounded=0)),
		('missed contact', dict(inContact=0, status='separated', compared=0)),
		('false contact', dict(touches=0)),
		('no way out along the normal', dict(free=0)),
		('error without a status', dict(centreError=1e-6)),
		('error without a status', dict(infeasibilityError=1e-13)),
		('error without a status', dict(depthError=1e-13)),
		('error without a status', dict(normalError=1e-3, status='normalFromOneBody')),
	],
)
def testFaultsAreSeen(fault, changes):
	found = pairTables.faults([sample(), sample(**changes)])
	assert [name for name, bad in found.items() if bad] == [fault] and len(found[fault]) == 1


@pytest.mark.parametrize(
	'changes',
	[
		{},
		dict(centreError=1.0, status='roundingLimited'),
		dict(inContact=0, within=1, status='separated', compared=0),
		dict(inContact=0, status='failed', compared=0),
		dict(touches=0, within=1),
	],
)
def testWhatIsLoudOrUndecidedIsNoFault(changes):
	assert not any(pairTables.faults([sample(**changes)]).values())


def testWhatIsNotJudgedIsCounted():
	silent = [
		sample(centreError=1.0, status='roundingLimited'),
		sample(inContact=0, status='failed', compared=0),
		sample(status='noDirection'),
		sample(status='refused', infeasibilityError=''),
		sample(compared=0),
	]
	judged = [sample(), sample(inContact=0, status='separated', compared=0), sample(status='normalFromDual')]
	assert pairTables.unjudged(silent + judged) == silent


def testACoordinateCostsItsOwnRoundingOnly():
	"""The pair is up to 1e9 sizes from the origin: the contact is that of the positions as stored, its point rounded where it stands."""
	turn = Quaternion((1, 2, 3), 0.4)
	for distance in (0, 1e3, 1e6, 1e9):
		far = Vector3(0.6, -0.48, 0.64) * distance
		one, two = polytope.regular(12, 1), polytope.regular(8, 1, orientation=turn)
		one.state.pos, two.state.pos = far, far + Vector3(0.7, 0.5, 1.1)
		here, there = polytope.regular(12, 1), polytope.regular(8, 1, orientation=turn)
		here.state.pos, there.state.pos = Vector3(0, 0, 0), two.state.pos - one.state.pos
		for model in ('foundation', 'spring', 'boon2012'):
			c, near = polytope.contact(one, two, contactModel=model), polytope.contact(here, there, contactModel=model)
			assert c.inContact and (c.infeasibility, c.depth, tuple(c.normal)) == (near.infeasibility, near.depth, tuple(near.normal))
			assert (c.point - one.state.pos - near.point).norm() <= 4e-16 * max(distance, 1)


# ------------------------------------------------------------------------------------------------ the runner

script = '''"""A small study."""
import json, pathlib, sys
folder = pathlib.Path(sys.argv[sys.argv.index('--output') + 1])
folder.mkdir(parents=True, exist_ok=True)
row = dict(quantity='error of {name}', unit='', paper=None, theory=None, ours={ours}, accept=[0, 1], good={ours} <= 1, note='')
good = row['good']
(folder / 'findings.json').write_text(json.dumps(dict(letter='{name}', title='Study {name}', options={{}}, rows=[row], parts=[], good=good)))
sys.exit(0 if good else 1)
'''


@pytest.fixture
def studies(tmp_path, monkeypatch):
	monkeypatch.setattr(report, 'scripts', tmp_path)
	monkeypatch.setattr(
		report, 'studies', {'one': ('first', 'First', ()), 'two': ('second', 'Second', ()), 'none': ('absent', 'Absent', ())}
	)
	(tmp_path / 'first.py').write_text(script.format(name='one', ours=0.5))
	(tmp_path / 'second.py').write_text(script.format(name='two', ours=0.25))
	return tmp_path


def testRunnerTakesTheScriptsThatAreThere(studies, capsys):
	out = studies / 'out'
	assert report.main(['--output', str(out)]) == 0
	page = (out / 'report.html').read_text()
	assert 'Study one' in page and 'Study two' in page and 'Absent' not in page and 'Accuracy of yade-polytope' in page
	assert '<th class="number">closed form</th>' not in page and 'All 2 required rows hold.' in page
	assert [row['quantity'] for row in csv.DictReader(open(out / 'results.csv'))] == ['error of one', 'error of two']
	(studies / 'second.py').write_text(script.format(name='two', ours=2))
	assert report.main(['--output', str(out), '--only', 'two', '--fresh']) == 1
	assert 'two: missed: error of two' in capsys.readouterr().out
	with pytest.raises(SystemExit):
		report.main(['--only', 'none'])


def testPartsOfSeveralCallsAreInOneReport(studies, capsys):
	"""They are in one report if source and options are the same."""
	out = studies / 'out'

	def shown(*options):
		assert report.main(['--output', str(out), *options]) == 0
		page, said = (out / 'report.html').read_text(), capsys.readouterr().out
		assert ('earlier call: one' in page) == ('earlier call, and shown as well: one' in said)
		return page, [row['quantity'] for row in csv.DictReader(open(out / 'results.csv'))]

	page, rows = shown('--only', 'one')
	assert 'not asked for: two' in page and 'earlier call' not in page and rows == ['error of one']
	page, rows = shown('--only', 'two')
	assert 'not asked for' not in page and 'of an earlier call: one' in page and rows == ['error of one', 'error of two']
	page, rows = shown('--only', 'two', '--quick')
	assert 'not asked for: one' in page and 'earlier call' not in page and rows == ['error of two']


@pytest.mark.parametrize('where', ['/proc/nope', 'file/below', 'file'])
def testAnOutputThatCannotBeWrittenIsRefusedAtOnce(where, studies, capsys):
	(studies / 'file').touch()
	with pytest.raises(SystemExit) as refused:
		report.main(['--output', str(studies / where)])
	assert refused.value.code == 2 and '--output: cannot write to' in capsys.readouterr().err


def testStudiesAreThere():
	assert {'pairs', 'scenes'} <= set(report.present())
