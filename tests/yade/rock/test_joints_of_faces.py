# SPDX-License-Identifier: GPL-2.0-or-later
"""Faces and contacts remember the joint that made them: arrays, pictures, files for ParaView."""

from math import pi, radians

import matplotlib.image
import numpy as np
import pytest
import vtk
from vtk.util.numpy_support import vtk_to_numpy
from yade import FrictMat, O, Polytope, RockJointMat, polytope
from yade.polytope import Joint, JointSet
from yade.polytope.pictures.faceColors import faceColors, palette
from yade.polytope.pictures.faces import collect
from yade.polytope.pictures.looks import usualFixedColor

box = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
density, gravity = 2600, 9.81


def rgb(color):
	return [int(color[k : k + 2], 16) for k in (1, 3, 5)]


def scattered():
	O.materials.append(FrictMat(density=density))
	sets = [JointSet(radians(30), pi / 2, 3, fisher=80), JointSet(radians(80), radians(250), 4, fisher=80)]
	rock = polytope.jointedRock(box, [6, 6, 5, 5, 4, 4], [*sets, JointSet(radians(85), 0, p32=0.25, radius=4)], seed=4)
	rock.append()
	return rock


def cubes(fixed=False):
	"""Eight of 1 m, between three joints of one set each, on a plate; in a scene with gravity."""
	O.materials.append(RockJointMat(density=density, normalStiffness=1e9, shearStiffness=5e8, frictionAngle=radians(35)))
	rock = polytope.jointedRock(box, [1] * 6, [Joint(0, 0, (0, 0, 0)), Joint(pi / 2, pi / 2, (0, 0, 0)), Joint(pi / 2, 0, (0, 0, 0))])
	rock.append()
	O.bodies.append(polytope.cuboid((0, 0, -1.5), (2, 2, 0.5), fixed=True))
	O.engines = polytope.engines(gravity=(0, 0, -gravity))
	return rock


def polytopes():
	return [body for body in O.bodies if isinstance(body.shape, Polytope)]


def planes(body):
	"""(normals, offsets) in the world."""
	normals = np.array([body.state.ori * normal for normal in body.shape.normals], float)
	return normals, np.array(body.shape.offsets, float) + normals @ np.array(body.state.pos, float)


def testEachFaceLiesOnItsJoint():
	rock, of = scattered(), {-1: 0, 0: 0, 1: 0, 2: 0}
	assert any(len(parts) > 1 for parts in rock.bodies), 'parts of a clump are among them'
	for body in polytopes():
		joints, sets = rock.jointsOfFaces(body), rock.setsOfFaces(body)
		for normal, offset, joint, number in zip(*planes(body), joints, sets, strict=True):
			of[int(number)] += 1
			if joint < 0:
				assert number == -1 and np.abs(normal).max() == pytest.approx(1)
				assert offset == pytest.approx(np.abs(normal) @ (6, 5, 4))
			else:
				assert number == rock.sets[joint]
				side = np.sign(normal @ rock.joints[joint, :3])
				assert side * np.append(normal, offset) == pytest.approx(rock.joints[joint], abs=1e-9)
	assert min(of.values()) > 4, of


def testBodiesThatAreNotTheRocksHaveNoJoint():
	rock = cubes()
	assert list(rock.setsOfFaces(O.bodies[8])) == [-1] * 6
	O.reset()
	O.materials.append(FrictMat(density=density))
	assert len(O.bodies) == O.bodies.append(polytope.regular(6, 1, orientation=None)) == 0
	O.bodies.append(polytope.regular(8, 1))
	assert list(rock.jointsOfFaces(O.bodies[1])) == [-1] * 8, 'of another scene'


@pytest.mark.parametrize('normal', [(0.1, 0.2, 1), (0, 0, 1)], ids=['oblique', 'along a joint'])
def testPiecesKeepJointsAndMaterialsOfWhatIsLeftOfFaces(normal):
	for k in range(2):
		O.materials.append(RockJointMat(density=density, normalStiffness=1e9, shearStiffness=1e9, frictionAngle=radians(40 - 15 * k)))
	rock = polytope.jointedRock(box, [1] * 6, [Joint(0, 0, (0, 0, 0)), Joint(pi / 2, 0.3, (0, 0, 0))])
	first = rock.append(material=0, jointMaterials=[1, None])[0]
	unit, middle = np.array(normal) / np.linalg.norm(normal), np.array(O.bodies[first].state.pos, float)
	fresh, found = 0, set()
	for piece in (O.bodies[k] for k in polytope.split(first, normal)):
		for one, offset, joint, material in zip(*planes(piece), rock.jointsOfFaces(piece), piece.shape.faceMaterials, strict=True):
			of = [
				k for k, plane in enumerate(rock.joints) if np.allclose(np.sign(one @ plane[:3]) * np.append(one, offset), plane, atol=1e-9)
			]
			assert [joint] == (of or [-1]) and material == (1 if joint == 0 else -1)
			fresh += abs(abs(one @ unit) - 1) < 1e-9 and abs(offset - one @ middle) < 1e-9
			found.add(int(joint))
	assert fresh == 2 and found == {-1, 0, 1}


def testInitialStressKeepsTheJointsOfFaces():
	rock = cubes()
	for axis in range(3):
		for side in (1, -1):
			if (axis, side) != (2, -1):
				middle, half = np.eye(3)[axis] * side * 1.5, 1 + (np.arange(3) > axis) - 0.5 * (np.arange(3) == axis)
				O.bodies.append(polytope.cuboid(middle, half, fixed=True))
	before = [rock.jointsOfFaces(O.bodies[k]).tolist() for k in range(8)]
	O.engines = polytope.engines(gravity=(0, 0, 0))
	polytope.inSitu(-1e6 * np.eye(3))
	assert [rock.jointsOfFaces(O.bodies[k]).tolist() for k in range(8)] == before


def testForcesBySetBearWhatLiesAboveThem():
	"""The four blocks above the level joint weigh on it, all eight on the plate, which no joint has made; nothing presses sideways."""
	rock = cubes()
	polytope.settle()
	contacts, sets = polytope.arrays().contacts, rock.contactSets()
	assert len(sets) == len(contacts.ids) and list(rock.sets[rock.contactJoints()[sets >= 0]]) == list(sets[sets >= 0])
	vertical = np.abs(contacts.normalForces[:, 2])
	assert vertical[sets == 0].sum() == pytest.approx(4 * density * gravity, rel=1e-3)
	assert vertical[sets == -1].sum() == pytest.approx(8 * density * gravity, rel=1e-3)
	assert (sets == 0).sum() == (sets == -1).sum() == 4
	for number, axis in ((1, 0), (2, 1)):
		assert np.abs(contacts.normals[sets == number][:, axis]) == pytest.approx(1)


def testParaViewHasASetForEachFace(tmp_path):
	rock = scattered()
	rock.writeFaces(tmp_path / 'new' / 'faces.0.vtp')
	reader = vtk.vtkXMLPolyDataReader()
	reader.SetFileName(str(tmp_path / 'new' / 'faces.0.vtp'))
	reader.Update()
	found = reader.GetOutput()
	size = vtk.vtkCellSizeFilter()
	size.SetInputData(found)
	size.Update()
	data = size.GetOutput().GetCellData()
	column = {data.GetArrayName(k): vtk_to_numpy(data.GetArray(k)) for k in range(data.GetNumberOfArrays())}
	assert found.GetNumberOfCells() == sum(len(body.shape.normals) for body in polytopes())
	for number in range(2):  # joints through the whole rock, each with a face on either side
		assert column['Area'][column['set'] == number].sum() == pytest.approx(2 * rock.sections[rock.sets == number].sum(), rel=1e-9)
	# parts of one convex block are put together again, and have no faces there
	assert 10 < column['Area'][column['set'] == 2].sum() < 2 * rock.sections[rock.sets == 2].sum()
	assert column['Area'][column['set'] == -1].sum() == pytest.approx(2 * (12 * 10 + 12 * 8 + 10 * 8), rel=1e-9)
	assert list(rock.sets[column['joint'][column['joint'] >= 0]]) == list(column['set'][column['set'] >= 0])
	assert set(column['id'].tolist()) == {body.id for body in polytopes()} and set(column['material'].tolist()) == {0}


def testParaViewHasTheMaterialOfEachFace(tmp_path):
	for k in range(2):
		O.materials.append(RockJointMat(density=density, normalStiffness=1e9, shearStiffness=1e9, frictionAngle=radians(40 - 15 * k)))
	rock = polytope.jointedRock(box, [1] * 6, [Joint(0, 0, (0, 0, 0)), Joint(pi / 2, 0, (0, 0, 0))])
	rock.append(material=0, jointMaterials=[1, None])
	rock.writeFaces(tmp_path / 'faces.vtp')
	reader = vtk.vtkXMLPolyDataReader()
	reader.SetFileName(str(tmp_path / 'faces.vtp'))
	reader.Update()
	data = reader.GetOutput().GetCellData()
	sets, materials = (vtk_to_numpy(data.GetArray(name)) for name in ('set', 'material'))
	assert list(materials) == list(np.where(sets == 0, 1, 0)) and (sets == 0).sum() == 4


def testFacesAreDrawnInTheColourOfTheirSet():
	rock = scattered()
	bodies = polytopes()
	mesh = collect(bodies, faceColors(bodies, rock.setsOfFaces, None).of)['solid']
	grey = np.round(255 * np.array(usualFixedColor)).astype(int).tolist()
	corners = np.split(mesh['connectivity'], mesh['offsets'][1:-1])
	seen = set()
	for color, face in zip(mesh['colors'].tolist(), corners, strict=True):
		points = mesh['points'][face]
		on = np.flatnonzero((np.abs(points @ rock.joints[:, :3].T - rock.joints[:, 3]) < 1e-9).all(axis=0))
		assert color == (rgb(palette[rock.sets[on[0]]]) if len(on) else grey)
		seen.add(tuple(color))
	assert len(seen) == 4


def testPictureAndItsLegendShowTheSets(tmp_path):
	rock = cubes()
	for body in O.bodies:
		body.state.pos += 0.6 * body.state.pos  # apart, so that faces of joints are seen
	bodies = [O.bodies[k] for k in range(8)]
	polytope.picture(
		str(tmp_path / 'sets.png'), bodies, colorBy=rock.setsOfFaces, legend='joint set', view=(1, -1, 0.8), size=(400, 300), edges=False
	)
	image = np.round(255 * matplotlib.image.imread(tmp_path / 'sets.png')[:, :, :3]).astype(int)
	scale = image[round(300 * (1 - 0.967)), round(400 * 0.05) : round(400 * 0.40)]
	assert [scale[round(len(scale) * (k + 0.5) / 4)].tolist() for k in range(3)] == [rgb(color) for color in palette[:3]]
	below = image[40:].reshape(-1, 3)
	for color in palette[:3]:  # shaded: of the same hue
		alike = below @ rgb(color) / np.maximum(np.linalg.norm(below, axis=1), 1) / np.linalg.norm(rgb(color))
		assert ((alike > 0.995) & (below.min(axis=1) < 100)).mean() > 0.01


def testManyNumbersHaveAScale():
	scattered()
	bodies = polytopes()
	many = faceColors(bodies, lambda body: np.full(len(body.shape.normals), body.id), None)
	legend = many.legend('number')
	assert (legend['low'], legend['high']) == (0, bodies[-1].id + -bodies[-1].id % 3) and 'labels' not in legend
	assert many.of(bodies[0])[0].tolist() != many.of(bodies[-1])[0].tolist()


def testAFilmHasColoursOfFaces(tmp_path):
	rock = cubes()
	with polytope.animate(str(tmp_path / 'a.gif'), every=5, colorBy=rock.setsOfFaces, legend='set', size=(200, 150)) as film:
		O.run(12, wait=True)
		assert film.frames >= 2
	assert (tmp_path / 'a.gif').stat().st_size > 1000


@pytest.mark.parametrize(
	'given, message',
	[
		({'colorBy': lambda body: [1, 2]}, '^colorBy: must give body 0 a whole number for each of the 6 planes'),
		({'colorBy': lambda body: [0.5] * 6}, '^colorBy: must give body 0 a whole number'),
		({'colorBy': lambda body: [1] * 6, 'valueRange': (0, 1)}, '^valueRange: .* leave it out'),
	],
)
def testBadColoursAreRefused(given, message):
	cubes()
	with pytest.raises(ValueError, match=message):
		polytope.picture('output/never.png', **given)


def testBadFilesAreRefused(tmp_path):
	rock = cubes()
	with pytest.raises(ValueError, match=r'^path: .*\.vtp'):
		rock.writeFaces(tmp_path / 'faces.vtu')
	O.reset()
	with pytest.raises(ValueError, match=r'^O\.bodies: .* append'):
		rock.writeFaces(tmp_path / 'faces.vtp')
