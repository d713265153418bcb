# SPDX-License-Identifier: GPL-2.0-or-later
"""PolytopeTimeStepper with other laws and bodies among the polytopes, clumps, polygons, periodic cells and threads."""

import math
import os
import subprocess
import sys

import pytest
from scenes import blockOnFloor, bounds, contactOf, density, gravity, joint, loop, stepper, stepUntil, supports
from yade import (
	Bo1_Polytope_Aabb,
	Bo1_Sphere_Aabb,
	ForceResetter,
	FrictMat,
	Ig2_Polytope_Polytope_PolytopeGeom,
	Ig2_Sphere_Polytope_PolytopeGeom,
	Ig2_Sphere_Sphere_ScGeom,
	InteractionLoop,
	Ip2_FrictMat_FrictMat_FrictPhys,
	Law2_ScGeom_FrictPhys_CundallStrack,
	NewtonIntegrator,
	O,
	PolytopeCollider,
	Quaternion,
	_polytope,
	polytope,
	utils,
)


def testFrictMatSpheresAndBlocks():
	O.materials.append(FrictMat(density=density, young=1e8, poisson=0.3, frictionAngle=0.5))
	O.engines = [
		ForceResetter(),
		PolytopeCollider([Bo1_Polytope_Aabb(), Bo1_Sphere_Aabb()], verletDist=0.01),
		InteractionLoop(
			[Ig2_Polytope_Polytope_PolytopeGeom(), Ig2_Sphere_Polytope_PolytopeGeom(), Ig2_Sphere_Sphere_ScGeom()],
			[Ip2_FrictMat_FrictMat_FrictPhys()],
			[Law2_ScGeom_FrictPhys_CundallStrack(sphericalBodies=False)],
		),
		NewtonIntegrator(gravity=(0, 0, -gravity), damping=0.4),
	]
	engine = stepper()
	O.bodies.append(polytope.cuboid((0, 0, -0.5), (3, 3, 0.5), fixed=True))
	ball = O.bodies.append(utils.sphere((0, 0, 0.3), 0.1))
	O.step()
	# YADE's stiffness of the ball on a wall, 2 E R, at most; κ = k (1/m + R²/I) = 3.5 k/m
	mass = O.bodies[ball].state.mass
	assert engine.limitingBody == ball
	assert 0.4 / math.sqrt(3.5 * 2e8 * 0.1 / mass) <= O.dt <= 0.4 / math.sqrt(3.5 * 1e8 * 0.1 / mass)
	O.bodies.append([utils.sphere((0.15 * (k - 1), 0.02 * k, 0.6 + 0.25 * k), 0.1) for k in range(3)])
	O.bodies.append([polytope.regular(faces, 0.12, (0.2 * (faces % 3 - 1), 0.1, 1.5 + 0.03 * faces)) for faces in (4, 6, 8, 12, 20)])
	stepUntil(4)
	moving = [body.state for body in O.bodies if body.dynamic]
	assert all(0 < state.pos[2] < 1 for state in moving)
	assert max(float(state.vel.norm()) for state in moving) < 1  # some roll, none is thrown


def testPolygons():
	joint()
	loop(gravity=(0, -gravity, 0), normalDamping=0.3, damping=0.2)
	engine = stepper(timeStepUpdateInterval=10)
	O.bodies.append(polytope.polygon([(-5, -1), (5, -1), (5, 0), (-5, 0)], fixed=True))
	square = O.bodies.append(polytope.polygon([(-0.5, 0.2), (0.5, 0.2), (0.5, 1.2), (-0.5, 1.2)]))
	O.step()
	# only the turn about z: κ = k (1/m + (L²/2)/(m L²/6)) = 4 k/m at a corner; dampers as the law has them
	free = O.dt
	O.engines[2].lawDispatcher.functors[0].normalDamping = 0
	O.run(100, wait=True)  # ten updates
	assert O.dt == pytest.approx(0.4 / math.sqrt(4 * 1e8 / density), rel=1e-9) and free < O.dt
	stepUntil(2)
	assert O.bodies[square].state.pos[1] == pytest.approx(0.5, abs=1e-3)
	assert engine.limitingBody == square


def testClumpsHaveTheContactsOfTheirMembers():
	joint()
	loop()
	stepper(timestepSafetyCoefficient=1)
	O.bodies.append(polytope.cuboid((0, 0, -1), (5, 5, 1), fixed=True))
	left, right = (polytope.cuboid((x, 0, 0.4999), (0.5, 0.5, 0.5)) for x in (-0.5, 0.5))
	clump, _ = O.bodies.appendClumped([left, right])
	O.step()
	O.step()
	contacts = _polytope.timeStepLimits()['contacts']
	state = O.bodies[clump].state
	translation = 2 * 1e8 / state.mass
	assert 1 / contacts**2 >= 0.999 * translation  # both springs carry it
	assert 1 / contacts**2 < 10 * translation


def testFixedBodiesLimitNothing():
	joint()
	loop()
	engine = stepper()
	O.bodies.append(polytope.cuboid((0, 0, 0), (1, 1, 1), fixed=True))
	O.dt = 0.123
	O.step()
	assert O.dt == 0.123 and engine.limitedBy == '' and engine.limitingBody == -1


@pytest.mark.parametrize('perArea', [False, True])
@pytest.mark.parametrize('model', ['boon2012', 'surface'])
@pytest.mark.parametrize('support', ['wall', 'box', 'facet'])
def testSupportsOfYadeAreAsPolytopes(support, model, perArea):
	"""A cube on a wall, a box or a facet has the step that it has on a polytope: rocking, too."""
	steps = []
	for functor, make in ((None, lambda: polytope.cuboid((0, 0, -1), (5, 5, 1), fixed=True)), supports[support]):
		O.reset()
		joint()
		ig2 = contactOf(model, perArea)
		loop(perArea=perArea, normalDamping=0.3, ig2=ig2)
		if functor:
			O.engines[1].boundDispatcher.functors = [one() for one in bounds]
			O.engines[2].geomDispatcher.functors = [Ig2_Polytope_Polytope_PolytopeGeom(**ig2), functor()]
		engine = stepper()
		O.bodies.append([make(), polytope.cuboid((0.1, 0.2, 0.4999), (0.5, 0.5, 0.5))])
		O.step()
		O.step()
		assert engine.limitingBody == 1 and engine.limitedBy
		steps.append((_polytope.timeStepLimits()['contacts'], _polytope.timeStepLimits()['material']))
	assert steps[1] == pytest.approx(steps[0], rel=1e-2)


@pytest.mark.parametrize('model', ['boon2012', 'spring'])
def testAcrossAPeriodicBoundary(model):
	steps = []
	for shift in (0, 1):
		O.reset()
		joint()
		loop(normalDamping=0.3, ig2={'contactModel': model})
		stepper()
		O.periodic = True
		O.cell.setBox(4, 4, 4)
		O.bodies.append(polytope.cuboid((3.6 if shift else 1.6, 2, 2), (0.5, 0.5, 0.5), Quaternion((1, 2, 3), 0.7)))
		O.bodies.append(polytope.cuboid((0.55 if shift else 2.55, 2.1, 2.05), (0.5, 0.5, 0.5)))
		O.bodies[0].state.vel = (1, 0, 0)
		O.dt = 1e-6
		O.step()
		O.step()
		assert O.interactions[0, 1].isReal
		steps.append((_polytope.timeStepLimits()['contacts'], O.dt))
	assert steps[0] == pytest.approx(steps[1], rel=1e-9)


threaded = """
import sys
sys.path.insert(0, sys.argv[1])
from scenes import *
joint(), loop(normalDamping=0.3, gravity=(0, 0, -gravity), damping=0.3)
engine = stepper()
O.bodies.append(polytope.cuboid((0, 0, -1), (5, 5, 1), fixed=True))
O.bodies.append([polytope.cuboid((2 * k - 3, 0, 0.5 + 1.0 * j), (0.5, 0.5, 0.5)) for k in range(4) for j in range(3)])
O.run(1000, True)
print('RESULT', O.numThreads, O.dt.hex(), engine.limitingBody, engine.limitedBy)
"""


def testTwoThreadsGiveTheSameStep():
	results = []
	for threads in ('1', '2'):
		run = subprocess.run(
			[sys.executable, '-c', threaded, os.path.dirname(os.path.dirname(__file__))],
			env={**os.environ, 'OMP_NUM_THREADS': threads},
			capture_output=True,
			text=True,
			timeout=100,
		)
		assert run.returncode == 0, run.stderr
		(line,) = [line.split() for line in run.stdout.splitlines() if line.startswith('RESULT')]
		assert line[1] == threads
		results.append(line[2:])
	assert results[0] == results[1]


def testWithoutALoopOnlyMotionLimits():
	joint()
	floor, block = blockOnFloor()
	O.engines = [ForceResetter(), NewtonIntegrator(gravity=(0, 0, -gravity))]
	engine = stepper()
	O.step()
	assert engine.limitedBy == 'motion' and O.dt == pytest.approx(math.sqrt(0.1 * 0.5 / gravity))


def testGravityOfAllIntegratorsThatActLimitsTheMotion():
	joint()
	blockOnFloor()
	parts = [NewtonIntegrator(gravity=(0, 0, -share * gravity)) for share in (0.75, 0.25)]
	O.engines = [ForceResetter(), *parts, NewtonIntegrator(gravity=(0, 0, -100 * gravity), dead=True)]
	engine = stepper()
	O.step()
	assert engine.limitedBy == 'motion' and O.dt == pytest.approx(math.sqrt(0.1 * 0.5 / gravity))
