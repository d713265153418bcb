# SPDX-License-Identifier: GPL-2.0-or-later
"""While it computes a pair, the functor prefetches the data of the pairs after it: of any kind, also if deleted."""

import pytest
from boon2012.falling.scene import FallingPolyhedra
from boon2012.runWatch import stateHash
from scenes import joint, loop
from yade import Bo1_Facet_Aabb, Bo1_Sphere_Aabb, Ig2_Facet_Polytope_PolytopeGeom, Ig2_Sphere_Polytope_PolytopeGeom, O, polytope, utils


def heap():
	scene = FallingPolyhedra(number=60)
	scene.build()
	O.run(1500, True)
	assert O.interactions.countReal() > 20
	return scene


def testErasedBodiesLeaveTheRunAlone():
	"""Their pairs stay in the list until the collider's next run."""
	scene = heap()
	collider = O.engines[1]
	for number in scene.particleIds[::3]:
		O.bodies.erase(number)
	O.step()
	pairs = len(O.interactions)
	assert collider.numAction > 0 and pairs > 0
	O.run(300, True)
	functor = scene.geometryFunctor
	assert functor.stats()['failures'] == 0
	assert all(O.bodies[i.id1] and O.bodies[i.id2] for i in O.interactions)


def testSortedLoopGivesTheSameContacts():
	"""There a pair's place in the list is not the order of computation."""
	geometry = []
	for ordered in (False, True):
		scene = heap()
		scene.interactionLoop.loopOnSortedInteractions = ordered
		O.step()
		geometry.append(
			{
				(i.id1, i.id2): (tuple(i.geom.contactPoint), tuple(i.geom.normal), i.geom.penetrationDepth)
				for i in O.interactions
				if i.isReal
			}
		)
	assert len(geometry[0]) > 20 and geometry[0] == geometry[1]


def testPairMadeByTheScript():
	"""It is computed before it is in the list."""
	scene = heap()
	there = {(i.id1, i.id2) for i in O.interactions}
	one, two = next((a, b) for a in scene.particleIds for b in reversed(scene.particleIds) if a < b and (a, b) not in there)
	contact = utils.createInteraction(one, two)
	assert contact.geom.penetrationDepth < 0
	O.step()
	assert scene.geometryFunctor.stats()['failures'] == 0


@pytest.mark.parametrize('kind', ['sphere', 'facet'])
def testPairsOfOtherShapesStandBetweenOurs(kind):
	"""Their geometry, material law and shape are smaller than ours."""
	hashes = []
	for _ in range(2):
		joint()
		loop(gravity=(0, 0, -10))
		O.engines[1].boundDispatcher.functors += [Bo1_Sphere_Aabb(), Bo1_Facet_Aabb()]
		O.engines[2].geomDispatcher.functors += [Ig2_Sphere_Polytope_PolytopeGeom(), Ig2_Facet_Polytope_PolytopeGeom()]
		for k in range(12):
			O.bodies.append(polytope.cuboid((k, 0, 0), (0.49, 0.49, 0.49), fixed=True))
			ball, facet = utils.sphere((k, 0, 0.98), 0.5), utils.facet([(k - 0.3, -0.3, 0.48), (k + 0.3, -0.3, 0.48), (k, 0.3, 0.48)])
			O.bodies.append(ball if kind == 'sphere' else facet)
		O.dt = 1e-4
		O.run(50, True)
		assert O.interactions.countReal() >= 12
		hashes.append(stateHash())
		O.reset()
	assert hashes[0] == hashes[1]
