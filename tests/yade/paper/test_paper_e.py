# SPDX-License-Identifier: GPL-2.0-or-later
"""Simulation E of the paper: the script's quick variant holds its tolerances; other geometry and settings are taken."""

import csv
import json
import math
from types import SimpleNamespace

import pytest
from boon2012.reporting.findings import Findings
from boon2012.slope.scene import SlumpingSlope, readSlope
from boon2012.slope.study import SlopeReport
from paperScripts import expectRangesOfTheWholeRun, folder, results, run, runHere
from yade import O

name, quick = 'e_slumping_slope', ('--quick', '--no-pictures')
geometry = folder / 'geometry/e_slope.json'


def changed(where, move, **changes):
	"""The reference geometry with its corners moved, in a file."""
	content = json.loads(geometry.read_text())
	for key in ('free', 'fixed'):
		content[key] = [[move(*corner) for corner in corners] for corners in content[key]]
	path = where / 'changed.json'
	path.write_text(json.dumps({**content, **changes}))
	return path


def testQuickVariantHoldsEveryTolerance(tmp_path):
	done = run(name, tmp_path, *quick)
	assert done.returncode == 0, done.stdout + done.stderr
	content, rows = results(tmp_path)
	assert content['good']
	expectRangesOfTheWholeRun(rows, 'E')
	assert 19 <= rows['critical friction angle']['ours'] <= 22.5
	assert rows['critical friction angle, limit analysis']['ours'] == pytest.approx(19.75, abs=0.005)
	assert rows['least backward rotation of the lowest 5 outer blocks at failure']['ours'] > 0.1
	assert rows['largest motion of an inner block at failure']['ours'] < 0.02
	assert rows['contact queries without an answer']['ours'] == 0
	with open(tmp_path / 'out/blocks.csv') as file:
		blocks = list(csv.DictReader(file))
	turns = [float(block['rotation [°]']) for block in blocks]
	assert all(turn < 0 for turn in turns[:7]), 'the outer layer turns clockwise, the face is on the left'
	assert max(abs(turn) for turn in turns[7:]) < 0.1 * abs(turns[0])
	with open(tmp_path / 'out/contacts.csv') as file:
		contacts = list(csv.DictReader(file))
	assert float(contacts[-1]['largest motion [m]']) > 0.1
	counts = [[int(row[name]) for name in ('face–face', 'edge–face', 'edge–edge')] for row in (contacts[0], contacts[-1])]
	assert counts[1][0] < counts[0][0], 'faces part as blocks turn'
	assert all(min(count) > 0 for count in counts)


def testBlockOnInclineSlidesAtItsDip(tmp_path):
	"""Another geometry, whose answer is known: limit analysis and simulation give the dip."""
	dip = math.radians(21.1)
	turn = (math.cos(dip), math.sin(dip))

	def turned(points):
		return [[x * turn[0] - y * turn[1], x * turn[1] + y * turn[0]] for x, y in points]

	(tmp_path / 'incline.json').write_text(
		json.dumps({'free': [turned([(0, 0), (2, 0), (2, 1), (0, 1)])], 'fixed': [turned([(-5, -3), (5, -3), (5, 0), (-5, 0)])]})
	)
	done = run(
		name,
		tmp_path,
		*quick,
		'--geometry',
		'incline.json',
		'--start',
		'30',
		'--steps',
		'2',
		'0.2',
		'--normal-stiffness',
		'5e8',
		'--stiffness-per-contact',
		'--contact-point',
		'centroid',
		'--gravity',
		'9.81',
	)
	assert done.returncode == 0, done.stdout + done.stderr
	_, rows = results(tmp_path)
	assert rows['critical friction angle, limit analysis']['ours'] == pytest.approx(21.1, abs=1e-5)
	assert rows['critical friction angle']['accept'] is None
	assert rows['critical friction angle']['ours'] == pytest.approx(21.1, abs=0.11)


@pytest.mark.parametrize(
	'options',
	[
		('--damping', '1'),
		('--steps', '0.1', '1'),
		('--start', '90'),
		('--time-step', '0.01'),
		('--geometry', 'none'),
		('--most-steps', '0'),
		('--corner-radius', '1'),
	],
)
def testRefusesNonsense(tmp_path, monkeypatch, capsys, options):
	with pytest.raises(SystemExit) as stop:
		runHere(name, tmp_path, monkeypatch, *quick, *options)
	assert stop.value.code == 2 and options[0] in capsys.readouterr().err


def testUnstableStartIsSaid(tmp_path, monkeypatch, capsys):
	"""Below the critical angle nothing can be found."""
	assert runHere(name, tmp_path, monkeypatch, *quick, '--start', '15') == 1
	assert 'not stable at the starting angle' in capsys.readouterr().err


def testGeometryFileIsChecked(tmp_path):
	path = tmp_path / 'slope.json'
	for content, word in (
		('{"free": []}', 'free'),
		('{"free": [[[0, 0], [1, 0], [0, 1]]]}', 'fixed'),
		('{"free": [[[0, 0], [1, 0]]], "fixed": [1]}', 'three'),
		('{"free": [[[0, 0], [1, "x"], [0, 1]]], "fixed": [1]}', 'three'),
		('{"free": [1, 2', 'not JSON'),
	):
		path.write_text(content)
		with pytest.raises(ValueError, match=word) as refusal:
			readSlope(path)
		assert str(path) in str(refusal.value)


@pytest.mark.parametrize('params', [{'delta': 'x'}, {'delta': 0}, {'delta': True}, {'delta': 50, 's': '1'}, {'s': -1}, [50, 1]])
def testParamsAreChecked(tmp_path, params):
	path = changed(tmp_path, lambda x, y: [x, y], params=params)
	with pytest.raises(ValueError, match='params') as refusal:
		readSlope(path)
	assert str(path) in str(refusal.value)


def testMirroredSlopeIsRefused(tmp_path, monkeypatch, capsys):
	path = changed(tmp_path, lambda x, y: [-x, y])
	with pytest.raises(SystemExit) as stop:
		runHere(name, tmp_path, monkeypatch, *quick, '--geometry', str(path))
	said = capsys.readouterr().err
	assert stop.value.code == 2 and str(path) in said and 'toe must be on the left' in said


@pytest.mark.parametrize('shift', [(100, -50), (-300, 20)])
def testLayersDoNotDependOnTheOrigin(tmp_path, shift):
	slope = SlumpingSlope(**readSlope(changed(tmp_path, lambda x, y: [x + shift[0], y + shift[1]])))
	assert slope.layers() == [k // 7 for k in range(28)]


def testThinSpacingLeavesAnOutermostLayer():
	assert min(SlumpingSlope(**{**readSlope(geometry), 'spacing': 0.3}).layers()) == 0


def testReportKnowsOuterBlocksFromBelow(tmp_path):
	"""The blocks may be in any order in the file; without params there are no rows on outer and inner blocks."""
	slope = readSlope(geometry)
	slope['free'] = slope['free'][::-1]
	for params, others in (({}, 1), ({'dip': None}, 0)):
		given = SimpleNamespace(slope={**slope, **params}, reference=False)
		findings = Findings('E', 'test', tmp_path, {})
		report = SlopeReport(findings, given, SlumpingSlope(**given.slope).layers())
		report.limitAnalysis()
		rows = {row['quantity']: row['ours'] for row in findings.content['rows']}
		assert sum('inner' in quantity for quantity in rows) == others
		assert ('mechanism: lowest outer blocks that turn as one' in rows) == bool(others)
		if others:
			assert report.outerFromBelow.tolist() == list(range(27, 20, -1))
			assert rows['mechanism: lowest outer blocks that turn as one'] == 5


def testBuilderMakesLayersOfPolygons():
	scene = SlumpingSlope(**readSlope(geometry)).build()
	assert scene.layers() == [k // 7 for k in range(28)]
	assert all(body.shape.dimension == 2 and body.shape.thickness == 1 for body in scene.bodies())
	assert sum(body.state.mass for body in scene.bodies()[:6]) == pytest.approx(6 * 5000)  # 1 m × 2 m × 1 m × 2500 kg/m³
	assert len(O.bodies) == 30 and not any(O.bodies[k].dynamic for k in scene.fixedIds)
