# SPDX-License-Identifier: GPL-2.0-or-later
"""What the boundaries of shear tests share: a rough plate below that stands still, and one above that holds the normal stress along z."""

import numpy as np
from yade import O

from ..scene.movers import partsOf
from .plates import force
from .sample import Sample
from .servo import Servo, actOn

__all__ = ['ShearApparatus']


class ShearApparatus(Sample):
	"""Takes the bodies of a sample between walls. A subclass has

	- *name*, of the apparatus, for messages,
	- *area*, which the normal stress acts on [m²],
	- *bottom* and *top*, its rough plates, and *displacement* along x [m],
	- move(), which sets the plates' velocities for a step.

	Plates have the material of the first body, sides that of the walls.
	"""

	def __init__(self, sample):
		super().__init__(sample.ids)
		self.smooth = O.bodies[sample.walls[0][0]].material
		self.rough = next(O.bodies[part].material for part in partsOf(self.ids[0]))
		self.servo, self.displacement = Servo(self.mass), 0.0

	def boundaryStress(self):
		"""Normal stress [Pa] on the upper plate, positive in compression; the other two are not measured."""
		return np.array([np.nan, np.nan, force(self.top)[2] / self.area])

	def apply(self):
		if any(self.rates) or self.stresses[0] is not None or self.stresses[1] is not None:
			raise ValueError(f'sample: in a {self.name} only the stress along z can be held')
		actOn(self)

	def speedOfTop(self, height):
		"""Speed along z [m/s] with which the upper plate looks for its stress, in a sample of this height [m]; 0 where none is held."""
		if self.stresses[2] is None:
			return 0.0
		self.servo.fastest = self.fastest[2] * height
		return self.servo.step(force(self.top)[2] - self.stresses[2] * self.area)
