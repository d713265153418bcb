# SPDX-License-Identifier: GPL-2.0-or-later
"""Colours of single faces by a whole number for each plane of a body's shape, as that of the joint set that made it."""

import numpy as np
from yade import Polytope, _polytope

from .looks import colorMap, rgbOf, shadesFor, usualFixedColor

__all__ = ['FaceColors', 'faceColors', 'ofFaces']

palette = ('#0072b2', '#e69f00', '#009e73', '#cc79a7', '#56b4e9', '#d55e00', '#f0e442')
"""Colours of the numbers from 0 on; colour-blind readers tell them apart (Okabe & Ito 2008, "Color universal design", without black)."""


def faceColors(bodies, colorBy, valueRange):
	"""*FaceColors*, if *colorBy* is a function that gives a polytope a number for each plane; else None.

	:raises ValueError: naming *colorBy* or *valueRange*
	"""
	polytopes = sorted((body for body in bodies if isinstance(body.shape, Polytope)), key=lambda body: not body.dynamic)
	if not callable(colorBy) or not polytopes or np.ndim(colorBy(polytopes[0])) == 0:
		return None
	if valueRange is not None:
		raise ValueError('valueRange: colours of single faces stand for whole numbers and have no range; leave it out')
	return FaceColors(polytopes, colorBy)


class FaceColors:
	"""Colours of numbers: below the length of the palette one each, so that a number has the same colour in all pictures; of others the
	shades of a scale."""

	def __init__(self, polytopes, numbers):
		self._numbers = numbers
		seen = np.unique(np.concatenate([self._ofFaces(body) for body in polytopes]))
		self._none, self._seen = bool((seen < 0).any()), seen[seen >= 0].tolist()
		low, high = (self._seen[0], self._seen[-1]) if self._seen else (0, 0)
		self._few = high < len(palette)
		self._ends = low, high + (low - high) % 3  # the scale's four numbers are whole

	def of(self, body):
		"""RGB in 0…1 of each of the body's faces, (n, 3); of one that is no polytope, and of faces without a number, grey."""
		if not isinstance(body.shape, Polytope):
			return usualFixedColor
		numbers = self._ofFaces(body)
		return np.where(numbers[:, None] < 0, usualFixedColor, self._colors(np.maximum(numbers, 0)))

	def legend(self, text):
		"""For render.py: a field for each number, or a scale where there are more than colours in the palette."""
		if not self._few:
			return dict(text=text, low=self._ends[0], high=self._ends[1], colors=colorMap)
		grey = ['#' + ''.join(f'{round(255 * part):02x}' for part in usualFixedColor)] if self._none else []
		labels = [str(number) for number in self._seen] + ['none'] * self._none
		return dict(text=text, labels=labels, colors=[palette[number] for number in self._seen] + grey)

	def _colors(self, numbers):
		if not self._few:
			return shadesFor(numbers, *self._ends)
		return rgbOf(palette)[numbers % len(palette)]

	def _ofFaces(self, body):
		numbers = np.asarray(self._numbers(body))
		planes = len(body.shape.normals)
		if numbers.shape not in ((0,), (planes,)) or (numbers.size and not np.issubdtype(numbers.dtype, np.integer)):
			raise ValueError(
				f'colorBy: must give body {body.id} a whole number for each of the {planes} planes in body.shape.normals, or one number, got {numbers!r}'
			)
		return ofFaces(body.shape, numbers)


def ofFaces(shape, numbers):
	"""Number of each face of a Polytope, from those of its planes; −1 for the caps of a polygon, and where *numbers* is empty."""
	planes = np.frombuffer(_polytope.planesOfFaces(shape), np.int32)
	return np.append(numbers, -1)[planes].astype(int) if len(numbers) else np.full(len(planes), -1)
