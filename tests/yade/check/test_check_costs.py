# SPDX-License-Identifier: GPL-2.0-or-later
"""polytope.check(O, costs=True): what a scene pays for without using it, how that is timed, and that the scene is unchanged; faults of contacts
that there are."""

import contextlib
import json
import math
import pathlib
import sys
import tempfile

import pytest
from boon2012.runWatch import stateHash
from yade import (
	Bo1_Polytope_Aabb,
	ForceResetter,
	FrictMat,
	GlobalStiffnessTimeStepper,
	Ig2_Polytope_Polytope_PolytopeGeom,
	InsertionSortCollider,
	InteractionLoop,
	Ip2_RockJointMat_RockJointMat_RockJointPhys,
	Law2_PolytopeGeom_RockJointPhys_MohrCoulomb,
	NewtonIntegrator,
	O,
	PolytopeCollider,
	PyRunner,
	Quaternion,
	RockJointMat,
	polytope,
	utils,
)
from yade.polytope.check import costs, costsProcess
from yade.polytope.check.scene import SceneToCheck


def row(number=3, steps=50, spin=0.01, material=None, **functor):
	"""Blocks on a floor, at rest but for the first steps; without a fault unless the arguments add one."""
	O.reset()
	O.materials.append(
		RockJointMat(**{'normalStiffness': 1e7, 'shearStiffness': 1e7, 'frictionAngle': 0.5, 'density': 1000, **(material or {})})
	)
	O.bodies.append(polytope.cuboid((0, 0, -0.5), (5, 5, 0.5), fixed=True))
	for k in range(number):
		ids = O.bodies.append(polytope.cuboid((1.5 * k, 0, 0.4995), (0.5, 0.4, 0.5)))
		O.bodies[ids].state.angVel = (spin, 0, 0)
	O.engines = [
		ForceResetter(),
		PolytopeCollider([Bo1_Polytope_Aabb()], verletDist=0.04),
		InteractionLoop(
			[Ig2_Polytope_Polytope_PolytopeGeom(**functor)],
			[Ip2_RockJointMat_RockJointMat_RockJointPhys(stiffnessPerArea=False)],
			[Law2_PolytopeGeom_RockJointPhys_MohrCoulomb(normalDamping=0.3)],
		),
		NewtonIntegrator(gravity=(0, 0, -10), damping=0.2),
	]
	O.dt = 5e-4
	for _ in range(steps):
		O.step()


def functor():
	return O.engines[2].geomDispatcher.functors[0]


def found():
	"""What is not needed, without its cost: name → advice."""
	return {what: advice for what, _, advice, _ in costs.costFindings(SceneToCheck(O))}


def testNothingToSayOfAGoodScene():
	row()
	O.dt = polytope.stableTimeStep(0.2)
	assert found() == {} and polytope.check(O) == []


def testSwitches():
	row(contactModel='boon2012', computeEnergy=True, timing=True, warmStart=False)
	O.trackEnergy = True
	assert found().keys() == {'computeEnergy', 'timing', 'warmStart', 'energy tracking'}
	assert found()['warmStart'].startswith('warmStart = True')


def testAreaThatIsNeededIsNotBlamed():
	row(computeArea=True, contactModel='boon2012')
	assert 'computeArea' not in found()  # every rock joint needs it
	O.reset()
	O.materials.append(FrictMat())
	O.bodies.append([polytope.cuboid((0, 0, z), (0.5, 0.5, 0.5), fixed=z == 0) for z in (0, 0.9999)])
	O.engines = polytope.engines(geometry=Ig2_Polytope_Polytope_PolytopeGeom(contactModel='boon2012', computeArea=True))
	O.step()
	O.step()
	assert any(one.isReal for one in O.interactions) and 'computeArea' in found()


@pytest.mark.parametrize('length', [0, 1e-9, 5])
def testColliderThatRunsTooOftenOrFindsTooMany(length):
	row()
	O.engines[1].verletDist = length
	if length > 1:
		functor().resetStats()
	assert found()['verletDist'] == 'verletDist = 0.04'  # a tenth of the smallest inscribed radius


def testBoxesThatAreNotTight():
	row()
	O.engines = [O.engines[0], InsertionSortCollider([Bo1_Polytope_Aabb()], verletDist=0.04), *O.engines[2:]]
	O.step()
	(seen,) = [seen for what, seen, *_ in costs.costFindings(SceneToCheck(O)) if what == 'boxes']
	assert '2 of 5 pairs' in seen  # three blocks on the floor; balls of neighbours overlap


def testSmallTimeStep():
	row()
	for fraction, small in ((0.2, False), (0.99, False), (0.01, True)):
		O.dt = fraction * polytope.stableTimeStep(1)
		assert ('small time step' in found()) == small
		assert not polytope.check(O)
	O.dt = 1.5 * polytope.stableTimeStep(1)
	assert '1.5 of the largest step' in polytope.check(O)['time step'].seen


def testGlobalStiffnessTimeStepperIsAdvisedAgainst():
	"""It takes steps beyond the limit, where the contact of a face rocks."""
	row(steps=0, contactModel='spring')
	O.engines = [*O.engines, GlobalStiffnessTimeStepper(timestepSafetyCoefficient=0.8, defaultDt=1e-5, timeStepUpdateInterval=1)]
	O.dt = 1e-5
	assert not polytope.check(O)
	for _ in range(300):
		O.step()
	assert O.dt > 1.5 * polytope.stableTimeStep(1)
	assert 'rocking of faces' in polytope.check(O)['time step'].seen


# ------------------------------------------------------------------------------------------------ prisms that polygons could be


def flatRow():
	row(steps=0, spin=0)
	O.engines[3].gravity = (0, -10, 0)
	for k, body in enumerate(O.bodies):
		if body.dynamic:
			body.state.blockedDOFs = 'zXY'
			body.state.pos = (1.2 * k, 0, 0.2)
			body.state.vel = body.state.angVel = (0, 0, 0)
	O.bodies[0].state.pos = (0, -5.3995, 0)


def testThirdDimensionAndItsPrice(monkeypatch):
	flatRow()
	for _ in range(20):
		O.step()
	times = {'': 10, 'dimension': 6}
	monkeypatch.setattr(costs, '_stepTimes', lambda O, trials: (times, ''))
	finding = polytope.check(O, costs=True)['third dimension']
	assert 'polygon' in finding.advice and finding.cost == 4
	times['dimension'] = 11  # at rest a contact in space may cost less than one of polygons
	assert 'third dimension' not in [one.what for one in polytope.check(O, costs=True)]
	O.bodies[1].state.blockedDOFs = ''
	O.bodies[1].state.angVel = (0.1, 0, 0)
	assert 'third dimension' not in found()


def testThirdDimensionUpToRounding():
	flatRow()
	for body in O.bodies:
		if body.dynamic:
			body.state.blockedDOFs = ''
			body.state.vel, body.state.angVel = (0.1, 0, 2e-18), (1e-18, 0, 0.1)
	assert 'third dimension' in found()
	for gravity in ((0, -10, -10), (0, 0, -10)):
		O.engines[3].gravity = gravity
		assert 'third dimension' not in found()
	O.engines[3].gravity = (0, -10, 0)
	O.forces.setPermF(1, (0, 0, 5))
	assert 'third dimension' not in found()


def testBlocksThatAreAboutToFallAreNoPolygons():
	row(steps=0, spin=0)
	assert 'third dimension' not in found()


@pytest.mark.parametrize('heights', [(0, 10, -0.5), (0.499, 1.497, -0.5), (0, 0, -0.999)])
def testPrismsAboveEachOtherAreNoPolygons(heights):
	"""Apart, stacked, and both on a floor below: polygons would meet where these do not, or meet from above."""
	row(number=2, steps=0, spin=0)
	O.engines[3].gravity = (0, -10, 0)
	floor, *blocks = O.bodies
	for body, x, z in ((blocks[0], 0, heights[0]), (blocks[1], 0.3, heights[1]), (floor, 0, heights[2])):
		body.state.pos = (x, 0, z)
		body.state.blockedDOFs = 'zXY' if body in blocks else body.state.blockedDOFs
	O.step()
	assert 'third dimension' not in found()


def testPrismsOfDifferentHeightSideBySideAreAdvised():
	flatRow()
	O.bodies[2].state.pos += (0, 0, 0.2)  # still shares most of its height with the floor and the others
	assert 'third dimension' in found()
	O.bodies[2].state.pos += (0, 0, 0.3)
	assert 'third dimension' not in found()


# ------------------------------------------------------------------------------------------------ faults of contacts


@pytest.mark.parametrize('material, held', [(FrictMat, True), (RockJointMat, False)])
def testAYadeLawHoldsABlockBetweenTwoFaces(material, held):
	"""With a law of YADE's it turns and falls out in space, silently; RockJointMat holds it."""
	own = {'young': 1e8} if material is FrictMat else {'normalStiffness': 1e8, 'shearStiffness': 1e8}
	O.materials.append(material(density=2600, frictionAngle=1, **own))
	for x in (-0.999, 0.999):
		O.bodies.append(polytope.cuboid((x, 0, 0), (0.5, 0.5, 0.5), fixed=True))
	O.bodies.append(polytope.cuboid((0, 0, 0), (0.5, 0.5, 0.5)))
	O.engines = polytope.engines(damping=0.5)
	O.run(400, True)
	assert [one.what for one in polytope.check(O)] == (['held by friction'] if held else [])
	if held:
		assert polytope.check(O)['held by friction'].seen.startswith('body 2 is held')


def testASteepSlopeBearsABlockItself():
	"""Friction bears a quarter of its weight there."""
	O.materials.append(FrictMat(density=2600, frictionAngle=1, young=1e8))
	O.bodies.append(polytope.cuboid((0, 0, -0.5), (2, 2, 0.5), fixed=True))
	O.bodies.append(polytope.cuboid((0, 0, 0.499), (0.5, 0.5, 0.5)))
	O.engines = polytope.engines(gravity=(4.9, 0, -8.5), damping=0.5)
	O.run(400, True)
	assert not polytope.check(O)


@pytest.mark.parametrize('perArea', [False, True])
def testAFaceOnSeveralPieces(perArea):
	"""Two bricks that move carry a beam."""
	row(number=0, steps=0)
	for x in (-0.5, 0.5):
		O.bodies.append(polytope.cuboid((x, 0, 0.2499), (0.25, 0.25, 0.25)))
	O.bodies.append(polytope.cuboid((0, 0, 0.7497), (1, 0.25, 0.25)))
	O.engines[2].physDispatcher.functors[0].stiffnessPerArea = perArea
	O.dt = 1e-6
	O.step()
	O.step()
	assert [one.what for one in polytope.check(O)] == ([] if perArea else ['several pieces under one face'])
	if not perArea:
		assert 'body 3 first' in polytope.check(O)['several pieces under one face'].seen


def testQueriesWithoutAnAnswerAreTold():
	row(number=1, steps=2)
	assert 'failures' not in [one.what for one in polytope.check(O)]
	O.bodies.append(polytope.polygon([(-1, 0.55), (1, 0.55), (1, 2), (-1, 2)], thickness=2))  # meets none of the others
	O.bodies[2].state.pos += (0, -1, 0)
	O.step()
	failed = functor().stats()['failures']
	assert failed > 0 and f'{failed} contact queries' in polytope.check(O)['failures'].seen


def testFixedBodiesThatPierceAreNamed():
	"""Two plates cross, as walls of a valley do below its line: each step has one query without an answer, until they have no contact."""
	O.materials.append(RockJointMat(normalStiffness=1e7, shearStiffness=1e7, frictionAngle=0.5, density=1000))
	cross = [polytope.cuboid((0, 0, 0), (1, 1, 0.1), orientation=Quaternion((1, 0, 0), turn), fixed=True) for turn in (0.7, -0.7)]
	O.bodies.append([polytope.cuboid((0, 0, 3), (0.1, 0.1, 0.1)), *cross])
	O.engines = polytope.engines()
	O.dt = 1e-6
	O.run(3, True)
	finding = polytope.check(O)['failures']
	assert finding.seen == '3 contact queries had no answer, now 1: body 1 and body 2 have noDirection, and are both fixed'
	assert 'mask=3 for each, and avoidSelfInteractionMask=2' in finding.advice
	O.interactions.clear()
	for body in cross:
		body.mask = 3
	O.engines[1].avoidSelfInteractionMask = 2
	O.engines[2].geomDispatcher.functors[0].resetStats()
	O.run(3, True)
	assert 'failures' not in [one.what for one in polytope.check(O)] and O.interactions.countReal() == 0


def testTheEnergyOfFixedBodiesIsNamed():
	"""A side wall that goes through the floor: nothing moves by their contact, but its energy is 1e10 times that of the block between them."""
	O.materials.append(RockJointMat(normalStiffness=1e9, shearStiffness=1e9, frictionAngle=0.5, density=2600))
	walls = [polytope.cuboid((0, 0, -0.5), (2, 2, 0.5), fixed=True), polytope.cuboid((-2, 0, 0.5), (0.5, 2, 1.5), fixed=True)]
	O.bodies.append([*walls, polytope.cuboid((0, 0, 0.2), (0.2, 0.2, 0.2))])
	O.engines = polytope.engines()
	O.run(3, True)
	assert not polytope.check(O)
	O.trackEnergy = True
	O.run(3, True)
	finding = polytope.check(O)['energy of fixed bodies']
	assert finding.seen == 'body 0 and body 1 are both fixed and pierce each other: the energy of their contact is in O.energy'
	assert O.energy['elastPotential'] > 1e8
	walls[0].mask = walls[1].mask = 3
	O.engines[1].avoidSelfInteractionMask = 2
	O.interactions.clear()
	O.run(3, True)
	assert not polytope.check(O) and O.energy['elastPotential'] < 1


def testUndampedPaperModel():
	row(contactModel='boon2012')
	assert not polytope.check(O)
	O.engines[2].lawDispatcher.functors[0].normalDamping = 0
	O.engines[3].damping = 0
	assert 'normalDamping' in polytope.check(O)['damping and energy'].advice
	functor().contactModel = 'spring'
	assert not polytope.check(O)


def testColliderBehindTheLoop():
	row()
	engines = O.engines
	O.engines = [engines[0], engines[2], engines[1], engines[3]]
	assert 'a step late' in polytope.check(O)['order of engines'].seen


# ------------------------------------------------------------------------------------------------ how costs are measured


def testMeasuringTouchesNothing(tmp_path):
	row(number=5, timing=True, warmStart=False)
	O.engines = [*O.engines, PyRunner(command='raise SystemExit', iterPeriod=1000, firstIterRun=10**6)]

	def everything(name):
		O.save(str(tmp_path / name), quiet=True)
		return (tmp_path / name).read_bytes(), stateHash(), functor().stats(), O.iter, O.time, O.timingEnabled, O.engines[2].execTime

	before = everything('before.yade.bin')
	checked = polytope.check(O, costs=True)
	assert everything('after.yade.bin') == before
	assert checked.stepMicroseconds > 0 and {'timing', 'warmStart'} == {one.what for one in checked if one.cost is not None}
	assert 'with all advice that was timed' in repr(checked) and 'saves' in repr(checked)
	O.step()  # and goes on


def testPermanentForcesActWhereTimesAreMeasured(monkeypatch):
	"""A scene's file does not hold them."""
	row()
	O.forces.setPermF(2, (0, 0, 3e4))  # lifts the block
	start, heights = O.bodies[2].state.pos[2], []
	monkeypatch.setattr(costsProcess, 'timed', lambda seconds: (heights.append(O.bodies[2].state.pos[2]), 1.0)[1:])
	monkeypatch.setattr(costsProcess, 'warmUp', 50)
	monkeypatch.setattr(
		costs.subprocess,
		'run',
		lambda command, **how: costsProcess.stepTimes(command[4], **json.loads(pathlib.Path(command[5]).read_text())),
	)
	costs.takeCosts(O, polytope.check(O))
	assert len(heights) == 2 and min(heights) > start + 1e-3


def testCostsAddUp(monkeypatch):
	"""Each change is timed with those before it in force, but for those that do not run."""
	times = {(): 10, ('a',): 7, ('a', 'b'): math.inf, ('a', 'c'): 8}
	monkeypatch.setattr(costsProcess, 'stepTime', lambda scene, loads, changes: times[tuple(name for name, _ in changes)])
	assert costsProcess.stepTimes('', [('a', 1), ('b', 1), ('c', 1)]) == {'': 10, 'a': 7, 'c': 8}

	row(timing=True, warmStart=False)
	monkeypatch.setattr(costs, '_stepTimes', lambda O, trials: ({'': 10, 'timing': 5, 'warmStart': 8}, ''))
	checked = polytope.check(O, costs=True)
	assert [checked[name].cost for name in ('timing', 'warmStart')] == [5, -3]
	assert 'a step takes 10 µs, 8 µs with all advice' in repr(checked)


def testWithoutContactsNothingIsTimed():
	row(timing=True)
	for body in O.bodies:
		if body.dynamic:
			body.state.pos += (0, 0, 5 * body.id)
	O.step()
	O.step()
	checked = polytope.check(O, costs=True)
	assert 'nothing is in contact' in repr(checked) and checked['timing'].cost is None and checked.stepMicroseconds is None


@pytest.mark.parametrize('part', ['folder', 'file'])
def testFolderThatCannotBeWritten(monkeypatch, tmp_path, part):
	row()
	before = stateHash()
	if part == 'folder':
		monkeypatch.setattr(tempfile, 'tempdir', str(tmp_path / 'gone'))
	else:
		folder = contextlib.nullcontext()
		folder.name = str(tmp_path / 'gone')
		monkeypatch.setattr(costs.tempfile, 'TemporaryDirectory', lambda **how: folder)
	with pytest.raises(OSError, match='costs: cannot write .*gone.*TMPDIR'):
		polytope.check(O, costs=True)
	assert stateHash() == before


def testProcessThatEndsWithoutAnAnswer(monkeypatch):
	row()
	monkeypatch.setattr(sys, 'executable', '/bin/false')
	checked = polytope.check(O, costs=True)
	assert checked.stepMicroseconds is None and 'ended without' in repr(checked)


@pytest.mark.parametrize('wrong', ['no', 1, None])
def testRefusals(wrong):
	row(steps=0)
	with pytest.raises(ValueError, match=f'costs: must be True or False, got {wrong!r}'):
		polytope.check(O, costs=wrong)
	with pytest.raises(ValueError, match='O: '):
		polytope.check(None, costs=True)


def testASceneWithoutPolytopesIsTimedToo():
	O.bodies.append([utils.sphere((0, 0, z), 0.5) for z in (0, 0.99)])
	O.engines = polytope.engines()
	O.dt = 1e-6
	O.step()
	O.step()
	assert polytope.check(O, costs=True).stepMicroseconds > 0
