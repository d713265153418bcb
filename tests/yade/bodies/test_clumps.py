# SPDX-License-Identifier: GPL-2.0-or-later
"""Clumps of convex parts, touching and overlapping: mass, centre, inertia of the union, no contact of their own; meshes as such parts."""

import sys
import types
import warnings

import numpy as np
import pytest
from PIL import Image
from scenes import gravity, joint, loop, stepper
from yade import O, Quaternion, Vector3, polytope
from yade.polytope.bodies.meshes import convexParts

density = 2000


@pytest.fixture(autouse=True)
def material():
	joint(density=density)
	convexParts.cutMeshes.clear()


def box(lower, upper, **body):
	lower, upper = np.array(lower, float), np.array(upper, float)
	return polytope.cuboid(tuple((lower + upper) / 2), tuple((upper - lower) / 2), **body)


def rectangle(lower, upper, **body):
	(a, b), (c, d) = lower, upper
	return polytope.polygon([(a, b), (c, b), (c, d), (a, d)], **body)


def sums(boxes):
	"""(mass, centre, tensor of inertia about it) of disjoint boxes (sign, lower, upper), by their closed forms."""
	mass, first, second = 0, np.zeros(3), np.zeros((3, 3))
	for sign, lower, upper in boxes:
		lower, upper = np.array(lower, float), np.array(upper, float)
		m, c, edges = sign * density * np.prod(upper - lower), (lower + upper) / 2, upper - lower
		mass, first = mass + m, first + m * c
		second += m * (np.outer(c, c) + np.diag(edges**2) / 12)
	centre = first / mass
	spread = second - mass * np.outer(centre, centre)
	return mass, centre, np.trace(spread) * np.eye(3) - spread


def properties(number):
	"""Mass and moments of a clump in the scene."""
	state = O.bodies[number].state
	turn = np.array(state.ori.toRotationMatrix(), float).reshape(3, 3)
	return float(state.mass), np.array(state.pos, float), turn @ np.diag([float(x) for x in state.inertia]) @ turn.T


def assertEqual(found, expected, scale):
	assert found[0] == pytest.approx(expected[0], rel=1e-12)
	assert np.abs(found[1] - expected[1]).max() < 1e-12 * scale
	assert np.abs(found[2] - expected[2]).max() < 1e-11 * expected[0] * scale**2


shapes = {
	'L of two boxes that share a face': ([((0, 0, 0), (3, 1, 1)), ((0, 1, 0), (1, 2, 1))], []),
	'L of two boxes that overlap': ([((0, 0, 0), (3, 1, 1)), ((0, 0, 0), (1, 2, 1))], [((0, 0, 0), (1, 1, 1))]),
	'a box in another': ([((0, 0, 0), (3, 3, 3)), ((1, 1, 1), (2, 2, 2))], [((1, 1, 1), (2, 2, 2))]),
	'three equal ones': ([((0, 0, 0), (1, 2, 3))] * 3, [((0, 0, 0), (1, 2, 3))] * 2),
	'apart': ([((0, 0, 0), (1, 1, 1)), ((2, 0, 0), (3, 1, 1))], []),
}


@pytest.mark.filterwarnings('ignore:parts:UserWarning')
@pytest.mark.parametrize('name', shapes)
def testPropertiesAreThoseOfTheUnion(name):
	boxes, twice = shapes[name]
	number, members = polytope.clump([box(*one) for one in boxes])
	expected = sums([(1, *one) for one in boxes] + [(-1, *one) for one in twice])
	assertEqual(properties(number), expected, 3)
	for k, (lower, upper) in zip(members, boxes, strict=True):
		middle = (np.array(lower) + np.array(upper)) / 2
		assert np.abs(np.array(O.bodies[k].state.pos, float) - middle).max() < 1e-12, 'parts stay where they are'


@pytest.mark.filterwarnings('ignore:parts:UserWarning')
@pytest.mark.parametrize('thick', [1, 0.1])
@pytest.mark.parametrize('name', shapes)
def testPropertiesOfPolygonsAreThoseOfTheirPrisms(name, thick):
	boxes, twice = ([(low[:2], high[:2]) for low, high in part] for part in shapes[name])
	number, _ = polytope.clump([rectangle(*one, thickness=thick) for one in boxes])
	signs = [(1, one) for one in boxes] + [(-1, one) for one in twice]
	expected = sums([(sign, (*low, -thick / 2), (*high, thick / 2)) for sign, (low, high) in signs])
	assertEqual(properties(number), expected, 3)
	assert O.bodies[number].state.blockedDOFs == 'zXY'


def testAClumpOfPolygonsRestsIsStressedAndIsCut(tmp_path):
	"""An L of two polygons that overlap: its weight on the floor, its stress with the union's area, its picture; a notch cut out of its
	foot and of the floor."""
	foot = rectangle((-5, -1), (5, 0), fixed=True, color=(0, 1, 0))
	floor = O.bodies.append(foot)
	number, members = polytope.clump([rectangle((0, 0), (3, 1), color=(1, 0, 0)), rectangle((0, 0), (1, 2), color=(1, 0, 0))])
	O.engines = polytope.engines(gravity=(0, -gravity, 0))
	polytope.settle()
	weight = 4 * density * gravity
	assert O.forces.f(floor)[1] == pytest.approx(-weight, rel=1e-4)
	assert all(O.bodies[k].state.pos[2] == 0 for k in members)
	# the mean of σ_yy: −(W/V) ȳ, as supports are at the bottom and weight at the height ȳ of the centroid
	stress = polytope.bodyStress([number])[number]
	assert stress[1, 1] == pytest.approx(-weight / 4 * 0.75, rel=1e-3) and abs(stress[0, 0]) < 1e-3 * weight
	polytope.picture(str(tmp_path / 'l.png'), size=(200, 150))
	with Image.open(tmp_path / 'l.png') as picture:
		red, green, blue = np.moveaxis(np.array(picture.convert('RGB'), int), 2, 0)
	assert ((red > 100) & (green < red / 3) & (blue < red / 3)).sum() > 500
	normals, offsets = [(1, 0), (-1, 0), (0, 1), (0, -1)], [0.7, -0.3, 0.7, 0.5]
	sunk = 0.75 - float(O.bodies[number].state.pos[1])
	gone = polytope.excavate(normals=normals, offsets=offsets)
	(left,) = gone[number]
	assert O.bodies[left].isClump and O.bodies[left].state.mass == pytest.approx(density * (4 - 0.4 * (0.7 + sunk)), rel=1e-9)
	polytope.settle()
	assert O.bodies[left].state.vel.norm() < 1e-4
	assert polytope.bodyStress([left])[left][1, 1] < 0


def expectPulledBar(number):
	"""A clump of a section of 1 m², bonded to a fixed body and to body 1, which is pulled: force over area."""
	loop(True, damping=0.5)
	assert polytope.bond() == 2
	stepper()
	O.forces.setPermF(1, (1e4, 0, 0))
	O.run(4000, wait=True)
	assert polytope.bodyStress([number])[number][0, 0] == pytest.approx(1e4, rel=1e-3)


def testABarOfPolygonsThatOverlapIsStressedByItsSection():
	"""Pulled at both ends by a bond."""
	left, right = (rectangle((x - 0.5, -0.5), (x + 0.5, 0.5), fixed=x < 0) for x in (-2, 2))
	O.bodies.append([left, right])
	number, _ = polytope.clump([rectangle((-1.5, -0.5), (0.5, 0.5)), rectangle((-0.5, -0.5), (1.5, 0.5))])
	expectPulledBar(number)


def testCrossOfThreeTurnedBars():
	"""Three bars through one point, their union by inclusion and exclusion, turned and far away; a script's own density."""
	half = np.array([2, 0.5, 0.5])
	turn, place = Quaternion((1, 2, 3), 0.8), Vector3(100, -20, 5)
	bars = [polytope.cuboid(place, tuple(np.roll(half, k)), orientation=turn) for k in range(3)]
	for bar in bars:
		bar.state.mass *= 3
		bar.state.inertia *= 3
	number, _ = polytope.clump(bars)
	cube = (-0.5, -0.5, -0.5), (0.5, 0.5, 0.5)
	mass, _, tensor = sums([(1, tuple(-np.roll(half, k)), tuple(np.roll(half, k))) for k in range(3)] + [(-1, *cube)] * 2)
	assertEqual(properties(number), (3 * mass, np.array(place, float), 3 * tensor), 100)  # the tensor is isotropic


def testManyPartsInOnePlace():
	"""A star of 24 bars through one point, and grains of many faces about it: in a second, and the same in any order."""

	def parts():
		bars = [polytope.cuboid((1, 2, 3), (2, 0.2, 0.1 + 0.01 * k), orientation=Quaternion((1, 2, k), 0.7 * k)) for k in range(24)]
		return bars + [polytope.randomGrain(1.2, vertices=30, seed=k, center=(1, 2, 3)) for k in range(6)]

	onward, _ = polytope.clump(parts())
	backward, _ = polytope.clump(parts()[::-1])
	assertEqual(properties(onward), properties(backward), 5)
	single = [float(part.state.mass) for part in parts()]
	assert max(single) < properties(onward)[0] < sum(single) / 2


def testPartsApartAreWarnedOf():
	"""Allowed, as in YADE; but by name: the part in the wrong place is seldom meant."""
	row = [box((k, 0, 0), (k + 1, 1, 1)) for k in range(3)]
	with pytest.warns(UserWarning, match=r'^parts: part 1 touches neither part 0 nor what is joined to it; the clump is rigid'):
		polytope.clump([row[0], box((5, 0, 0), (6, 1, 1)), row[1], row[2]])
	with warnings.catch_warnings():
		warnings.simplefilter('error')
		polytope.clump([box((0, 5, 0), (1, 6, 1)), box((2, 5, 0), (3, 6, 1)), box((1, 5, 0), (2, 6.2, 1))])  # joined by the last one


def testPartsDoNotTouchEachOtherAndTheClumpKeepsItsMotion():
	"""Thrown with a spin: parts go with it as one rigid body, its momenta stay."""
	number, members = polytope.clump([box((0, 0, 0), (3, 1, 1), velocity=(1, 0, 0), angularVelocity=(0, 0, 2)), box((0, 0, 0), (1, 2, 1))])
	loop(True)
	O.dt = 1e-4
	state = O.bodies[number].state
	start, velocity = Vector3(state.pos), Vector3(state.vel)
	assert (velocity - (Vector3(1, 0, 0) + Vector3(0, 0, 2).cross(start - Vector3(1.5, 0.5, 0.5)))).norm() < 1e-12
	arm = (O.bodies[members[0]].state.pos - start).norm()
	O.run(1000, wait=True)
	assert not [contact for contact in O.interactions if contact.isReal]
	assert (state.pos - start - velocity * O.time).norm() < 1e-9 and (state.vel - velocity).norm() < 1e-12
	assert state.angVel[2] == pytest.approx(2, rel=1e-6) and (O.bodies[members[0]].state.pos - state.pos).norm() == pytest.approx(
		arm, rel=1e-9
	)
	assert O.bodies[members[0]].state.vel.norm() > 0


def testLRestsWithItsTrueWeight():
	"""An L of overlapping parts stands on a floor: the floor bears the union's weight."""
	floor = O.bodies.append(box((-5, -5, -1), (5, 5, 0), fixed=True))
	number, _ = polytope.clump([box((0, 0, 0), (3, 1, 1)), box((0, 0, 0), (1, 2, 1))])
	loop(True, gravity=(0, 0, -gravity), normalDamping=0.3, damping=0.2)
	stepper()
	O.run(3000, wait=True)
	assert O.forces.f(floor)[2] == pytest.approx(-4 * density * gravity, rel=1e-4)
	assert O.bodies[number].state.vel.norm() < 1e-4


def testFixedPartsMakeAFixedClump():
	number, _ = polytope.clump([box((0, 0, 0), (1, 1, 1), fixed=True), box((1, 0, 0), (2, 1, 1))])
	assert O.bodies[number].state.blockedDOFs == 'xyzXYZ'


def testPartsAreChecked():
	inScene = box((0, 0, 0), (1, 1, 1))
	O.bodies.append(inScene)
	for parts, words in (
		([], 'must be a list'),
		(3, 'must be a list'),
		(
			[polytope.polygon([(0, 0), (1, 0), (0, 1)]), box((0, 0, 0), (1, 1, 1))],
			'must all be polyhedra, or all polygons of one thickness',
		),
		([rectangle((0, 0), (1, 1)), rectangle((0, 0), (1, 1), thickness=2)], 'must all be polyhedra, or all polygons of one thickness'),
		([inScene], 'must not be in'),
	):
		with pytest.raises(ValueError, match=f'^parts: {words}'):
			polytope.clump(parts)


def testOnePartIsAClumpOfOne():
	number, members = polytope.clump(box((0, 0, 0), (1, 2, 3)))
	assert len(members) == 1 and O.bodies[number].state.mass == pytest.approx(6 * density)


def testMeasuresCountAnOverlapOnce():
	"""Porosity of a box that cuts the clump, of a periodic cell, and the stress of a clump that bears a load, with the union's volume."""
	number, _ = polytope.clump([box((0, 0, 0), (3, 1, 1)), box((0, 0, 0), (1, 2, 1))])
	O.bodies.append(box((10, 10, 10), (11, 11, 11)))
	assert polytope.porosity((-1, -1, -1), (4, 3, 3), ids=[number]) == pytest.approx(1 - 4 / 80, rel=1e-12)
	assert polytope.porosity((0.5, -1, 0.5), (2, 3, 1), ids=[number]) == pytest.approx(1 - (1.5 + 0.5) / 2 / 3, rel=1e-12)
	assert polytope.porosity((5, 5, 5), (6, 6, 6), ids=[number]) == 1
	O.periodic = True
	O.cell.setBox(20, 20, 20)
	assert polytope.porosity(ids=[number]) == pytest.approx(1 - 4 / 8000, rel=1e-12)
	assert polytope.porosity((-1, -1, -1), (1, 1, 1), ids=[number]) == pytest.approx(1 - 1 / 8, rel=1e-12), 'the images do not reach it'
	assert polytope.porosity((20, 20, 20), (22, 22, 22), ids=[number]) == pytest.approx(1 - 3 / 8, rel=1e-12)


def testStressOfAClumpOfOverlappingParts():
	"""A bar of two parts that overlap by half, pulled at both ends by a bond: force over the area of its section."""
	left, right = (polytope.cuboid((side * 2, 0, 0), (0.5, 0.5, 0.5), fixed=side < 0) for side in (-1, 1))
	O.bodies.append([left, right])
	number, _ = polytope.clump([box((-1.5, -0.5, -0.5), (0.5, 0.5, 0.5)), box((-0.5, -0.5, -0.5), (1.5, 0.5, 0.5))])
	expectPulledBar(number)


# ------------------------------------------------------------------------------------------------ meshes

corners = [(x, y, z) for x, y in ((0, 0), (3, 0), (3, 1), (1, 1), (1, 2), (0, 2)) for z in (0, 1)]
faces = [
	(0, 3, 2),
	(0, 1, 3),
	(2, 5, 4),
	(2, 3, 5),
	(4, 7, 6),
	(4, 5, 7),
	(6, 9, 8),
	(6, 7, 9),
	(8, 11, 10),
	(8, 9, 11),
	(10, 1, 0),
	(10, 11, 1),
]
faces = [face[::-1] for face in faces] + [(0, 4, 2), (0, 6, 4), (0, 10, 6), (10, 8, 6), (1, 3, 5), (1, 5, 7), (1, 7, 11), (11, 7, 9)]


@pytest.fixture
def mesh(tmp_path):
	"""An L of 3 × 2 × 1 as OBJ, in centimetres."""
	path = tmp_path / 'L.obj'
	path.write_text(''.join('v {} {} {}\n'.format(*(100 * x for x in corner)) for corner in corners))
	with open(path, 'a') as file:
		file.writelines('f {} {} {}\n'.format(*(k + 1 for k in face)) for face in faces)
	return path


@pytest.fixture
def objects(tmp_path):
	"""The two boxes of an L as objects of a file, and a dented one."""
	path, tetrahedra = tmp_path / 'parts.obj', [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
	with open(path, 'w') as file:
		for k, (lower, upper) in enumerate((((0, 0, 0), (3, 1, 1)), ((0, 0, 0), (1, 2, 1)))):
			file.write(f'o part{k}\n')
			file.writelines(f'v {x} {y} {z}\n' for x in (lower[0], upper[0]) for y in (lower[1], upper[1]) for z in (lower[2], upper[2]))
			for a, b, c, d in tetrahedra:
				file.writelines('f {} {} {}\n'.format(*(8 * k + j + 1 for j in face)) for face in ((a, b, c), (a, c, d)))
	return path


def testObjectsOfAFileAreItsParts(objects):
	number, members = polytope.clump(
		polytope.fromMesh(objects, parts='objects', center=(5, 5, 5), orientation=Quaternion((0, 0, 1), np.pi / 2))
	)
	mass, _, tensor = sums([(1, (0, 0, 0), (3, 1, 1)), (1, (0, 1, 0), (1, 2, 1))])
	turn = np.array([[0, -1, 0], [1, 0, 0], [0, 0, 1]])
	assertEqual(properties(number), (mass, np.array([5, 5, 5]), turn @ tensor @ turn.T), 5)
	assert len(members) == 2


def testCoacdsPartsMakeAClump(mesh, monkeypatch):
	"""A stand-in for CoACD cuts the L in two: what it is asked, and what is made of its answer."""
	asked = {}

	def run(given, **settings):
		asked.update(settings, volume=given)
		blocks = ((0, 3), (0, 1)), ((0, 1), (1, 2))
		return [(100 * np.array([(x, y, z) for x in xs for y in ys for z in (0, 1)]), None) for xs, ys in blocks]

	stand = types.SimpleNamespace(Mesh=lambda points, triangles: len(triangles), run_coacd=run, set_log_level=lambda level: None)
	monkeypatch.setitem(sys.modules, 'coacd', stand)
	number, _ = polytope.clump(polytope.fromMesh(mesh, scale=0.01, parts=7))
	assert asked == {'threshold': 0.05, 'max_convex_hull': 7, 'seed': 0, 'volume': 20}
	assertEqual(properties(number), sums([(1, (0, 0, 0), (3, 1, 1)), (1, (0, 1, 0), (1, 2, 1))]), 3)
	asked.clear()
	stones = [polytope.fromMesh(mesh, scale=size, parts=7, orientation=Quaternion((0, 0, 1), size)) for size in (0.01, 0.03)]
	assert not asked, 'the same mesh was cut again'
	volumes = [[float(part.shape.volume) for part in stone] for stone in stones]
	assert volumes[1] == pytest.approx([27 * volume for volume in volumes[0]], rel=1e-12)
	assert (stones[1][0].state.ori.conjugate() * stones[0][0].state.ori).toAxisAngle()[1] == pytest.approx(0.02, rel=1e-6)
	stand.run_coacd = lambda given, **settings: [(100 * np.array(corners, float), None)]
	with pytest.warns(UserWarning, match=r"has 4 m³, its 1 convex parts 5 m³; give more parts"):
		polytope.fromMesh(mesh, scale=0.01, parts=1)
	with warnings.catch_warnings():
		warnings.simplefilter('error')
		polytope.fromMesh(mesh, scale=0.02, parts=1)  # that was said of this mesh


def testCoacdIsAskedFinerWhereItsPartsAreTooLarge(tmp_path, monkeypatch):
	"""CoACD gets joined vertices, though the mesh has three for each triangle, as STL has. What is nearest to the volume is taken."""
	import trimesh

	asked, lengths = [], {0.05: (1.5, 0.7), 0.02: (0.7, 0.7, 0.02), 0.01: (0.7, 0.7, 3)}
	trimesh.Trimesh(corners, faces).export(tmp_path / 'l.stl')

	def run(given, threshold, max_convex_hull, seed):
		asked.append((*given, threshold))
		return [(np.array([(x, y, z) for x in (0, length) for y in (0, 1) for z in (0, 1)]), None) for length in lengths[threshold]]

	stand = types.SimpleNamespace(
		Mesh=lambda points, triangles: (len(points), len(triangles)), run_coacd=run, set_log_level=lambda level: None
	)
	monkeypatch.setitem(sys.modules, 'coacd', stand)
	volume = abs(trimesh.Trimesh(corners, faces).volume)
	for key in lengths:
		lengths[key] = tuple(volume * length / 1.41 for length in lengths[key])
	with pytest.warns(UserWarning):  # the stand-in's parts lie in each other
		made = polytope.fromMesh(tmp_path / 'l.stl', parts=4)
	assert asked == [(len(corners), len(faces), threshold) for threshold in (0.05, 0.02)] and len(made) == 3
	asked.clear()
	lengths[0.02] = lengths[0.05]
	convexParts.cutMeshes.clear()
	with pytest.warns(UserWarning):
		made = polytope.fromMesh(tmp_path / 'l.stl', parts=4)
	assert [threshold for *_, threshold in asked] == [0.05, 0.02, 0.01] and len(made) == 2
	asked.clear()
	with pytest.warns(UserWarning):
		polytope.fromMesh(tmp_path / 'l.stl', parts=2)
	assert len(asked) == 1, 'no more parts are allowed'


def testCoacdItself(mesh):
	"""Runs where CoACD is installed."""
	pytest.importorskip('coacd', reason='CoACD is optional: pip install coacd')
	number, members = polytope.clump(polytope.fromMesh(mesh, scale=0.01, parts=4))
	mass, centre, tensor = sums([(1, (0, 0, 0), (3, 1, 1)), (1, (0, 1, 0), (1, 2, 1))])
	found = properties(number)
	assert 2 <= len(members) <= 4 and found[0] == pytest.approx(mass, rel=0.02)
	assert np.abs(found[1] - centre).max() < 0.02 and np.abs(found[2] - tensor).max() < 0.05 * np.abs(tensor).max()


def testWhatIsRefused(mesh, objects, tmp_path, monkeypatch):
	monkeypatch.setitem(sys.modules, 'coacd', None)
	with pytest.raises(
		ImportError, match=r"^parts: needs CoACD, which is not installed; install it .* 'pip install --no-deps --target ~/coacd coacd'"
	):
		polytope.fromMesh(mesh, parts=5)
	for parts in (0, 'all', True, 2.5):
		with pytest.raises(ValueError, match='^parts: must be a number of parts above 0'):
			polytope.fromMesh(mesh, parts=parts)
	with pytest.raises(ValueError, match='^path: object 1 of .* is not convex'):
		polytope.fromMesh(mesh, parts='objects')
	import trimesh

	trimesh.Trimesh(corners, faces).export(tmp_path / 'soup.stl')
	with pytest.raises(ValueError, match='^path: object 1 of .* is not convex'):
		polytope.fromMesh(tmp_path / 'soup.stl', parts='objects')
	trimesh.Trimesh(corners, faces[:-1]).export(tmp_path / 'open.stl')
	with pytest.raises(ValueError, match='^path: object 1 of .* is not closed, and there is no other; close it'):
		polytope.fromMesh(tmp_path / 'open.stl', parts='objects')
	with pytest.warns(UserWarning, match=r'not convex: it has 4 m³, its hull, which the body is, 5 m³; polytope.clump'):
		polytope.fromMesh(mesh, scale=0.01)


# ------------------------------------------------------------------------------------------------ without overlap

overlapping = {
	'bars one behind the other': lambda: [box((0, 0, 0), (4, 2, 2)), box((2, 0, 0), (6, 2, 2))],
	'L': lambda: [box((0, 0, 0), (4, 1, 1)), box((0, 0, 0), (1, 3, 1))],
	'cross': lambda: [box((0, 2, 0), (5, 3, 1)), box((2, 0, 0), (3, 5, 1))],
	'three about a corner': lambda: [box((0, 0, 0), (3, 1, 1)), box((0, 0, 0), (1, 3, 1)), box((0, 0, 0), (1, 1, 3))],
	'turned': lambda: [box((0, 0, 0), (4, 2, 2)), polytope.cuboid((3, 1, 1), (1.5, 0.4, 0.4), orientation=Quaternion((1, 2, 3), 0.7))],
	'solids': lambda: [polytope.regular(20, 1), polytope.regular(12, 1, (0.9, 0.2, 0)), polytope.regular(8, 1, (0.3, 0.8, 0.1))],
	'polygons': lambda: [rectangle((0, 0), (4, 1)), rectangle((0, 0), (1, 3))],
}


@pytest.mark.parametrize('name', overlapping)
def testBodiesWithoutOverlapFillTheSame(name):
	bodies = overlapping[name]()
	whole = polytope.bodies.clumps.volumeOfUnion(bodies)
	pieces = polytope.withoutOverlap(bodies)
	assert pieces[0] is bodies[0]
	assert sum(float(piece.shape.volume) for piece in pieces) == pytest.approx(whole, rel=1e-9)
	assert all(float(piece.state.mass) == pytest.approx(density * float(piece.shape.volume), rel=1e-9) for piece in pieces)
	deep = [-float(polytope.contact(one, other).infeasibility) for k, one in enumerate(pieces) for other in pieces[:k]]
	assert max(deep) < 1e-9


def testBodiesThatTouchAreLeftAsTheyAre():
	bodies = [box((0, 0, 0), (2, 1, 1)), box((2, 0, 0), (4, 1, 1), velocity=(1, 2, 3))]
	assert polytope.withoutOverlap(bodies) == bodies
	assert polytope.withoutOverlap([bodies[0], box((0.5, 0.2, 0.2), (1, 0.8, 0.8))]) == bodies[:1], 'one within another'


@pytest.mark.parametrize('perArea', [True, False])
def testABarOfOverlappingMembersCutApartLiesAsOneBody(perArea):
	"""Its area, force and depth are those of one bar; with members that overlap by half the depth is less, as of more springs."""
	stiffness = 1e7
	depths = []
	for make in (lambda parts: parts, polytope.withoutOverlap):
		O.reset()
		joint(density=density, normalStiffness=stiffness)
		loop(perArea, normalDamping=0.3, gravity=(0, 0, -gravity), damping=0.4)
		O.bodies.append(polytope.cuboid((0, 0, -1), (9, 9, 1), fixed=True))
		number, members = polytope.clump(make([box((0, 0, 0), (0.4, 0.2, 0.2)), box((0.2, 0, 0), (0.6, 0.2, 0.2))]))
		stepper()
		start = float(O.bodies[number].state.pos[2])
		O.run(3000, True)
		depths.append(start - float(O.bodies[number].state.pos[2]))
		force = sum(i.phys.normalForce.norm() for i in O.interactions if i.isReal)
		assert force == pytest.approx(density * 0.024 * gravity, rel=1e-3)
	assert depths[1] == pytest.approx(density * 0.024 * gravity / stiffness / (0.12 if perArea else 1), rel=2e-3)
	assert depths[0] < 0.85 * depths[1]


@pytest.mark.parametrize(
	'wrong, said',
	[
		(lambda: [], 'must be a list'),
		(lambda: 3, 'must be a list'),
		(lambda: [rectangle((0, 0), (1, 1)), rectangle((0, 0), (1, 1), thickness=2)], 'in one plane'),
		(lambda: [rectangle((0, 0), (1, 1))] * 2, 'twice'),
		(lambda: [rectangle((0, 0), (1, 1)), box((0, 0, 0), (1, 1, 1))], 'must all be polyhedra, or all polygons of one thickness'),
		(lambda: [O.bodies[O.bodies.append(box((0, 0, 0), (1, 1, 1)))]], 'not be in the scene'),
	],
)
def testWhatCannotBeCutApartIsRefused(wrong, said):
	with pytest.raises(ValueError, match=f'^bodies: .*{said}'):
		polytope.withoutOverlap(wrong())


def testABodyThatIsTwiceAmongThePartsIsRefused():
	part = box((0, 0, 0), (1, 1, 1))
	with pytest.raises(ValueError, match='^parts: the same body is there twice'):
		polytope.clump([part, part])
	assert len(O.bodies) == 0
