# SPDX-License-Identifier: GPL-2.0-or-later
"""Both contact models on the paper's scenes: the example's table, and the paper's scripts with the conservative one."""

import csv
import os
import pathlib
import subprocess
import sys

import paperScripts
import pytest

example = pathlib.Path(__file__).resolve().parents[2] / 'examples/paper/contactModels.py'


def table(folder, *parts):
	"""{quantity: (closed form, default, paper's normal, conservative)}"""
	subprocess.run(
		[sys.executable, example, '--quick', '--only', *parts, '--output', 'out'],
		cwd=folder,
		env={**os.environ, 'OMP_NUM_THREADS': '1'},
		check=True,
		timeout=1800,
	)
	with open(folder / 'out/models.csv') as file:
		return {row[0]: [float(value) if value else None for value in row[1:]] for row in list(csv.reader(file))[1:]}


withoutTheory = {
	('B: peak load [N], centroid', 'conservative'),
	('B: peak load [N], analyticCentre', 'conservative'),
	('B: peak load [N], from the energy', 'default'),
	('B: peak load [N], from the energy', 'paper'),
}
"""The conservative contact has a closed form of its own; each other cell of these rows must have its figure."""


def testBothModelsAgreeWithClosedForms(tmp_path):
	rows = table(tmp_path, 'B', 'C', 'D')
	assert len(rows) == 6
	for name, (closed, *found) in rows.items():
		relative = {'B': 1e-3, 'C': 6e-3, 'D': 1e-3}[name[0]]
		for model, value in zip(('default', 'paper', 'conservative'), found, strict=True):
			if (name, model) in withoutTheory:
				assert value is None, (name, model)
			else:
				assert value == pytest.approx(closed, rel=relative), (name, model)
	_, default, paper, conservative = rows['C: critical angle [°]']
	assert 33.0 < default < 33.4 and 33.0 < paper < 33.4 and 33.3 < conservative < 33.36


def testSlopeAndCollisionsWithTheDefault(tmp_path):
	"""No corner radius leans the normal: the slope's angle is nearer to limit analysis, and collisions gain next to no energy."""
	rows = table(tmp_path, 'E', 'F')
	limit, default, paper, _ = rows['E: critical angle [°]']
	assert default == pytest.approx(limit, rel=0.01) and abs(default - limit) < abs(paper - limit)
	for label in ('F1', 'F2'):
		_, default, paper, conservative = rows[f'F: largest rise of energy in 200 steps [J], {label}']
		assert default < 1e-2 and default < paper and conservative < 1e-6


def testRoofWedgeWithTheConservativeModel(tmp_path, monkeypatch):
	"""With blocks that touch as well: stiff in rocking, so stable with the shorter time step alone."""
	assert paperScripts.runHere('d_roof_wedge', tmp_path, monkeypatch, '--quick', '--no-pictures', '--contact-model', 'conservative') == 0
	_, rows = paperScripts.results(tmp_path)
	assert rows['critical friction angle, way 1, joint forces set']['ours'] == pytest.approx(34.402, abs=0.02)
	assert rows['critical friction angle, way 2, boundary stress']['ours'] == pytest.approx(34.402, abs=0.02)
	assert rows['blocks that touch: σ_eff/σ_h, A_v = 0.5 A']['ours'] == pytest.approx(0.8, abs=0.02)
	assert rows['contact queries without an answer']['ours'] == 0


def testBeamWithTheConservativeModel(tmp_path, monkeypatch):
	points = ('--contact-point', 'centroid', 'conservative')
	assert paperScripts.runHere('b_three_hinged_beam', tmp_path, monkeypatch, '--quick', '--no-pictures', *points) == 0
	with open(tmp_path / 'out/peaks.csv') as file:
		peaks = {row['contact point']: row for row in csv.DictReader(file)}
	peak = {name: float(value) for name, value in peaks['conservative contact'].items() if 'J' in name or 'N)' in name}
	assert peak['load (N)'] == pytest.approx(70627, rel=1e-3)
	# a conservative contact gives back what was put in; the paper's does not
	assert peak['energy stored (J)'] == pytest.approx(peak['work up to it (J)'], rel=2e-3)
	paper = peaks['centroid']
	assert float(paper['energy stored (J)']) > 1.05 * float(paper['work up to it (J)'])
