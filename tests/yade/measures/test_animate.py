# SPDX-License-Identifier: GPL-2.0-or-later
"""polytope.animate: films of a running scene, without a window."""

import shutil
import subprocess
import sys

import numpy as np
import pytest
from PIL import Image
from yade import ForceResetter, NewtonIntegrator, O, RockJointMat, polytope
from yade.polytope.pictures.films import filmEngines, openFilms

red, blue = (0.9, 0.1, 0.1), (0.1, 0.2, 0.9)
speed, dt, edge = 2.0, 1e-3, 0.5
look = dict(size=(240, 120), view=(0, -1, 0), up=(0, 0, 1), edges=False)


@pytest.fixture(autouse=True)
def noFilms():
	yield
	O.engines = []
	for film in list(openFilms.values()):
		film.close()


def movingBlock():
	"""A plate that moves along x, without forces, and one at rest below it. They are thin, so that only their fronts are seen."""
	O.materials.append(RockJointMat(density=2600, normalStiffness=1e8, shearStiffness=1e8, frictionAngle=0.5))
	O.bodies.append(polytope.cuboid((0, 0, -3 * edge), (edge / 2, 1e-3, edge / 2), color=blue, fixed=True))
	O.bodies.append(polytope.cuboid((0, 0, 0), (edge / 2, 1e-3, edge / 2), color=red, velocity=(speed, 0, 0)))
	O.engines = [ForceResetter(), NewtonIntegrator(damping=0)]
	O.dt = dt


def framesOf(path):
	"""(frames, height, width, 3) in 0…255"""
	with Image.open(path) as film:
		shown = []
		for k in range(film.n_frames):
			film.seek(k)
			shown.append(np.asarray(film.convert('RGB')).astype(float))
	return np.array(shown)


def middles(images, channel):
	"""For each frame (column, row) of the mean of the pixels in which this channel is more than twice each of the others."""
	others = [k for k in range(3) if k != channel]
	like = images[..., channel] > 2 * images[..., others].max(axis=-1)
	return np.array([np.argwhere(one)[:, ::-1].mean(axis=0) for one in like])


def testABlockMovesAsItShould(tmp_path):
	"""The motion is looked at in pixels: the block moves by v t over the width of the frame that was asked for, while the one at rest stays."""
	movingBlock()
	frame = [(x, 0, z) for x in (-1, 3) for z in (-2, 0)]
	with polytope.animate(tmp_path / 'folder' / 'a.gif', every=200, frame=frame, zoom=1.04, **look) as film:
		assert film.frames == 1 and len(filmEngines()) == 1
		O.run(1000, wait=True)
		assert film.frames == 5
	assert not filmEngines() and film.close() == film.path
	images = framesOf(tmp_path / 'folder' / 'a.gif')
	assert images.shape == (6, 120, 240, 3), 'the first, those after 200, 400 … and the last'
	steps = np.array([0, 201, 401, 601, 801, 1000])  # the engine acts at the end of a step that begins with this O.iter
	perMetre = 120 / 2  # the frame is 4 × 2 m, the picture 240 × 120 pixels
	block, support = middles(images, 0), middles(images, 2)
	assert block[:, 0] == pytest.approx((1 + speed * dt * steps) * perMetre - 0.5, abs=0.3)
	assert block[:, 1] == pytest.approx(np.full(6, block[0, 1]), abs=0.3)
	assert np.ptp(support, axis=0) == pytest.approx([0, 0], abs=1e-9), 'the view is the same in all frames'
	with Image.open(film.path) as file:
		assert file.info['duration'] == 50 and file.info['loop'] == 0


def testViewAndScaleHoldForAllFrames(tmp_path):
	"""Without a given frame the film holds the whole way of the block; colours have one scale, from the least to the greatest value of all."""
	movingBlock()
	with polytope.animate(tmp_path / 'a.gif', every=500, colorBy='displacement', fps=10, **look):
		O.run(1000, wait=True)
	images = framesOf(tmp_path / 'a.gif')
	assert len(images) == 3
	coloured = np.ptp(images, axis=-1) > 25
	columns = [np.nonzero(one.any(axis=0))[0] for one in coloured]
	assert columns[0].min() > 0 and columns[-1].max() < 239, 'within the picture'
	assert columns[-1].mean() - columns[0].mean() > 100
	shade = [images[k][coloured[k]].mean(axis=0) for k in (0, -1)]
	assert shade[0][2] > 2 * shade[0][0] and shade[1][0] > 2 * shade[1][2], 'from blue to red'
	assert (images[:, 0, 0] == 255).all(), 'white is white'


def testFramesByHandAndOfBodiesThatComeAndGo(tmp_path):
	movingBlock()
	film = polytope.animate(tmp_path / 'a.gif', every=10**6, bodies=[O.bodies[0], O.bodies[1]], **look)
	O.bodies.append(polytope.cuboid((2, 0, 0), (0.2, 0.2, 0.2), color=(0, 0.8, 0)))
	film.take()
	O.bodies.erase(1)
	film.take()
	assert film.close() == str(tmp_path / 'a.gif') and film.frames == 3
	images = framesOf(film.path)
	assert len(images) == 2, 'two frames alike are one of twice the duration in a GIF'
	assert not (images[..., 1] > 2 * images[..., [0, 2]].max(axis=-1)).any(), 'the new one was not asked for'
	assert (images[..., 0] > 2 * images[..., [1, 2]].max(axis=-1)).any(axis=(1, 2)).tolist() == [True, False]
	with pytest.raises(RuntimeError, match='film: it is closed'):
		film.take()


def testWhatEndsAFilm(tmp_path):
	"""O.reset and O.load take the engine away; what was filmed before is written. That of a saved state does nothing without a film."""
	movingBlock()
	O.save(str(tmp_path / 'before.yade.gz'))
	film = polytope.animate(tmp_path / 'a.gif', every=100, **look)
	O.run(150, wait=True)
	O.save(str(tmp_path / 'meanwhile.yade.gz'))
	O.load(str(tmp_path / 'before.yade.gz'))
	O.run(500, wait=True)
	assert film.frames == 2 and film.close() and film.frames == 2
	assert len(framesOf(film.path)) == 2
	O.load(str(tmp_path / 'meanwhile.yade.gz'))
	assert len(filmEngines()) == 1
	O.run(200, wait=True)
	again = polytope.animate(tmp_path / 'a.gif', every=100, **look)
	assert len(filmEngines()) == 1, 'the old one is replaced'
	O.reset()
	assert again.close() and again.frames == 1


def testNoFramesOfADividedScene(tmp_path, monkeypatch):
	"""Each process knows the motion of its own bodies only."""
	movingBlock()
	film = polytope.animate(tmp_path / 'a.gif', every=100, **look)
	monkeypatch.setattr(O, 'splitted', True, raising=False)  # as yade.mpy does
	with pytest.warns(UserWarning, match='no frames while the scene is divided'):
		O.run(150, wait=True)
	assert film.close() and film.frames == 1


def testTrialsOfTheFactorOfSafetyAreNotFilmed(tmp_path):
	"""A block on a slope of 20 degrees, with friction of 30: tan 30° / tan 20°."""
	dip = np.radians(20)
	O.materials.append(RockJointMat(density=2600, normalStiffness=1e8, shearStiffness=1e8, frictionAngle=np.radians(30)))
	O.bodies.append(polytope.cuboid((0, 0, -0.5), (2, 2, 0.5), fixed=True))
	O.bodies.append(polytope.cuboid((0, 0, 0.5), (0.5, 0.5, 0.5)))
	O.engines = polytope.engines(gravity=(9.81 * np.sin(dip), 0, -9.81 * np.cos(dip)))
	polytope.settle()
	film = polytope.animate(tmp_path / 'a.gif', every=10, **look)
	O.run(25, wait=True)
	found = polytope.factorOfSafety()
	assert found.factor == pytest.approx(np.tan(np.radians(30)) / np.tan(dip), rel=0.02)
	assert film.frames == 3


def testAFilmThatWasNotClosedIsWrittenAtTheEnd(tmp_path):
	script = f"""
from yade import O, polytope
O.bodies.append(polytope.regular(6, 0.5))
polytope.animate({str(tmp_path / 'a.gif')!r}, size=(60, 40))
"""
	done = subprocess.run([sys.executable, '-c', script], capture_output=True, text=True, timeout=300)
	assert done.returncode == 0 and not done.stderr, done.stderr
	assert framesOf(tmp_path / 'a.gif').shape == (1, 40, 60, 3)


def testBadInputIsRefusedBeforeTheRun(tmp_path, monkeypatch):
	movingBlock()
	engines = list(O.engines)
	name = tmp_path / 'a.gif'
	(tmp_path / 'file').write_text('')
	for arguments, message in (
		((tmp_path / 'a.avi',), 'path: films are GIF or MP4 files, their names end in .gif or .mp4'),
		((tmp_path / 'file' / 'a.gif',), 'path: the folder .*file cannot be made .*; give another one'),
		((tmp_path,), 'path: films are GIF'),
		((name, 0), 'every: must be a whole number of steps, at least 1, got 0'),
		((name, -5), 'every'),
		((name, 2.5), 'every'),
		((name, True), 'every'),
		((name, 10, 0), 'fps: 0; above 0'),
		((name, 10, 60), 'fps: 60; .* at most 50'),
	):
		with pytest.raises(ValueError, match=message):
			polytope.animate(*arguments)
	for wrong, message in (
		(dict(colorBy='beauty'), 'colorBy'),
		(dict(fixed='invisible'), 'fixed'),
		(dict(bodies=[]), 'bodies: there is nothing'),
	):
		with pytest.raises(ValueError, match=message):
			polytope.animate(name, **wrong)
	with pytest.raises(TypeError, match="there is no argument 'colour'"):
		polytope.animate(name, colour='speed')
	monkeypatch.setattr(O, 'splitted', True, raising=False)
	with pytest.raises(RuntimeError, match='several processes'):
		polytope.animate(name)
	monkeypatch.undo()
	monkeypatch.setenv('PATH', str(tmp_path))
	with pytest.raises(ValueError, match=r'MP4 needs the program ffmpeg: install the package ffmpeg, or .* \.gif'):
		polytope.animate(tmp_path / 'a.mp4')
	with pytest.raises(RuntimeError, match='install the package xvfb'):
		polytope.animate(name)
	assert O.engines == engines and not openFilms and not name.exists()


def testOneFilmOfAName(tmp_path):
	movingBlock()
	polytope.animate(tmp_path / 'a.gif', **look)
	with pytest.raises(ValueError, match='is being made already'):
		polytope.animate(tmp_path / 'a.gif', **look)


def testWhatCouldNotBeWrittenIsKept(tmp_path):
	movingBlock()
	film = polytope.animate(tmp_path / 'a' / 'a.gif', every=50, **look)
	O.run(100, wait=True)
	shutil.rmtree(tmp_path / 'a')
	with pytest.raises(RuntimeError, match='a.gif was not written'):
		film.close()
	film.path = str(tmp_path / 'b.gif')
	assert film.close() == film.path and film.frames == 3 and len(framesOf(film.path)) == 3


@pytest.mark.skipif(not shutil.which('ffmpeg'), reason='needs the program ffmpeg')
def testMp4(tmp_path):
	"""Sizes are made even; ffmpeg reads its frames back."""
	movingBlock()
	with polytope.animate(tmp_path / 'a.mp4', every=200, **{**look, 'size': (241, 121)}):
		O.run(1000, wait=True)
	command = ['ffmpeg', '-loglevel', 'error', '-i', str(tmp_path / 'a.mp4'), '-f', 'rawvideo', '-pix_fmt', 'rgb24', '-']
	raw = subprocess.run(command, capture_output=True, check=True).stdout
	images = np.frombuffer(raw, np.uint8).reshape(-1, 122, 242, 3).astype(float)
	assert len(images) == 6
	assert np.diff(middles(images, 0)[:, 0]).min() > 5
