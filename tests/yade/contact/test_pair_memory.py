# SPDX-License-Identifier: GPL-2.0-or-later
"""What pairs of bodies keep in memory: little until they touch, and enough to be dismissed at once in the next step."""

import math
import os
import pathlib
import sys

import pytest
from scenes import bounds, joint, loop, supports, withPolytopes
from yade import Bo1_Sphere_Aabb, Ig2_Sphere_Polytope_PolytopeGeom, O, Quaternion, polytope, utils

sys.path.append(str(pathlib.Path(__file__).resolve().parents[3] / 'tools/measure/benchmark'))
import memory  # noqa: E402

turned = Quaternion((0, 0, 1), math.pi / 4)


def functor():
	return O.engines[2].geomDispatcher.functors[0]


def diamonds(side, spacing=0.75):
	"""Cubes that stand on the squares of one colour of a board, turned by 45°: at 0.75 m their boxes overlap, at 1.6 m not even those."""
	O.reset()
	joint(normalStiffness=1e8)
	loop()
	for x in range(side):
		for y in range(x % 2, side, 2):
			O.bodies.append(polytope.cuboid((spacing * x, spacing * y, 0), (0.5, 0.5, 0.5), turned))
			O.bodies[-1].state.blockedDOFs = 'XYZ'  # tight boxes
	O.dt = 1e-6


def pairsOfDiamonds(side):
	return (side - 1) ** 2


def columns(number, gap):
	"""Cubes in twos, one above the other across this gap [m]."""
	O.reset()
	joint(normalStiffness=1e8)
	loop()
	for k in range(number):
		for z in (0, 1 + gap):
			O.bodies.append(polytope.cuboid((2 * k, 0, z), (0.5, 0.5, 0.5)))
			O.bodies[-1].state.blockedDOFs = 'XYZ'
	O.dt = 1e-6


def testAPairApartHasNoGeometry():
	diamonds(3)
	O.step()
	pairs = O.interactions.all(onlyReal=False)
	assert len(pairs) == pairsOfDiamonds(3) == 4
	assert all(pair.geom is None and pair.phys is None for pair in pairs)
	assert functor().stats()['statuses']['separated'] == 4


def testASpherePairApartHasNone():
	joint()
	loop()
	O.engines[1].boundDispatcher.functors += [Bo1_Sphere_Aabb()]
	O.engines[2].geomDispatcher.functors += [Ig2_Sphere_Polytope_PolytopeGeom()]
	O.bodies.append([polytope.cuboid((0, 0, 0), (0.5, 0.5, 0.5)), utils.sphere((0.95, 0.95, 0), 0.5)])  # 0.14 m from the edge
	O.dt = 1e-6
	O.step()
	(pair,) = O.interactions.all(onlyReal=False)
	assert not pair.isReal and pair.geom is None


def testBytesOfABodyAPairApartAndAContact():
	"""YADE's own Interaction is 0.37 kB of a pair and of a contact, with its places in the lists of the loop and of both bodies; the
	vertices and pieces that a contact keeps are 0.18 kB."""
	found = memory.measure(quick=True)
	print(found)
	assert found['pair apart'] < found['contact'] / 2
	if polytope.buildInfo()['precision'] == 'double':
		assert (
			300 < found['pair apart'] < 470 and 900 < found['contact'] < 1870 and 500 < found['body'] < 1030
		)  # 24 of it the list of materials of faces


def testPairsApartAreHardlySaved(tmp_path):
	"""O.save writes YADE's own Interaction of a pair, as for all shapes; a checkpoint not even that."""
	sizes, pairs = [], []
	for spacing in (0.75, 1.6):
		diamonds(20, spacing)
		engine = polytope.checkpoint(str(tmp_path / 'run'), iterPeriod=1000, onSignal=False)
		O.step()
		engine.write()
		O.save(str(tmp_path / 'scene.yade'), quiet=True)
		pairs.append(len(O.interactions))
		sizes.append([os.path.getsize(tmp_path / name) for name in ('scene.yade', 'run.yade')])
		assert all(len(body.intrs()) == 0 for body in O.bodies)
	assert pairs == [pairsOfDiamonds(20), 0]
	(saved, checkpoint), (savedWithout, checkpointWithout) = sizes
	assert saved - savedWithout < 100 * pairs[0] and abs(checkpoint - checkpointWithout) < 100


def testACheckpointHasTheContactsAndLeavesTheListsOfPairs(tmp_path):
	columns(5, gap=-1e-3)
	O.engines += [polytope.checkpoint(str(tmp_path / 'run'), iterPeriod=2, onSignal=False)]
	O.run(3, True)
	found = [[(pair.id1, pair.id2) for pair in body.intrs()] for body in O.bodies]
	assert all(len(pairs) == 1 for pairs in found)
	forces = {(one.id1, one.id2): tuple(one.phys.normalForce) for one in O.interactions}
	O.run(1, True)
	assert polytope.continueFrom(str(tmp_path / 'run'))
	assert [[(pair.id1, pair.id2) for pair in body.intrs()] for body in O.bodies] == found
	assert set(forces) == {(one.id1, one.id2) for one in O.interactions if one.isReal}


def testAPairApartIsFoundAgainAfterLoading(tmp_path):
	diamonds(20)
	O.step()
	O.save(str(tmp_path / 'scene.yade'), quiet=True)
	O.load(str(tmp_path / 'scene.yade'), quiet=True)
	O.step()
	assert len(O.interactions) == pairsOfDiamonds(20) and functor().stats()['statuses']['separated'] == pairsOfDiamonds(20)


def testPairsApartAreDismissedByTheirMemory():
	diamonds(20)
	O.step()
	first = functor().stats()
	assert first['simplexPivots'] > 0
	functor().resetStats()
	O.run(5, True)
	stats = functor().stats()
	assert stats['pairs'] == stats['dismissed'] == 5 * pairsOfDiamonds(20) and stats['simplexPivots'] == 0


def testAPairThatMovesInTheListStartsAnewOnce():
	"""A pair never takes another one's memory for its own, though places of deleted pairs in the list are filled from its end."""
	diamonds(20)
	O.run(2, True)
	for body in range(0, len(O.bodies), 5):
		O.bodies.erase(body)
	O.run(2, True)  # the collider deletes pairs
	left = len(O.interactions)
	assert 0 < left < pairsOfDiamonds(20)
	functor().resetStats()
	O.run(3, True)
	stats = functor().stats()
	assert stats['pairs'] == stats['dismissed'] == 3 * left and stats['failures'] == 0


def testMemoryOfAnExchangedShapeIsNotRead():
	"""The exchanged shape may have fewer planes than the pair remembers."""
	diamonds(3)
	for body in O.bodies:
		body.shape = polytope.regular(20, 0.5).shape
	O.run(2, True)
	for body in O.bodies:
		body.shape = polytope.regular(4, 0.3).shape
	O.run(2, True)
	assert functor().stats()['failures'] == 0 and O.interactions.countReal() == 0


floors = {
	'polytope': lambda: polytope.cuboid((0, 0, -1), (3, 3, 1), fixed=True),
	'box': supports['box'][1],
	'facet': supports['facet'][1],
	'wall': supports['wall'][1],
}
blocks = {'block': lambda: polytope.cuboid((0, 0, 0.1), (0.3, 0.2, 0.1)), 'ball': lambda: utils.sphere((0, 0, 0.1), 0.1)}


@pytest.mark.parametrize('after', [*floors, 'ball'])
@pytest.mark.parametrize('before', floors)
def testAShapeIsExchangedForOneOfAnotherClass(before, after):
	"""YADE keeps a contact's functor; the contact is made anew, with the right one, and the body lies there as before."""
	O.reset()
	joint()
	O.bodies.append(floors[before]())
	O.bodies.append(blocks['block']())
	loop(perArea=True, gravity=(0, 0, -9.81), damping=0.5)
	O.engines[1].boundDispatcher.functors = [one() for one in bounds]
	O.engines[2].geomDispatcher.functors = [one() for one in withPolytopes]
	O.dt = 1e-4
	O.run(200, True)
	if after == 'ball':
		O.bodies[1].shape = blocks['ball']().shape
	else:
		O.bodies[0].shape = floors[after]().shape
		O.bodies[0].state.pos = floors[after]().state.pos
	O.run(1, True)
	if after == 'ball' and before != 'polytope':
		assert not O.interactions.has(0, 1, True)  # that would be YADE's own
		return
	O.run(6000, True)
	assert abs(O.bodies[1].state.pos[2] - 0.1) < (1e-2 if after == 'ball' else 1e-3)  # under the block's weight
	assert abs(O.forces.f(1)[2] / (9.81 * O.bodies[1].state.mass) - 1) < 1e-2


def approach(begin):
	"""Two solids that have come as near as 1e-5 m of overlap, from pairs apart at so many steps before; the contact as it is made."""
	O.reset()
	joint(normalStiffness=1e8)
	loop()
	for k in range(2):
		O.bodies.append(polytope.regular(20, 0.5, (0, 0, 0), Quaternion((1, 2, 3), 0.3 + k)))
	O.bodies[1].state.blockedDOFs = O.bodies[0].state.blockedDOFs = 'xyzXYZ'
	O.dt = 1e-6
	for step in range(begin, -1, -1):
		O.bodies[1].state.pos = (0.8 + 0.001 * step, 0.02, 0.01)
		O.step()
		if O.interactions.countReal():
			break
	(contact,) = O.interactions
	assert contact.isReal and O.engines[2].geomDispatcher.functors[0].stats()['contacts'] == 1
	return step, tuple(contact.geom.contactPoint), tuple(contact.geom.normal), contact.geom.penetrationDepth, contact.geom.infeasibility


def testANewContactDoesNotDependOnWhatThePairRemembers():
	"""Therefore it is the same in a scene that was saved and loaded before."""
	warm = approach(100)
	assert warm[0] > 0
	cold = approach(warm[0])
	assert warm == cold
