# SPDX-License-Identifier: GPL-2.0-or-later
"""To how many digits a file gives its numbers, and whether that is enough where the mesh is."""

import numpy as np

from ...arguments import warn

__all__ = ['remedy', 'rounding', 'warnOfRounding']

tooCoarse = 1e-4
"""Largest error of a coordinate over the extent of a body above which there is a warning: the volume is off by about as much."""
remedy = 'write it in double precision, or move what it shows to the origin before it is written'
fewDigits = 6
"""Significant digits in decimal that programs write which are not told how many. Numbers with fewer are taken for exact, such as those of a grid."""


def rounding(points):
	"""Largest error that a coordinate has, where all points are numbers of single precision or of few digits; otherwise 0.

	Numbers that a coarser grid holds as well, such as whole ones, count as exact.
	"""
	if not np.isfinite(points).all():
		return 0.0
	single = np.abs(points).astype(np.float32)
	if (single == np.abs(points)).all():
		step = np.spacing(single).astype(float)
		last = np.abs(points) / step % 2 == 1  # the last of their 24 digits is not 0
		return float(step[last].max(initial=0)) / 2
	if _hasDigits(points[:100], fewDigits) and _hasDigits(points, fewDigits) and not _hasDigits(points, fewDigits - 1):
		return float(10.0 ** (np.floor(np.log10(np.abs(points).max())) + 1 - fewDigits)) / 2
	return 0.0


def _hasDigits(points, digits):
	"""Whether all numbers have at most so many significant digits in decimal."""
	values = np.abs(points[points != 0])
	places = digits - 1 - np.floor(np.log10(values))
	scale = 10.0 ** np.abs(places)
	kept = np.where(places >= 0, np.round(values * scale) / scale, np.round(values / scale) * scale)
	return bool((kept == values).all())


def warnOfRounding(path, name, points, length, what):
	"""Warns where the file's numbers have too few digits for a length, in the file's units.

	:param str name: of the argument
	:param str what: the length is
	:returns: the largest error of a coordinate
	"""
	error = rounding(points)
	if error > tooCoarse * length:
		seen = f"{name}: '{path}' gives coordinates up to {np.abs(points).max():.3g} with an error of {error:.2g}, {what} is {length:.3g}"
		warn(f'{seen}: the file has too few digits; {remedy}')
	return error
