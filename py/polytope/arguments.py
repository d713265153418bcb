# SPDX-License-Identifier: GPL-2.0-or-later
"""Arguments that scripts give, as YADE's numbers and vectors. What cannot be converted is a ValueError that names the argument."""

import functools
import inspect
import numbers
import os
import sys
import warnings

import numpy as np
from yade import Material, O, Quaternion, Vector3, _polytope, utils

from .precision import isNumber, real

__all__ = [
	'flag',
	'maskOf',
	'materialOf',
	'namedArguments',
	'number',
	'numbersOf',
	'pathOfFile',
	'positive',
	'randomOf',
	'rotation',
	'vector',
	'vectors',
	'warn',
]

infinite = float('inf')
package = os.path.dirname(os.path.abspath(__file__)) + os.sep


def namedArguments(function):
	"""Decorates a public function: where a keyword is unknown it is named, and what the function takes."""
	own = list(inspect.signature(function).parameters)

	@functools.wraps(function)
	def checked(*given, **named):
		for name in named:
			if name not in own:
				raise TypeError(f'{function.__name__}: there is no argument {name!r}; it takes {", ".join(own)}')
		return function(*given, **named)

	return checked


def warn(message):
	"""A warning at the line of the script that called this package, however deep in it the caller is."""
	level, frame = 1, sys._getframe()
	while frame.f_back is not None and os.path.abspath(frame.f_code.co_filename).startswith(package):
		level, frame = level + 1, frame.f_back
	warnings.warn(message, stacklevel=level)


def number(value, name):
	if not isNumber(value):
		raise ValueError(f'{name}: must be a number, got {value!r}')
	return real(value)


def positive(value, name):
	"""The number as a float, where it is above 0 and finite."""
	found = float(number(value, name))
	if not 0 < found < infinite:
		raise ValueError(f'{name}: must be positive and finite, got {value!r}')
	return found


def pathOfNewFile(path, name):
	"""The path as a text, where a file can be written."""
	if not isinstance(path, (str, os.PathLike)):
		raise ValueError(f'{name}: must be the path of a file, got {path!r}')
	if os.path.isdir(path):
		raise ValueError(f"{name}: '{path}' is a folder; give the path of a file in it")
	return os.fspath(path)


def pathOfFile(path, name):
	"""The path as a text, where there is such a file."""
	text = pathOfNewFile(path, name)
	if not os.path.exists(text):
		raise FileNotFoundError(f"{name}: there is no file '{text}'")
	return text


def flag(value, name):
	if not isinstance(value, (bool, np.bool_)):
		raise ValueError(f'{name}: must be True or False, got {value!r}')
	return bool(value)


def maskOf(value):
	if isinstance(value, bool) or not isinstance(value, numbers.Integral) or not abs(value) < 2**31:
		raise ValueError(f'mask: must be a whole number of 32 bits, got {value!r}')
	return int(value)


def randomOf(seed):
	"""A generator of random numbers; for None, it gives others at each call."""
	try:
		if not isinstance(seed, bool):
			return np.random.default_rng(seed)
	except (TypeError, ValueError):
		pass
	raise ValueError(f'seed: must be a whole number from 0 on, got {seed!r}')


def numbersOf(values, name):
	try:
		return [real(v) for v in values]
	except (TypeError, ValueError):
		raise ValueError(f'{name}: must be a sequence of numbers') from None


def vectors(rows, name, length):
	"""Rows of *length* numbers, 2 or 3, as the functions of _polytope take them (pkg/polytope/host/Vectors.cpp)."""
	if isinstance(rows, np.ndarray):
		rows = rows.tolist()  # its rows and numbers are slow to iterate
	return _polytope.vectors(rows, name, length, real)


def rows(values, name, length):
	"""Rows of *length* numbers as lists, to compute with."""
	try:
		found = [[real(x) for x in row] for row in values]
	except (TypeError, ValueError):
		raise ValueError(f'{name}: must be a sequence of {length}-vectors') from None
	if any(len(row) != length for row in found):
		raise ValueError(f'{name}: every row must have {length} components')
	return found


def vector(value, name):
	try:
		x, y, z = value
		x, y, z = real(x), real(y), real(z)
		vector = Vector3(x, y, z)
	except Exception:  # whatever is no sequence of three numbers
		raise ValueError(f'{name}: must be three numbers, got {value!r}') from None
	if not abs(x) + abs(y) + abs(z) < infinite:
		raise ValueError(f'{name}: must be finite, got {tuple(vector)}')
	return vector


def point(value, name):
	"""A point of space, or of the plane by two numbers: a tuple of three or two [m]."""
	try:
		flat = len(value) == 2
	except TypeError:
		flat = False
	found = vector((*value, 0) if flat else value, name)
	return tuple(float(x) for x in found)[: 2 if flat else 3]


def rotation(orientation):
	if not isinstance(orientation, Quaternion):
		raise ValueError('orientation: must be a Quaternion')
	if not 0 < orientation.norm() < float('inf'):
		raise ValueError('orientation: must be a finite quaternion other than zero')
	return orientation.normalized()


def materialOf(material):
	"""The material, given as YADE's own builders take it: a Material, its index or label in O.materials, or a function that makes one."""
	if isinstance(material, int) and material < 0 and len(O.materials) == 0:
		O.materials.append(utils.defaultMaterial())
	if isinstance(material, (int, str)):
		return _sound(_listed(material))
	made = material() if callable(material) else material
	if not isinstance(made, Material):
		raise TypeError('material: must be a Material, its index or label in O.materials, or a function that makes one')
	return _sound(made)


def _listed(material):
	"""The material of this label or index in O.materials."""
	try:
		return O.materials[material]
	except (IndexError, KeyError):
		labels = [one.label for one in O.materials if one.label]
	if isinstance(material, str):
		there = f'there are {labels}' if labels else 'none has a label'
		remedy = "O.materials.append(RockJointMat(label='…')) first"
		raise ValueError(f'material: no material in O.materials has the label {material!r}, {there}; {remedy}')
	seen = f'material: O.materials has no index {material}, it has {len(O.materials)} materials'
	raise ValueError(f'{seen}; O.materials.append(RockJointMat(…)) first')


def _sound(material):
	"""The material, unless it has a number that YADE takes without a word and no body can be made of."""
	for name in ('density', 'young'):
		value = getattr(material, name, 1)
		if not 0 < value < infinite:
			raise ValueError(f'material: its {name} must be positive and finite, got {value}')
	return material
