# SPDX-License-Identifier: GPL-2.0-or-later
"""Simple shear under a constant normal stress: between plates whose sides tilt with the sample, or in a periodic cell at any strain."""

import math

from ..arguments import namedArguments
from .loadingTest import LoadingTest, checkGoal, checkStress
from .sample import quasiStatic
from .shearFrame import ShearFrame
from .walls import WalledSample

__all__ = ['SimpleShear', 'simpleShear']


class SimpleShear(LoadingTest):
	"""What polytope.simpleShear() returns. Columns of the record: *shearStrain* [-], *shearStress*, *normalStress* [Pa], *stressRatio*, *axialStrain*
	(along z, compression positive: that of the volume, too), *porosity* [-]."""

	axes = (('shearStrain', ['stressRatio']), ('shearStrain', ['axialStrain']))
	titles = {
		'shearStrain': 'shear strain [-]',
		'stressRatio': 'shear over normal stress [-]',
		'axialStrain': 'axial strain [-], compression positive',
	}

	def __init__(self, sample, stress, rate, inertialNumber):
		super().__init__(sample, rate, inertialNumber, stress)
		self.sample = ShearFrame(sample) if isinstance(sample, WalledSample) else sample
		self.largest = self.sample.steepest if isinstance(self.sample, ShearFrame) else math.inf
		self.sample.control(stresses={2: stress})
		self.sample.settle()
		self.begin()
		self.begun = self.sample.shearStrain()

	def strain(self):
		"""Shear strain since the start [-]."""
		return self.sample.shearStrain() - self.begun

	def measure(self):
		shear, normal = self.sample.shearStress(), self.sample.boundaryStress()[2]
		return {
			'shearStrain': self.strain(),
			'shearStress': shear,
			'normalStress': normal,
			'stressRatio': shear / normal,
			'axialStrain': self.strains()[2],
			'porosity': self.sample.porosity,
		}

	def run(self, strain):
		"""Shears to this strain, then stands still.

		:param float strain: displacement over height (0.3 is 30 %), counted from the start of the test, not from the last run; less than now: back
		"""
		checkGoal(strain, 'strain')
		if not abs(self.begun + strain) <= self.largest:
			before = f' after {self.begun:.3g} of an earlier test' if self.begun else ''
			raise ValueError(f'strain: between plates at most {self.largest:g}{before}, got {strain!r}; for more take a periodic cell')
		self.sample.shear(self.rate if strain > self.strain() else -self.rate)
		self.until(self.strain, strain)
		self.sample.shear(0.0)


@namedArguments
def simpleShear(sample, stress, rate=None, inertialNumber=quasiStatic):
	"""Simple shear: velocity along x in proportion to z, under a constant normal stress along z:
	``polytope.simpleShear(sample, stress=1e5).run(0.3)``.

	Lengths along x and y do not change. Between walls, the sample gets rough plates (of the bodies' own material) below and above, and sides
	that tilt with it, to a strain of 1. A periodic cell may be sheared on and on.

	:param sample: what polytope.pack returns
	:param float stress: normal stress [Pa], positive
	:param float rate: of the shear strain [1/s]; default that of the inertial number
	:param float inertialNumber: of the test [-]; default 1e-3, quasi-static
	:returns: SimpleShear, with run(strain), record, columns, plot(path)
	:raises ValueError: naming the argument
	"""
	checkStress(stress)
	return SimpleShear(sample, float(stress), rate, inertialNumber)
