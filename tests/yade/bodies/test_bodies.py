# SPDX-License-Identifier: GPL-2.0-or-later
"""The builders of yade.polytope: textbook answers at every size, and refusals that name the argument."""

import math

import numpy
import pytest
from yade import Body, FrictMat, Ig2_Polytope_Polytope_PolytopeGeom, O, Polytope, Quaternion, RockJointMat, Vector3, polytope

SIZES = [1e-9, 1e-3, 1, 1e3]

# faces: vertices, volume and moment of inertia per unit density for edge length 1 (Weisstein, MathWorld: Platonic solids),
# circumradius for edge length 1
phi = (1 + math.sqrt(5)) / 2
REGULAR = {
	4: (4, math.sqrt(2) / 12, math.sqrt(2) / 240, math.sqrt(6) / 4),
	6: (8, 1, 1 / 6, math.sqrt(3) / 2),
	8: (6, math.sqrt(2) / 3, math.sqrt(2) / 30, math.sqrt(2) / 2),
	12: (20, (15 + 7 * math.sqrt(5)) / 4, (28 + 39 * phi) / 150 * (15 + 7 * math.sqrt(5)) / 4, math.sqrt(3) * phi / 2),
	20: (12, 5 * (3 + math.sqrt(5)) / 12, phi**2 / 10 * 5 * (3 + math.sqrt(5)) / 12, math.sqrt(phi * math.sqrt(5)) / 2),
}


@pytest.fixture(autouse=True)
def scene():
	O.reset()
	O.materials.append(FrictMat(density=2600, label='rock'))


@pytest.mark.parametrize('size', SIZES)
@pytest.mark.parametrize('faces', REGULAR)
def testRegularSolids(faces, size):
	vertices, volume, moment, circumradius = REGULAR[faces]
	b = polytope.regular(faces, circumradius * size, center=(1, 2, 3))
	assert len(b.shape.vertices) == vertices and len(b.shape.faces) == faces == len(b.shape.normals)
	assert b.shape.volume == pytest.approx(volume * size**3, rel=1e-12)
	assert max(abs(i / (moment * size**5) - 1) for i in b.shape.inertia) < 1e-12
	assert b.state.mass == pytest.approx(2600 * volume * size**3, rel=1e-12)
	assert (b.state.pos - Vector3(1, 2, 3)).norm() < 1e-14 * max(size, 1) * 10
	assert max(abs(v.norm() / (circumradius * size) - 1) for v in b.shape.vertices) < 1e-12
	assert not b.aspherical


def testCuboidKeepsItsAxes():
	turned = Quaternion((0, 0, 1), 0.3)
	b = polytope.cuboid((1, 0, 0), (3, 2, 1), orientation=turned)
	assert b.state.ori == turned and b.state.pos == Vector3(1, 0, 0)
	assert b.shape.volume == pytest.approx(48)
	assert list(b.shape.inertia) == pytest.approx([48 / 3 * 5, 48 / 3 * 10, 48 / 3 * 13])
	assert b.aspherical


def testHalfSpacesGoToTheirCentroidAndAxes():
	# the block of 6 × 4 × 2 at (10, 20, 30), turned by 0.4 about z, as world planes of any length
	turn = Quaternion((0, 0, 1), 0.4)
	centre = Vector3(10, 20, 30)
	normals, offsets = [], []
	for k, half in enumerate((3, 2, 1)):
		for sign in (-1, 1):
			n = turn * (sign * Vector3.Unit(k))
			normals.append(7 * n)
			offsets.append(7 * (n.dot(centre) + half))
	b = polytope.fromHalfSpaces(normals, offsets)
	assert (b.state.pos - centre).norm() < 1e-13
	assert list(b.shape.inertia) == pytest.approx(sorted([48 / 3 * 5, 48 / 3 * 10, 48 / 3 * 13]))
	corners = sorted(tuple(round(x, 9) for x in b.state.pos + b.state.ori * v) for v in b.shape.vertices)
	expected = sorted(
		tuple(round(x, 9) for x in centre + turn * Vector3(3 * i, 2 * j, k)) for i in (-1, 1) for j in (-1, 1) for k in (-1, 1)
	)
	assert corners == expected


def testRedundantPlanesAreKeptOrDroppedAsAsked():
	cube = polytope.cuboid((0, 0, 0), (1, 1, 1)).shape
	normals = list(cube.normals) + [Vector3(1, 1, 0), Vector3(1, 0, 0)]
	offsets = list(cube.offsets) + [5, 1]
	assert len(polytope.fromHalfSpaces(normals, offsets).shape.normals) == 7  # the repeated face goes in any case
	assert len(polytope.fromHalfSpaces(normals, offsets, keepRedundant=False).shape.normals) == 6


def testShapeDropsPlanesThatRepeatAnother():
	cube = polytope.cuboid((0, 0, 0), (1, 1, 1)).shape
	shape = Polytope(normals=list(cube.normals) + [Vector3(2, 0, 0)] * 3 + [Vector3(1, 1, 0)], offsets=list(cube.offsets) + [2] * 3 + [5])
	assert len(shape.normals) == len(shape.offsets) == 7  # the far plane is redundant and stays
	assert shape.normals[:6] == cube.normals and shape.offsets[:6] == cube.offsets
	shape.cornerRadius = 0.1
	assert len(shape.normals) == 7


def testVerticesGiveTheirHull():
	points = [(i, j, k) for i in (0, 2) for j in (0, 1) for k in (0, 1)] + [(1, 0.5, 0.5), (1, 0.5, 1)]
	b = polytope.fromVertices(points)
	assert len(b.shape.normals) == 6 and len(b.shape.vertices) == 8
	assert b.shape.volume == pytest.approx(2)
	assert b.state.pos == Vector3(1, 0.5, 0.5)


HULL = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (1.5, 0.25, 2)]


@pytest.mark.parametrize(
	'points',
	[
		[list(p) for p in HULL],
		tuple(HULL),
		(p for p in HULL),
		(iter(p) for p in HULL),
		[Vector3(*p) for p in HULL],
		[[str(x) for x in p] for p in HULL],
		[numpy.float32(p) for p in HULL],
		numpy.array(HULL),
		numpy.array(HULL, dtype=object),
	],
	ids=['lists', 'tuples', 'generator', 'iterators', 'Vector3', 'text', 'arrays', 'array', 'array of objects'],
)
def testPointsOfAnySequence(points):
	"""Whatever gives rows of three numbers, with the numbers as they are."""
	found, expected = polytope.fromVertices(points), polytope.fromVertices(HULL)
	assert found.shape.normals == expected.shape.normals and found.shape.offsets == expected.shape.offsets
	assert found.state.pos == expected.state.pos and found.state.ori == expected.state.ori


@pytest.mark.parametrize(
	'points, names',
	[
		(None, ['points', '3-vectors']),
		(1.5, ['points', '3-vectors']),
		('abcd', ['points', '3-vectors']),
		([1, 2, 3, 4], ['points', '3-vectors']),
		(HULL[:4] + [(0, 0, None)], ['points', '3-vectors']),
		(HULL[:4] + [(0, 0, 'x')], ['points', '3-vectors']),
		(HULL[:4] + [(0, 0, 1j)], ['points', '3-vectors']),
		(HULL[:4] + [None], ['points', '3-vectors']),
		(HULL[:4] + [(0, 0)], ['points', '3 components']),
		(HULL[:4] + [()], ['points', '3 components']),
		(HULL[:4] + [(0, 0, 1, 2)], ['points', '3 components']),
		(numpy.array(HULL)[:, :2], ['points', '3 components']),
		(numpy.array(1.5), ['points', '3-vectors']),
		([], ['points', '4']),
	],
)
def testWhatIsNoSequenceOfPointsIsRefused(points, names):
	with pytest.raises(ValueError) as refusal:
		polytope.fromVertices(points)
	assert all(name in str(refusal.value) for name in names)
	if isinstance(points, list):
		with pytest.raises(ValueError, match='points2d'):
			polytope.polygon(points)


def testOtherExceptionsOfASequenceArePassedOn():

	def rows():
		yield from HULL[:2]
		raise RuntimeError('lost')

	with pytest.raises(RuntimeError, match='lost'):
		polytope.fromVertices(rows())
	if polytope.buildInfo()['precision'] == 'double':  # wider numbers hold it
		with pytest.raises(OverflowError):
			polytope.fromVertices(HULL[:3] + [(10**400, 0, 0)])


def testPolygonStaysInItsPlane():
	b = polytope.polygon([(0, 0), (2, 0), (2, 1), (0, 1)], thickness=0.5)
	assert b.shape.dimension == 2 and b.state.blockedDOFs == 'zXY'
	assert b.shape.volume == pytest.approx(1) and b.state.mass == pytest.approx(2600)
	assert b.state.pos == Vector3(1, 0.5, 0)
	assert b.shape.inertia[2] == pytest.approx(5 / 12)
	assert polytope.polygon([(0, 0), (1, 0), (0, 1)], fixed=True).state.blockedDOFs == 'xyzXYZ'


@pytest.mark.parametrize('make', [polytope.polygon, lambda outline, **body: polytope.prism(outline, 2, **body)])
@pytest.mark.parametrize('size', [1e-9, 1, 1e4])
def testConcaveOutlineIsRefused(make, size):
	"""An L, wherever and however it is turned; but not points on a straight side, to six digits, a first corner repeated, or corners in any order."""
	corners = [(0, 0), (3, 0), (3, 1), (1, 1), (1, 2), (0, 2)]
	for outline in (corners, corners[::-1]):
		with pytest.raises(
			ValueError, match=r'^points2d: the outline is not convex, point \d \(.*\) lies inside the hull of the others; leave it out'
		):
			make([(size * (x + 7), size * y) for x, y in outline], center=(0, 0, 0), orientation=Quaternion((0, 0, 1), 1))
	pentagon = [(math.cos(k), math.sin(k)) for k in (0, 1, 2, 4, 5, 0)] + [((math.cos(1) + 1) / 2 - 1e-7, math.sin(1) / 2)]
	volume = make([(size * x, size * y) for x, y in pentagon[:5]]).shape.volume
	for outline in (pentagon, pentagon[::-1], sorted(pentagon)):
		assert make([(size * x, size * y) for x, y in outline]).shape.volume == pytest.approx(volume, rel=1e-9)
	assert make(point for point in corners[:3]).shape.volume > 0, 'an iterator'


def testMeshFile(tmp_path):
	import trimesh

	for name in ('box.stl', 'box.obj', 'box.ply', 'box.off'):
		path = str(tmp_path / name)
		trimesh.creation.box((2, 1, 1)).export(path)
		b = polytope.fromMesh(path, scale=1e-3)
		assert b.shape.volume == pytest.approx(2e-9, rel=1e-6) and len(b.shape.normals) == 6


def testBodyArguments():
	b = polytope.regular(
		6, 1, fixed=True, color=(1, 0, 0), mask=5, velocity=(1, 2, 3), angularVelocity=(0, 0, 4), material='rock', wire=True
	)
	assert b.state.blockedDOFs == 'xyzXYZ' and b.mask == 5 and b.shape.wire
	assert b.state.vel == Vector3(1, 2, 3) and b.state.angVel == Vector3(0, 0, 4)
	assert b.shape.color == Vector3(1, 0, 0) and b.material.label == 'rock'
	assert b.shape.cornerRadius == pytest.approx(b.shape.inscribedRadius / 10)
	with pytest.raises(TypeError):
		polytope.regular(6, 1, colour=(1, 0, 0))


CUBE = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
nan, inf = math.nan, math.inf


@pytest.mark.parametrize(
	'build, names',
	[
		(lambda: polytope.fromHalfSpaces(CUBE[:5], [1] * 5), ['normals', 'unbounded']),
		(lambda: polytope.fromHalfSpaces(CUBE, [1, -2, 1, 1, 1, 1]), ['offsets', 'common point']),
		(lambda: polytope.fromHalfSpaces(CUBE, [1, -1, 1, 1, 1, 1]), ['offsets', 'flat']),
		(lambda: polytope.fromHalfSpaces(CUBE, [1, 1, 1, 1, 1, nan]), ['offsets']),
		(lambda: polytope.fromHalfSpaces(CUBE, [1, 1, 1, 1, 1, inf]), ['offsets']),
		(lambda: polytope.fromHalfSpaces(CUBE[:5] + [(0, nan, 1)], [1] * 6), ['normals']),
		(lambda: polytope.fromHalfSpaces(CUBE[:5] + [(0, 0, 0)], [1] * 6), ['normals', 'zero']),
		(lambda: polytope.fromHalfSpaces(CUBE[:3], [1] * 3), ['normals', '4']),
		(lambda: polytope.fromHalfSpaces(CUBE, [1] * 5), ['offsets', 'normals']),
		(lambda: polytope.fromHalfSpaces([(1, 0)] * 6, [1] * 6), ['normals']),
		(lambda: polytope.fromHalfSpaces('abc', [1] * 3), ['normals']),
		(lambda: polytope.fromVertices([(0, 0, 0), (1, 0, 0), (0, 1, 0)]), ['points']),
		(lambda: polytope.fromVertices([(0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 1, 0)]), ['points']),
		(lambda: polytope.fromVertices([(0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 1, nan)]), ['points']),
		(lambda: polytope.polygon([(0, 0), (1, 0)]), ['points2d']),
		(lambda: polytope.polygon([(0, 0), (1, 1), (2, 2)]), ['points2d']),
		(lambda: polytope.polygon([(0, 0), (1, 0), (0, 1)], thickness=0), ['thickness']),
		(lambda: polytope.regular(5, 1), ['faces']),
		(lambda: polytope.regular(6.5, 1), ['faces']),
		(lambda: polytope.regular(6, 0), ['circumradius']),
		(lambda: polytope.regular(6, 'a'), ['circumradius']),
		(lambda: polytope.regular(6, 1, cornerRadius='a'), ['cornerRadius']),
		(lambda: polytope.cuboid((0, 0, 0), 1), ['extents']),
		(lambda: polytope.regular(6, 1, center=(nan, 0, 0)), ['center']),
		(lambda: polytope.regular(6, 1, cornerRadius=1), ['cornerRadius', 'inscribed']),
		(lambda: polytope.regular(6, 1, cornerRadius=0.6), ['cornerRadius', 'inscribed', '0.57735']),
		(lambda: polytope.regular(6, 1, cornerRadius=-0.1), ['cornerRadius']),
		(lambda: polytope.regular(6, 1, cornerRadius=nan), ['cornerRadius']),
		(lambda: polytope.regular(6, 1, velocity=(0, 0, nan)), ['velocity']),
		(lambda: polytope.regular(6, 1, velocity=(5, 6)), ['velocity', 'three']),
		(lambda: polytope.regular(6, 1, angularVelocity=(5, 6, 7, 8)), ['angularVelocity', 'three']),
		(lambda: polytope.regular(6, 1, center=(1, 2)), ['center', 'three']),
		(lambda: polytope.regular(6, 1, fixed='no'), ['fixed', 'True or False']),
		(lambda: polytope.regular(6, 1, wire='x'), ['wire']),
		(lambda: polytope.regular(6, 1, color='red'), ['color']),
		(lambda: polytope.regular(6, 1, mask='a'), ['mask']),
		(lambda: polytope.fromHalfSpaces(CUBE, [1] * 6, keepRedundant='no'), ['keepRedundant']),
		(lambda: polytope.polygon([(0, 0), (1, 0), (0, 1)], thickness='a'), ['thickness']),
		(lambda: polytope.fromMesh(None), ['path']),
		(lambda: polytope.regular(6, 1, fixed=numpy.array([True, False])), ['fixed']),
		(lambda: polytope.regular(6, 1, mask=2**40), ['mask']),
		(lambda: polytope.polygon([(0, 0), (1, 0), (0, 1)], velocity=(0, 0, 2)), ['velocity', 'plane']),
		(lambda: polytope.polygon([(0, 0), (1, 0), (0, 1)], angularVelocity=(1, 0, 0)), ['angularVelocity', 'about z']),
		(lambda: polytope.stableTimeStep(default=inf), ['default']),
		(lambda: polytope.stableTimeStep(default=True), ['default']),
		(lambda: polytope.cuboid((0, 0, 0), (1, 0, 1)), ['extents']),
		(lambda: polytope.cuboid((0, 0, 0), (1, 1, 1), orientation=(0, 0, 0, 1)), ['orientation']),
		(lambda: Polytope(normals=[Vector3(*n) for n in CUBE], offsets=[2, 1, 1, 1, 1, 1]), ['offsets', 'fromHalfSpaces']),
	],
)
def testWrongInputIsRefusedByName(build, names):
	with pytest.raises(ValueError) as refusal:
		build()
	for name in names:
		assert name in str(refusal.value)
	assert len(O.bodies) == 0


@pytest.mark.parametrize('far', [1e6, 1e9, 1e10])
def testBodiesFarFromTheOriginHaveTheirCentroidThere(far):
	"""The first centroid is rounded by the distance, so that it is computed again from there."""
	for k in range(40):
		normals = [
			(math.cos(a), math.sin(a), c) for a, c in zip(numpy.linspace(0, 6, 7) + k, (1, -1, 0.3, -0.4, 0.2, -0.1, 0.5), strict=True)
		]
		offsets = [numpy.dot(n, (far, far, far)) + 1 for n in normals]
		body = polytope.fromHalfSpaces(normals, offsets)
		assert abs(body.state.pos[0] - far) < 10


def testMissingAndUnreadableMeshes(tmp_path):
	with pytest.raises(FileNotFoundError, match='path'):
		polytope.fromMesh(str(tmp_path / 'none.stl'))
	broken = tmp_path / 'broken.stl'
	broken.write_text('not a mesh')
	with pytest.raises(ValueError, match='path'):
		polytope.fromMesh(str(broken))
	with pytest.raises(ValueError, match='path'):
		polytope.fromMesh(str(tmp_path))


def testRefusedCornerRadiusLeavesTheShape():
	shape = polytope.regular(6, 1).shape
	before = shape.cornerRadius
	with pytest.raises(ValueError, match='cornerRadius'):
		shape.cornerRadius = 10
	assert shape.cornerRadius == before
	shape.cornerRadius = before / 2
	assert shape.cornerRadius == before / 2


def testContactOfTwoCubes():
	a = polytope.cuboid((0, 0, 0), (0.5, 0.5, 0.5))
	b = polytope.cuboid((0.25, 0.125, 0.99), (0.5, 0.5, 0.5))
	c = polytope.contact(a, b)
	assert c.inContact and c.status == 'contact'
	assert c.infeasibility == pytest.approx(-0.005, rel=1e-12)
	# each cube ends on two sides of the face that they share: the force leans, and acts aside, by the depth over the length
	assert (c.point - Vector3(0.125, 0.0625, 0.495)).norm() < 0.01
	assert (c.normal - Vector3(0, 0, 1)).norm() < 0.01
	assert c.depth == pytest.approx(0.01, rel=0.01 * (1 / 0.75 + 1 / 0.875)) and c.area == pytest.approx(0.75 * 0.875, rel=0.01)
	paper = polytope.contact(a, b, contactModel='boon2012')
	assert (paper.normal - Vector3(0, 0, 1)).norm() < 1e-15 and (paper.point - Vector3(0.125, 0.0625, 0.495)).norm() < 1e-12
	assert paper.depth == pytest.approx(0.01, rel=1e-12) and paper.area == pytest.approx(0.75 * 0.875, rel=1e-12)
	apart = polytope.contact(a, polytope.cuboid((0, 0, 1.5), (0.5, 0.5, 0.5)))
	assert (
		not apart.inContact
		and apart.status == 'separated'
		and apart.depth == pytest.approx(-0.5)
		and apart.infeasibility == pytest.approx(0.25)
	)


@pytest.mark.parametrize('value', [1e-300, 0.0, -1e-10, 0.5, 1.0, nan])
def testNewtonToleranceHasARange(value):
	"""Below rounding nothing can be reached, and above a tenth the point is anywhere in the overlap."""
	functor = Ig2_Polytope_Polytope_PolytopeGeom(newtonTolerance=1e-6)
	with pytest.raises(ValueError, match='newtonTolerance: must lie between .* and 0.1'):
		functor.newtonTolerance = value
	assert float(functor.newtonTolerance) == pytest.approx(1e-6, rel=0)
	cube = polytope.cuboid((0, 0, 0), (0.5, 0.5, 0.5))
	with pytest.raises(ValueError, match='newtonTolerance'):
		polytope.contact(cube, polytope.cuboid((0.1, 0.2, 0.99), (0.5, 0.5, 0.5)), newtonTolerance=value)


@pytest.mark.parametrize('value', [3e-16, 0.1])
def testEndsOfNewtonTolerancesRange(value):
	one, two = polytope.cuboid((0, 0, 0), (0.5, 0.5, 0.5)), polytope.cuboid((0.1, 0.2, 0.99), (0.5, 0.5, 0.5))
	c = polytope.contact(one, two, newtonTolerance=value, contactModel='boon2012')
	assert c.inContact and c.depth == pytest.approx(0.01, rel=1e-12)


def testContactRefusesWhatIsNoPolytope():
	cube = polytope.cuboid((0, 0, 0), (0.5, 0.5, 0.5))
	with pytest.raises(ValueError, match='b2'):
		polytope.contact(cube, Body())
	with pytest.raises(ValueError, match='b2'):
		polytope.contact(cube, polytope.polygon([(0, 0), (1, 0), (0, 1)]))
	astray = polytope.cuboid((0, 0, 0), (0.5, 0.5, 0.5))
	astray.state.pos = (nan, 0, 0)
	with pytest.raises(ValueError, match='b2.*finite'):
		polytope.contact(cube, astray)
	if polytope.buildInfo()['precision'] == 'double':  # wider numbers reach farther than Python's
		astray.state.pos = (1e300, 0, 0)  # a number, but its square is none
		with pytest.raises(ValueError, match='b2.*too large to be squared'):
			polytope.contact(cube, astray)
	with pytest.raises(ValueError, match='contactPoint'):
		polytope.contact(cube, cube, contactPoint='middle')
	for wrong, name in ((3, 'int'), ('floor', 'str'), (cube.shape, 'Polytope')):
		with pytest.raises(ValueError, match=f'b2: must be a body with a Polytope shape.* not of type {name}$'):
			polytope.contact(cube, wrong)
	with pytest.raises(ValueError, match='b1: must be a body'):
		polytope.contact(None, cube)


@pytest.mark.parametrize('material', [None, 1.5, lambda: None], ids=['none', 'number', 'function'])
def testWhatMakesNoMaterialIsRefused(material):
	with pytest.raises(TypeError, match='material: must be a Material'):
		polytope.cuboid((0, 0, 0), (1, 1, 1), material=material)


def testAMaterialThatIsNotListedIsNamedWithTheRemedy():
	O.materials.append(RockJointMat())
	with pytest.raises(ValueError) as refusal:
		polytope.cuboid((0, 0, 0), (1, 1, 1), material='marble')
	assert str(refusal.value).startswith(
		"material: no material in O.materials has the label 'marble', there are ['rock']; O.materials.append("
	)
	for index in (7, -3):
		with pytest.raises(ValueError, match=rf'^material: O.materials has no index {index}, it has 2 materials; O.materials.append'):
			polytope.cuboid((0, 0, 0), (1, 1, 1), material=index)
	assert polytope.cuboid((0, 0, 0), (1, 1, 1), material=-2).material.label == 'rock'
	O.reset()
	with pytest.raises(ValueError, match='none has a label'):
		polytope.regular(8, 1, material='rock')


@pytest.mark.parametrize('value', [-5, 0, float('nan'), float('inf')])
@pytest.mark.parametrize('name', ['density', 'young'])
def testMaterialsOfNoBodyAreRefused(name, value):
	"""YADE takes such numbers without a word: masses and stiffnesses below zero."""
	for kind in (RockJointMat, FrictMat):
		material = kind()
		setattr(material, name, value)
		index = O.materials.append(material)
		for how in (material, index, lambda made=material: made):
			with pytest.raises(ValueError, match=f'^material: its {name} must be positive and finite, got '):
				polytope.cuboid((0, 0, 0), (1, 1, 1), material=how)
	with pytest.raises(ValueError, match=f'^material: its {name}'):
		polytope.regular(8, 1)  # the last one added
	assert len(O.bodies) == 0


# ------------------------------------------------------------------------------------------------ arguments of all builders

tetrahedron = [(0, 0, 0), (3, 0, 0), (0, 2, 0), (0, 0, 1)]
outline = [(0, 0), (2, 0), (0, 1)]


def builders(tmp_path):
	"""Name → function of further arguments."""
	trimesh = pytest.importorskip('trimesh')
	path = tmp_path / 'a.stl'
	trimesh.convex.convex_hull(numpy.array(tetrahedron, float)).export(path)
	planes = polytope.fromVertices(tetrahedron)
	turn, place = planes.state.ori, planes.state.pos
	normals = [turn * normal for normal in planes.shape.normals]
	offsets = [offset + normal.dot(place) for normal, offset in zip(normals, planes.shape.offsets, strict=True)]
	return {
		'fromHalfSpaces': lambda **body: polytope.fromHalfSpaces(normals, offsets, **body),
		'fromVertices': lambda **body: polytope.fromVertices(tetrahedron, **body),
		'fromMesh': lambda **body: polytope.fromMesh(path, **body),
		'regular': lambda **body: polytope.regular(8, 1, **body),
		'cuboid': lambda **body: polytope.cuboid(**{'center': (0, 0, 0), 'extents': (1, 2, 3), **body}),
		'polygon': lambda **body: polytope.polygon(outline, **body),
	}


@pytest.mark.parametrize('name', ['fromHalfSpaces', 'fromVertices', 'fromMesh', 'regular', 'cuboid', 'polygon'])
def testCenterAndOrientationOfEveryBuilder(name, tmp_path):
	"""The centroid goes to the center, the body is turned about it, and displacements count from there."""
	build = builders(tmp_path)[name]
	plain = build()
	turn = Quaternion((0, 0, 1), 0.3) if name == 'polygon' else Quaternion((1, 2, 3), 0.7)
	placed = build(center=(4, 5, 0), orientation=turn)
	assert list(placed.state.pos) == [4, 5, 0]
	for was, now in zip(plain.shape.vertices, placed.shape.vertices, strict=True):
		assert (turn * (plain.state.ori * was) - placed.state.ori * now).norm() < 1e-14
	for body in (plain, placed, build(center=(1, 1, 0)), build(orientation=turn)):
		assert body.state.refPos == body.state.pos and body.state.refOri == body.state.ori
	assert build(orientation=turn).state.pos == plain.state.pos and build(center=(1, 1, 0)).state.ori == plain.state.ori


@pytest.mark.parametrize('name', ['fromHalfSpaces', 'fromVertices', 'fromMesh', 'regular', 'cuboid', 'polygon'])
def testUnknownArgumentNamesTheFunctionAndWhatItTakes(name, tmp_path):
	build = builders(tmp_path)[name]
	with pytest.raises(
		TypeError, match=rf"^{name}: there is no argument 'colour'; it takes .*, and as all bodies .*\bcolor\b.*\bcenter\b|orientation"
	) as caught:
		build(colour=(1, 0, 0))
	assert 'material' in str(caught.value) and '_body' not in str(caught.value)
	for taken in ('center', 'orientation', 'fixed', 'velocity'):
		assert str(caught.value).count(taken) >= 1


def testPolygonsArePlacedInTheirPlane():
	for wrong in ({'center': (0, 0, 1)}, {'orientation': Quaternion((1, 0, 0), 0.1)}):
		with pytest.raises(ValueError, match=next(iter(wrong))):
			polytope.polygon(outline, **wrong)


def testYadesRandomColour():
	colours = {tuple(polytope.regular(4, 1, color=(-1, -1, -1)).shape.color) for _ in range(5)}
	assert len(colours) == 5 and all(0 <= x <= 1 for colour in colours for x in colour)
	assert tuple(polytope.regular(4, 1, color=(0, 0, 1)).shape.color) == (0, 0, 1)


def testMeshThatIsNotItsHullIsWarnedOf(tmp_path, recwarn):
	trimesh = pytest.importorskip('trimesh')
	closed = trimesh.creation.box((2, 1, 1))
	closed.export(tmp_path / 'box.stl')
	trimesh.creation.icosphere(3).export(tmp_path / 'ball.stl')
	for name in ('box.stl', 'ball.stl'):
		polytope.fromMesh(tmp_path / name)
	assert not recwarn.list
	outline = [(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)]  # an L of three squares, whose hull has half a square more
	points = [(x, y, z) for z in (0, 1) for x, y in outline]
	caps = [(0, 1, 3), (1, 2, 3), (0, 3, 5), (3, 4, 5)]
	sides = [triangle for k in range(6) for triangle in ((k, (k + 1) % 6, 6 + k), ((k + 1) % 6, 6 + (k + 1) % 6, 6 + k))]
	mesh = trimesh.Trimesh(points, [tuple(reversed(cap)) for cap in caps] + [tuple(6 + k for k in cap) for cap in caps] + sides)
	assert mesh.is_watertight and mesh.volume == pytest.approx(3)
	mesh.export(tmp_path / 'angle.stl')
	with pytest.warns(UserWarning, match='not convex: it has 3 m³, its hull, which the body is, 3.5 m³'):
		polytope.fromMesh(tmp_path / 'angle.stl')
	with pytest.warns(UserWarning, match='0.003 m³'):
		polytope.fromMesh(tmp_path / 'angle.stl', scale=0.1)
	trimesh.Trimesh(closed.vertices, closed.faces[:-1]).export(tmp_path / 'open.stl')
	with pytest.warns(UserWarning, match='is not closed') as told:
		polytope.fromMesh(tmp_path / 'open.stl')
	assert told[0].filename == __file__, 'the line of the script'
