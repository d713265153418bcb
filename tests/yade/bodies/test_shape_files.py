# SPDX-License-Identifier: GPL-2.0-or-later
"""Shapes from and to text files: what is written is read, Neper's and Rockable's as they say; malformed files are refused by line."""

import math
import pathlib
import sys
import types
import warnings

import numpy as np
import pytest
from scenes import joint
from yade import O, Polytope, Sphere, Vector3, polytope
from yade.polytope.bodies.meshes import convexParts

ballRadius = 0.08
files = pathlib.Path(__file__).parents[1] / 'shapes'


@pytest.fixture(autouse=True)
def material():
	joint()
	convexParts.cutMeshes.clear()


def corners(body):
	"""Vertices in world coordinates."""
	return np.array([body.state.pos + body.state.ori * vertex for vertex in body.shape.vertices], float)


def farthest(points, others):
	"""Largest distance of the points from the nearest of the others; there must be as many."""
	assert len(points) == len(others)
	return np.linalg.norm(np.asarray(points, float)[:, None] - others, axis=2).min(axis=1).max()


def testWhatIsWrittenIsReadAgain(tmp_path):
	O.bodies.append([polytope.randomGrain(0.1, seed=k, center=(k, 100, 0)) for k in range(5)])
	O.bodies.append([polytope.fromHalfSpaces(*block) for block in polytope.voronoi(((0, 0, 0), (1, 1, 1)), 10, seed=1).blocks])
	redundant = polytope.fromHalfSpaces(
		[(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1), (1, 1, 1)], [1, 1, 1, 1, 1, 1, 3]
	)
	O.bodies.append([redundant, polytope.polygon([(0, 0), (1, 0), (0, 1)])])
	path = tmp_path / 'new' / 'grains.txt'
	assert polytope.writeShapes(path) == 16
	again = polytope.readShapes(path)
	for body, other in zip(list(O.bodies)[:16], again, strict=True):
		assert farthest(corners(body), corners(other)) < 1e-12, 'of grains 100 m away'
		assert len(other.shape.normals) == (6 if body is redundant else len(body.shape.normals))
		assert other.shape.volume == pytest.approx(body.shape.volume, rel=1e-12) and other.state.mass == pytest.approx(
			body.state.mass, rel=1e-12
		)
	assert polytope.writeShapes(path, ids=[3]) == 1 and len(polytope.readShapes(path)) == 1
	with pytest.raises(ValueError, match='^ids: body 16 is no polyhedron'):
		polytope.writeShapes(path, ids=[16])
	with pytest.raises(ValueError, match='^path: .* is a folder'):
		polytope.writeShapes(tmp_path)
	O.reset()
	with pytest.raises(ValueError, match='^ids: the scene has no polyhedron'):
		polytope.writeShapes(path)


def testYadesOwnReaderTakesTheFile(tmp_path):
	"""The file is read by the rules of YADE's ymport.textPolyhedra, which itself needs YADE's Polyhedra: header of three words, vertices, faces are
	skipped."""
	O.bodies.append([polytope.regular(12, 1), polytope.cuboid((3, 0, 0), (1, 1, 1))])
	polytope.writeShapes(tmp_path / 'two.txt')
	lines = (tmp_path / 'two.txt').read_text().splitlines()
	found = []
	while lines:
		header = lines.pop(0).split()
		if header[0][0] == '#':
			continue
		assert len(header) == 3
		found.append(np.array([[float(x) for x in lines.pop(0).split()] for _ in range(int(header[1]))]))
		del lines[: int(header[2])]
	assert [len(points) for points in found] == [20, 8] and found[1].max() == 4


def testCellsOfNeperShareTheirFace():
	one, two = bodies = polytope.readShapes(files / 'twoCells.tess', scale=0.1, shift=(5, 0, 0))
	assert [body.shape.volume for body in bodies] == pytest.approx([0.75e-3, 1.25e-3], rel=1e-10)
	expected = [(5 + x, y, z) for x, y in ((0, 0), (0, 0.1), (0.025, 0.1), (0.125, 0)) for z in (0, 0.1)]
	assert farthest(expected, corners(one)) < 1e-12
	contact = polytope.contact(one, two)
	assert abs(contact.depth) < 1e-15 and abs(contact.normal.dot(Vector3(1, 1, 0))) == pytest.approx(2**0.5, rel=1e-9)
	flat = polytope.readShapes(files / 'twoCells2d.tess')
	assert [(body.shape.dimension, float(body.shape.volume)) for body in flat] == [(2, pytest.approx(0.75)), (2, pytest.approx(1.25))]


def testEmptyCellsOfNeperAreLeftOut(tmp_path):
	"""Neper writes empty cells without faces or, in 2-D, without vertices."""
	path = tmp_path / 'a.tess'
	path.write_text(cell(' **polyhedron\n 2\n', ' **polyhedron\n 3\n   3 0\n'))
	assert [body.shape.volume for body in polytope.readShapes(path)] == pytest.approx([0.75, 1.25])
	empty = '3 0\n     0\n    0.0 0.0 0.0 0.0\n     0 0 0.0 0.0 0.0\n'
	text = (files / 'twoCells2d.tess').read_text()
	assert ' **face\n 2\n' in text
	path.write_text(text.replace(' **face\n 2\n', f' **face\n 3\n   {empty}'))
	assert [body.shape.volume for body in polytope.readShapes(path)] == pytest.approx([0.75, 1.25])


@pytest.mark.parametrize('name', ['a.stl', 'a.OBJ', 'a.msh', 'a.gts', 'a.vtu', 'a.ele', 'a.smesh'])
def testMeshesAreReadByFromMesh(name, tmp_path):
	(tmp_path / name).write_text('solid')
	with pytest.raises(ValueError, match=f"^path: '.*{name}' is a mesh; polytope.fromMesh reads it, with parts='objects'"):
		polytope.readShapes(tmp_path / name)


def testShapesOfRockableHaveTheirFacesWhereRockableHasThem():
	cube, plate = polytope.readShapes(files / 'library.shp', names=['Cube', 'Plate'], scale=2)
	assert abs(corners(cube)).max() == pytest.approx(1, rel=1e-12) and cube.shape.volume == pytest.approx(8, rel=1e-12)
	assert np.ptp(corners(plate), axis=0) == pytest.approx([8.2, 0.2, 2.2], rel=1e-12) and len(plate.shape.normals) == 6
	with pytest.raises(ValueError, match="^names: .*has no shape 'Brick'; it has Cube, Plate, Ball"):
		polytope.readShapes(files / 'library.shp', names='Brick')


def rockable(name, radius, points, faces=(), more=''):
	"""A shape as Rockable's libraries have it."""
	rows = [
		f'<\nname {name}\nradius {radius}\n{more}nv {len(points)}',
		*(' '.join(map(str, point)) for point in points),
		f'nf {len(faces)}',
	]
	return '\n'.join([*rows, *(f'{len(face)} ' + ' '.join(map(str, face)) for face in faces), '>\n'])


def testABallIsASphereOfYades():
	"""Beside the polyhedra of its file; it falls on one of them and rests there."""
	cube, plate, ball = polytope.readShapes(files / 'library.shp', scale=2, shift=(0, 0, 5), material=0, color=(0.1, 0.2, 0.3), fixed=False)
	assert isinstance(ball.shape, Sphere) and isinstance(cube.shape, Polytope) and isinstance(plate.shape, Polytope)
	assert ball.shape.radius == pytest.approx(2 * ballRadius, rel=1e-12) and ball.state.pos == Vector3(0, 0, 5)
	assert ball.state.mass == pytest.approx(O.materials[0].density * 4 / 3 * math.pi * (2 * ballRadius) ** 3, rel=1e-9)
	assert tuple(ball.shape.color) == pytest.approx((0.1, 0.2, 0.3)) and ball.dynamic
	(held,) = polytope.readShapes(files / 'library.shp', names='Ball', fixed=True, velocity=(0, 0, 1))
	assert held.state.blockedDOFs == 'xyzXYZ' and tuple(held.state.vel) == (0, 0, 1)
	floor = polytope.cuboid((0, 0, 0), (2, 2, 1), fixed=True)
	ball.state.pos = Vector3(0, 0, 1 + 2 * ballRadius)
	O.bodies.append([floor, ball])
	O.engines = polytope.engines()
	while O.time < 1:
		O.run(200, wait=True)
	weight = 9.81 * float(ball.state.mass)
	assert O.interactions[0, 1].phys.normalForce.norm() == pytest.approx(weight, rel=1e-3)


def testWhatIsNoBodyIsLeftOutByName(tmp_path):
	path = tmp_path / 'some.shp'
	tetrahedron = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
	rods = (
		rockable('Rod', 0.1, [(0, 0, 0), (1, 0, 0)])
		+ rockable('Rice', 0.1, [(0, -1, 0), (0, 0, 0), (0, 1, 0)])
		+ rockable('Dot', 0, [(0, 0, 0)])
	)
	path.write_text(rods + rockable('Four', 0, tetrahedron))
	with pytest.warns(UserWarning, match="left out of .*some.shp': 'Rod' is a rod; 'Rice' is a rod; 'Dot' is a point$") as said:
		(body,) = polytope.readShapes(path)
	assert len(said) == 1 and body.shape.volume == pytest.approx(1 / 6)
	with pytest.raises(ValueError, match="^path: .*line 1: 'Rod' is a rod; leave it out: names"):
		polytope.readShapes(path, names=['Four', 'Rod'])
	path.write_text(rods)
	with pytest.raises(ValueError, match="^path: .*line 1: there is no shape that is a body: 'Rod' is a rod; 'Rice'"):
		polytope.readShapes(path)


def testASurfaceIsPlatesOfItsFaces(tmp_path):
	"""A square cup 2 wide and 1 high, open above: a block rests in it on the floor, as it does on none if the cup is solid."""
	ring = [(-1, -1), (1, -1), (1, 1), (-1, 1)]
	faces = [(0, 1, 2, 3), *((k, (k + 1) % 4, 4 + (k + 1) % 4, 4 + k) for k in range(4))]
	path = tmp_path / 'cup.shp'
	path.write_text(rockable('Cup', 0.05, [(*corner, z) for z in (0, 1) for corner in ring], faces, 'isSurface\n'))
	(plates,) = polytope.readShapes(path, fixed=True)
	assert len(plates) == 5 and all(not plate.dynamic for plate in plates)
	assert [float(plate.shape.volume) for plate in plates] == pytest.approx([2.1 * 2.1 * 0.1] + 4 * [2.1 * 1.1 * 0.1], rel=1e-12)
	O.bodies.append(plates)
	block = O.bodies[O.bodies.append(polytope.cuboid((0.1, 0, 0.46), (0.4, 0.4, 0.4)))]
	O.engines = polytope.engines()
	while O.time < 1:
		O.run(200, wait=True)
	assert block.state.pos[2] == pytest.approx(0.45, abs=1e-3)


def testPartsOfAShapeThatIsNotConvex(tmp_path, monkeypatch):
	"""An L of two blocks and a cube, with a stand-in for CoACD: parts are where the shape is, their faces moved out by the radius."""
	outline = [(0, 0), (3, 0), (3, 1), (1, 1), (1, 2), (0, 2)]
	points = [(x, y, z) for z in (0, 1) for x, y in outline]
	faces = [(3, 2, 1, 0), (5, 4, 3, 0), (6, 7, 8, 9), (6, 9, 10, 11), *((k, (k + 1) % 6, 6 + (k + 1) % 6, 6 + k) for k in range(6))]
	path = tmp_path / 'l.shp'
	path.write_text(rockable('L', 0.1, points, faces) + (files / 'library.shp').read_text())
	asked = []

	def run(given, **settings):
		asked.append((*given, settings['max_convex_hull']))
		blocks = ((0, 3), (0, 1)), ((0, 1), (1, 2))
		return [(np.array([(x, y, z) for x in xs for y in ys for z in (0, 1)]), None) for xs, ys in blocks]

	stand = types.SimpleNamespace(
		Mesh=lambda points, triangles: (len(points), len(triangles)), run_coacd=run, set_log_level=lambda level: None
	)
	monkeypatch.setitem(sys.modules, 'coacd', stand)
	parts, *others = polytope.readShapes(path, parts=4)
	assert asked == [(12, 20, 4)] and len(others) == 3
	assert [float(part.shape.volume) for part in parts] == pytest.approx([3.2 * 1.2 * 1.2, 1.2**3])
	number, _ = polytope.clump(parts)
	assert O.bodies[number].state.mass / O.materials[0].density == pytest.approx(1.2 * (3.2 * 1.2 + 1.2 * 1.0), rel=1e-9)
	polytope.readShapes(path, parts=4)
	assert len(asked) == 1, 'the same shape was cut again'
	with pytest.warns(UserWarning, match="'L' .line 1 .* is not convex; the body is its convex hull; parts=… cuts it"):
		polytope.readShapes(path)


def testWhatIsNotConvexIsSaid(tmp_path):
	"""A cube whose upper face is dented: five points of the hull, one inside."""
	points = [(0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0), (0, 0, 2), (2, 0, 2), (2, 2, 2), (0, 2, 2), (1, 1, 1)]
	faces = [(0, 1, 2, 3), (0, 1, 5, 4), (4, 5, 8), (5, 6, 8), (6, 7, 8), (7, 4, 8)]
	lists = '\n'.join(' '.join(map(str, row)) for row in points), '\n'.join(' '.join(map(str, row)) for row in faces)
	(tmp_path / 'dent.txt').write_text(f'7 9 6\n{lists[0]}\n{lists[1]}\n')
	numbered = '\n'.join(f'{len(row)} ' + ' '.join(map(str, row)) for row in faces)
	(tmp_path / 'dent.shp').write_text(f'<\nname Dent\nnv 9\n{lists[0]}\nnf 6\n{numbered}\n>\n')
	for name, words in (
		('dent.txt', "polyhedron 7 .line 1 of .*dent.txt'. is not convex"),
		('dent.shp', "'Dent' .line 1 of .* is not convex"),
	):
		with pytest.warns(UserWarning, match=words):
			(body,) = polytope.readShapes(tmp_path / name)
		assert body.shape.volume == pytest.approx(8)
	with warnings.catch_warnings():
		warnings.simplefilter('error')
		polytope.readShapes(files / 'library.shp', names='Cube')


def cell(old, new):
	text = (files / 'twoCells.tess').read_text()
	assert old in text
	return text.replace(old, new, 1)


@pytest.mark.parametrize(
	'name, text, words',
	[
		('a.txt', '', 'line 0: there is no polyhedron'),
		('a.txt', '1 4 4\n0 0 0\n1 0 0\n0 1 0\n', 'line 4: a coordinate of a vertex is expected, a number, but the file ends'),
		(
			'a.txt',
			'1 4 1\n0 0 0\n1 0 0\n0 x 0\n0 0 1\n0 1 2\n',
			"line 4: a coordinate of a vertex is expected, a number, but 'x' is there; a polyhedron is a line",
		),
		('a.txt', '1 4 1\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n0 1 4\n', 'line 6: the number of a vertex must be from 0 to 3, got 4'),
		('a.txt', '1 4 1\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n0 1\n', 'line 6: a face has at least three vertices, got 2'),
		('a.txt', '# head\n1 4 0\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n', 'line 2: the vertices of polyhedron 1 .* make no body'),
		('a.txt', '1 4 0\n0 0 0\n1 0 0\n0 1 nan\n', 'line 4: a coordinate of a vertex must be finite'),
		('a.tess', 'x', "line 1: a tessellation begins with '\\*\\*\\*tess', but 'x'"),
		('a.tess', cell('***end', ''), "line .*: the file ends where '\\*\\*\\*end' is expected"),
		('a.tess', cell('3 standard', '1 standard'), 'dimension 2 and 3 have bodies, this one has dimension 1'),
		('a.tess', cell('**polyhedron', '**other'), 'the section \\*\\*polyhedron is missing'),
		('a.tess', cell('4 2 3 9 8', '4 2 3 9 18'), 'line 58: there is no vertex 18; write the tessellation anew'),
		('a.tess', cell('6 7 8 9 -4 10 11', '6 7 8 9 -4 10 12'), 'there is no face 12'),
		(
			'a.tess',
			cell('6 7 8 9 -4 10 11', '6 7 8 9 4 10 11'),
			'line 58: a cell is not convex: .* regularization or -transform cut has bent; tessellate without them, or mesh',
		),
		('a.tess', cell('4 2 3 9 8', '4 2 3 9 -8'), 'line 58: there is no vertex -8'),
		('a.tess', cell('4 2 3 9 8', '4 2 3 9 0'), 'line 58: there is no vertex 0'),
		('a.tess', cell('4 2 3 9 8', '2 2 3'), 'line 58: a number of vertices must be 0 or at least 3, got 2'),
		('a.shp', 'name', "line 1: a shape begins with '<'"),
		('a.shp', '<\nnv 1\n0 0 0\n>', 'line 1: this shape has no name'),
		('a.shp', '<\nname a\nnv 1\n0 0 0\n<\n', "a shape begins before that of line 1 ends with '>'"),
		('a.shp', '<\nname a\nnv 1.5\n', "line 3: the number of vertices is expected, a whole number, but '1.5'"),
		('a.shp', '<\nname a\nradius -1\n', 'line 3: the radius must be at least 0'),
		(
			'a.shp',
			'<\nname a\nnv 4\n0 0 0\n1 0 0\n0 1 0\n0 0 1\nnf 1\n3 0 1 7\n>',
			'line 9: the number of a vertex must be from 0 to 3, got 7',
		),
	],
	ids=lambda value: value if len(value) < 80 else 'file',
)
def testMalformedFilesAreRefusedByLine(name, text, words, tmp_path):
	(tmp_path / name).write_text(text)
	with pytest.raises(ValueError, match=f'^path: .*{name}.*{words}'):
		polytope.readShapes(tmp_path / name)


def testArgumentsAreChecked(tmp_path):
	with pytest.raises(FileNotFoundError, match='^path: there is no file'):
		polytope.readShapes(tmp_path / 'none.tess')
	for arguments, words in (
		({'path': 3}, 'path: must be the path'),
		({'path': tmp_path}, 'path: .* is a folder; give the path of a file in it'),
		({'path': files / 'twoCells.tess', 'scale': 0}, 'scale: must be positive'),
		({'path': files / 'twoCells.tess', 'names': ['a']}, 'names: only shapes of a Rockable'),
		({'path': files / 'twoCells.tess', 'parts': 3}, 'parts: only shapes of a Rockable'),
		({'path': files / 'library.shp', 'parts': 0}, 'parts: must be a number of parts above 0'),
		({'path': files / 'library.shp', 'names': 'Ball', 'mask': 'all'}, 'mask: must be a whole number'),
	):
		with pytest.raises(ValueError, match=f'^{words}'):
			polytope.readShapes(**arguments)
	with pytest.raises(TypeError, match="readShapes: there is no argument 'center'"):
		polytope.readShapes(files / 'twoCells.tess', center=(0, 0, 0))
