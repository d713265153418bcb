# SPDX-License-Identifier: GPL-2.0-or-later
"""polytope.requirements: finds what was put into a scene on purpose, is silent without it, and leaves the scene as it was."""

import math

import pytest
from yade import (
	Bo1_Polytope_Aabb,
	ForceResetter,
	Ig2_Polytope_Polytope_PolytopeGeom,
	InsertionSortCollider,
	InteractionLoop,
	Ip2_RockJointMat_RockJointMat_RockJointPhys,
	Law2_PolytopeGeom_RockJointPhys_MohrCoulomb,
	NewtonIntegrator,
	O,
	Polytope,
	PolytopeCollider,
	PyRunner,
	Quaternion,
	RockJointMat,
	Vector3,
	polytope,
)
from yade.polytope.report import stateHash


def row(number=3, steps=50, spin=0.01, cornerRadius=0.02, material=None, **functor):
	"""Blocks on a floor, at rest but for what the first steps do; a good scene unless the arguments spoil it."""
	law, newton = {'normalDamping': 0.3}, {'damping': 0.2}
	O.reset()
	O.materials.append(RockJointMat(**{'normalStiffness': 1e7, 'shearStiffness': 1e7, 'frictionAngle': 0.5, 'density': 1000, **(material or {})}))
	O.bodies.append(polytope.cuboid((0, 0, -0.5), (5, 5, 0.5), fixed=True, cornerRadius=cornerRadius))
	for k in range(number):
		ids = O.bodies.append(polytope.cuboid((1.5 * k, 0, 0.4995), (0.5, 0.4, 0.5), cornerRadius=cornerRadius))
		O.bodies[ids].state.angVel = (spin, 0, 0)
	O.engines = [
		ForceResetter(),
		PolytopeCollider([Bo1_Polytope_Aabb()], verletDist=0.04),
		InteractionLoop(
			[Ig2_Polytope_Polytope_PolytopeGeom(**functor)],
			[Ip2_RockJointMat_RockJointMat_RockJointPhys(stiffnessPerArea=False)],
			[Law2_PolytopeGeom_RockJointPhys_MohrCoulomb(**law)],
		),
		NewtonIntegrator(gravity=(0, 0, -10), **newton),
	]
	O.dt = 5e-4
	for _ in range(steps):
		O.step()


def advised(measure=False):
	return {finding.what for finding in polytope.requirements(O, measure=measure).advice}


def testNothingToSayOfAGoodScene():
	row()
	O.dt = polytope.stableTimeStep(0.2)
	assert advised() == set()


def testFunctorsSwitches():
	row(computeArea=True, timing=True, warmStart=False, contactPoint='chebyshevCentre')
	O.trackEnergy = True
	assert advised() >= {'contact area', 'clocks', 'warm start', 'contact point', 'energy tracking'}


def testAreaThatIsNeededIsNotBlamed():
	row(computeArea=True)
	O.engines[2].physDispatcher.functors[0].stiffnessPerArea = True
	O.interactions.clear()
	O.step()
	O.step()
	found = polytope.requirements(O, measure=False)['contact area']
	assert not found.advice and 'need' in found.seen


def testTimeStep():
	row()
	limit = polytope.stableTimeStep(1)
	for fraction, word in ((0.2, ''), (0.99, ''), (1.5, 'near the limit'), (3.3, 'beyond the limit'), (0.01, 'of the steps')):
		O.dt = fraction * limit
		found = polytope.requirements(O, measure=False)['time step']
		assert bool(found.advice) == bool(word) and word in found.advice


def testWhatCannotBeLookedAtIsNamed():
	row()
	for body in O.bodies:
		if body.dynamic:
			body.state.pos += (0, 0, 5 * body.id)  # blown apart
	O.step()
	O.step()
	found = polytope.requirements(O, measure=False)
	missing = dict(found.notSeen)
	assert {'time step', 'corner radius', 'Newton tolerance'} <= set(missing) and 'no contact' in missing['time step']
	assert 'time step: no contact' in repr(found)
	with pytest.raises(KeyError, match='no contact'):
		found['time step']


def testCornerRadiusStaysBelowTheInscribedRadius():
	"""Contacts so soft that no radius is large enough, and so hard that any is."""
	row(material={'normalStiffness': 3e4, 'shearStiffness': 3e4}, cornerRadius=0.1, steps=400)
	found = polytope.requirements(O, measure=False)['corner radius']
	assert found.advice.startswith('stiffer contacts, and cornerRadius up to 0.36 m')
	assert ('gets no gradient' in found.advice) == (' 0 contact points' not in found.seen)
	row(material={'normalStiffness': 1e13, 'shearStiffness': 1e13}, cornerRadius=0.1, steps=0)
	O.bodies[1].state.pos -= (0, 0, 0.5 - 1e-6 - 0.4995)
	O.dt = 1e-7
	for body in O.bodies:
		body.state.pos += (0, 0, 0.5 - 1e-9 - 0.4995 if body.dynamic else 0)
	O.step()
	O.step()
	assert 'would do' in polytope.requirements(O, measure=False)['corner radius'].advice


def testOrdinaryBlocksAtRestKeepTheirDefaultCorner():
	row(cornerRadius=None, material={'normalStiffness': 1e8, 'shearStiffness': 1e8}, steps=2000)
	assert 'corner radius' not in advised()


def testCornersThatWereLostAreReported():
	row(number=1, cornerRadius=1e-4, steps=0, spin=0.5)
	O.bodies[1].state.pos += (0, 0, 0.2)
	O.bodies[1].state.vel = (0, 0, -5)
	for _ in range(4000):
		O.step()
	statuses = O.engines[2].geomDispatcher.functors[0].stats()['statuses']
	lost = sum(statuses.get(name, 0) for name in ('normalFromOneBody', 'normalFromDual'))
	assert lost > 0
	for body in O.bodies:
		body.shape.cornerRadius = 0.02  # what lies deeper now is none of it
	O.step()
	found = polytope.requirements(O, measure=False)['corner radius']
	assert f'{lost} since the start' in found.seen and 'no gradient' in found.advice
	O.bodies[1].state.pos += (0, 0, 10)  # gone, and still known
	O.step()
	O.step()
	assert 'no gradient' in polytope.requirements(O, measure=False)['corner radius'].advice
	O.engines[2].geomDispatcher.functors[0].resetStats()
	assert 'corner radius' in dict(polytope.requirements(O, measure=False).notSeen)


def testCornerRadiusAgainstOverlaps():
	row(cornerRadius=0.015)
	depth = max(float(contact.geom.penetrationDepth) for contact in O.interactions if contact.isReal)
	for radius, word in ((1.1 * depth, 'at least'), (300 * depth, ''), (10 * depth, '')):
		for body in O.bodies:
			body.shape.cornerRadius = radius
		O.engines[2].geomDispatcher.functors[0].resetStats()
		O.step()
		found = polytope.requirements(O, measure=False)['corner radius']
		assert word in found.advice and bool(word) == bool(found.advice), found


def testEnergyOfTheUndampedPaperModel():
	row()
	O.engines[2].lawDispatcher.functors[0].normalDamping = 0
	O.engines[3].damping = 0
	assert 'damping and energy' in advised()
	O.engines[2].geomDispatcher.functors[0].contactModel = 'conservative'
	assert 'damping and energy' not in advised()


@pytest.mark.parametrize('contacts', [True, False])
def testStiffnessPerAreaIsNotConservative(contacts):
	row(contactModel='conservative')
	assert 'damping and energy' not in advised()
	O.engines[2].physDispatcher.functors[0].stiffnessPerArea = True
	O.interactions.clear()
	if contacts:
		assert 'damping and energy' in advised()
		O.step()
		O.step()
		assert any(contact.isReal and contact.phys.normalStiffness > 0 for contact in O.interactions)
	found = polytope.requirements(O, measure=False)['damping and energy']
	assert 'per area' in found.seen and 'stiffnessPerArea = False' in found.advice
	O.engines[2].geomDispatcher.functors[0].contactModel = 'paper'
	assert 'damping and energy' not in advised()


def testPlanesWithoutAFace():
	"""A block on its edge, with one more plane: far away, or through that edge and to one side."""
	for direction, beyond, word in (((0, 0, -1), 1, ''), ((0.3, 0, -1), 0, 'keepRedundant')):
		row(number=1, steps=0)
		block = O.bodies[1]
		block.state.ori = Quaternion((0, 1, 0), math.pi / 4) * block.state.ori
		block.state.pos = (0, 0, 0.5 * math.sqrt(2) - 1e-3)
		O.step()
		O.step()
		found = polytope.requirements(O, measure=False)['planes without a face']
		assert found.seen == 'every plane owns a face' and not found.advice
		extra = block.state.ori.conjugate() * Vector3(*direction)
		block.shape = Polytope(
			normals=list(block.shape.normals) + [extra],
			offsets=list(block.shape.offsets) + [max(extra.dot(corner) for corner in block.shape.vertices) + beyond],
			cornerRadius=block.shape.cornerRadius,
		)
		found = polytope.requirements(O, measure=False)['planes without a face']
		assert found.seen.startswith('1 planes of 1 bodies') and word in found.advice and bool(word) == bool(found.advice), found


def testNewtonToleranceFarFromTheOrigin():
	row()
	assert 'Newton tolerance' not in advised()
	for body in O.bodies:
		body.state.pos += (1e7, 0, 0)
	found = polytope.requirements(O, measure=False)['Newton tolerance']
	assert 'origin' in found.advice and 'gains no digit' not in found.advice and found.trial is None  # the depth needs what there is


def testNewtonToleranceFinerThanTheDepthNeeds():
	row(newtonTolerance=1e-15)
	for body in O.bodies:
		body.state.pos += (1e7, 0, 0)
	found = polytope.requirements(O, measure=False)['Newton tolerance']
	name, coarser = found.trial
	assert 'gains no digit' in found.advice and name == 'newtonTolerance' and 1e-13 < coarser < 1e-9


def testColliderThatSortsInEveryStep():
	row()
	O.engines[1].verletDist = 0
	assert 'verletDist' in advised()


def testColliderThatRunsInNearlyEveryStep():
	row()
	O.engines[1].verletDist = 1e-9
	assert 'verletDist' in advised()


@pytest.mark.parametrize('dt', [0, math.nan])
def testTimeStepThatIsNone(dt):
	row()
	O.dt = dt
	assert 'above 0' in polytope.requirements(O, measure=False)['time step'].advice


def testBodyWhosePlaceIsNoNumber():
	row()
	O.bodies[2].state.pos = (math.nan, 0, 0)
	found = polytope.requirements(O, measure=False)['numbers of bodies']
	assert '1 of 4 bodies' in found.seen and 'body 2' in found.seen and found.advice


def testBoxesThatAreNotTight():
	row()
	O.engines = [O.engines[0], InsertionSortCollider([Bo1_Polytope_Aabb()], verletDist=0.04), *O.engines[2:]]
	O.step()
	found = polytope.requirements(O, measure=False)['boxes']
	# three blocks on the floor; balls of neighbours overlap
	assert '2 of 5 pairs' in found.seen and 'PolytopeCollider' in found.advice


def testCohesionThatIsLost():
	row(material={'cohesion': 1e5, 'tensileStrength': 1e4})
	assert 'cohesion' not in advised()
	for contact in O.interactions:
		contact.phys.intact = False
	assert 'cohesion' in advised()


def flatRow():
	row(steps=0, spin=0)
	O.engines[3].gravity = (0, -10, 0)
	for k, body in enumerate(O.bodies):
		if body.dynamic:
			body.state.blockedDOFs = 'zXY'
			body.state.pos = (1.2 * k, 0, 0.2)
			body.state.vel = body.state.angVel = (0, 0, 0)
	O.bodies[0].state.pos = (0, -5.3995, 0)


def testThirdDimensionAndItsPrice():
	flatRow()
	for _ in range(20):
		O.step()
	found = polytope.requirements(O)['third dimension']
	assert 'polygon' in found.advice and found.cost is not None
	O.bodies[1].state.blockedDOFs = ''
	O.bodies[1].state.angVel = (0.1, 0, 0)
	assert 'third dimension' not in advised()


def testThirdDimensionUpToRounding():
	flatRow()
	for body in O.bodies:
		if body.dynamic:
			body.state.blockedDOFs = ''
			body.state.vel, body.state.angVel = (0.1, 0, 2e-18), (1e-18, 0, 0.1)
	assert 'third dimension' in advised()
	for engine, gravity in ((O.engines[3], (0, -10, -10)), (O.engines[3], (0, 0, -10))):
		engine.gravity = gravity
		assert 'third dimension' not in advised()
	O.engines[3].gravity = (0, -10, 0)
	O.forces.setPermF(1, (0, 0, 5))
	assert 'third dimension' not in advised()


def testBlocksThatAreAboutToFallAreNoPolygons():
	row(steps=0, spin=0)
	assert 'third dimension' not in advised()


def testMeasuringTouchesNothing(tmp_path):
	row(number=5, computeArea=True, timing=True)
	O.engines = [*O.engines, PyRunner(command='raise SystemExit', iterPeriod=1000, firstIterRun=10**6)]
	functor = O.engines[2].geomDispatcher.functors[0]

	def everything(name):
		O.save(str(tmp_path / name), quiet=True)
		return (tmp_path / name).read_bytes(), stateHash(), functor.stats(), O.iter, O.time, O.timingEnabled, O.engines[2].execTime

	before = everything('before.yade.bin')
	found = polytope.requirements(O)
	assert everything('after.yade.bin') == before
	assert 0 < found.stepMicroseconds < 1e5
	assert {'contact area', 'clocks', 'warm start'} <= {finding.what for finding in found.findings if finding.cost is not None}
	assert found['warm start'].cost < 0  # without it, steps take longer
	assert 'contact area' in repr(found) and 'saves' in repr(found)
	O.step()  # and goes on


def testRefusals():
	O.reset()
	with pytest.raises(ValueError, match='O: '):
		polytope.requirements(O)
	with pytest.raises(ValueError, match='O: '):
		polytope.requirements(None)
	with pytest.raises(ValueError, match='fraction'):
		polytope.stableTimeStep('x')
	row()
	with pytest.raises(KeyError, match='nothing of the sort'):
		polytope.requirements(O, measure=False)['nothing of the sort']
