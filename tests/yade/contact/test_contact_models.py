# SPDX-License-Identifier: GPL-2.0-or-later
"""Both contacts on the paper's scenes: the example's table, and the paper's scripts with the contact surface."""

import csv
import math
import os
import pathlib
import subprocess
import sys

import paperScripts
import pytest
from boon2012.slidingWedge.study import limitEquilibrium
from boon2012.wedges.blockGeometry import BlockGeometry
from boon2012.wedges.scene import WedgeScene
from yade.polytope.frictionReduction import FrictionReduction

example = pathlib.Path(__file__).resolve().parents[3] / 'examples/paper/contactModels.py'


def table(folder, *parts):
	"""{quantity: (closed form, contact surface, the paper's)}"""
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
	('B: peak load [N], centroid', 'surface'),
	('B: peak load [N], analyticCentre', 'surface'),
	('B: peak load [N], from the energy', 'boon2012'),
}
"""The contact surface has a closed form of its own; each other cell of these rows must have its figure."""


def testBothModelsAgreeWithClosedForms(tmp_path):
	rows = table(tmp_path, 'B', 'C', 'D')
	assert len(rows) == 6
	for name, (closed, *found) in rows.items():
		relative = {'B': 1e-3, 'C': 6e-3, 'D': 1e-3}[name[0]]
		for model, value in zip(('surface', 'boon2012'), found, strict=True):
			if (name, model) in withoutTheory:
				assert value is None, (name, model)
			else:
				assert value == pytest.approx(closed, rel=relative), (name, model)


def testTheSlidingWedgeFailsWhereItsLockedInShearSays():
	"""A wedge that settles elastically takes shear across its line of sliding, and some of it is left at failure. Limit equilibrium with
	that shear is the angle that is found, to a friction step."""
	blocks = BlockGeometry.read(example.parent / 'geometry/c_sliding_wedge.json')
	theory = limitEquilibrium(blocks)
	scene = WedgeScene(blocks, timeStepFraction=0.2, contactModel='surface').build()
	scene.establishContacts()

	def transverse():
		return [
			float(scene.forceFrom(joint.block)[1].dot(direction)) / scene.weight
			for joint, direction in zip(scene.joints, theory.transverse(), strict=True)
		]

	steps = [math.radians(step) for step in (8, 1, 0.1, 0.02)]
	result = FrictionReduction([scene.wedgeId], math.radians(70), steps, measure=transverse).run()
	(last,) = (stage for stage in result.stages if stage.level == result.stable)
	explained = math.degrees(theory.frictionAngle(*last.measured))
	found = math.degrees(result.critical)
	print(
		f'critical angle {found:.3f}°, limit equilibrium with the shear left {explained:.3f}°, without {math.degrees(theory.frictionAngle()):.3f}°'
	)
	assert found == pytest.approx(explained, abs=0.03)
	assert math.degrees(theory.lowerBound()[0]) < found < math.degrees(theory.frictionAngle())


def testSlopeAndCollisions(tmp_path):
	"""No corner radius leans the contact surface's normal: the slope's angle is nearer to limit analysis, and collisions gain next to no energy."""
	rows = table(tmp_path, 'E', 'F')
	limit, surface, paper = rows['E: critical angle [°]']
	assert surface == pytest.approx(limit, rel=0.01) and abs(surface - limit) < abs(paper - limit)
	for label in ('F1', 'F2'):
		_, surface, paper = rows[f'F: largest rise of energy in 200 steps [J], {label}']
		assert surface < 1e-6 < paper


def testRoofWedgeWithAContactSurface(tmp_path, monkeypatch):
	"""It is tested with blocks that touch as well."""
	assert paperScripts.runHere('d_roof_wedge', tmp_path, monkeypatch, '--quick', '--no-pictures', '--contact-model', 'spring') == 0
	_, rows = paperScripts.results(tmp_path)
	assert rows['critical friction angle, way 1, joint forces set']['ours'] == pytest.approx(34.402, abs=0.02)
	assert rows['critical friction angle, way 2, boundary stress']['ours'] == pytest.approx(34.402, abs=0.02)
	assert rows['blocks that touch: σ_eff/σ_h, A_v = 0.5 A']['ours'] == pytest.approx(0.8, abs=0.02)
	assert rows['contact queries without an answer']['ours'] == 0


def testBeamWithAContactSurface(tmp_path, monkeypatch):
	points = ('--contact-point', 'centroid', 'spring')
	assert paperScripts.runHere('b_three_hinged_beam', tmp_path, monkeypatch, '--quick', '--no-pictures', *points) == 0
	with open(tmp_path / 'out/peaks.csv') as file:
		peaks = {row['contact point']: row for row in csv.DictReader(file)}
	peak = {name: float(value) for name, value in peaks['contact surface'].items() if 'J' in name or 'N)' in name}
	assert peak['load (N)'] == pytest.approx(41368, rel=1e-3)
	# a force that is the gradient of an energy gives back what was put in; the paper's does not
	assert peak['energy stored (J)'] == pytest.approx(peak['work up to it (J)'], rel=2e-3)
	paper = peaks['centroid']
	assert float(paper['energy stored (J)']) > 1.05 * float(paper['work up to it (J)'])
