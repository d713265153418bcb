# SPDX-License-Identifier: GPL-2.0-or-later
"""PolytopeTimeStepper: the step before contacts and with them, the reported limit, wrong values, files. Stability: test_time_step_stability.py."""

import math
import os
import tempfile

import pytest
from scenes import blockOnFloor, contactOf, density, driven, gravity, joint, loop, stepper, stepUntil
from yade import O, PolytopeTimeStepper, Quaternion, Vector3, _polytope, polytope

models = ('boon2012', 'surface')


# --------------------------------------------------------------------------------------------------- before there is a contact


@pytest.mark.parametrize('perArea', [False, True])
@pytest.mark.parametrize('model', models)
@pytest.mark.parametrize('turn', [Quaternion.Identity, Quaternion((1, 2, 3), 1)])
def testBlockLandsWithoutAStepOfTheScripts(model, perArea, turn):
	joint(normalStiffness=1e8, shearStiffness=1e8)
	loop(perArea=perArea, normalDamping=0.3, gravity=(0, 0, -gravity), damping=0.3, ig2=contactOf(model, perArea))
	engine = stepper()
	floor, block = blockOnFloor()
	block.state.pos, block.state.ori = Vector3(0, 0, 1.5), turn
	O.step()
	assert engine.limitedBy == 'material' and engine.limitingBody == block.id
	assert O.dt == pytest.approx(engine.timestepSafetyCoefficient * _polytope.timeStepLimits()['material'], rel=1e-12)
	stepUntil(0.6)
	heights, speeds = [], []
	stepUntil(4, lambda: (heights.append(block.state.pos[2]), speeds.append(block.state.vel.norm())))
	assert engine.limitedBy in ('material', 'contacts', 'rocking')
	assert max(heights) < 1.3 and max(speeds) < math.sqrt(2 * gravity * 1.0)  # does not bounce up again
	assert block.state.pos[2] == pytest.approx(0.5, abs=0.01) and block.state.vel.norm() < 1e-3


def testStepIsThereBeforeTheFirstMotion():
	joint()
	loop(gravity=(0, 0, -gravity))
	stepper()
	floor, block = blockOnFloor()
	block.state.pos = Vector3(0, 0, 5)
	assert O.dt < 1e-7  # YADE's own, of an empty scene
	O.step()
	# one contact of a cube at a vertex: κ = k (1/m + (3/4 L²)/(m L²/6)) = 5.5 k/m
	assert O.dt == pytest.approx(0.4 / math.sqrt(5.5 * 1e8 / density), rel=1e-9)


@pytest.mark.parametrize('model, stiffest', [('boon2012', 7), ('surface', 8)])
def testBeforeAContactAFlatFaceOfASpringIsStifferThanACorner(model, stiffest):
	"""A flat triangle of width b on its side: I = m b²/24, so with k at a corner κ = k/m (1 + (b/2)²/(b²/24)), of its base rocking as a
	spring 4 k b²/12 over I."""
	joint()
	loop(gravity=(0, -gravity, 0), ig2=contactOf(model, perArea=False))
	stepper()
	O.bodies.append(
		[polytope.polygon([(-5, -1), (5, -1), (5, 0), (-5, 0)], fixed=True), polytope.polygon([(-0.5, 3), (0.5, 3), (0, 3.001)])]
	)
	O.step()
	mass = O.bodies[1].state.mass
	assert _polytope.timeStepLimits()['material'] == pytest.approx(1 / math.sqrt(stiffest * 1e8 / mass), rel=1e-3)


def testMaterialsChangedInTheRunCount():
	joint()
	loop()
	engine = stepper()
	floor, block = blockOnFloor()
	block.state.pos = Vector3(0, 0, 5)
	O.step()
	first = O.dt
	block.material.normalStiffness *= 100  # the floor's, too: it is one material
	O.run(10 * engine.timeStepUpdateInterval, wait=True)
	assert O.dt == pytest.approx(first / 10, rel=1e-9)
	block.material.normalStiffness /= 100
	block.state.mass *= 4
	block.state.inertia *= 4
	O.run(10 * engine.timeStepUpdateInterval, wait=True)
	assert O.dt == pytest.approx(2 * first, rel=1e-9)


def testBodiesPutInLaterCountAtOnce():
	joint()
	loop()
	engine = stepper(timeStepUpdateInterval=1000)
	blockOnFloor()
	O.bodies[1].state.pos = Vector3(0, 0, 5)
	O.run(3, wait=True)
	first = O.dt
	small = O.bodies.append(polytope.cuboid((0, 0, 8), (0.05, 0.05, 0.05)))
	O.step()
	assert engine.limitingBody == small and O.dt == pytest.approx(first / 10**1.5, rel=1e-9)  # the same stiffness, a thousandth of the mass


def testAnErasedBodyLimitsNothing():
	"""It limits the step neither in flight, by what its material would give, nor by its contact."""
	for height in (8, 0.049):
		O.reset()
		joint()
		loop()
		engine = stepper(timeStepUpdateInterval=1000)
		blockOnFloor()
		O.bodies[1].state.pos = Vector3(0, 0, 5)
		O.run(3, wait=True)
		first = O.dt
		small = O.bodies.append(polytope.cuboid((2, 0, height), (0.05, 0.05, 0.05)))
		O.step()
		O.step()
		assert engine.limitingBody == small and O.dt < first / 10
		O.bodies.erase(small)
		O.step()
		assert engine.limitingBody == 1 and O.dt == pytest.approx(first, rel=1e-9)


# ------------------------------------------------------------------------------------------------------------------------ what limits


def testMotionLimits():
	joint(normalStiffness=1, shearStiffness=1)
	loop()
	engine = stepper(timeStepUpdateInterval=10)
	floor, block = blockOnFloor()
	block.state.pos, block.state.vel = Vector3(0, 0, 5), Vector3(0, 0, -100)
	O.step()
	assert engine.limitedBy == 'motion' and engine.limitingBody == block.id
	assert O.dt == pytest.approx(0.1 * 0.5 / 100)
	block.state.vel = Vector3.Zero
	driven(floor, velocity=(0, 0, 50))
	O.run(10, wait=True)
	assert engine.limitedBy == 'motion' and O.dt == pytest.approx(0.1 * 0.5 / 50)
	driven(floor)
	O.engines[3].gravity = (0, 0, -1000)
	block.state.vel = Vector3.Zero
	O.run(9, wait=True)
	block.state.vel = Vector3.Zero
	O.run(1, wait=True)
	assert engine.limitedBy == 'motion' and O.dt <= math.sqrt(0.1 * 0.5 / 1000) * (1 + 1e-9)


def testWhatLimitsIsNamed():
	joint()
	loop(ig2={'contactModel': 'spring'})
	engine = stepper(timeStepUpdateInterval=1)
	half = (0.5, 0.5, 0.05)
	floor, block = blockOnFloor(1e-4, half)
	O.bodies.append(polytope.cuboid((0, 0, 1.0998 - 1e-4), (2, 2, 1), fixed=True))  # between two: stiffer in rocking than a corner may be
	driven(block)  # cannot move: limits nothing
	O.run(2, wait=True)
	assert engine.limitedBy == '' and engine.limitingBody == -1
	block.state.blockedDOFs = ''
	O.step()
	assert engine.limitedBy == 'rocking' and engine.limitingBody == block.id
	O.reset()
	joint()
	loop(perArea=True)  # per contact a vertex, which may touch at any time, is as stiff as a face
	engine = stepper(maxDt=1e-6, timeStepUpdateInterval=10)
	O.bodies.append([polytope.cuboid((0, 0, 2 * 0.4999 * k), (0.5, 0.5, 0.5) if k == 1 else (2, 2, 0.5), fixed=k != 1) for k in range(3)])
	O.run(10, wait=True)
	assert engine.limitedBy == 'maxDt' and O.dt == 1e-6
	engine.maxDt = 1
	O.run(10, wait=True)
	assert engine.limitedBy == 'contacts' and engine.limitingBody == 1  # between two


def testStableTimeStepIsTheSame():
	joint()
	loop(perArea=True)
	engine = stepper(timestepSafetyCoefficient=0.5, timeStepUpdateInterval=10)
	O.bodies.append([polytope.cuboid((0, 0, 2 * 0.4999 * k), (0.5, 0.5, 0.5) if k == 1 else (2, 2, 0.5), fixed=k != 1) for k in range(3)])
	O.run(11, wait=True)
	assert engine.limitedBy == 'contacts'
	assert O.dt == pytest.approx(polytope.stableTimeStep(0.5), rel=1e-2)


# ------------------------------------------------------------------------------------------------------------- arguments, files, threads


@pytest.mark.parametrize(
	'name, value',
	[
		('timestepSafetyCoefficient', 0),
		('timestepSafetyCoefficient', 2.1),
		('timestepSafetyCoefficient', math.nan),
		('motionLimit', 0),
		('motionLimit', math.inf),
		('maxDt', 0),
		('maxDt', -1),
		('timeStepUpdateInterval', 0),
	],
)
def testWrongValuesAreRefusedByName(name, value):
	engine = PolytopeTimeStepper()
	before = getattr(engine, name)
	with pytest.raises(ValueError, match=name):
		setattr(engine, name, value)
	assert getattr(engine, name) == before
	with pytest.raises(ValueError, match=name):
		PolytopeTimeStepper(**{name: value})


def testSavedAndLoaded():
	joint()
	loop(gravity=(0, 0, -gravity), normalDamping=0.3)
	stepper(timestepSafetyCoefficient=0.3, motionLimit=0.2, maxDt=0.5, timeStepUpdateInterval=7)
	blockOnFloor()
	O.bodies[1].state.pos = Vector3(0, 0, 0.6)
	O.run(50, wait=True)
	with tempfile.TemporaryDirectory() as folder:
		path = os.path.join(folder, 'scene.xml')
		O.save(path)
		O.run(50, wait=True)
		ahead = (O.time, O.dt, O.bodies[1].state.pos)
		O.load(path)
	engine = O.engines[4]
	assert (engine.timestepSafetyCoefficient, engine.motionLimit, engine.maxDt, engine.timeStepUpdateInterval) == (0.3, 0.2, 0.5, 7)
	O.run(50, wait=True)
	assert O.time == pytest.approx(ahead[0], rel=1e-3) and O.dt == pytest.approx(ahead[1], rel=1e-3)
	assert (O.bodies[1].state.pos - ahead[2]).norm() < 1e-4
