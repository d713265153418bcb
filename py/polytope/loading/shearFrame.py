# SPDX-License-Identifier: GPL-2.0-or-later
"""A sample in a frame of plates that shears it, as a simple shear apparatus does."""

import math

import numpy as np
from yade import O

from .plates import force, moveTo, plate, replaced, thickness
from .servo import eased
from .shearApparatus import ShearApparatus

__all__ = ['ShearFrame']


class ShearFrame(ShearApparatus):
	"""Rough plates below and above, sides along x that tilt with the sample, the walls that it had along y.

	The lower plate stands still. The upper one holds the normal stress along z, and moves along x; the sides turn about their feet.
	"""

	name = 'shear frame'
	steepest = 1.0
	"""Largest shear strain for which the sides are long enough."""

	def __init__(self, sample):
		super().__init__(sample)
		low, high = sample.lower, sample.upper
		self.foot, (self.length, self.width, self.height) = low, sample.extents
		self.thick, self.shearRate = thickness * self.length, 0.0
		replaced([*sample.walls[0], *sample.walls[2]])
		aside = np.array([self.length + 2 * self.height * self.steepest, self.length, 0])
		up = np.array([0, 0, self.thick])
		self.bottom = plate(low - aside - up, [*(high + aside)[:2], low[2]], self.rough)
		self.top = plate([*(low - aside)[:2], high[2]], high + aside + up, self.rough)
		reach = np.array([0, self.length, self.height * self.steepest])  # beyond both plates, at every tilt
		self.sides = [
			plate(low - reach - (self.thick, 0, 0), [low[0], *(high + reach)[1:]], self.smooth),
			plate([high[0], *(low - reach)[1:]], high + reach + (self.thick, 0, 0), self.smooth),
		]
		self.hold([*sample.walls[1], self.bottom, self.top, *self.sides])
		self.tilt, self.rate = 0.0, 0.0

	@property
	def extents(self):
		return np.array([self.length, self.width, self.height])

	@property
	def area(self):
		"""Of the sample in a section normal to z [m²]."""
		return self.length * self.width

	def shearStrain(self):
		"""Displacement of the upper plate over the height [-]."""
		return self.displacement / self.height

	def shearStress(self):
		"""Shear stress on the upper plate along x [Pa], positive where it resists shear()."""
		return -float(force(self.top)[0]) / self.area

	def shear(self, rate):
		"""Simple shear from now on at this rate [1/s]."""
		self.shearRate = rate

	def move(self):
		"""Sets the plates' velocities for this step."""
		dt, speed = float(O.dt), self.speedOfTop(self.height)
		# both grow together: the sides stay straight between the plates
		self.rate = eased(self.rate, self.shearRate)
		self.displacement += (self.rate * self.height + self.shearStrain() * speed) * dt
		self.height += speed * dt
		middle = self.foot + np.array([self.length, self.width, self.height]) / 2
		moveTo(self.top, (middle[0] + self.displacement, middle[1], self.foot[2] + self.height + self.thick / 2))
		tilt = math.atan(self.shearStrain())
		across = np.array([math.cos(tilt), 0, -math.sin(tilt)])
		for k, sign in zip(self.sides, (-1, 1), strict=True):
			inner = middle + (self.displacement / 2 + sign * self.length / 2, 0, 0)
			moveTo(k, inner + sign * self.thick / 2 * across, (tilt - self.tilt) / dt)
		self.tilt = tilt
