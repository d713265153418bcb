# SPDX-License-Identifier: GPL-2.0-or-later
"""`./run tradeoff`: its options, its scenes and the summary."""

import os
import pathlib
import subprocess
import sys

import pytest
from yade.polytope.tradeoff import Row, TradeoffTable

project = pathlib.Path(__file__).resolve().parents[3]
program = project / 'tools/measure/tradeoff.py'


@pytest.fixture
def module(monkeypatch):
	monkeypatch.syspath_prepend(str(program.parent))
	import tradeoff

	return tradeoff


@pytest.mark.parametrize(
	('arguments', 'code', 'word'),
	[
		(['--only', 'Z'], 2, 'invalid choice'),
		(['--output', '/proc/nope'], 2, '--output: cannot write to /proc/nope'),
		(['--help'], 0, 'usage'),
		(['--only', 'B'], 1, 'configur'),
	],
)
def testOptionsAreReadBeforeAnythingIsBuilt(arguments, code, word, tmp_path):
	"""The program is started in a folder where building fails: only good options get as far as that."""
	for name in ('examples', 'tools'):
		(tmp_path / name).symlink_to(project / name)
	own = {name: str(tmp_path / name) for name in ('cache', 'logs', 'yadeSource')}
	for folder in own.values():
		pathlib.Path(folder).mkdir()
	environment = {**os.environ, **own, 'project': str(tmp_path), 'buildKey': 'none'}
	command = ['bash', str(tmp_path / 'tools/inside.sh'), 'tradeoff', *arguments]
	ended = subprocess.run(command, env=environment, cwd=tmp_path, capture_output=True, text=True)
	assert ended.returncode == code and word in (ended.stdout + ended.stderr).lower(), ended.stdout + ended.stderr
	assert (tmp_path / 'build').exists() == (code == 1)


@pytest.mark.parametrize(('arguments', 'precisions'), [('--only A', ''), ('--only B', 'longdouble float128 mpfr150'), ('--quick', '')])
def testOnlyThePrecisionsThatAreAskedForAreBuilt(arguments, precisions, tmp_path):
	command = [sys.executable, str(program), *arguments.split(), '--precisions', '--output', str(tmp_path)]
	said = subprocess.run(command, capture_output=True, text=True, check=True).stdout.splitlines()
	assert [line for line in said if not line.startswith('Using python')] == precisions.split()


def testLettersAreThoseOfTheScenes(module):
	assert list(module.letters) == list(module.allScenes())


def testSettingsAreThoseOfEachModel(module):
	scenes = module.allScenes()
	wedge = scenes['C'].settings(quick=True)
	assert list(wedge)[0] == 'surface' and {'surface, time step × 4', 'boon2012', 'boon2012, stiffness × 10'} < wedge.keys()
	assert 'surface, time step × 0.5' not in wedge and 'surface, time step × 0.5' in scenes['C'].settings(quick=False)
	seeds = [name for name in scenes['A'].settings(quick=False) if 'seed' in name]
	assert len(seeds) == 5 and all(name.startswith('surface') for name in seeds)


def testTheSummary(module):
	"""Cost over the first setting's of each scene, in the order of the models; why there is no error."""
	rows = {
		'C': [Row('surface', {}, 33.0, None, 1, 10), Row('boon2012', {}, 34.0, None, 1, 5)],
		'A': [
			*(Row('surface', {}, 5.0, None, 1, 20), Row('surface, seed 2', {}, 6.0, None, 1, 20)),
			*(Row('surface, time step × 4', {}, note='RuntimeError: blew up'), Row('boon2012', {}, 5.5, None, 1, 30)),
		],
	}
	tables = {letter: TradeoffTable(found, 33.0 if letter == 'C' else 5.5) for letter, found in rows.items()}
	assert [[cell if isinstance(cell, str) else round(cell, 4) for cell in row] for row in module.summary(tables)] == [
		['surface', 1, 1, 1, 0, 0.0909],
		['surface, time step × 4', '', '', '', '', 'blew up'],
		['boon2012', 0.5, 1.0, 1.5, 0.0303, 0],
	]


def testACollisionKeepsItsEnergy(module):
	"""One scene to its end, by both models: the error of the page's table."""
	scene = module.allScenes()['F']
	scene.varied = {}
	table = module.measured('F', scene, quick=True)
	assert table['surface'].error < 1e-4 and table['boon2012'].error > 1 and not any(row.note for row in table)
