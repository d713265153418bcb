# SPDX-License-Identifier: GPL-2.0-or-later
"""Lines of a text file, with errors that name them."""

import math
import os

from ..joint import Joint

__all__ = ['Rows']


class Rows:
	def __init__(self, path, scale):
		self.path, self.scale = os.fspath(path), scale
		try:
			with open(path, encoding='utf-8-sig') as file:
				lines = [line.strip() for line in file]
		except UnicodeDecodeError:
			raise ValueError(f"path: '{path}' is no text; export the joints as text") from None
		self.lines = ['' if line.startswith('#') else line for line in lines]
		"""Comments are empty."""
		self.first = next((number for number, line in enumerate(self.lines) if line), 0)
		"""Place of the first one that is not."""

	def wrong(self, line, what, remedy):
		"""The error for a line, counted from 1."""
		return ValueError(f"path: '{self.path}', line {line}: {what}; {remedy}")

	def number(self, line, text, what):
		try:
			value = float(text)
		except ValueError:
			value = math.nan
		if not math.isfinite(value):
			point = text.replace(',', '.')
			raise self.wrong(
				line, f'{what} must be a number, got {text!r}', f'write a decimal point: {point}' if _isNumber(point) else 'correct it'
			)
		return value

	def whole(self, line, text, what):
		value = self.number(line, text, what)
		if value != int(value):
			raise self.wrong(line, f'{what} must be a whole number, got {text!r}', 'correct it')
		return int(value)

	def point(self, line, texts):
		if len(texts) != 3:
			raise self.wrong(line, f'a corner must have three coordinates, got {" ".join(texts)!r}', 'correct it')
		return tuple(self.scale * self.number(line, text, 'a coordinate') for text in texts)

	def polygon(self, line, corners, set=0):
		"""A polygon, whose errors name the line at which it begins."""
		return self.checked(line, lambda: Joint.polygon(corners, set))

	def checked(self, line, make):
		try:
			return make()
		except ValueError as error:
			raise ValueError(f"path: '{self.path}', line {line}: {error}") from None


def _isNumber(text):
	try:
		return math.isfinite(float(text))
	except ValueError:
		return False
