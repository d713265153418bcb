# SPDX-License-Identifier: GPL-2.0-or-later
"""Bodies from mesh files: far from the origin, several in one file, formats; the others are in test_bodies.py and test_clumps.py."""

import locale
import warnings

import numpy as np
import pytest
import trimesh
from scenes import joint
from yade import O, polytope

meshio = pytest.importorskip('meshio')
utm = np.array([500000.3, 4000000.7, 300.1])


@pytest.fixture(autouse=True)
def material():
	joint()


def box(extents=(1, 1, 1), place=(0, 0, 0)):
	return trimesh.creation.box(extents).apply_translation(place)


def rock(seed=1):
	"""The hull of 40 points on an ellipsoid: 76 triangles."""
	directions = np.random.default_rng(seed).normal(size=(40, 3))
	return trimesh.convex.convex_hull(directions / np.linalg.norm(directions, axis=1)[:, None] * (0.5, 0.4, 0.3))


def writeObj(path, mesh, digits='%.9f'):
	vertices = (f'v {digits} {digits} {digits}\n' % tuple(vertex) for vertex in mesh.vertices)
	path.write_text(''.join(vertices) + ''.join('f {} {} {}\n'.format(*(face + 1)) for face in mesh.faces))
	return path


def volumes(bodies):
	return sorted(float(body.shape.volume) for body in bodies)


def warningsOf(*arguments, **named):
	"""(what fromMesh makes, its warnings)."""
	with warnings.catch_warnings(record=True) as told:
		warnings.simplefilter('always')
		made = polytope.fromMesh(*arguments, **named)
	return made, [str(one.message) for one in told if one.category is UserWarning]


@pytest.mark.parametrize('place', [(0, 0, 0), (1400, 0, 0), (0, 14000, 0), (1e5, -1e5, 0), utm], ids=str)
def testRocksKeepTheirFacesWhereverTheyAre(place, tmp_path):
	"""They keep them at UTM coordinates, too, where a sum over the surface about the origin has lost all digits of the volume."""
	mesh = rock()
	made, told = warningsOf(writeObj(tmp_path / 'rock.obj', mesh.copy().apply_translation(place)))
	assert len(made.shape.normals) == 76 and not told
	assert made.shape.volume == pytest.approx(mesh.volume, rel=3e-8), 'coordinates have nine decimals'
	assert np.array(made.state.pos, float) == pytest.approx(mesh.center_mass + place, abs=1e-8)


@pytest.mark.parametrize('size', [1e-6, 1e-3, 1, 1e3])
def testAMeshIsClosedAndConvexInEveryUnit(size, tmp_path):
	"""Corners that lie within 1e-8 were one point, whatever the size."""
	outline = [(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)]
	angle = trimesh.util.concatenate([box((2, 1, 1), (1, 0.5, 0.5))])
	assert not warningsOf(writeObj(tmp_path / 'box.obj', angle.apply_scale(size), '%.17g'))[1]
	points = [(x, y, z) for z in (0, 1) for x, y in outline]
	caps = [(0, 1, 3), (1, 2, 3), (0, 3, 5), (3, 4, 5)]
	sides = [triangle for k in range(6) for triangle in ((k, (k + 1) % 6, 6 + k), ((k + 1) % 6, 6 + (k + 1) % 6, 6 + k))]
	angle = trimesh.Trimesh(points, [cap[::-1] for cap in caps] + [tuple(6 + k for k in cap) for cap in caps] + sides)
	for place in ((0, 0, 0), 4e6 * np.ones(3)):
		moved = angle.copy().apply_translation(place).apply_scale(size)
		(said,) = warningsOf(writeObj(tmp_path / 'angle.obj', moved, '%.17g'))[1]
		assert f'is not convex: it has {3 * size**3:.3g} m³, its hull, which the body is, {3.5 * size**3:.3g} m³' in said


def testFilesWithTooFewDigitsAreWarnedOf(tmp_path):
	"""Single precision, and six digits; not numbers that any precision holds, nor those of a file that has enough."""
	for place, digits in (((1400, 0, 0), False), ((14000, 0, 0), True), (utm, True)):
		moved = rock().apply_translation(place)
		moved.export(tmp_path / 'rock.stl')
		told = warningsOf(tmp_path / 'rock.stl')[1]
		assert [('the file has too few digits' in one) for one in told][:1] == [True] * digits, place
	told = warningsOf(writeObj(tmp_path / 'six.obj', rock().apply_translation((1234, 0, 0)), '%g'))[1]
	assert 'with an error of 0.005, its extent is' in told[0]
	for mesh, digits in (
		(rock(), '%g'),
		(box((1, 2, 3)), '%g'),
		(box((1, 2, 3), (500000, 4000000, 300)), '%.1f'),
		(box((1, 2, 3), (500000, 4000000, 300)), '%.10g'),
		(box((1, 2, 3), utm), '%.9f'),
	):
		assert not warningsOf(writeObj(tmp_path / 'fine.obj', mesh, digits))[1]
	with pytest.warns(UserWarning, match='^heights: .* too few digits'):
		trimesh.Trimesh([(0, 0, 0), (1, 0, 0.1), (0, 1, 0.2), (1, 1, 0)] + utm, [(0, 1, 2), (1, 3, 2)]).export(tmp_path / 'ground.stl')
		polytope.terrain(tmp_path / 'ground.stl')


def testFacesOfSinglePrecisionStayWhole(tmp_path):
	"""A turned box: its corners miss the faces by the file's rounding, up to 3e-5 at 300 m."""
	turn = trimesh.transformations.rotation_matrix(1, (1, 2, 3))
	for place in ((0, 0, 0), (300, 0, 0), (0, 1000, 0)):
		box((1, 2, 3)).apply_transform(turn).apply_translation(place).export(tmp_path / 'box.stl')
		made, told = warningsOf(tmp_path / 'box.stl')
		assert len(made.shape.normals) == 6 and not told
		assert made.shape.volume == pytest.approx(6, rel=3e-4)


def testPlatesThinnerThanTheToleranceAreBodies(tmp_path):
	box((1, 1, 1e-7)).export(tmp_path / 'plate.stl')
	made = polytope.fromMesh(tmp_path / 'plate.stl')
	assert len(made.shape.normals) == 6 and made.shape.volume == pytest.approx(1e-7, rel=1e-6)


places = {
	'faces': [(x, y, z) for x in range(3) for y in range(2) for z in range(2)],
	'edge': [(0, 0, 0), (0, 1, 1)],
	'corner': [(0, 0, 0), (1, 1, 1)],
	'apart': [(0, 0, 0), (3, 0, 0), (0, 5, 0)],
}


@pytest.mark.parametrize('inverted', [False, True])
@pytest.mark.parametrize('ending', ['stl', 'obj', 'ply', 'merged.obj'])
@pytest.mark.parametrize('name', places)
def testSeveralBodiesOfAFile(name, ending, inverted, tmp_path):
	"""Cubes that share faces, edges, corners or nothing: told of, and read one by one; with points of their own, or points in common."""
	meshes = [box(place=place) for place in places[name]]
	mesh, path = trimesh.util.concatenate(meshes), tmp_path / f'cubes.{ending}'
	if inverted:
		mesh.invert()
	if ending == 'merged.obj':
		mesh.merge_vertices()
	mesh.export(path)
	made, (said,) = warningsOf(path)
	assert (
		f"has {len(meshes)} bodies; the body is the convex hull of all of them, {made.shape.volume:.3g} m³; polytope.fromMesh(…, parts='objects')"
		in said
	)
	bodies, told = warningsOf(path, parts='objects')
	assert not told and volumes(bodies) == pytest.approx([1] * len(meshes))
	assert np.array([body.state.pos for body in bodies], float) == pytest.approx(np.array(places[name]), abs=1e-6), (
		'in the order of the file'
	)


def testObjectsFollowTheLinesOfTheFile(tmp_path):
	"""Two tetrahedra that share three points; a change of material is no other object. Objects that are closed only together are one."""
	path = tmp_path / 'two.obj'
	points = 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 1 1 1\n'
	path.write_text(
		f'o a\n{points}f 1 3 2\nf 1 2 4\nf 2/1/1 3//2 4\nf -5 -2 -3\no b\nusemtl x\nf 2 3 5\nusemtl y\nf 2 4 3\nf 2 5 4\nf 3 4 5\n'
	)
	assert [float(body.shape.volume) for body in polytope.fromMesh(path, parts='objects')] == pytest.approx([1 / 6, 1 / 3])
	path.write_text(f'o a\n{points}f 1 3 2\nf 1 2 4\no b\nf 2 3 4\nf 1 4 3\n')
	made, told = warningsOf(path)
	assert not told and made.shape.volume == pytest.approx(1 / 6), 'a vertex of no face does not count'
	assert volumes(polytope.fromMesh(path, parts='objects')) == pytest.approx([1 / 6])


def testOneBodyThatIsNotConvexDoesNotRefuseTheOthers(tmp_path):
	"""A cube with a dent, one that is open, a sheet, and a sound one."""
	dented, opened = box(), box(place=(3, 0, 0))
	top = np.flatnonzero((dented.vertices[dented.faces][:, :, 2] > 0.4).all(axis=1))
	rim = sorted(
		map(int, np.flatnonzero(dented.vertices[:, 2] > 0)), key=lambda k: np.arctan2(dented.vertices[k, 1], dented.vertices[k, 0])
	)
	cone = [(rim[k], rim[(k + 1) % 4], 8) for k in range(4)]
	dented = trimesh.Trimesh(np.vstack([dented.vertices, [(0, 0, 0.3)]]), np.vstack([np.delete(dented.faces, top, axis=0), cone]))
	assert dented.is_watertight and dented.volume == pytest.approx(1 - 0.2 / 3)
	opened = trimesh.Trimesh(opened.vertices, opened.faces[:-1])
	sheet = trimesh.Trimesh([(0, 0, 9), (1, 0, 9), (0, 1, 9)], [(0, 1, 2)])
	trimesh.util.concatenate([dented, opened, box(place=(6, 0, 0)), sheet]).export(tmp_path / 'four.obj')
	bodies, (said,) = warningsOf(tmp_path / 'four.obj', parts='objects')
	assert volumes(bodies) == pytest.approx([1, 1, 1])
	for words in ('object 1 is not convex (0.933 m³, its hull 1 m³)', 'object 2 is not closed', 'object 4 is flat and is left out'):
		assert words in said
	dented.export(tmp_path / 'one.obj')
	with pytest.raises(ValueError, match='^path: object 1 of .* is not convex .* there is no other'):
		polytope.fromMesh(tmp_path / 'one.obj', parts='objects')


def testHolesBelongToTheBodyAroundThem(tmp_path):
	outer, inner = box((3, 3, 3)), box()
	inner.invert()
	trimesh.util.concatenate([outer, inner]).export(tmp_path / 'hollow.stl')
	assert 'it has 26 m³, its hull, which the body is, 27 m³' in warningsOf(tmp_path / 'hollow.stl')[1][0]
	trimesh.util.concatenate([outer, inner, box((0.5, 0.5, 0.5))]).export(tmp_path / 'grain.stl')
	assert volumes(warningsOf(tmp_path / 'grain.stl', parts='objects')[0]) == pytest.approx([0.125, 27])


def testTrianglesThatFaceEitherWay(tmp_path):
	"""Some programs write such files: the volume is that of the body all the same."""
	turned = box((1, 2, 3))
	turned.faces[::3] = turned.faces[::3, ::-1]
	trimesh.util.concatenate([turned, box(place=(5, 0, 0))]).export(tmp_path / 'two.ply')
	bodies, told = warningsOf(tmp_path / 'two.ply', parts='objects')
	assert volumes(bodies) == pytest.approx([1, 6]) and not told
	turned.export(tmp_path / 'one.stl')
	assert not warningsOf(tmp_path / 'one.stl')[1]


corners = np.array([(x, y, z) for z in (0, 3) for y in (0, 2) for x in (0, 1, 2)], float)
bricks = np.array([(0, 1, 4, 3, 6, 7, 10, 9), (1, 2, 5, 4, 7, 8, 11, 10)])


def tetrahedra(cells):
	"""Six tetrahedra for each brick; neighbours share the diagonals of their faces."""
	six = [(0, 1, 2, 6), (0, 2, 3, 6), (0, 3, 7, 6), (0, 7, 4, 6), (0, 4, 5, 6), (0, 5, 1, 6)]
	return np.array([[cell[k] for k in one] for cell in cells for one in six])


@pytest.mark.parametrize(
	'ending, form',
	[
		('msh', 'gmsh'),
		('msh', 'gmsh22'),
		('vtk', 'vtk'),
		('vtu', 'vtu'),
		('inp', 'abaqus'),
		('mesh', 'medit'),
		('bdf', 'nastran'),
		('ele', 'tetgen'),
	],
)
def testMeshesOfVolumes(ending, form, tmp_path):
	"""A block of two bricks, of hexahedra or tetrahedra, with a point of no cell: the surface is taken."""
	path, points = tmp_path / f'block.{ending}', np.vstack([corners, [(9, 9, 9)]])
	for cells in ([('hexahedron', bricks)], [('tetra', tetrahedra(bricks))]):
		if form != 'tetgen' or cells[0][0] == 'tetra':
			meshio.Mesh(points, cells).write(path, file_format=form)
			made, told = warningsOf(path)
			assert made.shape.volume == pytest.approx(12) and len(made.shape.normals) == 6 and not told
			assert np.array(made.state.pos, float) == pytest.approx([1, 1, 1.5])


def testVolumesOfGmshAreObjects(tmp_path):
	"""The two bricks, which share points and, inside, a face: each is a body."""
	cells, tag = tetrahedra(bricks), np.repeat([7, 3], 6)
	path = tmp_path / 'two.msh'
	data = {'gmsh:physical': [tag], 'gmsh:geometrical': [tag]}
	meshio.Mesh(corners, [('tetra', cells)], cell_data=data).write(path, file_format='gmsh22')
	bodies = polytope.fromMesh(path, parts='objects')
	assert volumes(bodies) == pytest.approx([6, 6])
	contact = polytope.contact(*bodies)
	assert abs(contact.depth) < 1e-12 and abs(contact.normal[0]) == pytest.approx(1)
	assert 'has 2 bodies' in warningsOf(path)[1][0]


def testOtherCells(tmp_path):
	"""Prisms and pyramids, cells of second order, surfaces of triangles and quadrangles."""
	prism = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 2), (1, 0, 2), (0, 1, 2)], float)
	pyramid = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0.5, 0.5, 3)])
	simplex = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], float)
	middles = [(simplex[a] + simplex[b]) / 2 for a, b in ((0, 1), (1, 2), (0, 2), (0, 3), (1, 3), (2, 3))]
	cube = np.array([(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)], float)
	quads = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2)]
	for points, cells, volume in (
		(prism, [('wedge', [range(6)])], 1),
		(pyramid, [('pyramid', [range(5)])], 1),
		(np.vstack([simplex, middles]), [('tetra10', [range(10)])], 1 / 6),
		(cube, [('quad', quads), ('triangle', [(1, 3, 7), (1, 7, 5)])], 1),
	):
		meshio.Mesh(points, [(kind, np.array([list(one) for one in those])) for kind, those in cells]).write(
			tmp_path / 'a.msh', file_format='gmsh22'
		)
		made, told = warningsOf(tmp_path / 'a.msh')
		assert made.shape.volume == pytest.approx(volume) and not told


def testSurfacesOfOtherPrograms(tmp_path):
	before, texts = (
		locale.setlocale(locale.LC_ALL),
		{
			'a.gts': '4 6 4 GtsSurface GtsFace GtsEdge GtsVertex\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 2\n2 3\n3 1\n1 4\n2 4\n3 4\n1 2 3\n1 5 4\n2 6 5\n3 4 6\n',
			'a.smesh': '# part 1\n4 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1 # the last\n4 0\n3 1 2 3\n3 1 2 4\n3 2 3 4\n3 1 3 4\n0\n0\n',
			'a.vtk': '# vtk DataFile Version 3.0\nx\nASCII\nDATASET POLYDATA\nPOINTS 4 double\n0 0 0\n1 0 0\n0 1 0\n0 0 1\nPOLYGONS 4 16\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n',
		},
	)
	for name, text in texts.items():
		(tmp_path / name).write_text(text)
		made, told = warningsOf(tmp_path / name)
		assert made.shape.volume == pytest.approx(1 / 6) and not told
	assert locale.setlocale(locale.LC_ALL) == before, 'readers leave the process as it was'


@pytest.mark.parametrize(
	'name, text, words',
	[
		('a.obj', 'v 0 0 0\nv 1 0\n', "line 2: 'v 1 0' is no vertex or face"),
		('a.obj', 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 7\n', 'a triangle has a vertex that is not there; there are 4'),
		('a.obj', 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 nan\nf 1 2 3\n', 'has a vertex that is not finite'),
		('a.off', 'OFF\n4 1 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 9\n', 'cannot be read as a mesh'),
		('a.off', 'OFF\n4 4 0\n0 0 0\n1 0 0\n', 'cannot be read as a mesh'),
		(
			'a.ply',
			'ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 5\n',
			'cannot be read as a mesh',
		),
		('a.ply', 'ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nend_header\n', 'cannot be read as a mesh|has no vertices'),
		('a.smesh', '4 3 0 0\n1 0 0 0\n', 'it ends before its points and facets do'),
		('a.msh', 'no mesh', 'cannot be read as a mesh'),
		('a.vtk', 'no mesh', 'cannot be read as a mesh'),
		('a.vtu', '<VTKFile', 'cannot be read as a mesh'),
		('a.gts', 'no mesh', 'cannot be read as a mesh'),
		('a.gts', '4 6 4 GtsSurface\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 2\n', 'it ends before its points, edges and triangles do'),
		('a.ele', '1 4 0\n1 1 2 3 4\n', 'cannot be read as a mesh'),
		('a.csv', 'x,y,z\n0,0,0\n', 'cannot be read as a mesh'),
		('a.tess', '***tess', 'is a tessellation of Neper, no mesh; polytope.readShapes reads it'),
	],
	ids=lambda value: value if len(value) < 9 else 'text',
)
def testWhatIsNoMeshIsRefused(name, text, words, tmp_path, capfd):
	(tmp_path / name).write_text(text)
	for make in (polytope.fromMesh, polytope.terrain):
		with pytest.raises(ValueError, match=f'^(path|heights): .*{name}.*({words})'):
			make(tmp_path / name)
	assert len(O.bodies) == 0 and capfd.readouterr().out == ''


@pytest.mark.parametrize('place', [(0, 0, 0), utm], ids=['origin', 'UTM'])
def testAWallOfBlocksOfOneFileStands(place, tmp_path):
	"""Eight blocks that share faces, as an assembly is exported, on a floor: it carries their weight, by default settings, wherever they are."""
	O.reset()
	joint()
	blocks = [box((0.5, 0.5, 0.5), (x / 2, y / 2, z / 2 + 0.25)) for z in range(2) for x in range(2) for y in range(2)]
	path = writeObj(tmp_path / 'wall.obj', trimesh.util.concatenate(blocks).apply_translation(place))
	x, y, z = map(float, place)
	floor = O.bodies.append(polytope.cuboid((x, y, z - 0.5), (2, 2, 0.5), fixed=True))
	ids = O.bodies.append(polytope.fromMesh(path, parts='objects'))
	weight = 9.81 * sum(float(O.bodies[k].state.mass) for k in ids)
	assert weight == pytest.approx(9.81 * 2600, rel=1e-6)
	O.engines = polytope.engines()
	while O.time < 1:
		O.run(200, wait=True)
	carried = sum(float(i.phys.normalForce.norm()) for i in O.interactions if floor in (i.id1, i.id2))
	assert carried == pytest.approx(weight, rel=1e-3)
	for k in ids:
		# sunk by the weight above over stiffness and area
		moved = O.bodies[k].state.pos - O.bodies[k].state.refPos
		assert abs(moved[0]) + abs(moved[1]) < 1e-6 and 0 < -float(moved[2]) < 3 * 9.81 * 2600 / 1e8


def testMessagesSayWhatAFileIsNot(tmp_path):
	"""A binary file that ends early is no text, and formats are named where the file's is unknown."""
	cube = trimesh.creation.box((1, 1, 1))
	cube.export(tmp_path / 'whole.stl')
	content = (tmp_path / 'whole.stl').read_bytes()
	(tmp_path / 'half.stl').write_bytes(content[: len(content) // 2])
	with pytest.raises(
		ValueError, match='^path: .*half.stl. (cannot be read as a mesh .*(end early|expected)|has no vertices)'
	):  # the latter where chardet is installed
		polytope.fromMesh(tmp_path / 'half.stl')
	with pytest.raises(ValueError, match='^path: .* is a folder; give the path of a file in it'):
		polytope.fromMesh(tmp_path)
	(tmp_path / 'what.foo').write_text('0 0 0\n')
	with pytest.raises(ValueError, match='^path: .*what.foo. cannot be read as a mesh .*[.]3mf, .*[.]stl'):
		polytope.fromMesh(tmp_path / 'what.foo')


def testGtsHasTwoSignsForCommentsAndEdgesThatAreThere(tmp_path):
	corners, edges = ['0 0 0', '1 0 0', '0 1 0', '0 0 1'], ['1 2', '1 3', '1 4', '2 3', '2 4', '3 4']
	for faces, good in ((['1 4 2', '1 5 3', '2 6 3', '4 6 5'], True), (['1 4 2', '1 5 3', '2 6 9', '4 6 5'], False)):
		(tmp_path / 'solid.gts').write_text('\n'.join(['! of GTS', '4 6 4 # numbers', *corners, *edges, *faces]) + '\n')
		if good:
			assert float(polytope.fromMesh(tmp_path / 'solid.gts').shape.volume) == pytest.approx(1 / 6, rel=1e-12)
		else:
			with pytest.raises(ValueError, match='^path: .*solid.gts. cannot be read as a mesh'):
				polytope.fromMesh(tmp_path / 'solid.gts')


def testAFileWithTooFewDigitsForAnyBodySaysSo(tmp_path):
	"""The body's corners fall together far from the origin: the remedy is that of the file, not of the shape."""
	corners = [(x, y, z) for x in (0, 0.3) for y in (0, 0.3) for z in (0, 0.3)]
	faces = ['1 2 4 3', '5 7 8 6', '1 5 6 2', '3 4 8 7', '1 3 7 5', '2 6 8 4']
	lines = ['v ' + ' '.join(f'{4e6 + x:.6g}' for x in corner) for corner in corners] + ['f ' + face for face in faces]
	(tmp_path / 'cube.obj').write_text('\n'.join(lines) + '\n')
	with pytest.raises(ValueError, match='^path: .* too few digits: write it in double precision'):
		polytope.fromMesh(tmp_path / 'cube.obj')
