# SPDX-License-Identifier: GPL-2.0-or-later
"""A sample of bodies within a boundary whose directions are each held at a stress or moved at a rate: what loading tests load.

Stresses and strains of loading tests are positive in compression, as in soil mechanics; those of polytope.bodyStress are YADE's, positive
in tension.
"""

import math
import weakref

import numpy as np
from tqdm import tqdm
from yade import O, Polytope, utils

from ..measures.arrays import arrays
from ..measures.porosity import solidVolume
from ..measures.stress import bodyStress
from ..scene.movers import moverOf, partsOf

__all__ = ['Sample', 'deepest', 'idsOfSample', 'replaceInSamples', 'tooDeep']

stressError, restingForce = 5e-4, 5e-3
"""Relative deviation from the target stress, and YADE's unbalanced force, below which a sample counts as settled."""
mostSteps = 200000
"""Steps after which a sample that does not settle is given up."""
between, looks = 20, 10
"""Steps between two looks at it, and how many in a row must find it at rest: one alone may be a turning point."""
deepest = 0.05
"""Mean overlap over the mean size of the bodies above which they are pressed into each other as no bodies are: some thousandths are usual."""
fastestStrain = 3e-4
"""Strain in a time step at which boundaries move at most while they look for a stress. The step follows from the grains' own periods: neighbours that
meet at this rate overlap by some 1e-3 of their size."""
quasiStatic = 1e-3
"""Inertial number of tests by default: below it the answer does not depend on the rate (GDR MiDi 2004, Eur. Phys. J. E 14:341)."""


_samples = weakref.WeakSet()


def _isThere(k, body):
	"""Whether the scene's body k is this one: its text has its address, which no other one has while this one is kept."""
	return k < len(O.bodies) and repr(O.bodies[k]) == repr(body)


def replaceInSamples(k, pieces):
	"""A body of the scene has been broken: its pieces take its place in the samples that it is in."""
	for sample in _samples:
		if k in sample.volumes and sample.isPresent:
			sample.replace(k, pieces)


def tooDeep(overlap):
	"""Message where bodies are pressed into each other."""
	seen = f'the bodies overlap by {100 * overlap:.2g} % of their size on average, which no bodies do'
	return f'{seen}; give the material a higher normalStiffness, or a lower stress, or a larger porosity'


def idsOfSample(ids):
	"""Ids of the bodies and clumps that can move.

	:raises ValueError: naming *ids*
	"""
	chosen = [k for k in dict.fromkeys(map(moverOf, ids)) if O.bodies[k].dynamic]
	if not chosen:
		raise ValueError('ids: the sample has no body that can move')
	for part in (part for k in chosen for part in partsOf(k)):
		shape = O.bodies[part].shape
		if not isinstance(shape, Polytope) or shape.dimension != 3:
			raise ValueError(f'ids: a sample is made of polyhedra, and body {part} is none')
	return chosen


class Sample:
	"""Base of samples between walls, in a periodic cell, in a shear frame, in a shear box.

	:ivar list ids: of the bodies; a clump's for all its members
	:ivar ndarray extents: lengths of the sample [m]
	"""

	def __init__(self, ids):
		self.ids = idsOfSample(ids)
		self._first = O.bodies[self.ids[0]]
		self.volumes = {k: solidVolume(k) for k in self.ids}
		self.solidVolume = sum(self.volumes.values())
		self.mass = sum(float(O.bodies[k].state.mass) for k in self.ids)
		self.meanSize = (self.solidVolume / len(self.ids)) ** (1 / 3)
		self.stresses, self.rates, self.fastest = [None] * 3, [0.0] * 3, [math.inf] * 3
		self._boundary = {}
		_samples.add(self)

	@property
	def isPresent(self):
		"""Whether the scene is still the one with its bodies."""
		return _isThere(self.ids[0], self._first)

	def hold(self, ids):
		"""Takes these bodies as the sample's walls or plates."""
		self._boundary.update((k, O.bodies[k]) for k in ids)

	def mustBePresent(self):
		"""RuntimeError where the scene is another one by now: what moves the boundary, and all that is measured, would be of bodies that are gone."""
		if not self.isPresent:
			raise RuntimeError(
				f'sample: its body {self.ids[0]} is not in the present scene, as after O.load or O.reset; make it, and the test, anew: polytope.sample(lower=…, upper=…)'
			)
		gone = next((k for k, body in self._boundary.items() if not _isThere(k, body)), None)
		if gone is not None:
			seen = f'sample: body {gone}, of its walls or plates, is no longer in the scene; a shear test, and polytope.sample(), put others there'
			raise RuntimeError(f'{seen}: go on with their sample (test.sample), or make one anew: polytope.sample(lower=…, upper=…)')

	def replace(self, k, pieces):
		"""Pieces take the place of a body that breaks, and fill the same volume. Call it before the body is erased."""
		place = self.ids.index(k)
		self.ids[place : place + 1] = pieces
		del self.volumes[k]
		self.volumes.update((piece, solidVolume(piece)) for piece in pieces)
		self._first = O.bodies[self.ids[0]]

	@property
	def volume(self):
		"""[m³], voids included"""
		return float(np.prod(self.extents))

	@property
	def porosity(self):
		"""1 − volume of the bodies over that of the sample [-]. Overlaps of bodies in contact count twice."""
		return 1 - self.solidVolume / self.volume

	def stress(self):
		"""Mean stress of the sample by the contacts of its bodies [Pa], positive in compression: (3, 3) array.

		−1/V Σ f ⊗ (x − c) over bodies and their contacts, walls included; equal to the stress on the walls where all bodies are at rest
		(Love 1927, Weber 1966).
		"""
		return -sum(self.volumes[k] * one for k, one in bodyStress(self.ids).items()) / self.volume

	def control(self, stresses=None, rates=None):
		"""What the boundary does from the next step on, until it is told otherwise.

		:param dict stresses: axis (0, 1, 2) → normal stress that is held [Pa], positive in compression
		:param dict rates: axis → rate of shortening [1/s]; axes in neither stand still
		"""
		self.mustBePresent()
		for axis in range(3):
			self.stresses[axis] = None if stresses is None or axis not in stresses else float(stresses[axis])
			self.rates[axis] = 0.0 if rates is None else float(rates.get(axis, 0))
			self.fastest[axis] = fastestStrain / float(O.dt)
		self.apply()

	def inertialRate(self, stress, inertialNumber=quasiStatic):
		"""Strain rate [1/s] of an inertial number I = rate · d · √(ρ/p), with the mean size d."""
		density = self.mass / self.solidVolume
		return inertialNumber / (self.meanSize * math.sqrt(density / stress))

	def deviation(self):
		"""Largest relative difference of a held stress from its target."""
		now = self.boundaryStress()
		return max((abs(now[axis] / goal - 1) for axis, goal in enumerate(self.stresses) if goal), default=0.0)

	def overlap(self):
		"""Mean overlap of bodies in contact over their mean size [-]."""
		depths = arrays().contacts.depths
		depths = depths[depths > 0]
		return float(depths.mean()) / self.meanSize if len(depths) else 0.0

	def settle(self, steps=mostSteps, untouched=False):
		"""Steps until held stresses, if there are any, are met to 0.05 % and the bodies are at rest.

		:param bool untouched: bodies that bear no force at all count as being at rest
		:raises RuntimeError: if they are not after so many steps, or are pressed into each other
		"""
		quiet, seen = 0, ''
		with tqdm(desc='settling', unit=' steps', disable=None, leave=False) as bar:
			for _ in range(0, steps, between):
				for _ in range(between):
					O.step()
				unbalanced, deviation = float(utils.unbalancedForce()), self.deviation()  # nan where nothing bears a force
				seen = f'stress off by {100 * deviation:.2g} %, unbalanced force {unbalanced:.2g}'
				bar.set_postfix_str(seen, refresh=False)
				bar.update(between)
				resting = unbalanced < restingForce or untouched and math.isnan(unbalanced)
				quiet = quiet + 1 if resting and deviation < stressError else 0
				if quiet == looks:
					return
				if (pressed := self.overlap()) > deepest:
					raise RuntimeError(f'loading: {tooDeep(pressed)}')
		raise RuntimeError(
			f'loading: the sample has not come to rest within {steps} steps ({seen}); give more damping, or a stress that it can bear'
		)
