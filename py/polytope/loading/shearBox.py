# SPDX-License-Identifier: GPL-2.0-or-later
"""Direct shear in a box of two halves."""

import math

from ..arguments import namedArguments
from ..precision import isNumber
from .loadingTest import LoadingTest, checkGoal, checkStress
from .sample import quasiStatic
from .splitBox import SplitBox
from .walls import WalledSample

__all__ = ['ShearBox', 'shearBox']

band = 10
"""Thickness of the sheared zone over the mean size of the bodies, to tell a strain rate from a speed (Mühlhaus & Vardoulakis 1987)."""


class ShearBox(LoadingTest):
	"""What polytope.shearBox() returns. Columns of the record: *displacement* [m], *shearStress*, *normalStress* [Pa], *stressRatio* [-],
	*rise* of the upper plate since the start [m]. Stresses are forces over the area at the beginning."""

	axes = (('displacement', ['stressRatio']), ('displacement', ['rise']))
	titles = {'displacement': 'displacement [m]', 'stressRatio': 'shear over normal stress [-]', 'rise': 'rise of the upper plate [m]'}

	def __init__(self, sample, stress, speed, inertialNumber):
		if not isinstance(sample, WalledSample):
			raise ValueError('sample: a shear box has walls; in a periodic cell take polytope.simpleShear')
		super().__init__(sample, None, inertialNumber, stress)
		# strain is in a band of some grains between the halves
		self.speed = self.rate * band * sample.meanSize if speed is None else speed
		if not isNumber(self.speed) or not 0 < self.speed < math.inf:
			raise ValueError(f'speed: must be above 0 [m/s], got {speed!r}')
		self.sample = SplitBox(sample)
		self.sample.control(stresses={2: stress})
		self.sample.settle()
		self.begin()
		self.settled = self.sample.rise

	def measure(self):
		shear, normal = self.sample.shearStress(), self.sample.boundaryStress()[2]
		return {
			'displacement': self.sample.displacement,
			'shearStress': shear,
			'normalStress': normal,
			'stressRatio': shear / normal,
			'rise': self.sample.rise - self.settled,
		}

	def run(self, displacement):
		"""Moves the upper half along x to this displacement, then stops it.

		:param float displacement: [m], counted from the start of the test, not from the last run; less than now: back
		"""
		checkGoal(displacement, 'displacement')
		if not abs(displacement) <= self.sample.longest:
			seen = (
				f'displacement: at most {self.sample.longest:.3g} m, a quarter of the box, so that it does not open, got {displacement!r}'
			)
			raise ValueError(seen)
		self.sample.speed = self.speed if displacement > self.sample.displacement else -self.speed
		self.until(lambda: self.sample.displacement, displacement)
		self.sample.speed = 0.0


@namedArguments
def shearBox(sample, stress, speed=None, inertialNumber=quasiStatic):
	"""Direct shear: the upper half of the box slides along x over the lower one, under a constant normal stress:
	``polytope.shearBox(sample, 1e5).run(0.01)``.

	The sample's walls are replaced by plates at the same places: sides with the walls' friction, rough plates (of the bodies' own material) below
	and above. Halves divide the height in two, with a gap of a twentieth of a body between them; sides are a quarter of the length thick,
	so the box stays closed up to that displacement.

	:param sample: what polytope.pack returns, between walls
	:param float stress: normal stress [Pa], positive, on the area at the beginning
	:param float speed: of the upper half [m/s]; default that of the inertial number in a band of ten grains
	:param float inertialNumber: of the test [-]; default 1e-3, quasi-static
	:returns: ShearBox, with run(displacement), record, columns, plot(path)
	:raises ValueError: naming the argument
	"""
	checkStress(stress)
	return ShearBox(sample, float(stress), speed, inertialNumber)
