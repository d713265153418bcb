# SPDX-License-Identifier: GPL-2.0-or-later
"""A text file word by word; what is not as expected is refused with the line's number."""

import math

from yade import Vector3

from ...arguments import warn

__all__ = ['Words', 'notConvex', 'warnIfNotConvex']

onHull = 1e-6
"""Distance of a face's corners from a plane of the hull, over the size, up to which it is a part of it: files have six digits and more."""


class Words:
	"""Words of a file in order.

	:param path: the file
	:param str remedy: ends each message
	"""

	def __init__(self, path, remedy):
		self.path, self.remedy, self.place = path, remedy, 0
		try:
			with open(path, encoding='utf-8') as file:
				lines = file.read().splitlines()
		except (UnicodeDecodeError, OSError) as error:
			raise ValueError(f"path: '{path}' cannot be read as text ({error}); {remedy}") from None
		self.words = [(word, k) for k, line in enumerate(lines, 1) if not line.lstrip().startswith('#') for word in line.split()]
		self.last = len(lines)

	@property
	def line(self):
		"""Number of the present word's line, from 1."""
		return self.words[self.place][1] if self.place < len(self.words) else self.last

	@property
	def present(self):
		"""The word that comes next; '' at the end."""
		return self.words[self.place][0] if self.place < len(self.words) else ''

	def wrong(self, what, line=None):
		"""The exception for the present word."""
		return ValueError(f"path: '{self.path}', line {self.line if line is None else line}: {what}; {self.remedy}")

	def word(self, what):
		if not self.present:
			raise self.wrong(f'the file ends where {what} is expected')
		self.place += 1
		return self.words[self.place - 1][0]

	def _number(self, what, kind, name):
		try:
			return kind(self.present)
		except ValueError:
			found = f'{self.present!r} is there' if self.present else 'the file ends'
			raise self.wrong(f'{what} is expected, {name}, but {found}') from None

	def real(self, what):
		value = self._number(what, float, 'a number')
		if not math.isfinite(value):
			raise self.wrong(f'{what} must be finite, got {value}')
		self.place += 1
		return value

	def whole(self, what, least=None, most=None):
		value = self._number(what, int, 'a whole number')
		if (least is not None and value < least) or (most is not None and value > most):
			limits = f'from {least} to {most}' if most is not None else f'at least {least}'
			raise self.wrong(f'{what} must be {limits}, got {value}')
		self.place += 1
		return value

	def point(self, what):
		return tuple(self.real(f'a coordinate of {what}') for _ in range(3))

	def endLine(self):
		"""Passes over what is left of the line of the last word taken."""
		line = self.words[self.place - 1][1]
		while self.present and self.line == line:
			self.place += 1


def warnIfNotConvex(name, body, points, faces, remedy=''):
	"""Warns where notConvex()."""
	if notConvex(body, points, faces):
		warn(f'path: {name} is not convex; the body is its convex hull{remedy}')


def notConvex(body, points, faces):
	"""Whether a face is not on the surface of the body, the hull of the points.

	:param points: in world coordinates
	:param faces: numbers of points, for each face
	"""
	state, shape = body.state, body.shape
	planes = [(state.ori * normal, offset) for normal, offset in zip(shape.normals, shape.offsets, strict=True)]
	arms = [Vector3(*point) - state.pos for point in points]
	near = onHull * max(arm.norm() for arm in arms)
	return not all(any(all(normal.dot(arms[k]) > offset - near for k in face) for normal, offset in planes) for face in faces)
