# SPDX-License-Identifier: GPL-2.0-or-later
"""Joint properties that belong to faces: contacts have those of the face they lie on, also when they end and are made again."""

from math import cos, degrees, pi, radians, sin, tan

import numpy as np
import pytest
from yade import FrictMat, O, Quaternion, RockJointMat, Vector3, polytope

gravity = 9.81
stiff = {'density': 2600, 'normalStiffness': 1e9, 'shearStiffness': 1e9}


def angles():
	"""Friction angle [°] of each contact, by its bodies."""
	return {
		(one.id1, one.id2): round(degrees(np.arctan(float(one.phys.tangensOfFrictionAngle))), 6) for one in O.interactions if one.isReal
	}


def materials():
	O.materials.append(RockJointMat(label='rock', frictionAngle=radians(45), **stiff))
	O.materials.append(RockJointMat(label='bedding', frictionAngle=radians(20), **stiff))
	O.materials.append(RockJointMat(label='steep', frictionAngle=radians(50), **stiff))


def top(body, index, others=-1):
	"""Gives the face that looks up, in the body's axes, a material."""
	body.shape.faceMaterials = [index if normal[2] > 0.9 else others for normal in body.shape.normals]
	return body


def slope(two):
	"""A row of fixed blocks that dips by 30°, with the top of bedding, and a block on it; returns the block."""
	materials()
	if two:
		turned, up = Quaternion((0, 0, 1), -pi / 6), 1
		pieces = []
		for k in range(4):
			pieces.append(
				polytope.polygon(
					[tuple(turned * Vector3(x, y, 0))[:2] for x, y in ((2 * k, -1), (2 * k + 2, -1), (2 * k + 2, 0), (2 * k, 0))],
					material=0,
					fixed=True,
				)
			)
		block = polytope.polygon(
			[tuple(turned * Vector3(x, y, 0))[:2] for x, y in ((0.5, 0), (1.5, 0), (1.5, 0.3), (0.5, 0.3))], material=0
		)
	else:
		turned, up = Quaternion((0, 1, 0), pi / 6), 2
		pieces = [
			polytope.cuboid(turned * Vector3(2 * k + 1, 0, -0.5), (1, 1, 0.5), orientation=turned, material=0, fixed=True) for k in range(4)
		]
		block = polytope.cuboid(turned * Vector3(1, 0, 0.15), (0.5, 0.4, 0.15), orientation=turned, material=0)
	axis = turned * Vector3(*(1.0 if k == up else 0.0 for k in range(3)))
	for piece in pieces:
		own = [np.dot(np.array(piece.state.ori * normal, float), np.array(axis, float)) for normal in piece.shape.normals]
		piece.shape.faceMaterials = [1 if along > 0.9 else 2 for along in own]
	O.bodies.append(pieces)
	O.bodies.append(block)
	down = Vector3(0, -gravity, 0) if two else Vector3(0, 0, -gravity)
	O.engines = polytope.engines(damping=0, gravity=down)
	return block, turned * Vector3(1, 0, 0)


@pytest.mark.parametrize('two', [False, True])
def testABlockThatSlidesFromPieceToPieceHasTheFrictionOfTheirFaces(two):
	block, along = slope(two)
	start, begin, met = Vector3(block.state.pos), O.time, set()
	while (block.state.pos - start).norm() < 4.5 and O.time < 4:
		O.run(100, wait=True)
		found = angles()
		assert set(found.values()) <= {20.0}
		met |= set(found)
	way = float((block.state.pos - start).dot(along))
	assert len(met) == 4
	assert way == pytest.approx(gravity * (sin(pi / 6) - cos(pi / 6) * tan(radians(20))) * (O.time - begin) ** 2 / 2, rel=1e-2)


def testAContactThatEndsAndComesBackHasItsFaceAgain():
	materials()
	O.bodies.append(top(polytope.cuboid((0, 0, -0.5), (2, 2, 0.5), material=0, fixed=True), 1))
	block = O.bodies[O.bodies.append(polytope.cuboid((0, 0, 0.5 - 1e-5), (0.5, 0.5, 0.5), material=0))]
	O.engines = polytope.engines()
	for height, expected in ((0, {(0, 1): 20.0}), (0.2, {}), (0, {(0, 1): 20.0}), (0.2, {}), (0, {(0, 1): 20.0})):
		block.state.pos, block.state.vel = (0, 0, 0.5 - 1e-5 + height), (0, 0, 0)
		O.run(5, wait=True)
		assert angles() == expected


@pytest.mark.parametrize(
	'upper, lower, turn, expected',
	[
		(2, 1, 0, 20.0),  # both faces: the weaker one
		(-1, 2, 0, 45.0),
		(1, 2, 0.3, 50.0),  # an edge on a face: the face
		(1, -1, 0.3, 45.0),
		(2, 1, 0.3, 20.0),
	],
)
def testTheFaceThatLiesInTheContactsPlaneCounts(upper, lower, turn, expected):
	materials()
	O.bodies.append(top(polytope.cuboid((0, 0, -0.5), (2, 2, 0.5), material=0, fixed=True), lower))
	reach = 0.5 * (sin(turn) + cos(turn))
	body = polytope.cuboid((0, 0, reach - 1e-4), (0.5, 0.5, 0.5), orientation=Quaternion((0, 1, 0), turn), material=0, fixed=False)
	body.shape.faceMaterials = [upper] * 6
	O.bodies.append(body)
	O.engines = polytope.engines(gravity=(0, 0, 0))
	O.step()
	assert angles() == {(0, 1): expected}


def rock():
	box = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
	sets = [polytope.JointSet(radians(20), radians(90), spacing=1), polytope.JointSet(radians(75), radians(250), spacing=1.3)]
	return sets, polytope.jointedRock(box, [2, 2, 0.5, 0.5, 2, 2], sets, seed=2)


def testContactsOfJointedRockHaveThePropertiesOfTheirSet():
	sets, cut = rock()
	materials()
	cut.append(jointMaterials=['bedding', O.materials[2]], material='rock')
	for body in O.bodies:
		body.state.pos *= 1 - 1e-7  # they touch
	O.engines = polytope.engines(gravity=(0, 0, 0))
	O.step()
	first = angles()
	checked = []
	for (a, b), angle in first.items():
		normal = np.array(O.interactions[a, b].geom.normal, float)
		along = [abs(normal @ np.array(one.normal, float)) for one in sets]
		if max(along) > 0.999:
			assert angle == [20.0, 50.0][int(np.argmax(along))]
			checked.append(angle)
	assert len(checked) > 10 and set(checked) == {20.0, 50.0}
	O.interactions.clear()
	O.step()
	O.step()
	assert angles() == first


def testAMaterialForNoneOfASetIsTheBlocksOwn():
	_, cut = rock()
	materials()
	new = RockJointMat(frictionAngle=radians(33), **stiff)
	cut.append(jointMaterials=[None, new], material='rock')
	assert O.materials[3] is new
	given = {index for body in O.bodies for index in body.shape.faceMaterials}
	assert given == {-1, 3}


def testFacesAreSavedWithTheScene(tmp_path):
	materials()
	O.bodies.append(top(polytope.cuboid((0, 0, -0.5), (2, 2, 0.5), material=0, fixed=True), 1, 2))
	given = list(O.bodies[0].shape.faceMaterials)
	for archive in ('state.xml', 'state.yade'):
		O.save(str(tmp_path / archive))
		O.load(str(tmp_path / archive))
		assert list(O.bodies[0].shape.faceMaterials) == given and sorted(given) == [1, 2, 2, 2, 2, 2]


@pytest.mark.parametrize(
	'given, message',
	[
		(['bedding'], '^jointMaterials: must be a sequence .* 2 jointSets'),
		('bedding', '^jointMaterials: must be a sequence'),
		(['bedding', 'other'], r"^jointMaterials\[1\]: .*no material in O.materials has the label 'other'"),
		(['bedding', 'soil'], r'^jointMaterials\[1\]: must be a RockJointMat, got FrictMat'),
		([None, 'stiffer'], r'^jointMaterials\[1\]: its normalStiffness is above'),
	],
)
def testMaterialsThatCannotBeAreNamed(given, message):
	_, cut = rock()
	materials()
	O.materials.append(FrictMat(label='soil'))
	O.materials.append(RockJointMat(label='stiffer', **{**stiff, 'normalStiffness': 2e9}))
	with pytest.raises(ValueError, match=message):
		cut.append(jointMaterials=given, material='rock')
	assert len(O.bodies) == 0
