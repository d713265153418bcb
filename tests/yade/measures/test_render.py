# SPDX-License-Identifier: GPL-2.0-or-later
"""Pictures: they show what is in the scene. Colours of pixels are compared, not pictures to the last bit."""

import os
import shutil
import subprocess
import time

import matplotlib.image
import numpy as np
import pytest
from yade import FrictMat, NewtonIntegrator, O, Quaternion, RockJointMat, polytope, utils
from yade.polytope.pictures.camera import against, fromTheFront
from yade.polytope.pictures.faces import _rings, mostSphereFaces
from yade.polytope.pictures.looks import colors, usualFixedColor
from yade.polytope.pictures.still import collect, picture

red, blue = (0.9, 0.1, 0.1), (0.1, 0.2, 0.9)


@pytest.fixture(autouse=True)
def material():
	O.materials.append(FrictMat(density=2600))


def pixels(path):
	return matplotlib.image.imread(path)[:, :, :3]


def drawn(path, **options):
	picture(str(path), **{'size': (300, 200), **options})
	return pixels(path)


def shareLike(image, channel):
	"""Share of the pixels in which this channel is more than twice each of the others."""
	others = [k for k in range(3) if k != channel]
	return np.mean(image[:, :, channel] > 2 * image[:, :, others].max(axis=2))


def testPictureShowsTheBodiesInTheirColours(tmp_path):
	O.bodies.append(polytope.cuboid((0, 0, -0.5), (2, 2, 0.5), fixed=True, color=(0.8, 0.8, 0.8)))
	O.bodies.append(polytope.regular(4, 0.6, center=(-1, 0, 0.3), color=red))
	O.bodies.append(polytope.regular(20, 0.5, center=(1, 0, 0.4), color=blue))
	image = drawn(tmp_path / 'folder' / 'a.png')
	assert image.shape == (200, 300, 3)
	assert shareLike(image, 0) > 0.01 and shareLike(image, 2) > 0.01
	columns = [np.nonzero((image[:, :, k] > 2 * image[:, :, 2 - k]).any(axis=0))[0].mean() for k in (0, 2)]
	assert columns[0] < 150 < columns[1], 'the red one is on the left'
	assert 0.05 < np.mean(image.min(axis=2) > 0.99) < 0.9, 'white around the bodies'


def testBodiesAreDrawnWhereTheyAre(tmp_path):
	"""A cube from the side, in a frame of twice the size of its front, covers a quarter of a square picture."""
	O.bodies.append(polytope.cuboid((5, 6, 7), (0.5, 0.5, 0.5), color=red))
	frame = [(x, 5.5, z) for x in (4, 6) for z in (6, 8)]
	image = drawn(tmp_path / 'a.png', size=(200, 200), view=(0, -1, 0), frame=frame, edges=False)
	covered = np.mean(image.min(axis=2) < 0.9)
	assert covered == pytest.approx(0.25 / 1.04**2, rel=0.02)  # the frame has a margin
	middle = np.argwhere(image.min(axis=2) < 0.9).mean(axis=0)
	assert list(middle) == pytest.approx([100, 100], abs=1)


def testColoursFollowTheValueAskedFor(tmp_path):
	for k in range(2):
		O.bodies.append(polytope.regular(8, 0.5, center=(2 * k, 0, 0), velocity=(3 * k, 0, 0), color=(0, 1, 0)))
	image = drawn(tmp_path / 'a.png', colorBy='speed', view=(0, -1, 0), legend='speed [m/s]')
	left, right = image[60:, :150], image[60:, 150:]
	difference = [part[:, :, 0].astype(float) - part[:, :, 2] for part in (left, right)]
	assert difference[0].min() < -0.1 and difference[0].max() < 0.1, 'slow: blue'
	assert difference[1].max() > 0.1 and difference[1].min() > -0.1, 'fast: red'


@pytest.mark.parametrize('size, speeds', [((1600, 1100), 4), ((1200, 1000), 0.0159)])
def testTextOfTheLegendDoesNotLieOverItsColours(tmp_path, size, speeds):
	"""Dark text; the darkest colour is that of the lowest value."""
	for k in range(2):
		O.bodies.append(polytope.regular(8, 0.5, center=(2 * k, 0, 0), velocity=(speeds * k, 0, 0)))
	image = drawn(tmp_path / 'a.png', colorBy='speed', view=(0, -1, 0), legend='speed [m/s]', size=size)
	bar = image[: size[1] // 8]
	colours = np.ptp(bar, axis=2) > 0.15
	rows, columns = np.nonzero(colours.mean(axis=1) > 0.25)[0], np.nonzero(colours.any(axis=0))[0]
	inside = bar[rows.min() : rows.max() + 1, columns.min() + 1 : columns.max()]
	assert len(rows) > 2 and (inside.max(axis=2) > 0.4).all(), 'nothing darker than the scale'
	assert (bar[rows.max() + 1 :].max(axis=2) < 0.4).any(), 'the text is below'


def testFixedBodiesInFrontDoNotHideTheOthers(tmp_path):
	O.bodies.append(polytope.regular(12, 0.5, color=red))
	O.bodies.append(polytope.cuboid((0, -1, 0), (1, 0.1, 1), fixed=True, color=(0.5, 0.5, 0.5)))
	assert shareLike(drawn(tmp_path / 'auto.png'), 0) > 0.02
	assert shareLike(drawn(tmp_path / 'solid.png', fixed='solid', view=(0, -1, 0)), 0) == 0
	assert shareLike(drawn(tmp_path / 'hidden.png', fixed='hidden', view=(0, -1, 0)), 0) > 0.1


def testNothingIsCutOffWhateverItsStyle(tmp_path):
	"""A body twenty times as wide as the other one is in the picture as edges, too; a frame of one's own is what it says."""
	O.bodies.append(polytope.regular(12, 0.1, color=red))
	O.bodies.append(polytope.cuboid((0, -1, 0), (2, 0.1, 1), fixed=True, color=(0.5, 0.5, 0.5)))

	def drawnAtTheRim(**options):
		image = drawn(tmp_path / 'a.png', view=(0, -1, 0.2), **options).min(axis=2) < 0.95
		assert image.any()
		return image[:, [0, -1]].any() or image[[0, -1]].any()

	for style in ('solid', 'glass', 'wire', 'auto'):
		assert not drawnAtTheRim(fixed=style), style
	assert drawnAtTheRim(fixed='wire', frame=[(-0.1, -0.1, -0.1), (0.1, 0.1, 1)])


def testPolygonsAreSeenAlongZ(tmp_path):
	O.bodies.append(polytope.polygon([(0, 0), (2, 0), (0, 1)], color=red))
	image = drawn(tmp_path / 'a.png')
	lower, upper = image[100:], image[:100]
	assert shareLike(image, 0) > 0.2
	assert shareLike(lower, 0) > 1.5 * shareLike(upper, 0), 'the triangle stands on its long side'


def testOtherShapesOfYadeAreDrawnToo():
	O.bodies.append(utils.sphere((0, 0, 0), 0.5))
	O.bodies.append(utils.box((2, 0, 0), (0.5, 0.5, 0.5)))
	O.bodies.append(utils.facet([(0, 0, 0), (1, 0, 0), (0, 1, 0)]))
	O.bodies.append(utils.wall(0, axis=2))
	meshes = collect(O.bodies)
	assert set(meshes) == {'smooth', 'solid'}
	assert np.linalg.norm(meshes['smooth']['points'], axis=1) == pytest.approx(0.5)
	assert list(meshes['solid']['ids']) == [1] * 6 + [2] + [3]


def testAWallReachesAsFarAsTheOtherBodies():
	O.bodies.append(polytope.cuboid((1, 2, 3), (1, 2, 3)))
	O.bodies.append(utils.wall((0, 0, -5), axis=2))
	O.bodies.append(utils.wall((7, 0, 0), axis=0))
	meshes = collect(O.bodies)['solid']
	points = meshes['points'].reshape(-1, 3)
	below, aside = points[8:12], points[12:16]
	assert (below[:, 2] == -5).all() and (aside[:, 0] == 7).all()
	assert np.ptp(below, axis=0) == pytest.approx([7, 4, 0]) and np.ptp(aside, axis=0) == pytest.approx([0, 4, 11])
	O.bodies.erase(0)
	assert collect([body for body in O.bodies if body]) == {}, 'nothing says how far they reach'


def testUpIsAgainstGravity():
	O.bodies.append(polytope.regular(6, 0.5))
	O.engines = []
	assert list(against(False)) == [0, 0, 1] and list(against(True)) == [0, 1, 0]
	O.engines = [NewtonIntegrator(gravity=(0, -9.81, 0))]
	up = against(False)
	assert list(up / np.linalg.norm(up)) == [0, 1, 0] and list(against(True)) == [0, 9.81, 0]
	usual = fromTheFront(np.array([0.0, 0, 1]))
	assert list(usual) == [-0.55, -1, 0.62]
	for up in np.eye(3), -np.eye(3), [np.array([0.6, 0, 0.8])]:
		for one in up:
			turned = fromTheFront(one)
			assert turned @ one == pytest.approx(0.62) and np.linalg.norm(turned) == pytest.approx(np.linalg.norm(usual))
	tilted = fromTheFront(np.array([0.0, 1, 0]))
	assert tilted == pytest.approx([-0.55, 0.62, 1]), 'what was the front, against y, now looks along z'


def testColoursOfBodiesThatCannotMove():
	O.bodies.append(polytope.regular(6, 0.5, color=red, fixed=True))
	O.bodies.append(polytope.regular(6, 0.5, center=(0, 3, 0), color=blue))
	up = np.array([0.0, 1, 0])
	low, high, usual = colors(list(O.bodies), 'height', None, up, usualFixedColor)
	assert (low, high) == (3, 3) and usual(O.bodies[0]) == usualFixedColor
	*_, own = colors(list(O.bodies), 'height', None, up, 'own')
	assert list(own(O.bodies[0])) == list(red) and list(own(O.bodies[1])) != list(blue)
	with pytest.raises(ValueError, match='fixedColor'):
		colors(list(O.bodies), 'speed', None, up, 'red')


def testPictureOfASmallSceneTakesLittleTime(tmp_path):
	"""The limit is on the processors' time of the drawing program and what it starts: 0.9 s, 1.4 s where Mesa keeps no compiled shaders;
	9.8 s when the shading was drawn in full size."""
	O.bodies.append(polytope.cuboid((0, 0, -0.5), (2, 2, 0.5), fixed=True))
	O.bodies.append([polytope.regular(12, 0.4, center=(k - 2, 0, 0.5)) for k in range(5)])
	before = os.times()
	picture(str(tmp_path / 'a.png'), view=(0, 0, 1))
	after = os.times()
	assert after.children_user + after.children_system - before.children_user - before.children_system < 3
	assert pixels(tmp_path / 'a.png').shape == (1100, 1600, 3)


countingRenders = """
import sys
import render
count, make = [0], render.vtkRenderWindow

def counted():
	window = make()
	window.AddObserver('RenderEvent', lambda *_: count.__setitem__(0, count[0] + 1))
	return window

render.vtkRenderWindow = counted
render.main(*sys.argv[1:])
print(count[0])
"""


def testEveryPictureIsDrawnOnceInEachSize(tmp_path, monkeypatch):
	"""It is drawn in full, and small with and without the shading; it used to be drawn anew to read each of them."""
	run, said = subprocess.run, []

	def counted(command, **options):
		environment = {**os.environ, 'PYTHONPATH': os.path.dirname(command[2])}
		said.append(run([command[0], '-c', countingRenders, *command[3:]], env=environment, **options))
		return said[-1]

	monkeypatch.setattr(subprocess, 'run', counted)
	O.bodies.append(polytope.cuboid((0, 0, 0.5), (0.5, 0.5, 0.5), color=red))
	assert shareLike(drawn(tmp_path / 'a.png'), 0) > 0.1
	assert int(said[0].stdout) == 3


def testFacesOfManyBodiesAreCollectedAtOnce():
	"""They are those of the shapes' lists of vertices and faces, each body's at its place."""
	for k in range(400):
		turn = Quaternion((1, 2, 3), k)
		O.bodies.append(polytope.randomGrain(0.9, 0.8, 0.8, vertices=14, seed=k % 7, center=(k, 0, 0), orientation=turn))

	def listed():
		for body in O.bodies:
			turn = np.array(body.state.ori.toRotationMatrix(), float).reshape(3, 3)
			yield np.array(body.shape.vertices, float) @ turn.T + np.array(body.state.pos, float), body.shape.faces

	mesh = collect(O.bodies)['solid']
	points, faces = zip(*listed(), strict=True)
	assert np.abs(mesh['points'] - np.concatenate(points)).max() < 1e-12
	begin = np.cumsum([0, *map(len, points)])
	assert mesh['connectivity'].tolist() == [first + v for first, own in zip(begin[:-1], faces, strict=True) for face in own for v in face]
	assert np.diff(mesh['offsets']).tolist() == [len(face) for own in faces for face in own]


def testManySpheresHaveFewerFaces(tmp_path):
	"""24 rings of 48 each; 100 000 of those would not fit into memory."""
	assert _rings(1) == 24 and _rings(2000) == 24 and _rings(10**7) == 4
	assert all(2 * _rings(n) ** 2 * n <= mostSphereFaces for n in (3000, 10000, 70000))
	O.bodies.append(utils.sphere((0, 0, 0), 0.5))
	assert len(collect(O.bodies)['smooth']['ids']) == 24 * 48


def testSoftShadingDarkensGaps(tmp_path):
	"""A floor is darker where a block stands close to it."""
	O.bodies.append(polytope.cuboid((0, 0, -0.5), (3, 3, 0.5), fixed=True, color=(0.7, 0.7, 0.7)))
	O.bodies.append(polytope.cuboid((0, 0, 0.5), (0.5, 0.5, 0.5), color=red))
	image = drawn(tmp_path / 'a.png', view=(0, 0, 1), fixed='solid', size=(301, 200), edges=False)
	assert image.shape == (200, 301, 3), 'no whole number of the smaller picture\'s pixels'
	floor = image[100, :, 1]
	beside = np.nonzero(image[100, :, 0] > 2 * image[100, :, 1])[0].max() + 3
	assert floor[beside] < 0.97 * floor[beside + 40]


def testCollectedFacesLieOnTheBodies():
	O.bodies.append(polytope.regular(12, 0.3, center=(1, 2, 3)))
	mesh = collect(O.bodies)['solid']
	assert len(mesh['offsets']) == 13 and list(mesh['ids']) == [0] * 12
	assert np.linalg.norm(mesh['points'] - (1, 2, 3), axis=1) == pytest.approx(0.3)


def testRefusals(tmp_path, monkeypatch):
	with pytest.raises(ValueError, match='bodies: there is nothing to draw'):
		picture(str(tmp_path / 'a.png'))
	O.bodies.append(polytope.regular(4, 1))
	with pytest.raises(ValueError, match='colorBy'):
		picture(str(tmp_path / 'a.png'), colorBy='beauty')
	with pytest.raises(ValueError, match='fixed'):
		picture(str(tmp_path / 'a.png'), fixed='invisible')
	with pytest.raises(ValueError, match="path: pictures are PNG files, .* 'a.jpg'"):
		picture('a.jpg')
	with pytest.raises(TypeError, match="picture: there is no argument 'colour'; it takes path, bodies, colorBy"):
		picture(str(tmp_path / 'a.png'), colour='height')
	monkeypatch.setenv('PATH', str(tmp_path))
	with pytest.raises(RuntimeError, match='install the package xvfb'):
		picture(str(tmp_path / 'a.png'))
	assert not (tmp_path / 'a.png').exists()


viewScript = '''
import os, time
from yade import O, FrictMat, Gl1_Polytope, RockJointMat, qt
from yade import polytope
from PyQt5.QtWidgets import QApplication

O.materials.append(FrictMat())
O.bodies.append(polytope.regular(12, 0.5, color=(1, 0, 0)))
qt.Renderer().bgColor = (1, 1, 1)
view = qt.View()

def shown(name):
	for _ in range(100):
		QApplication.processEvents()
		time.sleep(0.01)
	view.saveSnapshot(name)
	for _ in range(100):
		QApplication.processEvents()
		time.sleep(0.01)

view.center()
shown('solid.jpg')
Gl1_Polytope.wire = True
shown('wire.jpg')

O.bodies.erase(0)
Gl1_Polytope.wire = False
O.materials.append(RockJointMat(density=2600, normalStiffness=1e8, shearStiffness=1e8, frictionAngle=0.5))
O.bodies.append([
	polytope.cuboid((0, 0, -0.5), (1, 1, 0.5), fixed=True, color=(0.7, 0.7, 0.7)),
	polytope.cuboid((0, 0, 0.5), (0.5, 0.5, 0.5), color=(0.7, 0.7, 0.7)),
])
O.engines = polytope.engines()
O.run(50, wait=True)
view.center()
shown('bodies.jpg')
qt.Renderer().intrGeom = True
shown('contact.jpg')
O.interactions.clear()
shown('gone.jpg')
os._exit(0)
'''


@pytest.mark.skipif(not (shutil.which('xvfb-run') and shutil.which('yade')), reason='needs yade and xvfb-run')
def testYadesOwnViewDrawsPolytopes(tmp_path):
	"""Gl1_Polytope, in the Qt window on a virtual screen."""
	(tmp_path / 'view.py').write_text(viewScript)
	environment = {**os.environ, 'LIBGL_ALWAYS_SOFTWARE': '1', 'XDG_RUNTIME_DIR': str(tmp_path)}
	command = ['xvfb-run', '-a', '-s', '-screen 0 1024x768x24', 'yade', 'view.py']
	done = subprocess.run(command, cwd=tmp_path, env=environment, capture_output=True, text=True, timeout=1800)
	assert done.returncode == 0, done.stdout + done.stderr
	# in JPEG whatever the name says
	solid, wire = (shareLike(matplotlib.image.imread(tmp_path / name) / 255, 0) for name in ('solid.jpg', 'wire.jpg'))
	assert solid > 0.05 and 0 < wire < solid / 3
	# the rim of the area in which the block stands, its middle and the normal there, over the bodies
	bodies, contact, gone = (redness(matplotlib.image.imread(tmp_path / name) / 255) for name in ('bodies.jpg', 'contact.jpg', 'gone.jpg'))
	contact, gone = contact & ~bodies, gone & ~bodies  # the axis x is red, too
	assert bodies.sum() < 50 and gone.sum() < 20 and contact.sum() > 200, (bodies.sum(), gone.sum(), contact.sum())
	columns = np.nonzero(contact)[1]
	assert np.ptp(columns) > 0.1 * contact.shape[1], 'the rim is as wide as the block'


def redness(picture):
	"""Pixels that are red."""
	return picture[:, :, 0] > picture[:, :, 1] + 0.3


@pytest.mark.parametrize(
	'given, name',
	[(dict(view=(0, 0, 0)), 'view'), (dict(up=(0, 0, float('nan'))), 'up'), (dict(size=(0, 10)), 'size'), (dict(size=7), 'size')],
)
def testDirectionsAndSizesAreChecked(given, name, tmp_path):
	O.reset()
	O.materials.append(RockJointMat())
	O.bodies.append(polytope.cuboid((0, 0, 0), (0.5, 0.5, 0.5)))
	O.engines = polytope.engines()
	with pytest.raises(ValueError, match=f'^{name}: must be'):
		polytope.picture(tmp_path / 'one.png', **given)
	with pytest.raises(ValueError, match=f'^{name}: must be'):
		polytope.animate(tmp_path / 'one.gif', every=10, **given)
	assert not list(tmp_path.iterdir())
