# SPDX-License-Identifier: GPL-2.0-or-later
"""Films of a running scene, without a window and without a screen: `polytope.animate(…)` (docs/results.md)."""

import atexit
import numbers
import os

from yade import O, PyRunner

from ..arguments import namedArguments, number, warn
from .camera import pixels
from .filmFiles import checkedName, encode
from .filmFrames import Frames
from .looks import usualFixedColor

__all__ = ['Film', 'animate', 'filmEngines', 'record']

module = "__import__('yade.polytope.pictures.films', fromlist=['record']).record"
"""A call that leaves no name among the script's own."""

openFilms = {}
"""Films of this process that are open, by the path of the file."""


@namedArguments
def animate(
	path,
	every=100,
	fps=20,
	bodies=None,
	colorBy='color',
	valueRange=None,
	legend=None,
	fixed='auto',
	view=None,
	up=None,
	frame=None,
	zoom=1.0,
	size=(800, 550),
	background=(1, 1, 1),
	edges=True,
	fixedColor=usualFixedColor,
):
	"""Begins a film of the scene: a GIF or MP4 file, drawn as by *polytope.picture*, without a window.

	::

	    with polytope.animate('slide.gif', every=200):
	        O.run(20000, wait=True)

	Takes the first frame at once, and adds an engine to O.engines that takes one every so many steps. The file is written by *close*, or
	at the end of the ``with`` block, or when YADE ends. All frames have the view, the scale of colours and the way of drawing fixed
	bodies in common; where these are not given, they follow from the first frame and from how far bodies go in all of the film. One frame
	is drawn and written for trial before this returns, so that what is wrong shows before the run.

	The rest as for *polytope.picture*:

	:param str path: the file, .gif or .mp4; its folder is made if there is none. MP4 needs the program ffmpeg (a package of Debian)
	:param int every: steps from one frame to the next
	:param float fps: frames shown in a second, at most 50; in a GIF rounded so that each lasts a whole number of hundredths of a second
	:param bodies: the bodies to draw; default all that there are at each frame
	:param colorBy: 'color', 'height', 'speed', 'size', 'displacement' or a function of the body that returns a number, or
	    one for each plane of its shape
	:param valueRange: (low, high) ends of the colour scale; default those of the moving bodies in all frames
	:param str legend: draw the colour scale, with this text
	:param fixed: how bodies are drawn that cannot move: 'auto', 'solid', 'glass', 'wire', 'hidden' or a function of the body
	:param view: direction from the scene to the camera
	:param up: direction that is up in the film
	:param frame: points (n, 3) the film must hold; default all vertices drawn in any frame. Give it if a body falls out of the scene
	:param float zoom: above 1 to come nearer than the frame requires
	:param size: (width, height) in pixels
	:param background: RGB
	:param bool edges: draw the edges of the faces
	:param fixedColor: RGB of bodies that cannot move where colours follow a value, or 'own'
	:returns: the film, with *take*, *close*, *frames*
	:raises ValueError: naming the argument
	:raises RuntimeError: if the scene is running, or divided on several processes (MPI), or if the trial frame cannot be drawn or written
	"""
	look = dict(
		bodies=bodies,
		colorBy=colorBy,
		valueRange=valueRange,
		legend=legend,
		fixed=fixed,
		view=view,
		up=up,
		frame=frame,
		zoom=zoom,
		size=pixels(size),
		background=background,
		edges=edges,
		fixedColor=fixedColor,
	)
	if isinstance(every, bool) or not isinstance(every, numbers.Integral) or every < 1:
		raise ValueError(f'every: must be a whole number of steps, at least 1, got {every!r}')
	path, fps = checkedName(path), float(number(fps, 'fps'))
	if not 0 < fps <= 50:
		raise ValueError(f'fps: {fps:g}; above 0 and at most 50, which is all that a GIF can hold')
	if path in openFilms:
		raise ValueError(f'path: a film of {path} is being made already; close() it first, or take another name')
	if O.running:
		raise RuntimeError('O: is running in the background; O.pause() or O.wait() first')
	if _divided():
		raise RuntimeError('O.bodies: the scene is divided on several processes; begin a film before that, or after polytope.mpi.merge()')
	return Film(path, int(every), fps, look)


def filmEngines(path=None):
	"""The engines of this kind in the scene, of one film or of all."""
	begin = f'{module}({path!r})' if path else module
	return [engine for engine in O.engines if isinstance(engine, PyRunner) and engine.command.startswith(begin)]


def record(path):
	"""What the engine calls. A scene that was saved with it and loaded by another process has no film there."""
	if path not in openFilms:
		return
	if _divided():
		warn('polytope.animate: no frames while the scene is divided on several processes; film.take() on rank 0 after mpi.run(…)')
		return
	openFilms[path].take()


def _divided():
	return getattr(O, 'splitted', False)  # which yade.mpy sets


class Film:
	"""A film that *polytope.animate* began. As a context manager it is closed at the end of the block, also after an error.

	Frames end with O.reset() and O.load(…), which take the engine away (unless the state was saved while this film was being made:
	then they go on); *close* then writes those taken before. While a scene is divided on several processes (MPI) there are none:
	*take* them on rank 0 after ``polytope.mpi.merge()``.
	"""

	def __init__(self, path, every, fps, look):
		self.path = self._name = path
		self.fps, self._kept, self._closed = fps, Frames(**look), False
		try:
			self.take()
			encode(self._kept.place('trial' + os.path.splitext(path)[1]), self._kept.draw(), fps)
		except BaseException:
			self._kept.remove()
			raise
		stale = filmEngines(path)  # of an earlier process, in a scene that was loaded
		# without iterLast it would act in the next step, too, if steps were taken before
		engine = PyRunner(command=f'{module}({path!r})', iterPeriod=every, iterLast=O.iter)
		O.engines = [*(one for one in O.engines if one not in stale), engine]
		openFilms[path] = self
		atexit.register(self.close)  # is called before the folder's own removal, which was registered earlier

	def __enter__(self):
		return self

	def __exit__(self, *_):
		self.close()

	@property
	def frames(self):
		"""Number of frames taken so far."""
		return self._kept.count

	def take(self):
		"""Takes a frame of the scene as it is now, beside those that the engine takes.

		:raises RuntimeError: if the film is closed
		"""
		if self._closed:
			raise RuntimeError('film: it is closed; begin another one')
		self._kept.take()
		self._latest = O.iter

	def close(self):
		"""Takes the last frame, if the scene has run on since the one before and is still that of the film, draws all and writes the
		file. The engine is gone then.

		:returns: the file's path
		:raises RuntimeError: if the scene is running, or the file cannot be drawn or written; then the frames are kept: give *path*
		    another value, or make room, and close again
		"""
		if self._closed:
			return self.path
		if O.running:
			raise RuntimeError('O: is running in the background; O.pause() or O.wait() first')
		own = filmEngines(self._name)
		if own and O.iter > self._latest and not _divided():
			self.take()
		O.engines = [engine for engine in O.engines if engine not in own]
		encode(self.path, self._kept.draw(), self.fps)
		self._closed = True
		openFilms.pop(self._name)
		atexit.unregister(self.close)
		self._kept.remove()
		return self.path
