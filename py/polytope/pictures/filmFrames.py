# SPDX-License-Identifier: GPL-2.0-or-later
"""Frames of a film: the faces of all bodies, kept in files of a temporary folder while the scene runs, and drawn at its end.

By then it is known how far bodies have moved and which values their colours stand for, so that all frames have one view and one scale.
"""

import os
import tempfile

import numpy as np
from tqdm import tqdm
from yade import O

from .camera import cameraFor, viewAxes
from .faceColors import faceColors
from .faces import collect
from .looks import colorMap, colorsWithoutValue, endsOf, shadesFor, styles, typicalRadius, valueFunction
from .still import draw, drawable, isFlat, keep, kept, legendShare, nothingToDraw, settingsFor, shownPoints

__all__ = ['Frames']

together = 10
"""Frames that one process draws: its start takes as long as a frame."""

directions = 200
"""In which the farthest vertices of a frame are kept for the camera. They are 0.25 apart: between two a round scene reaches 1 % farther,
and the picture's margin is 4 %."""


class Frames:
	"""The frames of one film.

	:param look: arguments of *polytope.animate*
	:raises ValueError: naming the argument
	"""

	def __init__(self, bodies, colorBy, fixed, view, up, fixedColor, **look):
		self.count, self._look = 0, look
		self._ids = None if bodies is None else [body.id for body in bodies]
		drawn = self._drawn()
		self._flat = isFlat(drawn)
		self._axes = view, up = viewAxes(view, up, self._flat)
		self._ofFaces, self._least, self._greatest = faceColors(drawn, colorBy, look['valueRange']), np.inf, -np.inf
		self._value = None if self._ofFaces else valueFunction(colorBy, up)
		self._plainColor = self._ofFaces.of if self._ofFaces else colorsWithoutValue(colorBy, fixedColor)
		self._newStyle, self._styles = styles(drawn, fixed, view, up, self._flat), {}
		if not collect(drawn, self._plainColor, self._style):
			raise ValueError(nothingToDraw)
		self._radius, self._far = typicalRadius(drawn), []
		self._folder = tempfile.TemporaryDirectory(prefix='polytope-film-')

	def take(self):
		"""Keeps the scene as it is now."""
		drawn = self._drawn()
		meshes = collect(drawn, self._plainColor, self._style)
		if self._value:
			self._addValues(meshes, {body.id: float(self._value(body)) for body in drawn if body.dynamic})
		folder = self.place(str(self.count))
		os.makedirs(folder, exist_ok=True)
		keep(folder, meshes)
		if meshes and self._look['frame'] is None:
			self._far.append(_farthest(shownPoints(meshes)))
		self.count += 1

	def draw(self):
		"""Draws all of them, with a bar of progress in a terminal.

		:returns: the PNG files
		"""
		least, greatest = (self._least, self._greatest) if self._least <= self._greatest else (0, 1)
		low, high = endsOf(least, greatest, self._look['valueRange'])
		settings = self._settings(low, high)
		folders = [self.place(str(k)) for k in range(self.count)]
		with tqdm(total=self.count, unit=' frames', disable=None, leave=False) as bar:
			for k in range(0, self.count, together):
				some = folders[k : k + together]
				if self._value:
					for folder in some:
						_paint(folder, low, high)
				draw([(folder, folder + '.png') for folder in some], settings)
				bar.update(len(some))
		return [folder + '.png' for folder in folders]

	def place(self, name):
		"""Path of this name in the temporary folder."""
		return os.path.join(self._folder.name, name)

	def remove(self):
		self._folder.cleanup()

	def _drawn(self):
		count = len(O.bodies)
		return drawable(O.bodies if self._ids is None else [O.bodies[k] for k in self._ids if k < count])

	def _style(self, body):
		"""Style of a body: for one that cannot move that of the first frame, since which of them stand before the others changes in a run."""
		if body.dynamic:
			return 'solid'
		if body.id not in self._styles:
			self._styles[body.id] = self._newStyle(body)
		return self._styles[body.id]

	def _addValues(self, meshes, values):
		"""To each face that of its body; nan where its colour follows none."""
		finite = [value for value in values.values() if np.isfinite(value)]
		self._least, self._greatest = min([self._least, *finite]), max([self._greatest, *finite])
		ofBody = np.full(len(O.bodies), np.nan)
		ofBody[list(values)] = list(values.values())
		for mesh in meshes.values():
			mesh['values'] = ofBody[mesh['ids']]

	def _settings(self, low, high):
		look, (width, height) = self._look, self._look['size']
		legend = look['legend'] and (
			self._ofFaces.legend(look['legend']) if self._ofFaces else dict(text=look['legend'], low=low, high=high, colors=colorMap)
		)
		points = np.concatenate(self._far) if look['frame'] is None else np.asarray(look['frame'], float)
		camera = cameraFor(points, *self._axes, width / height, look['zoom'], self._flat, legendShare if legend else 0)
		return settingsFor(camera, look['size'], look['background'], look['edges'], self._flat, self._radius, legend)


def _paint(folder, low, high):
	"""Colours for the values of a frame, now that the ends of the scale are known."""
	meshes = kept(folder)
	for mesh in meshes.values():
		valued = np.isfinite(mesh['values'])
		mesh['colors'][valued] = np.round(255 * shadesFor(mesh['values'][valued], low, high))
	keep(folder, meshes)


def _farthest(points):
	"""The points that are outermost in any of the directions, which are spread over a sphere (a Fibonacci lattice)."""
	height = 1 - (2 * np.arange(directions) + 1) / directions
	angle = np.pi * (1 + 5**0.5) * np.arange(directions)
	ways = np.stack([np.cos(angle) * np.sqrt(1 - height**2), np.sin(angle) * np.sqrt(1 - height**2), height], axis=-1)
	return points[sorted({int((points @ way).argmax()) for way in ways})]
