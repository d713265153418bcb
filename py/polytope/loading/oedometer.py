# SPDX-License-Identifier: GPL-2.0-or-later
"""One-dimensional compression, between rigid walls or in a periodic cell."""

from ..arguments import namedArguments
from .loadingTest import LoadingTest, checkAxis, checkStress

__all__ = ['Oedometer', 'oedometer']


class Oedometer(LoadingTest):
	"""What polytope.oedometer() returns. Columns of the record: *axialStress*, *lateralStress* (mean of both) [Pa], *axialStrain*, *voidRatio*,
	*lateralRatio* (lateral over axial stress, K₀ at rest) [-]."""

	axes = (('axialStress', ['voidRatio']), ('axialStress', ['lateralRatio']))
	titles = {'axialStress': 'axial stress [Pa]', 'voidRatio': 'void ratio [-]', 'lateralRatio': 'lateral over axial stress [-]'}

	def __init__(self, sample, axis):
		super().__init__(sample, rate=1)
		self.axis, self.lateral = axis, [k for k in range(3) if k != axis]
		sample.control()
		self.begin()
		self.note()

	def measure(self):
		stresses, porosity = self.sample.boundaryStress(), self.sample.porosity
		axial, lateral = stresses[self.axis], stresses[self.lateral].mean()
		return {
			'axialStress': axial,
			'lateralStress': lateral,
			'lateralRatio': lateral / axial if axial else float('nan'),
			'axialStrain': self.strains()[self.axis],
			'voidRatio': porosity / (1 - porosity),
		}

	def load(self, *stresses):
		"""Loads to each of these axial stresses [Pa] in turn, waits for rest, and notes a row: stages of an oedometer test, unloading as well."""
		if not stresses:
			raise ValueError('stresses: give the axial stresses of the stages [Pa], such as load(1e5, 2e5, 4e5, 1e5)')
		for stress in stresses:
			checkStress(stress, 'stresses')
		for stress in stresses:
			self.sample.control(stresses={self.axis: stress})
			self.sample.settle()
			self.note()


@namedArguments
def oedometer(sample, axis=2):
	"""Oedometer test: no lateral strain, the axial stress goes through stages: ``polytope.oedometer(sample).load(1e5, 2e5, 4e5, 1e5)``.

	:param sample: what polytope.pack returns, between walls or in a periodic cell
	:param int axis: 0, 1 or 2
	:returns: Oedometer, with load(stress, …), record, columns, plot(path)
	:raises ValueError: naming the argument
	"""
	checkAxis(axis)
	return Oedometer(sample, axis)
