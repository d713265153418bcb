# SPDX-License-Identifier: GPL-2.0-or-later
"""PolytopeVTKRecorder: its files are read back with VTK's own readers and compared with the scene."""

import os
import xml.etree.ElementTree

import numpy as np
import pytest
import vtk
from scenes import joint, loop, withPolytopes
from vtk.util.numpy_support import vtk_to_numpy
from yade import (
	FrictMat,
	Ig2_Box_Sphere_ScGeom,
	Ig2_Facet_Sphere_ScGeom,
	Ig2_Sphere_Sphere_ScGeom,
	Ig2_Wall_Sphere_ScGeom,
	O,
	PolytopeGeom,
	PolytopeVTKRecorder,
	Quaternion,
	polytope,
	utils,
)


def readBodies(path):
	reader = vtk.vtkXMLUnstructuredGridReader()
	reader.SetFileName(str(path))
	reader.Update()
	return reader.GetOutput()


def readContacts(path):
	reader = vtk.vtkXMLPolyDataReader()
	reader.SetFileName(str(path))
	reader.Update()
	return reader.GetOutput()


def arraysOf(attributes):
	return {attributes.GetArrayName(k): vtk_to_numpy(attributes.GetArray(k)) for k in range(attributes.GetNumberOfArrays())}


def surfaceOf(grid, cell):
	"""Triangles of one cell's faces."""
	pick = vtk.vtkExtractCells()
	pick.SetInputData(grid)
	pick.AddCellRange(cell, cell)
	surface = vtk.vtkGeometryFilter()
	surface.SetInputConnection(pick.GetOutputPort())
	triangles = vtk.vtkTriangleFilter()
	triangles.SetInputConnection(surface.GetOutputPort())
	triangles.Update()
	return triangles.GetOutput()


def openEdges(surface):
	edges = vtk.vtkFeatureEdges()
	edges.SetInputData(surface)
	edges.FeatureEdgesOff()
	edges.ManifoldEdgesOff()
	edges.Update()
	return edges.GetOutput().GetNumberOfCells()


def volumeOf(surface):
	properties = vtk.vtkMassProperties()
	properties.SetInputData(surface)
	return properties.GetVolume()


@pytest.fixture
def someBodies():
	"""One of each regular solid, turned, and a pentagon; distinct values in every field."""
	O.materials.append(FrictMat(density=2600))
	O.materials.append(FrictMat(density=2000))
	for k, faces in enumerate((4, 6, 8, 12, 20)):
		body = polytope.regular(
			faces,
			0.1 * (k + 1),
			center=(k, 2, -1),
			orientation=Quaternion((1, k, 2), 0.3 * k),
			material=k % 2,
			mask=1 << k,
			color=(0.2 * k, 0.5, 1),
			velocity=(k, -1, 2),
			angularVelocity=(0, k, 1),
			fixed=faces == 6,
		)
		O.bodies.append(body)
	O.bodies.append(polytope.polygon([(0, 0), (1, 0), (1.4, 0.7), (0.5, 1.5), (-0.3, 0.8)], thickness=0.3))
	O.bodies[2].state.refPos = O.bodies[2].state.pos - (0.5, 0, 0)


@pytest.mark.parametrize('options', [{}, {'ascii': True}, {'compress': False}])
def testBodiesComeBackAsClosedSolidsWithTheirData(tmp_path, someBodies, options):
	PolytopeVTKRecorder(fileName=f'{tmp_path}/run-', **options)()
	grid = readBodies(tmp_path / 'run-bodies.0.vtu')
	assert grid.GetNumberOfCells() == len(O.bodies)
	data = arraysOf(grid.GetCellData())
	for body in O.bodies:
		k = body.id
		assert grid.GetCellType(k) == vtk.VTK_POLYHEDRON
		assert grid.GetCell(k).GetNumberOfFaces() == len(body.shape.faces)
		surface = surfaceOf(grid, k)
		assert openEdges(surface) == 0
		assert volumeOf(surface) == pytest.approx(body.shape.volume, rel=1e-9)
		assert data['id'][k] == k and data['mask'][k] == body.mask and data['materialId'][k] == body.material.id
		assert data['dynamic'][k] == body.dynamic
		assert data['mass'][k] == pytest.approx(body.state.mass)
		assert list(data['velocity'][k]) == pytest.approx(list(body.state.vel))
		assert list(data['angularVelocity'][k]) == pytest.approx(list(body.state.angVel))
		assert list(data['displacement'][k]) == pytest.approx(list(body.state.pos - body.state.refPos))
		assert list(data['color'][k]) == pytest.approx([255 * c for c in body.shape.color], abs=1)
	bounds = grid.GetBounds()
	corners = [b.state.pos + b.state.ori * v for b in O.bodies for v in b.shape.vertices]
	assert list(bounds) == pytest.approx([f(c[k] for c in corners) for k in range(3) for f in (min, max)], abs=1e-12)


def testContactsComeBackWithTheirForces(tmp_path):
	joint()
	O.bodies.append(polytope.cuboid((0, 0, -0.5), (2, 2, 0.5), fixed=True))
	for k in range(3):
		O.bodies.append(polytope.cuboid((0.1 * k, 0, 0.5 + 0.999 * k), (0.5, 0.4, 0.5)))
	loop(perArea=True, gravity=(0.5, 0, -9.81))
	O.dt = 1e-4
	for _ in range(20):
		O.step()
	PolytopeVTKRecorder(fileName=f'{tmp_path}/')()
	data = readContacts(tmp_path / f'contacts.{O.iter}.vtp')
	assert data.GetNumberOfPoints() == data.GetNumberOfCells() == 3
	arrays = arraysOf(data.GetPointData())
	names = data.GetFieldData().GetAbstractArray('statusNames')
	for k in range(3):
		contact = O.interactions[int(arrays['id1'][k]), int(arrays['id2'][k])]
		assert list(data.GetPoint(k)) == pytest.approx(list(contact.geom.contactPoint))
		assert list(arrays['normal'][k]) == pytest.approx(list(contact.geom.normal))
		assert list(arrays['normalForce'][k]) == pytest.approx(list(contact.phys.normalForce))
		assert list(arrays['shearForce'][k]) == pytest.approx(list(contact.phys.shearForce))
		assert arrays['depth'][k] == pytest.approx(contact.geom.penetrationDepth)
		assert arrays['area'][k] == pytest.approx(contact.geom.contactArea)
		assert arrays['infeasibility'][k] == pytest.approx(contact.geom.infeasibility)
		assert names.GetValue(int(arrays['status'][k])) == contact.geom.status


def testContactsOfSpheresAndOfPolytopesStandInOneFile(tmp_path):
	"""A sphere on a sphere, on a facet, a box and a wall, and one on a cuboid: the forces that YADE keeps, its weight each, in the same columns."""
	O.materials.append(FrictMat(density=2600, young=1e8, poisson=0.3, frictionAngle=0.5))
	O.bodies.append(utils.sphere((0, 0, 0), 0.5, fixed=True))
	O.bodies.append(utils.facet([(3, -1, 0.4), (6, -1, 0.4), (4, 3, 0.4)], fixed=True))
	O.bodies.append(utils.box((8, 0, 0), (1, 1, 0.4), fixed=True))
	O.bodies.append(utils.wall(-2, 2, sense=1))
	O.bodies.append(polytope.cuboid((16, 0, 0), (1, 1, 0.4), fixed=True))
	supports = len(O.bodies)
	for place in ((0, 0, 1), (4, 0, 0.9), (8, 0, 0.9), (12, 0, -1.5), (16, 0, 0.9)):
		O.bodies.append(utils.sphere(place, 0.5))
	own = [Ig2_Sphere_Sphere_ScGeom(), Ig2_Facet_Sphere_ScGeom(), Ig2_Box_Sphere_ScGeom(), Ig2_Wall_Sphere_ScGeom()]
	mixed = [functor() for functor in withPolytopes]
	O.engines = polytope.engines(geometry=own + mixed, damping=0.6)
	polytope.run(until=0.5)
	recorder = PolytopeVTKRecorder(fileName=f'{tmp_path}/')
	recorder()
	data = readContacts(tmp_path / f'contacts.{O.iter}.vtp')
	arrays = arraysOf(data.GetPointData())
	names = data.GetFieldData().GetAbstractArray('statusNames')
	assert sorted(zip(arrays['id1'].tolist(), arrays['id2'].tolist())) == sorted((i.id1, i.id2) for i in O.interactions)
	assert {max(pair) for pair in zip(arrays['id1'], arrays['id2'])} == set(range(supports, len(O.bodies)))
	for k in range(data.GetNumberOfPoints()):
		contact = O.interactions[int(arrays['id1'][k]), int(arrays['id2'][k])]
		assert list(data.GetPoint(k)) == pytest.approx(list(contact.geom.contactPoint))
		assert list(arrays['normal'][k]) == pytest.approx(list(contact.geom.normal))
		assert list(arrays['normalForce'][k]) == pytest.approx(list(contact.phys.normalForce))
		assert list(arrays['shearForce'][k]) == pytest.approx(list(contact.phys.shearForce))
		assert arrays['depth'][k] == pytest.approx(float(contact.geom.penetrationDepth)) and arrays['depth'][k] > 0
		up = 1 if contact.id2 >= supports else -1  # forces are those on the second body
		weight = 9.81 * O.bodies[max(contact.id1, contact.id2)].state.mass
		assert list(up * arrays['normalForce'][k]) == pytest.approx([0, 0, weight], rel=1e-3, abs=1e-3 * weight)
		ofPolytope = type(contact.geom) is PolytopeGeom
		assert arrays['area'][k] == (float(contact.geom.contactArea) if ofPolytope else 0)
		assert arrays['infeasibility'][k] == (float(contact.geom.infeasibility) if ofPolytope else 0)
		assert names.GetValue(int(arrays['status'][k])) == 'contact'
	PolytopeVTKRecorder(fileName=f'{tmp_path}/none-', mask=4)()
	assert readContacts(tmp_path / f'none-contacts.{O.iter}.vtp').GetNumberOfPoints() == 0


def testBlocksOfALargeSceneComeBackBitForBit(tmp_path):
	"""There are so many bodies that columns are compressed in several blocks; the file names a compressor that every reader knows."""
	joint()
	for k in range(4096):
		place = (0.999 * (k % 16), 1.01 * (k // 16 % 16), k // 256)
		O.bodies.append(polytope.cuboid(place, (0.5, 0.5, 0.5), velocity=(k, 0, 1 / (k + 1))))
	loop()
	O.dt = 1e-7
	O.run(2, True)
	PolytopeVTKRecorder(fileName=f'{tmp_path}/')()
	files = [tmp_path / f'{name}.{O.iter}.{kind}' for name, kind in (('bodies', 'vtu'), ('contacts', 'vtp'))]
	assert all(b'compressor="vtkZLibDataCompressor"' in file.read_bytes()[:300] for file in files)
	bodies, contacts = polytope.arrays()
	grid = readBodies(files[0])
	data = arraysOf(grid.GetCellData())
	for name, column in (('id', bodies.ids), ('velocity', bodies.velocities), ('angularVelocity', bodies.angularVelocities)):
		assert (data[name] == column).all(), name
	corners = vtk_to_numpy(grid.GetPoints().GetData())
	assert corners.nbytes > 2 * 2**18 and grid.GetNumberOfCells() == 4096
	assert corners.reshape(4096, 8, 3).mean(axis=1) == pytest.approx(bodies.positions, abs=1e-12)
	data = readContacts(files[1])
	assert data.GetNumberOfPoints() == len(contacts.ids) > 3000
	assert (vtk_to_numpy(data.GetPoints().GetData()) == contacts.points).all()
	fields = arraysOf(data.GetPointData())
	columns = [('id1', contacts.ids[:, 0]), ('normal', contacts.normals), ('depth', contacts.depths)]
	for name, column in (*columns, ('normalForce', contacts.normalForces), ('shearForce', contacts.shearForces)):
		assert (fields[name] == column).all(), name


def seriesIn(path):
	"""[(time, file)] of a .pvd list."""
	return [(float(e.get('timestep')), e.get('file')) for e in xml.etree.ElementTree.parse(path).iter('DataSet')]


def testSeriesListsEverySnapshotOnceWithItsTime(tmp_path, someBodies):
	recorder = PolytopeVTKRecorder(fileName=f'{tmp_path}/deep/folder/x.', iterPeriod=3)
	O.engines = [recorder]
	O.dt = 0.25
	for _ in range(8):
		O.step()
	for recorded, extension in (('bodies', 'vtu'), ('contacts', 'vtp')):
		series = seriesIn(tmp_path / f'deep/folder/x.{recorded}.pvd')
		assert series == [(0.25 * k, f'x.{recorded}.{k}.{extension}') for k in (0, 3, 6)]
		assert all(os.path.exists(tmp_path / 'deep/folder' / file) for _, file in series)


def testSeriesGoesOnAfterLoadAndStartsAgainWithTheSimulation(tmp_path, someBodies):
	O.engines = [PolytopeVTKRecorder(fileName=f'{tmp_path}/', iterPeriod=2, recorders=['bodies'], label='recorder')]
	O.dt = 0.5
	for _ in range(3):
		O.step()
	O.save(str(tmp_path / 'scene.xml'))
	for _ in range(4):
		O.step()
	assert [t for t, _ in seriesIn(tmp_path / 'bodies.pvd')] == [0, 1, 2, 3]
	O.load(str(tmp_path / 'scene.xml'))
	recorder = O.engines[0]
	assert type(recorder) is PolytopeVTKRecorder and recorder.steps == [0, 2] and recorder.iterPeriod == 2
	for _ in range(2):
		O.step()
	assert [t for t, _ in seriesIn(tmp_path / 'bodies.pvd')] == [0, 1, 2]
	assert not (tmp_path / 'contacts.pvd').exists()


def testOnlyBodiesAskedForAreRecorded(tmp_path, someBodies):
	PolytopeVTKRecorder(fileName=f'{tmp_path}/mask-', mask=0b101)()
	PolytopeVTKRecorder(fileName=f'{tmp_path}/moving-', skipNondynamic=True)()

	def idsIn(name):
		return list(vtk_to_numpy(readBodies(tmp_path / name).GetCellData().GetArray('id')))

	assert idsIn('mask-bodies.0.vtu') == [b.id for b in O.bodies if b.mask & 0b101]
	assert idsIn('moving-bodies.0.vtu') == [b.id for b in O.bodies if b.dynamic]


def testBodiesOfPeriodicSceneAreInsideTheCell(tmp_path):
	O.materials.append(FrictMat(density=2600))
	O.periodic = True
	O.cell.setBox(2, 2, 2)
	O.bodies.append(polytope.regular(8, 0.1, center=(5, -1, 0.5)))
	PolytopeVTKRecorder(fileName=f'{tmp_path}/')()
	bounds = readBodies(tmp_path / 'bodies.0.vtu').GetBounds()
	assert [(bounds[2 * k] + bounds[2 * k + 1]) / 2 for k in range(3)] == pytest.approx([1, 1, 0.5])


def testEmptySceneGivesFilesWithoutCells(tmp_path):
	PolytopeVTKRecorder(fileName=f'{tmp_path}/')()
	assert readBodies(tmp_path / 'bodies.0.vtu').GetNumberOfCells() == 0
	assert readContacts(tmp_path / 'contacts.0.vtp').GetNumberOfCells() == 0


def testRefusesWhatItCannotDo(tmp_path):
	with pytest.raises(ValueError, match="recorders: must be among 'bodies', 'contacts', 'bonds' and 'bolts', not 'spheres'"):
		PolytopeVTKRecorder(recorders=['spheres'])
	recorder = PolytopeVTKRecorder(recorders=['bodies'])
	with pytest.raises(ValueError, match='recorders'):
		recorder.recorders = ['bodies', 'all']
	assert recorder.recorders == ['bodies']
	(tmp_path / 'file').write_text('')
	with pytest.raises(RuntimeError, match='file'):
		PolytopeVTKRecorder(fileName=f'{tmp_path}/file/x')()


def testBondsAreReadBack(tmp_path):
	"""Areas where the first body has carried them, state, force and stresses; a failed one stays, one of an erased body does not."""
	joint(normalStiffness=1e9, shearStiffness=5e8)
	O.bodies.append([polytope.cuboid((k, 0, 0), (0.5, 0.4, 0.3), fixed=k == 0) for k in range(4)])
	loop(True)
	assert polytope.bond(tensileStrength=1e7, cohesion=1e7) == 3
	O.dt = 1e-5
	O.bodies[1].state.pos += (1e-4, 0, 0)
	O.bodies[2].state.pos += (1e-4, 0, 0)
	O.bodies[3].state.pos += (0.1, 0, 0)
	recorder = PolytopeVTKRecorder(fileName=str(tmp_path / 'r-'), recorders=['bonds'], ascii=True)
	O.step()
	recorder()
	(file,) = tmp_path.glob('r-bonds.*.vtp')
	data = readContacts(file)
	cells, bonds = arraysOf(data.GetCellData()), polytope.bonds().bonds
	assert cells['id1'].tolist() == [0, 1, 2] and cells['id2'].tolist() == [1, 2, 3] and cells['state'].tolist() == [0, 0, 1]
	assert cells['normalStress'] == pytest.approx([1e5, 0, 0], rel=1e-9, abs=1e-3) and cells['edgeStress'][0] == pytest.approx(1e5)
	assert cells['force'][0] == pytest.approx([-1e5 * 0.48, 0, 0], rel=1e-9) and cells['energy'][0] == pytest.approx(float(bonds[0].energy))
	names = data.GetFieldData().GetAbstractArray('stateNames')
	assert [names.GetValue(k) for k in range(3)] == ['intact', 'tension', 'shear']
	for k in range(3):
		corners = vtk_to_numpy(data.GetCell(k).GetPoints().GetData())
		assert len(corners) == 4 and corners[:, 0] == pytest.approx(float(O.bodies[k].state.pos[0]) + 0.5, abs=1e-9)
		assert sorted({round(float(y), 6) for y in corners[:, 1]}) == [-0.4, 0.4]
	assert (tmp_path / 'r-bonds.pvd').exists()
	O.bodies.erase(3)
	O.step()
	recorder()
	newest = max(tmp_path.glob('r-bonds.*.vtp'), key=lambda path: int(path.name.split('.')[1]))
	assert arraysOf(readContacts(newest).GetCellData())['id2'].tolist() == [1, 2]


def testBoltsAreReadBack(tmp_path):
	"""Elements of steel between the stations where the blocks have carried them, with their forces; what is at an erased block is left out."""
	joint()
	O.bodies.append([polytope.cuboid((2.1 * k, 0, 0), (1, 0.5, 0.5), fixed=k == 0) for k in range(3)])
	loop(True)
	polytope.bolt((-0.5, 0, 0), (2.0, 0, 0), area=5e-4, youngsModulus=2e11)
	grouted = polytope.bolt(
		(-0.5, 0.2, 0), (5, 0.2, 0), area=5e-4, youngsModulus=2e11, grout=polytope.Grout(1e9, 1e6), dowel=polytope.Dowel(1e8, 1e6)
	)
	O.dt = 1e-12
	for k in (1, 2):
		O.bodies[k].state.pos += (1e-3, 0, 2e-3)
	recorder = PolytopeVTKRecorder(fileName=str(tmp_path / 'r-'), recorders=['bolts'], ascii=True)
	O.step()
	recorder()
	(file,) = tmp_path.glob('r-bolts.*.vtp')
	data, arrays = readContacts(file), polytope.boltArrays()
	cells = arraysOf(data.GetCellData())
	assert cells['bolt'].tolist() == arrays.bolts.tolist() and cells['bolt'][0] == 0
	assert cells['force'] == pytest.approx(arrays.forces) and cells['strain'] == pytest.approx(arrays.strains)
	assert cells['force'][0] == pytest.approx(1e8 / 2.5 * (np.hypot(2.501, 2e-3) - 2.5), rel=1e-6)
	sheared = cells['shearForce'][np.abs(cells['shearForce']).sum(axis=1) > 0]
	assert sheared[0] == pytest.approx([0, 0, -2e5], abs=1e-2) and cells['radius'][0] == pytest.approx((5e-4 / np.pi) ** 0.5)
	ends = vtk_to_numpy(data.GetCell(0).GetPoints().GetData())
	assert ends == pytest.approx(np.array([(-0.5, 0, 0), (2.001, 0, 2e-3)]), abs=1e-9)
	last = vtk_to_numpy(data.GetCell(data.GetNumberOfCells() - 1).GetPoints().GetData())
	assert last[1] == pytest.approx(np.array([float(grouted.stations[-1]) - 0.5 + 1e-3, 0.2, 2e-3]), abs=1e-9)
	O.bodies.erase(2)
	O.step()
	recorder()
	newest = max(tmp_path.glob('r-bolts.*.vtp'), key=lambda path: int(path.name.split('.')[1]))
	fewer = readContacts(newest)
	assert 0 < fewer.GetNumberOfCells() < data.GetNumberOfCells()
	assert max(vtk_to_numpy(fewer.GetPoints().GetData())[:, 0]) < 3.2
