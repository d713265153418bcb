# SPDX-License-Identifier: GPL-2.0-or-later
"""Simulation D: the script's quick variant, its options, and the parts it is made of."""

import json
from math import atan, cos, degrees, pi, radians

import numpy as np
import pytest
from boon2012.roofWedge.scene import RoofWedge
from boon2012.wedges.blockGeometry import BlockGeometry, touchingRoofBlocks
from boon2012.wedges.theory import stressShare
from paperScripts import expectRangesOfTheWholeRun, expectRefusal, folder, results, run, runHere
from yade import O

geometryFile = folder / 'geometry/d_roof_wedge.json'
script = 'd_roof_wedge'


@pytest.fixture(scope='module')
def quick(tmp_path_factory):
	where = tmp_path_factory.mktemp('d')
	done = run(script, where, '--quick', '--no-pictures')
	assert done.returncode == 0, done.stdout + done.stderr
	return results(where)


# ------------------------------------------------------------------------------------------------ the quick variant


@pytest.mark.parametrize('way', ['way 1, joint forces set', 'way 2, boundary stress'])
@pytest.mark.parametrize('gravity,angle', [('10', 34.4019), ('9.81', 34.3186)])
def testCriticalAngle(quick, way, gravity, angle):
	content, rows = quick
	name = f'{way}, g = {gravity} m/s²'
	row = rows[f'critical friction angle, {name}']
	assert content['good'] and row['good']
	assert row['ours'] == pytest.approx(angle, abs=0.02) and row['theory'] == pytest.approx(angle, abs=5e-5)
	assert row['accept'] == [pytest.approx(angle - 0.02, abs=1e-4), pytest.approx(angle + 0.02, abs=1e-4)]
	force = rows[f'the same against 30° + atan(W/ΣH), {name}']
	assert force['good'] and abs(force['ours'] - force['theory']) <= 0.02


def testRangesAreThoseOfTheWholeRun(quick):
	expectRangesOfTheWholeRun(quick[1], 'D')


def testAnswerDoesNotHangOnTimeStepAndStiffness(quick):
	for what in ('time step halved', 'stiffness doubled'):
		row = quick[1][f'change of the critical angle: {what}']
		assert row['good'] and abs(row['ours']) <= 0.02


def testBlocksThatTouchGiveThePapersAngle(quick):
	_, rows = quick
	label = 'σ_eff = 0.9148 σ_h, which 34.81° needs'
	assert rows[f'blocks that touch: critical angle, {label}']['ours'] == pytest.approx(34.81, abs=0.02)
	share = rows[f'blocks that touch: σ_eff/σ_h, {label}']
	assert share['ours'] == pytest.approx(share['theory'], abs=1e-3) and 0.90 < share['ours'] < 0.92


def testNoQueryFailed(quick):
	assert quick[1]['contact queries without an answer']['ours'] == 0


# ------------------------------------------------------------------------------------------------ options


def testOtherSettingsAreUsed(tmp_path, monkeypatch):
	options = '--horizontal-stress 8e4 --shear-stiffness 5e6 --density 2500 --gravity 9 --start 60 --steps 2 0.02 --quick --no-pictures'
	assert runHere(script, tmp_path, monkeypatch, *options.split()) == 0
	content, rows = results(tmp_path)
	row = rows['critical friction angle, way 1, joint forces set']
	weight, horizontal = 0.5773502691896258 * 2500 * 9, 8e4 * 3.0
	horizontal -= 0.5 * np.sqrt(3) / 4 * weight / (0.25 + 0.5 * 0.75)  # softer in shear: the settlement takes some
	assert row['paper'] is None and row['good'] and row['theory'] == pytest.approx(30 + degrees(atan(weight / horizontal)))
	assert row['ours'] == pytest.approx(row['theory'], abs=0.02)


def testAnotherWedge(tmp_path, monkeypatch):
	"""Joints of dip 65° instead of 60°, half as high."""
	dip, blocks = radians(65), {}
	outward = [np.array([np.sin(dip) * np.sin(a), np.sin(dip) * np.cos(a), np.cos(dip)]) for a in radians(40) + 2 * pi / 3 * np.arange(3)]
	apex = 0.5
	blocks['roof wedge'] = {'planes': [[*n, n[2] * apex] for n in outward] + [[0, 0, -1, 0]]}
	for k, n in enumerate(outward):
		away = np.array([n[0], n[1], 0]) / np.hypot(*n[:2])
		sides = [np.array([-away[1], away[0], 0]) * sign * 0.5 - away * np.sqrt(3) / 2 for sign in (1, -1)]
		rows = [[*-n, -n[2] * apex], [*away, 2], [0, 0, 1, 1], [0, 0, -1, 0]] + [[*side, -0.02] for side in sides]
		blocks[f'rock {k}'] = {'planes': [[float(x) for x in row] for row in rows]}
	(tmp_path / 'roof.json').write_text(json.dumps(blocks))
	assert (
		runHere(script, tmp_path, monkeypatch, '--geometry', f'{tmp_path}/roof.json', '--steps', '1', '0.02', '--quick', '--no-pictures')
		== 0
	)
	_, rows = results(tmp_path)
	row = rows['critical friction angle, way 2, boundary stress']
	side = 2 * apex / np.tan(dip) * np.sqrt(3)
	weight, area = side**2 * np.sqrt(3) / 4 * apex / 3 * 2000 * 10, side * apex / np.sin(dip) / 2
	expected = 25 + degrees(atan(weight / (3 * area * np.sin(dip) * 5e4)))
	assert row['theory'] == pytest.approx(expected) and row['ours'] == pytest.approx(expected, abs=0.02)


def testCoarseLastStepIsAllowedFor(tmp_path, monkeypatch):
	assert runHere(script, tmp_path, monkeypatch, '--steps', '1', '0.1', '--quick', '--no-pictures') == 0
	row = results(tmp_path)[1]['critical friction angle, way 1, joint forces set']
	assert row['good'] and row['accept'] == [pytest.approx(row['theory'] + sign * 0.05) for sign in (-1, 1)]


def testFourJoints(tmp_path, monkeypatch):
	"""The joints have the dip 65° and face the four quarters."""
	dip, blocks = radians(65), {}
	horizontal = [np.array([np.cos(a), np.sin(a), 0]) for a in pi / 2 * np.arange(4)]
	outward = [np.sin(dip) * away + (0, 0, np.cos(dip)) for away in horizontal]
	blocks['wedge'] = {'planes': [[*n, n[2]] for n in outward] + [[0, 0, -1, 0]]}
	for k, (n, away) in enumerate(zip(outward, horizontal, strict=True)):
		sides = [np.array([-away[1], away[0], 0]) * sign - away for sign in (1, -1)]
		rows = [[*-n, -n[2]], [*away, 2.5], [0, 0, 1, 2], [0, 0, -1, 0]] + [[*side, -0.01] for side in sides]
		blocks[f'rock {k}'] = {'planes': [[float(x) for x in row] for row in rows]}
	(tmp_path / 'four.json').write_text(json.dumps(blocks))
	assert runHere(script, tmp_path, monkeypatch, '--geometry', f'{tmp_path}/four.json', '--quick', '--no-pictures') == 0
	content, rows = results(tmp_path)
	half = 1 / np.tan(dip)
	weight, area = 4 * half**2 / 3 * 2000 * 10, half / np.sin(dip)
	expected = 25 + degrees(atan(weight / (4 * area * np.sin(dip) * 5e4)))
	for way in ('way 1, joint forces set', 'way 2, boundary stress'):
		row = rows[f'critical friction angle, {way}']
		assert row['good'] and row['theory'] == pytest.approx(expected) and row['ours'] == pytest.approx(expected, abs=0.02)
		assert 'see below' not in row['note']
	normal = 4 * 5e4 * area * np.sin(dip) ** 2
	wrong = degrees(atan((weight / normal + np.cos(dip)) / np.sin(dip)))
	assert rows['a constant normal force would give, wrongly']['ours'] == pytest.approx(wrong)
	assert 'a quarter of ΣH' in str(content) and not any('blocks that touch' in name for name in rows)


def testClosedFormsByAreaAreNotShownWhereStiffnessDoesNotGoByIt(tmp_path, monkeypatch):
	options = '--stiffness-times contact --shear-stiffness 5e6 --quick --no-pictures'
	assert runHere(script, tmp_path, monkeypatch, *options.split()) == 0
	content, rows = results(tmp_path)
	touching = [row for name, row in rows.items() if 'blocks that touch' in name]
	assert touching and all(row['theory'] is None for row in touching)
	assert 'With kn = ks' not in str(content)


def testUnboundedWedgeIsRefused(tmp_path, monkeypatch, capsys):
	blocks = json.loads(geometryFile.read_text())
	wedge = next(block for name, block in blocks.items() if 'wedge' in name)
	wedge['planes'] = [plane for plane in wedge['planes'] if plane[2] > -0.99]
	(tmp_path / 'open.json').write_text(json.dumps(blocks))
	expectRefusal(script, tmp_path, monkeypatch, capsys, ['--geometry', f'{tmp_path}/open.json'], '--geometry: block')


bad = [
	(('--horizontal-stress', '0'), '--horizontal-stress'),
	(('--start', '0'), '--start'),
	(('--steps', '1', '1'), '--steps'),
	(('--density', 'much'), '--density'),
	(('--failed-distance', '-1'), '--failed-distance'),
	(('--geometry', 'none.json'), 'none.json'),
	(('--geometry', str(folder / 'geometry/c_sliding_wedge.json')), 'share just one plane'),
]


@pytest.mark.parametrize('options,name', bad)
def testBadOptionsAreRefused(tmp_path, monkeypatch, capsys, options, name):
	expectRefusal(script, tmp_path, monkeypatch, capsys, options, name)


# ------------------------------------------------------------------------------------------------ the two ways


def testBlocksAreThoseOfTheFile():
	geometry = BlockGeometry.read(geometryFile)
	scene = RoofWedge(geometry).build()
	for name, block in json.loads(geometryFile.read_text()).items():
		assert O.bodies[scene.ids[name]].shape.volume == pytest.approx(block['volume'], rel=1e-12)
	assert [joint.area for joint in scene.joints] == [pytest.approx(2 / np.sqrt(3))] * 3
	assert scene.inclinations == [pytest.approx(pi / 6)] * 3


@pytest.mark.parametrize('stiffnessTimes,stiffness', [('face', 1e7), ('section', 1e7), ('contact', 2e7)])
def testSetForcesAreThoseOfTheStressField(stiffnessTimes, stiffness):
	scene = RoofWedge(
		BlockGeometry.read(geometryFile), stiffnessTimes=stiffnessTimes, normalStiffness=stiffness, shearStiffness=stiffness
	).build()
	assert scene.setJointForces() == [(pytest.approx(43301.27, abs=0.01), pytest.approx(25000))] * 3
	for joint in scene.joints:
		push, shear = scene.forceFrom(joint.block)
		assert push == pytest.approx(43301.27 * joint.normal, abs=1)
		assert push + shear == pytest.approx(5e4 * joint.normal * (1, 1, 0) / cos(pi / 6), abs=1), 'horizontal, σ_h A cos α'
	assert scene.horizontalForce() == pytest.approx(1.5e5, abs=3)
	for _ in range(3000):
		O.step()
	total = sum(sum(scene.forceFrom(joint.block)) for joint in scene.joints)
	assert total == pytest.approx([0, 0, scene.weight], abs=1e-3)
	assert scene.horizontalForce() == pytest.approx(1.5e5, rel=5e-4)


def testBoundaryStressClosesTheJoints():
	scene = RoofWedge(BlockGeometry.read(geometryFile)).build()
	assert scene.pressByBoundary() == [pytest.approx(4.330e-3, abs=1e-6)] * 3
	assert scene.horizontalForce() == pytest.approx(1.5e5, rel=1e-4)
	assert O.bodies[scene.wedgeId].state.blockedDOFs == ''
	assert all(O.bodies[scene.ids[joint.block]].state.blockedDOFs == 'xyzXYZ' for joint in scene.joints)


def testSoftShearSpringsKeepTheWedge():
	"""Blocks that close fast push a weightless wedge out of its joints where these hold it with a tenth of the stiffness."""
	blocks = touchingRoofBlocks(BlockGeometry.read(geometryFile), 0.6)
	scene = RoofWedge(blocks, sideArea=0.6, shearStiffness=1e6).build()
	scene.pressByBoundary()
	assert scene.horizontalForce() / 1.5e5 == pytest.approx(stressShare(2 / np.sqrt(3), 0.6, pi / 6, 0.1), abs=1e-4)
	assert O.engines[2].lawDispatcher.functors[0].normalDamping == 0


@pytest.mark.parametrize('options,remedy', [((1e4, 20000), '--shear-stiffness'), ((1e7, 50), "--most-steps")])
def testWhyThereIsNoRest(options, remedy):
	blocks = touchingRoofBlocks(BlockGeometry.read(geometryFile), 0.6)
	scene = RoofWedge(blocks, sideArea=0.6, shearStiffness=options[0]).build()
	with pytest.raises(RuntimeError, match=remedy):
		scene.pressByBoundary(mostSteps=options[1])


@pytest.mark.parametrize('sideArea', [0.1, 0.6])
def testTouchingBlocksTakeTheirShare(sideArea):
	blocks = touchingRoofBlocks(BlockGeometry.read(geometryFile), sideArea)
	scene = RoofWedge(blocks, sideArea=sideArea).build()
	scene.pressByBoundary()
	assert scene.horizontalForce() / 1.5e5 == pytest.approx(stressShare(2 / np.sqrt(3), sideArea), abs=1e-4)
	sides = [contact for contact in O.interactions if contact.isReal and scene.wedgeId not in (contact.id1, contact.id2)]
	assert len(sides) == 3
	# the joint's area is the one asked for, less what the closure of some mm takes
	assert [contact.phys.contactArea for contact in sides] == [pytest.approx(sideArea, rel=0.02)] * 3


def testTouchingBlocksNeedAThreefoldWedge():
	with pytest.raises(ValueError, match='^geometry: '):
		touchingRoofBlocks(BlockGeometry.read(folder / 'geometry/c_sliding_wedge.json'), 0.1)
