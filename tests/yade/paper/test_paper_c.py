# SPDX-License-Identifier: GPL-2.0-or-later
"""Simulation C: the script's quick variant, its options, and the parts it is made of."""

import csv
import json
from math import atan, degrees, radians, tan

import numpy as np
import pytest
from boon2012.wedges.blockGeometry import BlockGeometry
from boon2012.wedges.scene import WedgeScene
from paperScripts import expectRangesOfTheWholeRun, expectRefusal, folder, results, run, runHere
from scenes import blockOnFloor, contact, joint, loop
from yade import MatchMaker, O, polytope
from yade.polytope.frictionReduction import FrictionReduction, setFrictionAngle

geometryFile = folder / 'geometry/c_sliding_wedge.json'
script = 'c_sliding_wedge'


@pytest.fixture(scope='module')
def quick(tmp_path_factory):
	where = tmp_path_factory.mktemp('c')
	done = run(script, where, '--quick', '--no-pictures')
	assert done.returncode == 0, done.stdout + done.stderr
	return where, *results(where)


# ------------------------------------------------------------------------------------------------ the quick variant


def testCriticalAngleIsThatOfTheReference(quick):
	_, content, rows = quick
	row = rows['critical friction angle']
	assert row['accept'] == [pytest.approx(33.18), pytest.approx(33.28)] and content['good'] and row['good']
	assert abs(row['ours'] - 33.23) <= 0.05
	assert row['theory'] == pytest.approx(33.35722, abs=5e-6)


def testRangesAreThoseOfTheWholeRun(quick):
	expectRangesOfTheWholeRun(quick[2], 'C')


def testAnswerDoesNotHangOnTimeStepAndStiffness(quick):
	_, _, rows = quick
	for what in ('time step halved', 'stiffness doubled'):
		row = rows[f'change of the critical angle: {what}']
		assert row['good'] and abs(row['ours']) <= 0.05


def testLockedInShearExplainsTheDifference(quick):
	where, _, rows = quick
	with open(where / 'out/settings.csv') as file:
		stable, failed = next((float(row['stable [°]']), float(row['failed [°]'])) for row in csv.DictReader(file))
	row = rows['limit equilibrium with the locked-in shear measured']
	assert failed - 0.02 <= row['ours'] <= stable + 0.02


def testBackEdgeCountsOnlyWithAStiffnessOfItsOwn(quick):
	_, _, rows = quick
	assert rows['force of the back edge over W']['ours'] < 1e-3
	assert rows['critical angle with a back edge of 1e7 N/m']['ours'] == pytest.approx(33.96, abs=0.05)


def testNoQueryFailed(quick):
	assert quick[2]['contact queries without an answer']['ours'] == 0


def testAMissedRowEndsTheScriptWithAnError(quick):
	"""Basis of the checks above: with another answer the same row is missed."""
	from boon2012.reporting.findings import Findings

	where, _, rows = quick
	findings = Findings('C', 'another answer', where / 'other')
	assert not findings.row('critical friction angle', 33.96, accept=rows['critical friction angle']['accept'])
	assert not findings.save()


# ------------------------------------------------------------------------------------------------ options


def testOtherSettingsAreUsed(tmp_path, monkeypatch):
	options = '--stiffness-times contact --start 50 --steps 2 0.2 --gravity 9.81 --time-step-fraction 0.3 --quick --no-pictures'
	assert runHere(script, tmp_path, monkeypatch, *options.split()) == 0
	content, rows = results(tmp_path)
	row = rows['critical friction angle']
	assert row['accept'] is None and row['paper'] is None
	assert row['ours'] == pytest.approx(34.0, abs=0.25)  # the back edge bears with 1e7 N/m
	assert rows['force of the back edge over W']['ours'] > 0.1
	assert content['options']['start'] == 50 and content['options']['gravity'] == 9.81


@pytest.mark.parametrize('damping', ['0', '0.3'])
def testSoftShearSpringsHaveAnAnswerToo(tmp_path, monkeypatch, damping):
	"""With a tenth of the shear stiffness the undamped wedge hops as it slips: its contacts get their stiffness back, and the rows say so."""
	options = f'--shear-stiffness 1e6 --contact-damping {damping} --steps 8 1 0.1 0.02 --quick --no-pictures'
	assert runHere(script, tmp_path, monkeypatch, *options.split()) == 0
	_, rows = results(tmp_path)
	change = rows['change of the critical angle: time step halved']
	# limit equilibrium with what shear is locked in; hops change that by some hundredths
	assert rows['critical friction angle']['ours'] == pytest.approx(33.357, abs=0.03 if damping == '0.3' else 0.1)
	assert abs(change['ours']) <= (0.02 if damping == '0.3' else 0.1)
	assert ('contacts opened' in change['note']) == (damping == '0')


def testASettingWithoutAnAnswerSaysWhy(tmp_path, monkeypatch, capsys):
	assert runHere(script, tmp_path, monkeypatch, '--shear-stiffness', '1e5', '--quick', '--no-pictures') == 1
	assert 'start with more strength, with stiffer contacts' in capsys.readouterr().err


def testAnotherWedge(tmp_path, monkeypatch):
	"""The reference turned by 90° about z and twice as large: the same angle, and limit equilibrium with the other trend."""
	blocks = {}
	for name, block in json.loads(geometryFile.read_text()).items():
		blocks[name] = {'planes': [[y, -x, z, 2 * d] for x, y, z, d in block['planes']]}
	(tmp_path / 'wedge.json').write_text(json.dumps(blocks))
	options = f'--geometry {tmp_path}/wedge.json --normal-stiffness 2e7 --shear-stiffness 2e7 --quick --no-pictures'
	assert runHere(script, tmp_path, monkeypatch, *options.split()) == 0
	_, rows = results(tmp_path)
	assert rows['critical friction angle']['ours'] == pytest.approx(33.23, abs=0.05)
	assert rows['limit equilibrium: its trend']['ours'] == pytest.approx(245.848, abs=1e-3)


bad = [
	(('--start', '95'), '--start'),
	(('--start', 'x'), '--start'),
	(('--steps', '0.1', '1'), '--steps'),
	(('--steps', '0'), '--steps'),
	(('--normal-stiffness', '-1'), '--normal-stiffness'),
	(('--damping', '1'), '--damping'),
	(('--gravity', 'nan'), '--gravity'),
	(('--check-every', '0.5'), '--check-every'),
	(('--contact-point', 'middle'), '--contact-point'),
	(('--geometry', 'none.json'), 'none.json'),
	(('--stiffness-times', 'none'), '--stiffness-times'),
]


@pytest.mark.parametrize('options,name', bad)
def testBadOptionsAreRefused(tmp_path, monkeypatch, capsys, options, name):
	expectRefusal(script, tmp_path, monkeypatch, capsys, options, name)


# ------------------------------------------------------------------------------------------------ geometry


def testBlocksAreThoseOfTheFile():
	geometry = BlockGeometry.read(geometryFile)
	scene = WedgeScene(geometry).build()
	for name, block in json.loads(geometryFile.read_text()).items():
		body = O.bodies[scene.ids[name]]
		assert body.shape.volume == pytest.approx(block['volume'], rel=1e-12)
		assert tuple(body.state.pos) == pytest.approx(block['centroid'], abs=1e-12)
		assert (body.state.blockedDOFs == '') == (name == 'wedge(free)')
	assert geometry.wedge == 'wedge(free)' and geometry.edgeBlocks == ['under A and B (fixed)']
	assert [joint.area for joint in scene.joints] == [pytest.approx(1.226961, abs=5e-7), pytest.approx(1.085310, abs=5e-7)]
	assert scene.weight == pytest.approx(0.49418721751825917 * 2000 * 10)


@pytest.mark.parametrize(
	'content,message',
	[
		('[]', 'must be an object'),
		('{', 'wedge.json'),
		('{"wedge": {}}', 'planes'),
		('{"a": {"planes": [[0, 0, 1, 1]]}}', "'wedge'"),
		('{"wedge": {"planes": [[0, 0, 1]]}}', "block 'wedge'"),
		('{"wedge": {"planes": [[0, 0, 0, 1]]}}', "block 'wedge'"),
		('{"wedge": {"planes": [[0, 0, 1, "x"]]}}', "block 'wedge'"),
	],
)
def testBadGeometryIsRefused(tmp_path, content, message):
	path = tmp_path / 'wedge.json'
	path.write_text(content)
	with pytest.raises(ValueError, match=message):
		BlockGeometry.read(path)


def testOpenBlockIsRefused():
	with pytest.raises(ValueError, match="block 'wedge'"):
		WedgeScene(BlockGeometry({'wedge': [[0, 0, 1, 1], [1, 0, 0, 1]]})).build()


def testFixedStiffnessesAreKept():
	scene = WedgeScene(BlockGeometry.read(geometryFile), edgeStiffness=1e6).build()
	scene.establishContacts()
	for _ in range(500):
		O.step()
	for face in scene.joints:
		phys = O.interactions[scene.wedgeId, scene.ids[face.block]].phys
		assert (phys.kn, phys.ks) == (pytest.approx(1e7 * face.area), pytest.approx(1e7 * face.area))
	assert O.interactions[scene.wedgeId, scene.ids['under A and B (fixed)']].phys.kn == 1e6
	total = sum(sum(scene.forceFrom(name)) for name in scene.geometry.others)
	assert total == pytest.approx([0, 0, scene.weight], abs=1e-3 * scene.weight)
	assert scene.keepStiffness() == 0
	before = O.bodies[scene.wedgeId].state.pos
	O.bodies[scene.wedgeId].state.pos += (0, 0, 0.1)  # opens all contacts
	O.step()
	assert scene.keepStiffness() == 0
	O.bodies[scene.wedgeId].state.pos = before
	O.step()  # new ones, with stiffnesses per area
	face = scene.joints[0]
	phys = O.interactions[scene.wedgeId, scene.ids[face.block]].phys
	assert phys.normalStiffness == 1e7
	assert scene.keepStiffness() == 3
	assert (phys.normalStiffness, phys.kn, phys.ks) == (0, pytest.approx(1e7 * face.area), pytest.approx(1e7 * face.area))
	assert O.interactions[scene.wedgeId, scene.ids['under A and B (fixed)']].phys.kn == 1e6


# ------------------------------------------------------------------------------------------------ friction reduction


def incline(dip, **material):
	"""A block that rests on a slope of *dip* degrees under gravity, and the functor's engines."""
	joint(normalStiffness=1e8, shearStiffness=1e8, **material)
	loop(damping=0.5, gravity=(9.81 * np.sin(radians(dip)), 0, -9.81 * np.cos(radians(dip))), rockingDamping=1)
	floor, block = blockOnFloor(half=(0.5, 0.5, 0.1))
	O.dt = 3e-4
	return floor, block


def testBlockOnASlopeSlidesAtItsDip():
	_, block = incline(25.05)
	reduction = FrictionReduction(
		[block.id], radians(60), [radians(step) for step in (10, 1, 0.1)], failedDistance=2e-3, measure=lambda: O.iter
	)
	found = reduction.run()
	assert degrees(found.failed) < 25.05 < degrees(found.stable)
	assert degrees(found.stable - found.failed) == pytest.approx(0.1)
	assert found.critical == pytest.approx((found.stable + found.failed) / 2)
	assert found.failedQueries == 0
	outcomes = [stage.outcome for stage in found.stages]
	assert outcomes[0] == 'stable' and outcomes[-1] == 'failed' and outcomes.count('failed') == 3
	assert all(stage.displacement > 2e-3 for stage in found.stages if stage.outcome == 'failed')
	assert all(stage.speed < 2e-7 for stage in found.stages if stage.outcome == 'stable')
	assert all(stage.measured is not None and len(stage.samples) == stage.steps / 100 for stage in found.stages)
	assert O.bodies[block.id].state.vel.norm() > 1e-3, 'the scene is left as it failed'
	reduction.restore()
	assert O.bodies[block.id].state.vel.norm() < 2e-7
	assert O.interactions[0, 1].phys.tangensOfFrictionAngle == pytest.approx(tan(found.stable))


@pytest.mark.parametrize('lever', [0, 0.1])
def testAPermanentForceStays(lever):
	"""A block that 0.3 of its weight pulls aside, with a torque or without, slides at atan 0.3, though O.loadTmp drops such loads."""
	_, block = incline(0)
	pull = 0.3 * 9.81 * block.state.mass
	O.forces.setPermF(block.id, (pull, 0, 0))
	O.forces.setPermT(block.id, (0, lever * pull, 0))
	reduction = FrictionReduction([block.id], radians(30), [radians(step) for step in (5, 0.5, 0.05)], failedDistance=2e-3)
	found = reduction.run()
	assert degrees(found.failed) - 0.01 < degrees(atan(0.3)) < degrees(found.stable) + 0.01
	reduction.restore()
	assert tuple(O.forces.f(block.id, sync=True)) == (pull, 0, 0) and tuple(O.forces.t(block.id, sync=True)) == (0, lever * pull, 0)


def testNewContactsHaveThePresentFriction():
	_, block = incline(10)
	O.step()
	O.step()
	setFrictionAngle(0.3)
	assert contact(O.bodies[0], block).phys.tangensOfFrictionAngle == pytest.approx(tan(0.3))
	other = polytope.cuboid((3, 0, 0.0999), (0.5, 0.5, 0.1))
	O.bodies.append(other)
	O.step()
	assert contact(O.bodies[0], other).phys.tangensOfFrictionAngle == pytest.approx(tan(0.3))


def testFrictionOfAMatchMakerIsRefused():
	incline(10)
	O.engines[2].physDispatcher.functors[0].frictAngle = MatchMaker(val=0.5)
	with pytest.raises(ValueError, match='^frictAngle: '):
		setFrictionAngle(0.3)


def testSceneThatSlidesAtTheStartIsRefused():
	_, block = incline(25)
	with pytest.raises(RuntimeError, match='not stable at the starting angle, 20°: failed'):
		FrictionReduction([block.id], radians(20), [radians(1)], failedDistance=0.01).run()


def testSceneThatStandsAtAnyAngleIsRefused():
	_, block = incline(0)
	with pytest.raises(RuntimeError, match='stable at every friction angle'):
		FrictionReduction([block.id], radians(20), [radians(6)]).run()


def testWhatIsNeitherStableNorFailedCountsAsFailed():
	_, block = incline(25)
	found = FrictionReduction([block.id], radians(30), [radians(1)], failedDistance=1e3, mostSteps=2000).run()
	assert found.stages[-1].outcome == 'creeping' and degrees(found.failed) <= 25


@pytest.mark.parametrize(
	'change,name',
	[
		({'bodies': []}, 'bodies'),
		({'start': 70}, 'start'),
		({'steps': []}, 'steps'),
		({'steps': [0.1, 0.2]}, 'steps'),
		({'steps': [-0.1]}, 'steps'),
		({'stableSpeed': 0}, 'stableSpeed'),
		({'failedDistance': -1}, 'failedDistance'),
		({'checkEvery': 0}, 'checkEvery'),
	],
)
def testBadProtocolIsRefused(change, name):
	O.bodies.append(polytope.cuboid((0, 0, 0), (1, 1, 1)))
	with pytest.raises(ValueError, match=f'^{name}: '):
		FrictionReduction(**{'bodies': [0], 'start': 1, 'steps': [0.1], **change})
