# SPDX-License-Identifier: GPL-2.0-or-later
"""Distributions of the radii of joints.

A disc is the more likely to reach into a region the larger it is. So radii are drawn weighted by their powers 0, 1 and 2 (jointSets.py),
which each of these distributions gives in closed form.
"""

import math

import numpy as np

from ..precision import isNumber

__all__ = ['radiiOf']


class Constant:
	"""Radii that are all equal."""

	def __init__(self, radius):
		self.radius = radius

	def moment(self, power):
		"""Mean of the radius to this power."""
		return self.radius**power

	def draw(self, power, number, random):
		"""Radii [m] from the distribution weighted by the radius to this power."""
		return np.full(number, self.radius)


class Exponential:
	"""Density exp(−r/mean)/mean. Weighted by r^k: a gamma distribution of shape k + 1."""

	def __init__(self, mean):
		self.mean = mean

	def moment(self, power):
		return math.factorial(power) * self.mean**power

	def draw(self, power, number, random):
		return random.gamma(power + 1, self.mean, number)


class LogNormal:
	"""ln r is normal. Weighted by r^k: the same with the mean of ln r larger by k times its variance."""

	def __init__(self, mean, deviation):
		self.variance = math.log1p((deviation / mean) ** 2)
		self.middle = math.log(mean) - self.variance / 2

	def moment(self, power):
		return math.exp(power * self.middle + power**2 * self.variance / 2)

	def draw(self, power, number, random):
		return random.lognormal(self.middle + power * self.variance, math.sqrt(self.variance), number)


class PowerLaw:
	"""Density in proportion to r^−exponent between two radii. Weighted by r^k: the exponent is less by k."""

	def __init__(self, smallest, largest, exponent):
		self.smallest, self.largest, self.exponent = smallest, largest, exponent

	def moment(self, power):
		return self._integral(self.exponent - power) / self._integral(self.exponent) * self.smallest**power

	def draw(self, power, number, random):
		rest, part = 1 - (self.exponent - power), random.random(number)
		ratio = self.largest / self.smallest
		if abs(rest) < nearlyOne:
			return self.smallest * ratio**part
		return self.smallest * (1 + part * (ratio**rest - 1)) ** (1 / rest)

	def _integral(self, exponent):
		"""Integral of x^−exponent from 1 to the ratio of both radii."""
		rest, ratio = 1 - exponent, self.largest / self.smallest
		return math.log(ratio) if abs(rest) < nearlyOne else (ratio**rest - 1) / rest


nearlyOne = 1e-9
"""An exponent this near to one is one: the integral of its power is a logarithm, and the general formula has lost its digits."""

kinds = {
	'exponential': (Exponential, 'mean'),
	'lognormal': (LogNormal, 'mean, standard deviation'),
	'powerLaw': (PowerLaw, 'smallest, largest, exponent'),
}


def radiiOf(radius):
	"""The distribution that a script's argument *radius* names.

	:raises ValueError: naming *radius*
	"""
	if isNumber(radius) and not isinstance(radius, bool):
		given, make = (radius,), Constant
	else:
		name, given = (radius[0], tuple(radius[1:])) if isinstance(radius, (tuple, list)) and radius else (None, ())
		make, takes = kinds.get(name if isinstance(name, str) else None, (None, ''))
		if make is None or len(given) != len(takes.split(',')):
			forms = ', '.join(f"('{name}', {takes})" for name, (_, takes) in kinds.items())
			raise ValueError(f'radius: must be a number [m], or one of {forms}, got {radius!r}')
	positive = given[:2] if make is PowerLaw else given
	if not all(isNumber(x) and not isinstance(x, bool) and math.isfinite(x) for x in given) or not all(x > 0 for x in positive):
		raise ValueError(f'radius: lengths must be positive and finite [m], got {radius!r}')
	if make is PowerLaw and not given[0] < given[1]:
		raise ValueError(f'radius: the smallest must be below the largest, got {radius!r}')
	return make(*(float(x) for x in given))
