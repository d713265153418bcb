# SPDX-License-Identifier: GPL-2.0-or-later
"""Findings: rows that hold and rows that are missed, and that the files are complete."""

import csv
import json
import math

import numpy as np
import pytest
from boon2012.reporting.findings import Findings, rowCells


@pytest.fixture
def findings(tmp_path):
	return Findings('A', 'A title', tmp_path / 'out', {'seed': 1})


def testRowHoldsWithinItsRangeOnly(findings):
	assert findings.row('inside', 1.0, accept=(1, 2)) and findings.row('at the end', 2, accept=(1, 2)) and findings.row('only reported', 7)
	assert findings.good
	assert not findings.row('outside', np.nextafter(2, 3), accept=(1, 2))
	assert not findings.good


@pytest.mark.parametrize('ours', [math.nan, math.inf])
def testWhatIsNotFiniteMisses(findings, ours):
	assert not findings.row('result', ours, accept=(0, 1e300))
	assert json.loads(json.dumps(findings.content))['rows'][0]['ours'] == str(ours)


@pytest.mark.parametrize('accept', [(2, 1), (0, math.nan)])
def testRangeThatCannotBeMetIsRefused(findings, accept):
	with pytest.raises(ValueError, match='accept'):
		findings.row('result', 1, accept=accept)


def testCellsGiveTheDifferenceToTheClosedFormElseToThePaper(findings):
	findings.row('both', 33.25, '°', paper=33.23, theory=33.357, accept=(33, 33.4))
	findings.row('paper alone', 33.25, '°', paper=33.23)
	findings.row('in words', 3.2, 'µs', paper='tens of µs')
	findings.row('exactly', 0, accept=(0, 0))
	findings.row('at most', 3, accept=(-math.inf, 2))
	both, paper, words, exactly, most = [rowCells(row) for row in findings.content['rows']]
	assert both == ['both', '°', '33.23', '33.357', '33.25', '-0.107', '33 … 33.4', 'ok']
	assert paper[5:] == ['+0.02', '', '']
	assert words[2:6] == ['tens of µs', '', '3.2', '']
	assert exactly[6:] == ['0', 'ok']
	assert most[6:] == ['≤ 2', 'MISSED']


def testFilesHoldEverything(findings):
	findings.row('result', np.float64(0.5), paper=0.4, accept=(0, 1), note='why')
	findings.text('An explanation.')
	findings.table('curve', 'A curve', ['x [m]', 'name'], [(0.1, 'a'), (0.2, 'b, c')])
	(findings.folder / 'plot.png').write_bytes(b'png')
	findings.figure(findings.folder / 'plot.png', 'A plot')
	assert findings.save()
	with open(findings.folder / 'curve.csv', newline='') as file:
		assert list(csv.reader(file)) == [['x [m]', 'name'], ['0.1', 'a'], ['0.2', 'b, c']]
	saved = json.loads((findings.folder / 'findings.json').read_text())
	assert saved['good'] and saved['letter'] == 'A' and saved['options'] == {'seed': 1}
	row = {'quantity': 'result', 'unit': '', 'paper': 0.4, 'theory': None, 'ours': 0.5, 'accept': [0, 1], 'good': True, 'note': 'why'}
	assert saved['rows'] == [row]
	assert [part['kind'] for part in saved['parts']] == ['text', 'table', 'figure']
	assert saved['parts'][2]['file'] == 'plot.png'


def testMistakesAreRefused(findings):
	with pytest.raises(ValueError, match='curve'):
		findings.table('curve', 'A curve', ['x', 'y'], [(1,)])
	with pytest.raises(FileNotFoundError, match='nothing.png'):
		findings.figure(findings.folder / 'nothing.png', '')


def testShowPrintsEveryRow(findings, capsys):
	findings.row('something', 1, accept=(2, 3))
	findings.show()
	text = capsys.readouterr().out
	assert 'something' in text and 'MISSED' in text and 'closed form' in text
