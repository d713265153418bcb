# SPDX-License-Identifier: GPL-2.0-or-later
"""contactTypes names the type of a contact in exact poses, two cubes or two squares, each overlapping by a tenth of the corner radius."""

from math import atan, pi, sqrt

import numpy as np
import pytest
from scenes import contact, joint, loop
from yade import O, Quaternion, Vector3, polytope
from yade.polytope.measures.contactTypes import ContactTypes, types2d, types3d

overlap = 0.005
cornerRadius = 0.05
edgeUp = Quaternion((1, 0, 0), pi / 4)
vertexDown = Quaternion(Vector3(1, -1, 0).normalized(), atan(sqrt(2)))
"""Turns the vertex (1, 1, 1) onto the vertical."""
floor = (0, 0, -2), (3, 3, 2), Quaternion.Identity
below = (0, 0, 0), (0.5, 0.5, 0.5)

# (lower body, upper body's half-lengths, orientation, height of its centre above the touch, offset in x) → type
poses3d = {
	'face-face': (floor, Quaternion.Identity, 0.5, 0),
	'edge-face': (floor, edgeUp, sqrt(0.5), 0),
	'vertex-face': (floor, vertexDown, sqrt(0.75), 0),
	'edge-edge': ((*below, edgeUp), Quaternion((0, 1, 0), pi / 4), sqrt(2), 0),
	'vertex-edge': ((*below, edgeUp), vertexDown, sqrt(0.5) + sqrt(0.75), 0),
	'vertex-vertex': ((*below, vertexDown), vertexDown, 2 * sqrt(0.75), 0),
}


def touch(lower, orientation, height, sideways=0.0, **ig2):
	joint()
	loop(ig2=ig2)
	a = polytope.cuboid(lower[0], lower[1], lower[2], fixed=True, cornerRadius=cornerRadius)
	b = polytope.cuboid((sideways, 0, height - overlap), (0.5, 0.5, 0.5), orientation, cornerRadius=cornerRadius)
	O.bodies.append([a, b])
	O.dt = 1e-9
	O.step()
	return contact(a, b)


@pytest.mark.parametrize('name', poses3d)
def testExactPose(name):
	assert ContactTypes().of(touch(*poses3d[name])) == name


@pytest.mark.parametrize('name', poses3d)
def testTurnedAndMovedTogetherIsTheSame(name):
	"""The pair is turned and moved as a whole, with either order of the bodies."""
	lower, orientation, height, _ = poses3d[name]
	turn, shift = Quaternion((1, 2, 3), 0.7), Vector3(100, -20, 3)
	joint()
	loop()
	a = polytope.cuboid(turn * Vector3(*lower[0]) + shift, lower[1], turn * lower[2], fixed=True, cornerRadius=cornerRadius)
	b = polytope.cuboid(turn * Vector3(0, 0, height - overlap) + shift, (0.5, 0.5, 0.5), turn * orientation, cornerRadius=cornerRadius)
	O.bodies.append([b, a])
	O.dt = 1e-9
	O.step()
	assert ContactTypes().of(contact(a, b)) == name
	assert ContactTypes().count() == {name: 1}


def testTypesAreAllOfThem():
	assert set(poses3d) == set(types3d)
	assert set(poses2d) == set(types2d)


def testToleranceDecidesOverNarrowStrips():
	"""Two cubes that share a strip of 60 mm: the point is 30 mm from the edges at both ends of it."""
	pair = touch((*below, Quaternion.Identity), Quaternion.Identity, 1.0, sideways=0.94)
	assert abs(pair.geom.contactPoint[0] - 0.47) < 1e-6
	assert ContactTypes(0.029).of(pair) == 'face-face'
	assert ContactTypes(0.031).of(pair) == 'edge-edge'
	assert ContactTypes().of(pair) == 'edge-edge'  # the corner radius is 50 mm


def testTiltedEdgeBecomesAFaceWhenTheOverlapSpreads():
	"""A cube on its edge, tilted by θ from lying flat: the overlap is a wedge of length overlap/sin θ, the point a third along."""
	found = []
	for tilt in (0.5, 0.1, 0.05, 0.003):
		O.reset()
		height = 0.5 * np.cos(tilt) + 0.5 * np.sin(tilt)
		found.append(ContactTypes().of(touch(floor, Quaternion((1, 0, 0), tilt), height)))
	assert found == ['edge-face', 'edge-face', 'edge-face', 'face-face']


def testRedundantPlaneIsNoFace():
	"""A plane that touches the cube's upper edge alone must not turn the edge into a vertex, nor a face into an edge."""
	joint()
	loop()
	normals = [s * Vector3.Unit(k) for k in range(3) for s in (1, -1)] + [Vector3(1, 0, 1)]
	a = polytope.fromHalfSpaces(normals, [0.5] * 6 + [1.0], fixed=True, cornerRadius=cornerRadius)
	assert len(a.shape.normals) == 7
	O.bodies.append(a)
	names = ContactTypes()
	assert names.feature(a, (0, 0, 0.499)) == 'face'
	assert names.feature(a, (0.499, 0, 0.499)) == 'edge'
	assert names.feature(a, (0.499, 0.499, 0.499)) == 'vertex'


poses2d = {'edge-edge': (0, 0, 1.0), 'vertex-edge': (0, pi / 4, 0.5 + sqrt(0.5)), 'vertex-vertex': (pi / 4, pi / 4, 2 * sqrt(0.5))}
square = np.array([(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)])


@pytest.mark.parametrize('name', poses2d)
def testExactPose2d(name):
	lower, upper, height = poses2d[name]
	joint()
	loop()

	def turned(angle):
		return square @ np.array([(np.cos(angle), np.sin(angle)), (-np.sin(angle), np.cos(angle))])

	a = polytope.polygon(turned(lower), fixed=True, cornerRadius=cornerRadius)
	b = polytope.polygon(turned(upper) + (0, height - overlap), cornerRadius=cornerRadius)
	O.bodies.append([a, b])
	O.dt = 1e-9
	O.step()
	assert ContactTypes().of(contact(a, b)) == name


def testPolygonsRedundantLineIsNoEdge():
	"""A line through a square's corner."""
	joint()
	a = polytope.polygon(square, cornerRadius=cornerRadius)
	shape = type(a.shape)(
		normals=list(a.shape.normals) + [Vector3(1, 1, 0)], offsets=list(a.shape.offsets) + [1.0], dimension=2, cornerRadius=cornerRadius
	)
	a.shape = shape
	assert len(shape.normals) == 5
	assert ContactTypes().feature(a, (0, 0.499, 0)) == 'edge'


def testRefusals():
	for tolerance in (-1, float('nan'), float('inf')):
		with pytest.raises(ValueError, match='tolerance'):
			ContactTypes(tolerance)
	from yade import utils

	sphere = utils.sphere((0, 0, 0), 1)
	with pytest.raises(ValueError, match='Polytope'):
		ContactTypes().feature(sphere, (0, 0, 0))
