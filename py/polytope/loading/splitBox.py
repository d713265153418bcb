# SPDX-License-Identifier: GPL-2.0-or-later
"""A sample in a box of two halves, the upper of which slides over the lower one."""

import numpy as np
from yade import O

from .plates import force, moveTo, plate, replaced, thickness
from .servo import eased
from .shearApparatus import ShearApparatus

__all__ = ['SplitBox']


gap = 0.05
"""Gap between the halves, over the mean size of the bodies: what slides over the lower half's rim must not lean on it, as in the apparatus;
no grain falls through."""


class SplitBox(ShearApparatus):
	"""Lower half: a rough bottom and four smooth sides, which stand still. Upper half: four smooth sides that move along x, and a rough
	plate that moves with them and holds the normal stress along z, on the area that the box had at the beginning.
	"""

	name = 'shear box'

	def __init__(self, sample):
		super().__init__(sample)
		low, high = sample.lower, sample.upper
		self.begun, self.area = np.array(sample.extents), float(np.prod(sample.extents[:2]))
		self.longest = thickness * float(self.begun[0])
		replaced([k for pair in sample.walls for k in pair])
		thick, middle = np.full(3, self.longest), (low[2] + high[2]) / 2
		outer = low - thick, high + thick
		self.bottom = plate(outer[0], [*outer[1][:2], low[2]], self.rough)
		above = high[2] + self.begun[2]  # room for the plate, which moves between the sides
		half = gap / 2 * sample.meanSize
		self.lowerSides = _sides(low, high, thick, outer[0][2], middle - half, self.smooth)
		self.upperSides = _sides(low, high, thick, middle + half, above, self.smooth)
		self.top = plate([*outer[0][:2], high[2]], [*outer[1][:2], high[2] + self.longest], self.rough)
		self.hold([self.bottom, self.top, *self.lowerSides, *self.upperSides])
		self.places = {k: np.array(O.bodies[k].state.pos, float) for k in (*self.upperSides, self.top)}
		self.speed, self.present, self.rise = 0.0, 0.0, 0.0

	@property
	def extents(self):
		return self.begun + (0, 0, self.rise)

	def shearStress(self):
		"""Force along x between the halves over the area at the beginning [Pa], positive where it resists the displacement."""
		return -float(force(self.top, *self.upperSides)[0]) / self.area

	def move(self):
		"""Sets the velocities of the upper half for this step."""
		dt, speed = float(O.dt), self.speedOfTop(float(self.begun[2]))
		self.present = eased(self.present, self.speed)
		self.displacement += self.present * dt
		self.rise += speed * dt
		for k in self.upperSides:
			moveTo(k, self.places[k] + (self.displacement, 0, 0))
		moveTo(self.top, self.places[self.top] + (self.displacement, 0, self.rise))


def _sides(low, high, thick, bottom, top, material):
	"""Four plates round a box, from one height to another."""
	outer = low - thick, high + thick
	return [
		plate([outer[0][0], outer[0][1], bottom], [low[0], outer[1][1], top], material),
		plate([high[0], outer[0][1], bottom], [outer[1][0], outer[1][1], top], material),
		plate([low[0], outer[0][1], bottom], [high[0], low[1], top], material),
		plate([low[0], high[1], bottom], [high[0], outer[1][1], top], material),
	]
