# SPDX-License-Identifier: GPL-2.0-or-later
"""What all loading tests share: steps until something is reached, a record of what was measured on the way, and its curves as a picture."""

import math
import os

import numpy as np
from tqdm import tqdm
from yade import O

from ..precision import isNumber
from .sample import Sample, quasiStatic

__all__ = ['LoadingTest', 'checkAxis', 'checkGoal', 'checkStress']

records = 200
"""Rows of the record for each run()."""


def checkStress(stress, name='stress'):
	if isinstance(stress, bool) or not isNumber(stress) or not 0 < stress < math.inf:
		raise ValueError(f'{name}: must be a number above 0, and finite [Pa], got {stress!r}')


def checkGoal(value, name):
	"""Refuses a goal of run() that is not a number: it would record rows without a step."""
	if isinstance(value, bool) or not isNumber(value) or not abs(value) < math.inf:
		raise ValueError(f'{name}: must be a finite number, got {value!r}')


def checkAxis(axis):
	if isinstance(axis, bool) or axis not in (0, 1, 2):
		raise ValueError(f'axis: must be 0, 1 or 2, got {axis!r}')


class LoadingTest:
	"""Base of the tests. Stresses and strains are positive in compression, strains logarithmic from the start of the test.

	:ivar dict record: name → list of what was measured since the start; *columns* has them as arrays
	"""

	axes = ()
	"""(abscissa, [ordinates]) of each diagram of plot()."""
	titles = {}
	"""Column → axis label."""

	def __init__(self, sample, rate=None, inertialNumber=quasiStatic, stress=None):
		if not isinstance(sample, Sample):
			raise ValueError(f'sample: must be what polytope.pack returns, or polytope.sample(), got {sample!r}')
		sample.mustBePresent()
		self.sample, self.record = sample, {}
		if rate is not None and not (isNumber(rate) and 0 < rate < math.inf):
			raise ValueError(f'rate: must be a strain rate above 0 [1/s], got {rate!r}')
		if not (isNumber(inertialNumber) and 0 < inertialNumber < math.inf):
			raise ValueError(f'inertialNumber: must be above 0, got {inertialNumber!r}')
		self.rate = rate if rate is not None else sample.inertialRate(stress, inertialNumber)

	def begin(self):
		"""Strains and displacements (refPos) count from here."""
		self.start = np.array(self.sample.extents)
		for k in self.sample.ids:
			for part in (k, *(O.bodies[k].shape.members if O.bodies[k].isClump else ())):
				state = O.bodies[part].state
				state.refPos, state.refOri = state.pos, state.ori

	def strains(self):
		"""Logarithmic strain along each axis since the start [-], positive in compression."""
		return np.log(self.start / self.sample.extents)

	def measure(self):
		"""One row of the record: dictionary."""
		raise NotImplementedError

	@property
	def columns(self):
		"""The record as arrays."""
		return {name: np.array(values) for name, values in self.record.items()}

	def note(self):
		"""Adds a row to the record."""
		for name, value in self.measure().items():
			self.record.setdefault(name, []).append(value)

	def until(self, progress, goal, rows=records):
		"""Steps until progress() has gone from what it is to *goal*, and notes so many rows at equal distances."""
		self.sample.mustBePresent()
		begin = progress()
		sign = 1 if goal >= begin else -1
		marks = np.linspace(begin, goal, rows + 1)[0 if not self.record else 1 :]
		for mark in tqdm(marks, desc='loading', unit=' rows', disable=None, leave=False):
			while sign * (mark - progress()) > 0:
				O.step()
			self.note()

	def plot(self, path):
		"""Draws the record's curves into a PNG, SVG or PDF file; makes its folder where there is none."""
		from matplotlib.figure import Figure

		if not self.record:
			raise ValueError('plot: nothing is recorded yet; run the test first')
		columns = self.columns
		figure = Figure(figsize=(6.4 * len(self.axes), 4.8), layout='constrained')
		for diagram, (abscissa, ordinates) in zip(np.atleast_1d(figure.subplots(1, len(self.axes))), self.axes, strict=True):
			for name in ordinates:
				diagram.plot(columns[abscissa], columns[name], label=self.titles[name])
			diagram.set_xlabel(self.titles[abscissa])
			if len(ordinates) == 1:
				diagram.set_ylabel(self.titles[ordinates[0]])
			else:
				diagram.legend()
			diagram.grid(alpha=0.3)
		os.makedirs(os.path.dirname(os.path.abspath(path)), exist_ok=True)
		figure.savefig(path, dpi=120)
