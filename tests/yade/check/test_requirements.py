# SPDX-License-Identifier: GPL-2.0-or-later
"""polytope.requirements: finds faults put into a scene on purpose, reports none without them, and leaves the scene unchanged."""

import math

import pytest
from requirementsScenes import advised, row
from yade import (
	Bo1_Polytope_Aabb,
	Bo1_Sphere_Aabb,
	GlobalStiffnessTimeStepper,
	InsertionSortCollider,
	InteractionLoop,
	O,
	Polytope,
	Quaternion,
	Vector3,
	polytope,
)


def testNothingToSayOfAGoodScene():
	row()
	O.dt = polytope.stableTimeStep(0.2)
	assert advised() == set()


def testFunctorsSwitches():
	row(contactModel='boon2012', computeArea=True, timing=True, warmStart=False, contactPoint='chebyshevCentre')
	O.trackEnergy = True
	assert advised() >= {'clocks', 'warm start', 'contact point', 'energy tracking'}


def testAreaThatIsNeededIsNotBlamed():
	row(computeArea=True, contactModel='boon2012')
	O.engines[2].physDispatcher.functors[0].stiffnessPerArea = True
	O.interactions.clear()
	O.step()
	O.step()
	found = polytope.requirements(O, measure=False)['contact area']
	assert not found.advice and 'need' in found.seen


def testOverlapsOfALoadedSceneAreSaidToBeUnknown(tmp_path):
	"""YADE's archives have no penetration depths."""
	row(contactModel='boon2012')
	O.save(str(tmp_path / 'scene.yade.gz'))
	O.load(str(tmp_path / 'scene.yade.gz'))
	missing = dict(polytope.requirements(O, measure=False).notSeen)
	for what in ('corner radius', 'several pieces under one face'):
		assert missing[what].startswith('the depths of 3 contacts are not known') and 'O.step()' in missing[what]
	O.step()
	assert not {'corner radius', 'several pieces under one face'} & dict(polytope.requirements(O, measure=False).notSeen).keys()


def testPermanentForcesAreNamed():
	row()
	assert polytope.requirements(O, measure=False)['permanent forces'].seen == 'none'
	O.forces.setPermF(2, (1, 0, 0))
	O.forces.setPermT(3, (1, 0, 0))
	found = polytope.requirements(O, measure=False)['permanent forces']
	assert found.seen.startswith('2 bodies') and 'ForceEngine' in found.advice


wrongEngines = [
	(lambda e: e[1:], 'ForceResetter() at the start'),
	(lambda e: e[:3], 'NewtonIntegrator() after the InteractionLoop'),
	(lambda e: [e[0], *e[2:]], 'PolytopeCollider([Bo1_Polytope_Aabb()])'),
	(lambda e: [e[0], InsertionSortCollider([Bo1_Sphere_Aabb()]), *e[2:]], 'Bo1_Polytope_Aabb() in the collider'),
	(lambda e: [e[0], e[1], InteractionLoop(e[2].geomDispatcher.functors, [], e[2].lawDispatcher.functors), e[3]], 'an Ip2 functor'),
	(lambda e: [e[0], e[1], InteractionLoop(e[2].geomDispatcher.functors, e[2].physDispatcher.functors, []), e[3]], 'an Law2 functor'),
	(lambda e: [e[1], e[2], e[0], e[3]], 'ForceResetter before InteractionLoop'),
	(lambda e: [e[0], e[2], e[1], e[3]], 'collider before InteractionLoop'),
	(lambda e: [e[0], e[1], e[3], e[2]], 'InteractionLoop before NewtonIntegrator'),
]


@pytest.mark.parametrize('change,word', wrongEngines, ids=[word for _, word in wrongEngines])
def testEnginesThatAreMissingOrInTheWrongOrder(change, word):
	row(steps=0)
	O.engines = change(O.engines)
	found = polytope.requirements(O, measure=False)['engines']
	assert word in found.advice and found.advice.count(';') == 0


def testGlobalStiffnessTimeStepperIsAdvisedAgainst():
	"""With good reason: it takes steps beyond the limit, where the contact of a face rocks."""
	row(steps=0, contactModel='spring')
	O.engines = [*O.engines, GlobalStiffnessTimeStepper(timestepSafetyCoefficient=0.8, defaultDt=1e-5, timeStepUpdateInterval=1)]
	O.dt = 1e-5
	for _ in range(300):
		O.step()
	assert 'PolytopeTimeStepper' in polytope.requirements(O, measure=False)['time step'].advice
	assert O.dt > 1.5 * polytope.stableTimeStep(1)


def testTimeStep():
	row()
	limit = polytope.stableTimeStep(1)
	for fraction, word in ((0.2, ''), (0.99, ''), (1.5, 'near the limit'), (3.3, 'beyond the limit'), (0.01, 'of the steps')):
		O.dt = fraction * limit
		found = polytope.requirements(O, measure=False)['time step']
		assert bool(found.advice) == bool(word) and word in found.advice


def testCornerRadiusStaysBelowTheInscribedRadius():
	"""Contacts so soft that no radius is large enough, and so hard that any is."""
	row(material={'normalStiffness': 3e4, 'shearStiffness': 3e4}, cornerRadius=0.1, steps=400, contactModel='boon2012')
	found = polytope.requirements(O, measure=False)['corner radius']
	assert found.advice.startswith('stiffer contacts, and cornerRadius up to 0.36 m')
	assert ('gets no gradient' in found.advice) == (' 0 contact points' not in found.seen)
	row(material={'normalStiffness': 1e13, 'shearStiffness': 1e13}, cornerRadius=0.1, steps=0, contactModel='boon2012')
	O.bodies[1].state.pos -= (0, 0, 0.5 - 1e-6 - 0.4995)
	O.dt = 1e-7
	for body in O.bodies:
		body.state.pos += (0, 0, 0.5 - 1e-9 - 0.4995 if body.dynamic else 0)
	O.step()
	O.step()
	assert 'would do' in polytope.requirements(O, measure=False)['corner radius'].advice


def testOrdinaryBlocksAtRestKeepTheirDefaultCorner():
	row(cornerRadius=None, material={'normalStiffness': 1e8, 'shearStiffness': 1e8}, steps=2000, contactModel='boon2012')
	assert 'corner radius' not in advised()


def testCornersThatWereLostAreReported():
	row(number=1, cornerRadius=1e-4, steps=0, spin=0.5, contactModel='boon2012')
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
	O.bodies[1].state.pos += (0, 0, 10)  # gone, and still known, but not how deep it was
	O.step()
	O.step()
	assert f'{lost} contact points were deeper' in dict(polytope.requirements(O, measure=False).notSeen)['corner radius']
	O.engines[2].geomDispatcher.functors[0].resetStats()
	assert 'deeper' not in dict(polytope.requirements(O, measure=False).notSeen)['corner radius']


def testCornerRadiusAgainstOverlaps():
	row(cornerRadius=0.015, contactModel='boon2012')
	depth = max(float(contact.geom.penetrationDepth) for contact in O.interactions if contact.isReal)
	for radius, word in ((1.1 * depth, 'at least'), (300 * depth, ''), (10 * depth, '')):
		for body in O.bodies:
			body.shape.cornerRadius = radius
		O.engines[2].geomDispatcher.functors[0].resetStats()
		O.step()
		found = polytope.requirements(O, measure=False)['corner radius']
		assert word in found.advice and bool(word) == bool(found.advice), found


def testEnergyOfTheUndampedPaperModel():
	row(contactModel='boon2012')
	O.engines[2].lawDispatcher.functors[0].normalDamping = 0
	O.engines[3].damping = 0
	assert 'damping and energy' in advised()
	O.engines[2].geomDispatcher.functors[0].contactModel = 'spring'
	assert 'damping and energy' not in advised()


@pytest.mark.parametrize('contacts', [True, False])
def testASpringHasNoStiffnessPerArea(contacts):
	row(contactModel='spring')
	assert 'damping and energy' not in advised()
	O.engines[2].physDispatcher.functors[0].stiffnessPerArea = True
	O.interactions.clear()
	if contacts:
		assert 'damping and energy' in advised()
		O.step()
		O.step()
		assert any(contact.isReal and contact.phys.normalStiffness > 0 for contact in O.interactions)
	found = polytope.requirements(O, measure=False)['damping and energy']
	assert 'per area' in found.seen and "contactModel='surface', which goes by the unit, or 'foundation', or stiffnessPerArea=False" in found.advice
	O.engines[2].geomDispatcher.functors[0].contactModel = 'foundation'
	assert 'damping and energy' not in advised()
	O.engines[2].geomDispatcher.functors[0].contactModel = 'boon2012'
	assert 'damping and energy' not in advised()


def testPlanesWithoutAFace():
	"""A block on its edge, with one more plane: far away, or through that edge and to one side."""
	for direction, beyond, word in (((0, 0, -1), 1, ''), ((0.3, 0, -1), 0, 'keepRedundant')):
		row(number=1, steps=0, contactModel='boon2012')
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
	row(contactModel='boon2012')
	assert 'Newton tolerance' not in advised()
	for body in O.bodies:
		body.state.pos += (1e7, 0, 0)
	found = polytope.requirements(O, measure=False)['Newton tolerance']
	assert 'origin' in found.advice and 'gains no digit' not in found.advice and found.trial is None  # the depth needs what there is


def testNewtonToleranceFinerThanTheDepthNeeds():
	row(newtonTolerance=1e-15, contactModel='boon2012')
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


def testRefusals():
	O.reset()
	with pytest.raises(ValueError, match='O: '):
		polytope.requirements(O)
	with pytest.raises(ValueError, match='O: '):
		polytope.requirements(None)
	for wrong in ('no', 1, None):
		with pytest.raises(ValueError, match=f'measure: must be True or False, got {wrong!r}'):
			polytope.requirements(O, measure=wrong)
	with pytest.raises(ValueError, match='fraction'):
		polytope.stableTimeStep('x')
	row()
	with pytest.raises(KeyError, match='nothing of the sort'):
		polytope.requirements(O, measure=False)['nothing of the sort']
