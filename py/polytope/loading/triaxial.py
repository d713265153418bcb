# SPDX-License-Identifier: GPL-2.0-or-later
"""Triaxial compression or extension, between rigid walls or in a periodic cell."""

from ..arguments import namedArguments
from .loadingTest import LoadingTest, checkAxis, checkGoal, checkStress
from .sample import quasiStatic

__all__ = ['Triaxial', 'triaxial']


largest = 0.7
"""Logarithmic strain up to which a test is run: more, 1 as well, is a percentage that was not divided by 100."""


class Triaxial(LoadingTest):
	"""What polytope.triaxial() returns. Columns of the record: *axialStrain*, *volumetricStrain* [-], *axialStress*, *lateralStress* (mean of
	both), *deviator* [Pa], *porosity* [-]."""

	axes = (('axialStrain', ['deviator']), ('axialStrain', ['volumetricStrain']))
	titles = {
		'axialStrain': 'axial strain [-]',
		'deviator': 'axial − lateral stress [Pa]',
		'volumetricStrain': 'volumetric strain [-], compression positive',
	}

	def __init__(self, sample, stress, axis, rate, inertialNumber):
		super().__init__(sample, rate, inertialNumber, stress)
		self.stress, self.axis = stress, axis
		self.lateral = [k for k in range(3) if k != axis]
		self.hold()
		self.begin()

	def hold(self):
		"""All three stresses at the confining one, until the sample has settled."""
		self.sample.control(stresses=dict.fromkeys(range(3), self.stress))
		self.sample.settle()

	def measure(self):
		stresses, strains = self.sample.boundaryStress(), self.strains()
		axial, lateral = stresses[self.axis], stresses[self.lateral].mean()
		return {
			'axialStrain': strains[self.axis],
			'volumetricStrain': strains.sum(),
			'axialStress': axial,
			'lateralStress': lateral,
			'deviator': axial - lateral,
			'porosity': self.sample.porosity,
		}

	def run(self, strain):
		"""Shortens the sample to this axial strain, then stands still.

		:param float strain: 0.02 is 2 %, counted from the start of the test, not from the last run: run(0.01) and then run(0.02) end at 2 %.
		    Negative: extension; less than now: unloading. At most 0.7
		"""
		checkGoal(strain, 'strain')
		if not abs(strain) <= largest:
			raise ValueError(f'strain: must be at most {largest:g}, a shortening to half (0.02 is 2 %), got {strain!r}')
		now = self.strains()[self.axis]
		lateral = dict.fromkeys(self.lateral, self.stress)
		self.sample.control(stresses=lateral, rates={self.axis: self.rate if strain > now else -self.rate})
		self.until(lambda: self.strains()[self.axis], strain)
		self.sample.control(stresses=lateral)


@namedArguments
def triaxial(sample, stress, axis=2, rate=None, inertialNumber=quasiStatic):
	"""Triaxial test: lateral stresses are held, the axis is shortened at a constant rate: ``polytope.triaxial(sample, stress=1e5).run(0.2)``.

	First brings all three stresses to *stress* and waits for rest; strains count from there.

	:param sample: what polytope.pack returns, between walls or in a periodic cell
	:param float stress: confining stress [Pa], positive
	:param int axis: 0, 1 or 2
	:param float rate: of the axial strain [1/s]; default that of the inertial number
	:param float inertialNumber: of the test [-]; default 1e-3, quasi-static
	:returns: Triaxial, with run(strain), record, columns, plot(path)
	:raises ValueError: naming the argument
	"""
	checkStress(stress)
	checkAxis(axis)
	return Triaxial(sample, float(stress), axis, rate, inertialNumber)
