# SPDX-License-Identifier: GPL-2.0-or-later
"""polytope.engines: the usual loop for whatever the scene has, each part replaceable, and what is wrong is warned of."""

import math
import warnings

import pytest
from yade import (
	Bo1_Polytope_Aabb,
	ForceResetter,
	FrictMat,
	Ig2_Polytope_Polytope_PolytopeGeom,
	InsertionSortCollider,
	InteractionLoop,
	Ip2_RockJointMat_RockJointMat_RockJointPhys,
	Law2_PolytopeGeom_RockJointPhys_MohrCoulomb,
	NewtonIntegrator,
	O,
	PolytopeCollider,
	PolytopeGeomFunctor,
	PolytopeTimeStepper,
	RockJointMat,
	polytope,
	utils,
)

rock = {'density': 2600, 'normalStiffness': 1e8, 'shearStiffness': 1e8, 'frictionAngle': 0.6}


@pytest.fixture(autouse=True)
def warningsAreErrors():
	with warnings.catch_warnings():
		warnings.simplefilter('error')
		yield


def blockOnFloor(others=list, material=None):
	O.materials.append(material or RockJointMat(**rock))
	O.bodies.append([polytope.cuboid((0, 0, -0.5), (2, 2, 0.5), fixed=True), polytope.cuboid((0, 0, 0.51), (0.5, 0.4, 0.5))])
	O.bodies.append(others())


def names(functors):
	return sorted(type(functor).__name__ for functor in functors)


def settle(seconds):
	while O.time < seconds:
		O.step()


def testBlockComesToRest():
	blockOnFloor()
	O.engines = polytope.engines()
	settle(1)
	contact = O.interactions[0, 1]
	assert contact.phys.normalForce.norm() == pytest.approx(9.81 * O.bodies[1].state.mass, rel=1e-6)
	assert names(O.engines[2].geomDispatcher.functors) == ['Ig2_Polytope_Polytope_PolytopeGeom'], 'what the scene has, and no more'
	assert O.engines[1].verletDist == pytest.approx(0.04)


def testEveryShapeIsMet():
	"""Blocks and spheres on a wall, a box, facets and each other: nothing falls through."""
	blockOnFloor()
	O.bodies.append([utils.wall((0, 0, -3), axis=2), utils.box((8, 0, -0.5), (2, 2, 0.5), fixed=True)])
	O.bodies.append([utils.facet([(-12, -6, 0), (-4, -6, 0), (-8, 6, 0)])])
	places = [(8, 0), (-8, -2), (0, 5)]
	O.bodies.append([polytope.cuboid((x, y, 0.51 if y < 5 else -2.49), (0.5, 0.4, 0.5)) for x, y in places])
	O.bodies.append([utils.sphere((x + 1.2, y, 0.41 if y < 5 else -2.59), 0.4) for x, y in places])
	O.bodies.append([utils.sphere((0, 0, 1.42), 0.4), utils.sphere((9.2, 0, 1.22), 0.4)])
	O.engines = polytope.engines(integrator=NewtonIntegrator(gravity=(0, 0, -9.81), damping=0.6))
	assert not polytope.check(O)
	settle(0.5)
	for body in (one for one in O.bodies if one.dynamic):
		assert body.state.pos[2] > (-3 if body.state.pos[1] > 4 else -0.51), body.id
	assert {type(one.geom).__name__ for one in O.interactions if one.isReal} == {'PolytopeGeom', 'ScGeom'}


def testSmallestMovingBodySetsTheReachOfTheBoxes():
	blockOnFloor()
	O.bodies.append(utils.sphere((1, 1, 3), 0.05))
	assert polytope.engines()[1].verletDist == pytest.approx(0.005)
	O.bodies[2].state.blockedDOFs = 'xyzXYZ'
	assert polytope.engines()[1].verletDist == pytest.approx(0.04)


def testFunctorsFollowMaterials():
	blockOnFloor(material=FrictMat(density=2600, young=1e8))
	loop = polytope.engines()[2]
	assert names(loop.physDispatcher.functors) == ['Ip2_FrictMat_FrictMat_FrictPhys']
	assert not loop.lawDispatcher.functors[0].sphericalBodies
	O.bodies[1].material = RockJointMat(**rock)
	with pytest.warns(UserWarning, match='no rock joint'):
		O.engines = polytope.engines()
	assert names(O.engines[2].physDispatcher.functors) == ['Ip2_FrictMat_FrictMat_FrictPhys', 'Ip2_RockJointMat_RockJointMat_RockJointPhys']
	settle(0.2)
	assert O.bodies[1].state.pos[2] > 0.48, 'a block of one material rests on a floor of the other'


def testPolygonsFallAlongY():
	O.materials.append(RockJointMat(**rock))
	O.bodies.append(polytope.polygon([(0, 0.1), (1, 0.1), (0, 1)]))
	assert list(polytope.engines()[3].gravity) == [0, -9.81, 0]
	assert list(polytope.engines(gravity=(1, 2, 0))[3].gravity) == [1, 2, 0]


def testSceneWithoutBodiesGetsAllPairs():
	loop = polytope.engines()[2]
	assert len(loop.geomDispatcher.functors) == 9 and len(loop.lawDispatcher.functors) == 2


def testEveryPartIsReplaceable():
	blockOnFloor()
	physics, law = (
		Ip2_RockJointMat_RockJointMat_RockJointPhys(stiffnessPerArea=False),
		Law2_PolytopeGeom_RockJointPhys_MohrCoulomb(normalDamping=0.7),
	)
	collider, integrator = InsertionSortCollider([Bo1_Polytope_Aabb()]), NewtonIntegrator(damping=0.1)
	stepper = PolytopeTimeStepper(maxDt=1e-4)
	made = polytope.engines(physics=physics, law=law, collider=collider, integrator=integrator, timeStepper=stepper)
	assert [type(one) for one in made] == [ForceResetter, InsertionSortCollider, InteractionLoop, NewtonIntegrator, PolytopeTimeStepper]
	assert not made[2].physDispatcher.functors[0].stiffnessPerArea and made[2].lawDispatcher.functors[0].normalDamping == 0.7
	assert made[3].damping == 0.1 and made[4].maxDt == 1e-4
	assert isinstance(polytope.engines()[1], PolytopeCollider)
	assert len(polytope.engines(timeStepper=False)) == 4


def testSettingsHoldForAllPairs():
	blockOnFloor(lambda: [utils.wall((0, 0, -3), axis=2), utils.sphere((0, 0, 2), 0.3)])
	geometry = Ig2_Polytope_Polytope_PolytopeGeom(contactModel='spring', newtonTolerance=1e-9)
	made = O.engines = polytope.engines(geometry=geometry, physics=Ip2_RockJointMat_RockJointMat_RockJointPhys(stiffnessPerArea=False))
	mixed = [one for one in made[2].geomDispatcher.functors if isinstance(one, PolytopeGeomFunctor)]
	assert len(mixed) == 3 and all(one.contactModel == 'spring' and one.newtonTolerance == 1e-9 for one in mixed)
	O.bodies.erase(3)
	wall = next(one for one in mixed if 'Wall' in type(one).__name__)
	ofAList = polytope.engines(geometry=[geometry, wall], physics=made[2].physDispatcher.functors[0])
	assert len(ofAList[2].geomDispatcher.functors) == 2


def testALawForPolytopesLeavesSpheresTheirs():
	blockOnFloor(lambda: [utils.sphere((0, 0, 2), 0.3), utils.sphere((0, 0, 3), 0.3)])
	laws = polytope.engines(law=Law2_PolytopeGeom_RockJointPhys_MohrCoulomb(normalDamping=0.1))[2].lawDispatcher.functors
	assert names(laws) == ['Law2_PolytopeGeom_RockJointPhys_MohrCoulomb', 'Law2_ScGeom_FrictPhys_CundallStrack']
	assert laws[0].normalDamping == 0.1


def testWhatIsWrongIsWarnedOf():
	blockOnFloor()
	O.bodies[1].state.mass = 0
	with pytest.warns(UserWarning, match='mass: body 1 can move and has mass 0'):
		polytope.engines()
	O.reset()
	blockOnFloor()
	with pytest.warns(UserWarning, match="contactModel 'spring' with stiffnesses per area"):
		polytope.engines(geometry=Ig2_Polytope_Polytope_PolytopeGeom(contactModel='spring'))


@pytest.mark.parametrize('damping, share', [(0, 1), (None, 0.8)])
def testASlideIsThatOfTheoryWithoutDamping(damping, share):
	"""A block on a floor of 30°, friction angle 10°. YADE's damping takes its part of the force along the slope: slower by it."""
	O.materials.append(RockJointMat(**{**rock, 'frictionAngle': math.radians(10)}))
	O.bodies.append([polytope.cuboid((0, 0, -0.5), (5, 2, 0.5), fixed=True), polytope.cuboid((-2, 0, 0.2), (0.5, 0.4, 0.2))])
	slope, g = math.radians(30), 9.81
	O.engines = polytope.engines(gravity=(g * math.sin(slope), 0, -g * math.cos(slope)), damping=damping)
	assert O.engines[3].damping == (0.2 if damping is None else damping)
	settle(0.3)
	began, speed = O.time, float(O.bodies[1].state.vel[0])
	settle(0.8)
	acceleration = (float(O.bodies[1].state.vel[0]) - speed) / (O.time - began)
	theory = g * (math.sin(slope) - math.tan(math.radians(10)) * math.cos(slope))
	assert acceleration == pytest.approx(share * theory, rel=5e-3)


@pytest.mark.parametrize('damping', [-0.1, 1, math.nan])
def testDampingHasARange(damping):
	with pytest.raises(ValueError, match='damping: must be from 0 to below 1'):
		polytope.engines(damping=damping)


@pytest.mark.parametrize('name', ['geometry', 'physics', 'law', 'collider', 'integrator', 'timeStepper', 'gravity', 'damping'])
def testRefusals(name):
	blockOnFloor()
	with pytest.raises(ValueError, match=f'{name}: must be'):
		polytope.engines(**{name: ForceResetter()})


def testGravityAndDampingBelongToOneOfThem():
	with pytest.raises(ValueError, match='gravity: belongs to the integrator'):
		polytope.engines(gravity=(0, 0, -1), integrator=NewtonIntegrator())
	with pytest.raises(ValueError, match='damping: belongs to the integrator'):
		polytope.engines(damping=0, integrator=NewtonIntegrator())


def testAStepMadeBeforeDoesNotShootTheBodies():
	"""YADE's own engines set O.dt to a second; the first step of ours must not be that long."""
	O.reset()
	O.materials.append(RockJointMat(density=2600, normalStiffness=1e8, shearStiffness=1e8, frictionAngle=0.6))
	O.dt = 0.8
	block = O.bodies.append(polytope.cuboid((0, 0, 1), (0.5, 0.4, 0.3)))
	O.engines = polytope.engines()
	O.step()
	assert O.bodies[block].state.vel.norm() < 1e-6 and 1e-6 < O.dt < 0.1
	O.dt = 0.8
	polytope.engines(timeStepper=False)
	assert O.dt == 0.8, "without a time stepper it is the script's"


def testWhatActsOnTheSceneIsStillThereAfterwards():
	"""A moving base, a quiet boundary, forces that fade and histories."""
	O.materials.append(RockJointMat(density=2600, normalStiffness=1e9, shearStiffness=1e9, frictionAngle=0.6))
	shaken, quiet, gone = (O.bodies.append(polytope.cuboid((3 * k, 0, 0.25), (0.5, 0.5, 0.25), fixed=True)) for k in range(3))
	block = O.bodies.append(polytope.cuboid((6, 0, 1), (0.5, 0.5, 0.5)))
	O.engines = polytope.engines(damping=0)
	polytope.settle(unbalanced=1e-7)
	polytope.quietBoundary(quiet, (0, 0, -1), 600, 400)
	polytope.baseMotion(shaken, polytope.velocityHistory([0, 1, 1], times=[0, 1, 2], kind='velocity', baseline=False))
	polytope.history({'block': block}, every=10)
	polytope.excavate([gone], over=1000)
	before = [type(one).__name__ for one in O.engines]
	O.engines = polytope.engines(damping=0)
	assert sorted(type(one).__name__ for one in O.engines) == sorted(before)
	names = [type(one).__name__ for one in O.engines]
	assert names[0] == 'BaseMotion' and names.index('QuietBoundary') < names.index('NewtonIntegrator')
	assert names.count('PyRunner') == 2 and names.index('PyRunner') < names.index('NewtonIntegrator')
