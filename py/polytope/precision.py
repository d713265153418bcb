# SPDX-License-Identifier: GPL-2.0-or-later
"""The only conversions from a script's numbers to YADE's.

In YADE's double these are Python's floats. Its wider precisions return a type of their own, yade.minieigenHP.Real, and accept
that, Python's and mpmath's numbers.
"""

import numbers

from yade import minieigenHP
from yade._polytope import buildInfo

__all__ = ['isNumber', 'real']


def isNumber(value):
	"""Whether it is a real number of Python's, NumPy's, mpmath's or YADE's."""
	return isinstance(value, (numbers.Real, minieigenHP.Real))  # in double, YADE's is float


if buildInfo()['precision'] == 'double':
	real = float
else:
	import mpmath

	def real(value):
		"""A number, or the text of one, with all its digits, as YADE takes it.

		:raises TypeError, ValueError: for what is no number
		"""
		mpmath.mp.dps = max(mpmath.mp.dps, buildInfo()['digits'] + 4)  # it starts with 15; YADE sets the same with its first number
		return mpmath.mpf(mpmath.mp.convert(value))  # NumPy's, too
