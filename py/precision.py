# SPDX-License-Identifier: GPL-2.0-or-later
"""The one place where a script's numbers become YADE's.

In YADE's double they are Python's floats; its wider precisions hand out and take mpmath's, with as many digits as they have.
"""
from yade._polytope import buildInfo

__all__ = ['real']

if buildInfo()['precision'] == 'double':
	real = float
else:
	import mpmath

	def real(value):
		"""A number (or the text of one) with all its digits, as YADE takes it.

		:raises TypeError, ValueError: for what is no number
		"""
		mpmath.mp.dps = max(mpmath.mp.dps, buildInfo()['digits'] + 4)  # mpmath starts with 15; YADE sets the same with its first number
		return mpmath.mpf(value)
