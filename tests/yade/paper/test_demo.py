# SPDX-License-Identifier: GPL-2.0-or-later
"""The examples run as a user runs them: as programs of their own, in an empty folder."""

import importlib
import json
import os
import pathlib
import subprocess
import sys

import pytest

examples = pathlib.Path(__file__).resolve().parents[3] / 'examples'


def run(folder, script, *options):
	environment = {**os.environ, 'OMP_NUM_THREADS': '1'}
	return subprocess.run(
		[sys.executable, examples / script, *options], cwd=folder, env=environment, capture_output=True, text=True, timeout=1800
	)


def demo(folder, *options):
	done = run(folder, 'paper/a_falling_polyhedra.py', '--output', 'out', *options)
	assert done.returncode == 0, done.stdout + done.stderr
	return done.stdout, json.loads((folder / 'out' / 'results.json').read_text())


def testShortDemoComesToRestWithoutFailure(tmp_path):
	text, results = demo(tmp_path, '--number', '45', '--steps', '6000', '--no-pictures')
	assert [r['shape'] for r in results] == ['tetrahedron', 'cube', 'octahedron', 'dodecahedron', 'icosahedron']
	for result in results:
		assert result['inside'] == 45 and result['failures'] == 0
		assert result['energyEnd'] < 1e-3 < 0.1 < max(energy for _, energy in result['energies']), 'has fallen, and come to rest'
		assert result['overlap'] < 0.005 and result['deepestOverlap'] < 0.03
		assert result['contacts'] >= 45, 'each lies on something'
		assert 0.4 < result['meanHeight'] < 0.9
		assert result['stateHash'] in text
	assert (tmp_path / 'out' / 'results.csv').read_text().count('\n') == 6


def testOneThreadEndsInTheSameStateEveryTime(tmp_path):
	hashes = []
	for folder in (tmp_path / 'first', tmp_path / 'second'):
		folder.mkdir()
		_, results = demo(folder, '--shape', 'mixed', '--number', '50', '--steps', '2500', '--no-pictures')
		hashes.append(results[0]['stateHash'])
	assert hashes[0] == hashes[1]


def testDemoDrawsAndRecords(tmp_path):
	demo(tmp_path, '--shape', 'cube', '--number', '10', '--steps', '40', '--vtk-every', '20')
	files = {path.name for path in (tmp_path / 'out' / 'cube').iterdir()}
	assert {'step00000.png', 'step00040.png', 'bodies.pvd', 'contacts.pvd', 'bodies.0.vtu', 'bodies.20.vtu', 'bodies.40.vtu'} <= files


def testDemoRefusesNonsense(tmp_path):
	assert run(tmp_path, 'paper/a_falling_polyhedra.py', '--number', '0').returncode == 2
	assert run(tmp_path, 'paper/a_falling_polyhedra.py', '--shape', 'sphere').returncode == 2


def testNumbersOfAChaoticHeapGetNoVerdict(monkeypatch, capsys):
	"""What is a bound gets one."""
	monkeypatch.setattr(sys, 'path', [str(examples / 'paper'), *sys.path])
	tables = importlib.import_module('boon2012.falling.tables')
	result = {
		**dict.fromkeys(tables.quantities, 1.0),
		'number': 5,
		'inside': 5,
		'failures': 0,
		'shape': 'cube',
		'contacts': 500,
		'overlap': 0.1,
	}
	tables.showOutcome([result], {'contacts': (373, 469), 'overlap': (0, 0.005), 'deepestOverlap': (0, 2)}, 'all', {'contacts': (1, 2)})
	lines = {line.split('  ')[0]: line for line in capsys.readouterr().out.splitlines()}
	contacts = lines[tables.quantities['contacts'] + ' *']
	assert '373 … 469' in contacts and '500' in contacts and 'outside' not in contacts
	assert lines[tables.quantities['overlap']].endswith('outside') and lines[tables.quantities['deepestOverlap']].endswith('ok')
	assert any(line.startswith('* Heaps are chaotic') for line in lines)


def testHelloPrintsTheContact(tmp_path):
	done = run(tmp_path, 'hello.py')
	assert done.returncode == 0, done.stderr
	lines = {line[:17].strip(): line[17:].strip() for line in done.stdout.splitlines()}
	assert float(lines['force over weight']) == pytest.approx(1, abs=1e-3)
	assert float(lines['area'].split()[0]) == pytest.approx(0.8, rel=1e-3)
