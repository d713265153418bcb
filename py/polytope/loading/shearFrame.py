# SPDX-License-Identifier: GPL-2.0-or-later
"""A sample in a frame of plates that shears it, as a simple shear apparatus does."""

import math

import numpy as np
from yade import O

from ..scene.movers import partsOf
from .plates import force, moveTo, plate, replaced, thickness
from .sample import Sample
from .servo import Servo, actOn, eased

__all__ = ['ShearFrame']


class ShearFrame(Sample):
	"""Rough plates below and above, sides along x that tilt with the sample, the walls that it had along y.

	The lower plate stands still. The upper one holds the normal stress along z, and moves along x; the sides turn about their feet.
	"""

	steepest = 1.0
	"""Largest shear strain for which the sides are long enough."""

	def __init__(self, sample):
		super().__init__(sample.ids)
		low, high = sample.lower, sample.upper
		smooth = O.bodies[sample.walls[0][0]].material
		rough = next(O.bodies[part].material for part in partsOf(self.ids[0]))
		self.foot, (self.length, self.width, self.height) = low, sample.extents
		self.thick, self.displacement, self.shearRate = thickness * self.length, 0.0, 0.0
		replaced([*sample.walls[0], *sample.walls[2]])
		aside = np.array([self.length + 2 * self.height * self.steepest, self.length, 0])
		up = np.array([0, 0, self.thick])
		self.bottom = plate(low - aside - up, [*(high + aside)[:2], low[2]], rough)
		self.top = plate([*(low - aside)[:2], high[2]], high + aside + up, rough)
		reach = np.array([0, self.length, self.height * self.steepest])  # beyond both plates, at every tilt
		self.sides = [
			plate(low - reach - (self.thick, 0, 0), [low[0], *(high + reach)[1:]], smooth),
			plate([high[0], *(low - reach)[1:]], high + reach + (self.thick, 0, 0), smooth),
		]
		self.hold([*sample.walls[1], self.bottom, self.top, *self.sides])
		self.servo, self.tilt, self.rate = Servo(self.mass), 0.0, 0.0

	@property
	def extents(self):
		return np.array([self.length, self.width, self.height])

	def boundaryStress(self):
		"""Normal stress [Pa] on the upper plate, positive in compression; the other two are not measured."""
		return np.array([np.nan, np.nan, force(self.top)[2] / (self.length * self.width)])

	def shearStrain(self):
		"""Displacement of the upper plate over the height [-]."""
		return self.displacement / self.height

	def shearStress(self):
		"""Shear stress on the upper plate along x [Pa], positive where it resists shear()."""
		return -float(force(self.top)[0]) / (self.length * self.width)

	def shear(self, rate):
		"""Simple shear from now on at this rate [1/s]."""
		self.shearRate = rate

	def apply(self):
		if any(self.rates) or self.stresses[0] is not None or self.stresses[1] is not None:
			raise ValueError('sample: in a shear frame only the stress along z can be held')
		actOn(self)

	def move(self):
		"""Sets the plates' velocities for this step."""
		dt = float(O.dt)
		speed = 0.0
		if self.stresses[2] is not None:
			self.servo.fastest = self.fastest[2] * self.height
			speed = self.servo.step(force(self.top)[2] - self.stresses[2] * self.length * self.width)
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
