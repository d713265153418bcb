# SPDX-License-Identifier: GPL-2.0-or-later
"""One place has the settings of all contacts of a scene: its Ig2_Polytope_Polytope_PolytopeGeom."""

import itertools
import warnings

import pytest
from yade import (
	Bo1_Box_Aabb,
	Bo1_Polytope_Aabb,
	Bo1_Wall_Aabb,
	ForceResetter,
	Ig2_Box_Polytope_PolytopeGeom,
	Ig2_Polytope_Polytope_PolytopeGeom,
	Ig2_Sphere_Polytope_PolytopeGeom,
	Ig2_Wall_Polytope_PolytopeGeom,
	InsertionSortCollider,
	InteractionLoop,
	Ip2_RockJointMat_RockJointMat_RockJointPhys,
	Law2_PolytopeGeom_RockJointPhys_MohrCoulomb,
	NewtonIntegrator,
	O,
	Quaternion,
	RockJointMat,
	Vector3,
	polytope,
	utils,
)

tilt = Quaternion(Vector3(1, 0.3, 0).normalized(), 0.02)
floors = 'polytope', 'box', 'wall'
others = {
	'contactModel': 'boon2012',
	'contactPoint': 'centroid',
	'solver': 'newton',
	'warmStart': False,
	'tolerance': 1e-4,
	'newtonTolerance': 1e-9,
}
others |= {'computeArea': True, 'computeEnergy': True, 'timing': True}


def functors(**settings):
	return [Ig2_Wall_Polytope_PolytopeGeom(), Ig2_Box_Polytope_PolytopeGeom(), Ig2_Polytope_Polytope_PolytopeGeom(**settings)]


def blocksOnFloors(geometry, perArea=False):
	"""Puts equal tilted blocks, one on a floor of each kind, far from each other; none moves."""
	O.reset()
	O.materials.append(RockJointMat(density=2600, normalStiffness=1e7, shearStiffness=1e7, frictionAngle=0.5, stiffnessPerArea=perArea))
	for k, floor in enumerate(floors):
		if floor == 'polytope':
			O.bodies.append(polytope.cuboid((10 * k, 0, -1), (3, 3, 1), fixed=True))
		elif floor == 'box':
			O.bodies.append(utils.box((10 * k, 0, -1), (3, 3, 1), fixed=True))
		else:
			O.bodies.append(utils.wall((10 * k, 0, 0), axis=2, mask=2))
		O.bodies.append(polytope.cuboid((10 * k, 0, 0.99), (1, 1, 1), orientation=tilt))
		if floor == 'wall':
			O.bodies[-1].mask = 3
	O.engines = [
		ForceResetter(),
		InsertionSortCollider([Bo1_Polytope_Aabb(), Bo1_Box_Aabb(), Bo1_Wall_Aabb()], verletDist=0.1),
		InteractionLoop(geometry, [Ip2_RockJointMat_RockJointMat_RockJointPhys()], [Law2_PolytopeGeom_RockJointPhys_MohrCoulomb()]),
		NewtonIntegrator(dead=True),
	]
	O.dt = 1e-6


def contactsOfBlocks():
	"""(depth, area, point from the block) of each, in the order of *floors*."""
	O.step()
	found = []
	for k in range(len(floors)):
		contact = O.interactions[2 * k, 2 * k + 1]
		geom = contact.geom
		place = geom.contactPoint - O.bodies[2 * k + 1].state.pos
		found.append([float(x) for x in (geom.penetrationDepth, geom.contactArea, *place)])
	return found


def alike(found):
	return all(one == pytest.approx(other, rel=1e-9, abs=1e-12) for one, other in itertools.combinations(found, 2))


@pytest.mark.parametrize('order', [slice(None), slice(None, None, -1)])
def testAllPairsHaveTheSettingsOfTheOne(order):
	"""Blocks on a polytope, a box and a wall have the same contact with each model, though one functor alone is given it."""
	ofModels = {}
	for model, perArea in (('foundation', True), ('spring', False), ('boon2012', False), ('surface', True), ('surface', False)):
		blocksOnFloors(functors(contactModel=model, computeArea=True)[order], perArea)
		found = contactsOfBlocks()
		assert alike(found[:2] if model == 'boon2012' else found), (model, found)  # the paper's normal knows the sides of a floor
		ofModels[model, perArea] = found
	for kind in range(len(floors)):
		ofKind = {key: found[kind] for key, found in ofModels.items()}
		assert alike([ofKind['surface', True], ofKind['foundation', True]]) and alike([ofKind['surface', False], ofKind['spring', False]])
		assert not any(alike(pair) for pair in itertools.combinations(list(ofKind.values())[:3], 2)), 'models differ'


def testWhatIsSetLaterHoldsForAllFromTheNextStep():
	geometry = functors(contactModel='spring')
	blocksOnFloors(geometry)
	before = contactsOfBlocks()
	geometry[2].contactModel = 'boon2012'
	after = contactsOfBlocks()
	assert alike(before) and not any(alike(pair) for pair in zip(before, after, strict=True))
	O.engines[2].geomDispatcher.functors = [*geometry[:2], Ig2_Polytope_Polytope_PolytopeGeom(contactModel='spring')]
	O.interactions.clear()
	assert contactsOfBlocks() == before, 'another functor took its place'


def testOthersShowThemAndHaveNone():
	geometry = functors(**others)
	blocksOnFloors(geometry)
	mixed = [*geometry[:2], Ig2_Sphere_Polytope_PolytopeGeom()]
	for functor, (name, value) in itertools.product(mixed, others.items()):
		assert getattr(functor, name) == value
		with pytest.raises(
			ValueError, match=f"{name}: {type(functor).__name__} has no settings of its own; set it in the scene's Ig2_Polytope"
		):
			setattr(functor, name, value)
		with pytest.raises(ValueError, match=f'{name}: .*Ig2_Polytope_Polytope_PolytopeGeom'):
			type(functor)(**{name: value})
		assert getattr(functor, name) == value
	assert Ig2_Wall_Polytope_PolytopeGeom(label='ofWalls').label == 'ofWalls'


def testWithoutTheOneTheDefaultsHold():
	blocksOnFloors(functors(), perArea=True)
	expected = contactsOfBlocks()
	assert alike(expected)
	O.engines[2].geomDispatcher.functors = functors()[:2]
	O.interactions.clear()
	O.step()
	wall = O.interactions[4, 5].geom
	assert float(wall.penetrationDepth) == pytest.approx(expected[2][0], rel=1e-12)
	assert functors()[0].contactModel == 'surface' and functors(contactModel='spring')[0].contactModel == 'surface', 'not in the scene'
	with pytest.raises(ValueError, match=r'O.engines: .*Ig2_Polytope_Polytope_PolytopeGeom\(\)'):
		polytope.mechanicalEnergy()


def testTheyAreSavedWithTheScene():
	blocksOnFloors(functors(**others))
	O.saveTmp()
	found = contactsOfBlocks()
	O.reset()
	O.loadTmp()
	wall = O.engines[2].geomDispatcher.functors[0]
	assert {name: getattr(wall, name) for name in others} == others
	assert contactsOfBlocks() == found


def testTheContactOfTwoBodiesIsThatOfTheScene():
	for model in ('spring', 'boon2012'):
		blocksOnFloors(functors(contactModel=model))
		depth = contactsOfBlocks()[0][0]
		contact = polytope.contact(O.bodies[0], O.bodies[1])
		assert float(contact.depth) == pytest.approx(depth, rel=1e-12)
		assert float(polytope.contact(O.bodies[0], O.bodies[1], contactModel='foundation').depth) != pytest.approx(depth, rel=1e-3)
	with pytest.raises(ValueError, match='contactModel: must be'):
		polytope.contact(O.bodies[0], O.bodies[1], contactModel='winkler')


def testTwoOfAKindAreRefused():
	blocksOnFloors(functors())
	with pytest.raises(ValueError, match='geometry: has Ig2_Polytope_Polytope_PolytopeGeom twice'):
		polytope.engines(geometry=[*functors(contactModel='spring'), Ig2_Polytope_Polytope_PolytopeGeom()])


def testAllFunctorsOfTheScenesEnginesShowWhatOneWasGiven():
	blocksOnFloors(functors())
	O.engines = polytope.engines(geometry=Ig2_Polytope_Polytope_PolytopeGeom(contactModel='boon2012'))
	assert [one.contactModel for one in O.engines[2].geomDispatcher.functors] == ['boon2012'] * 3


def testEnginesThatAreMadeAreCheckedWithTheirOwnSettings():
	"""They are not the scene's yet. A block on a wall, whose functor has no settings."""
	O.reset()
	O.materials.append(RockJointMat(density=2600, normalStiffness=1e7, shearStiffness=1e7, frictionAngle=0.5))
	O.bodies.append([utils.wall((0, 0, 0), axis=2), polytope.cuboid((0, 0, 1), (1, 1, 1))])
	undamped = {'law': Law2_PolytopeGeom_RockJointPhys_MohrCoulomb(), 'damping': 0}
	with pytest.warns(UserWarning, match="with contactModel 'boon2012' they gain energy"):
		O.engines = polytope.engines(geometry=Ig2_Polytope_Polytope_PolytopeGeom(contactModel='boon2012'), **undamped)
	with warnings.catch_warnings():
		warnings.simplefilter('error')
		polytope.engines(**undamped)


@pytest.mark.parametrize('option', [{'contactPoint': 'centroid'}, {'contactPoint': 'chebyshevCentre'}, {'solver': 'ipopt'}])
def testOptionsOfThePapersContactAreRefusedWithAnother(option):
	name, value = next(iter(option.items()))
	for model in ('surface', 'foundation', 'spring'):
		with pytest.raises(ValueError, match=f"{name}: '{value}' is an option of contactModel='boon2012' alone, set that first; '{model}'"):
			Ig2_Polytope_Polytope_PolytopeGeom(contactModel=model, **option)
	geometry = Ig2_Polytope_Polytope_PolytopeGeom()
	with pytest.raises(ValueError, match=name):
		setattr(geometry, name, value)
	with pytest.raises(ValueError, match=name):
		polytope.contact(polytope.cuboid((0, 0, 0), (1, 1, 1)), polytope.cuboid((0, 0, 1), (1, 1, 1)), **option)


def testOptionsOfThePapersContactAreThoseOfItsSceneAlone():
	blocksOnFloors(functors(contactModel='boon2012', contactPoint='centroid'))
	geometry = O.engines[2].geomDispatcher.functors[2]
	with pytest.raises(ValueError, match="contactPoint: 'centroid' .* 'spring' goes with contactPoint='analyticCentre'"):
		geometry.contactModel = 'spring'
	assert geometry.contactModel == 'boon2012'
	ofSurface = polytope.contact(O.bodies[0], O.bodies[1], contactModel='spring')
	assert tuple(ofSurface.point) != tuple(polytope.contact(O.bodies[0], O.bodies[1]).point)
