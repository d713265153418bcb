# SPDX-License-Identifier: GPL-2.0-or-later
"""Simulation F of the paper: the script's quick variant holds its tolerances, and its budgets detect an error."""

import json

import numpy as np
import pytest
from boon2012.collisions.scene import Block, Collision, readBlocks
from boon2012.collisions.study import largestFall
from paperScripts import expectRangesOfTheWholeRun, folder, results, run, runHere
from yade import O
from yade.polytope.motionRecord import MotionRecord

name, quick = 'f_collisions', ('--quick', '--no-pictures')
geometry = folder / 'geometry/f_collisions.json'


def testQuickVariantHoldsEveryTolerance(tmp_path):
	done = run(name, tmp_path, *quick)
	assert done.returncode == 0, done.stdout + done.stderr
	content, rows = results(tmp_path)
	assert content['good']
	expectRangesOfTheWholeRun(rows, 'F')
	assert rows['F1: height at rest']['ours'] == pytest.approx(0.499804, abs=1e-5)
	assert rows['F1: lies on its face −z']['ours'] == 1
	assert rows['F1: place of rest, distance from (0.472, 0.518)']['ours'] < 0.1
	assert rows['F1: energy at the start']['ours'] == pytest.approx(16917.96, abs=0.01)
	assert rows['F1: energy at the end']['ours'] == pytest.approx(9808.08, abs=0.01)
	for label in ('F1', 'F2'):
		for words in ('', ', YADE damping 0'):
			assert rows[f'{label}: momentum budget{words}']['ours'] < 1e-6
			assert rows[f'{label}: energy in free flight{words}']['ours'] < 1e-9
			assert rows[f'{label}: energy balance{words}']['ours'] < 1e-6
			assert rows[f"{label}: law's own account of energy{words}"]['ours'] < 1e-7
			assert rows[f'{label}: energy that dampers and friction give{words}']['ours'] < 1e-6
	for steps, theirs in ((20, 1894.04), (200, 9256.5)):  # an independent program of the paper's algorithm, the same steps
		assert rows[f'F2: largest rise of energy in any {steps} steps, normal damper alone']['ours'] == pytest.approx(theirs, rel=1e-4)
	plots = {f'{label}_overview.png' for label in ('F1', 'F2')}
	assert {path.name for path in (tmp_path / 'out').iterdir()} >= {'transitions.csv', 'energy_rises.csv', *plots}
	types = [line.split(',')[3] for line in (tmp_path / 'out/transitions.csv').read_text().splitlines() if line.startswith('F2')]
	assert types[:2] == ['edge-edge', 'edge-face'] and types[-1] == 'none'


def testOtherSettingsKeepTheBudgets(tmp_path):
	"""Other blocks (no cubes, other places), stiffness, friction, contact point and time step: no reference, but laws hold."""
	blocks = json.loads(geometry.read_text())
	blocks['vertexFace']['fixed']['position'] = [10, 20, 29.5]
	blocks['vertexFace']['free'] = {'halfLengths': [0.5, 0.4, 0.3], 'position': [10, 20, 30.72], 'orientation': [0.9, 0.3, -0.3, 0.1]}
	(tmp_path / 'other.json').write_text(json.dumps(blocks))
	done = run(
		name,
		tmp_path,
		*quick,
		'--collision',
		'vertexFace',
		'--geometry',
		'other.json',
		'--contact-point',
		'centroid',
		'--normal-stiffness',
		'4e7',
		'--friction',
		'0.5',
		'--time-step',
		'2e-4',
		'--density',
		'2600',
	)
	content, rows = results(tmp_path)
	print(done.stdout, done.stderr)
	assert rows['F1: momentum budget']['ours'] < 1e-6
	assert rows['F1: energy in free flight, YADE damping 0']['ours'] < 1e-9
	assert rows['F1: first touch']['accept'] is None
	height = 30 + 0.3 - 2600 * 8 * 0.5 * 0.4 * 0.3 * 9.81 / 4e7
	assert rows['F1: height at rest']['theory'] == pytest.approx(height, abs=1e-9)
	assert rows['F1: height at rest']['ours'] == pytest.approx(height, abs=1e-5)
	assert done.returncode == 0


@pytest.mark.parametrize(
	'option, value',
	[
		('--damping', '1'),
		('--density', '0'),
		('--time-step', '1'),
		('--friction', 'nan'),
		('--contact-point', 'x'),
		('--geometry', 'none'),
		('--corner-radius', '0.5'),
	],
)
def testRefusesNonsense(tmp_path, monkeypatch, capsys, option, value):
	with pytest.raises(SystemExit) as stop:
		runHere(name, tmp_path, monkeypatch, *quick, option, value)
	assert stop.value.code == 2 and option in capsys.readouterr().err


def testGeometryFileIsChecked(tmp_path):
	path = tmp_path / 'blocks.json'
	path.write_text('{"vertexFace": {"fixed": {}}}')
	with pytest.raises(ValueError, match='free'):
		readBlocks(path, 'vertexFace')
	path.write_text('{"vertexFace": {"fixed": {}, "free": {"size": [1, 1, 1]}}}')
	with pytest.raises(ValueError, match='size'):
		readBlocks(path, 'vertexFace')


def shortRecord(steps=600, velocity=(0, 0, 0), **settings):
	scene = Collision(*readBlocks(geometry, 'vertexFace'), **settings).build()
	scene.body.state.vel = velocity
	record = MotionRecord(scene.body, scene.contact, scene.integrator)
	for _ in range(steps):
		record.step()
	return record.finish()


def testBudgetsNoticeAnError():
	record = shortRecord()
	assert record.momentumError() < 1e-12
	assert abs(record.balance()).max() < 1e-9 * record.energy()[0]
	record.damping = 0.299  # the integrator's rule with another fraction
	assert record.momentumError() > 1e-6
	record.damping = 0.3
	record.contactForce[300] *= 1.01  # one step's force of 600
	assert record.momentumError() > 1e-6
	record = shortRecord(velocity=(3, 0, -4))
	assert abs(record.balance()).max() < 1e-9 * record.energy()[0]
	record.contactForce[np.linalg.norm(record.contactForce, axis=1).argmax()] *= 1.01
	assert abs(record.balance()).max() > 1e-6 * record.energy()[0]


@pytest.mark.parametrize(
	'term, law',
	[
		('springs', 'elastPotential'),
		('normal damper', 'normDampDissip'),
		('friction', 'plastDissip'),
		('shear damper', 'shearDampDissip'),
		('sum', 'nonconservative'),
	],
)
def testTheLawsAccountIsCompared(term, law):
	"""A hundredth less of one term of the law, made up for by its term nonconservative: all terms still add up, and it is noticed."""
	record = shortRecord(velocity=(3, 0, -4), contactDamping=0.1)
	limit = 1e-7 * record.energy()[0]
	assert max(record.bookError().values()) < limit
	missing = getattr(record, law) / 100
	setattr(record, law, 0.99 * getattr(record, law))
	if term != 'sum':
		record.nonconservative = record.nonconservative + missing
	assert abs(missing).max() > 10 * limit and [name for name, error in record.bookError().items() if error > limit] == [term]


def testDampersAndFrictionOnlyTake():
	record = shortRecord(velocity=(3, 0, -4), contactDamping=0.1)
	assert largestFall(record.normalLoss()) < 1e-6 * record.energy()[0] > largestFall(record.shearLoss())
	record.contactForce *= 0.9  # a damper that pushes where it ought to hold
	assert largestFall(record.normalLoss()) > 1e-6 * record.energy()[0]


def testEnergyOfTurningBlockIsRight():
	"""Unequal moments, no forces: translation and rotation by hand."""
	scene = Collision(Block(position=(0, 0, -10)), Block((0.5, 0.4, 0.3), (0, 0, 5)), damping=0, gravity=1e-12).build()
	scene.body.state.vel = (1, 2, 3)
	scene.body.state.angVel = (0, 0, 2)
	record = MotionRecord(scene.body, scene.contact, scene.integrator)
	record.step()
	record.finish()
	mass = 2000 * 8 * 0.5 * 0.4 * 0.3
	assert record.kineticEnergy()[0] == pytest.approx(mass * (14 / 2 + (0.5**2 + 0.4**2) / 3 * 4 / 2), rel=1e-9)
	assert O.iter == 1 and np.all(record.type == 'none')


def testApproachIsTheDepthsGrowthWhereTheBlockFallsFlat():
	"""With a face flat on the floor depth, normal and point belong together; the order of the bodies does not matter."""
	scene = Collision(Block((1, 1, 0.5), (0, 0, -0.5)), Block(position=(0, 0, 0.5005)), contactDamping=0).build()
	record = MotionRecord(scene.body, scene.contact, scene.integrator)
	for _ in range(400):
		record.step()
	record.finish()
	touching = np.flatnonzero(np.isfinite(record.depth))
	begin, end = touching[0], touching[record.depth[touching].argmax()]
	assert set(record.type[touching]) == {'face-face'}
	assert record.approach()[end] - record.approach()[begin] == pytest.approx(record.depth[end] - record.depth[begin], rel=0.01)
