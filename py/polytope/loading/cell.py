# SPDX-License-Identifier: GPL-2.0-or-later
"""A sample in a periodic cell, moved by YADE's PeriTriaxController, which measures by YADE's getStress: right for any shape."""

import math

import numpy as np
from yade import Matrix3, O, PeriTriaxController, utils

from ..bonding.bonds import bonds
from ..scene.present import insertEngine, placeOfForces
from .sample import Sample
from .servo import massShare

__all__ = ['PeriodicSample']

far = 20.0
"""Logarithmic strain as the controller's goal where a direction is moved at its largest rate: never reached."""


def _withoutBonds():
	engine = bonds()
	if engine and engine.intactCount:
		raise RuntimeError(
			f'sample: has {engine.intactCount} intact bonds, whose stress a periodic cell does not feel (YADE measures it by contacts alone); load it between walls: polytope.sample() with O.periodic = False'
		)


class PeriodicSample(Sample):
	"""Bodies in O.cell; what polytope.pack(…, periodic=True) returns."""

	def __init__(self, ids):
		super().__init__(ids)
		_withoutBonds()
		self.shearRate = 0.0

	@property
	def extents(self):
		"""Edges of the rectangular cell of the same base and height: the diagonal of hSize. Shear leaves them as they are."""
		return np.abs(np.diag(np.array(O.cell.hSize, float).reshape(3, 3)))

	@property
	def volume(self):
		return abs(float(O.cell.volume))

	def stress(self):
		"""Mean stress by the contacts [Pa], positive in compression: (3, 3) array; YADE's getStress."""
		return -np.array(utils.getStress(), float).reshape(3, 3)

	def boundaryStress(self):
		"""Normal stresses [Pa], positive in compression."""
		return np.diag(self.stress())

	def apply(self):
		_withoutBonds()
		controller = self._controller()
		goal, fastest, mask = [0.0] * 3, [0.0] * 3, 0
		for axis in range(3):
			if self.stresses[axis] is None:
				goal[axis], fastest[axis] = (-far if self.rates[axis] > 0 else far), abs(self.rates[axis])
			else:
				mask |= 1 << axis
				goal[axis], fastest[axis] = -self.stresses[axis], self.fastest[axis]
		controller.stressMask, controller.goal, controller.maxStrainRate = mask, goal, fastest
		# inertia against a change of length, as the controller counts it: mass over length, with the mass of a wall
		controller.mass = massShare * self.mass / float(np.mean(self.extents))

	def shearStrain(self):
		"""Displacement along x over height, of the deformation gradient, which goes on where the cell is replaced by a less tilted one [-]."""
		gradient = np.array(O.cell.trsf, float).reshape(3, 3)
		return float(gradient[0, 2] / gradient[2, 2])

	def shearStress(self):
		"""Shear stress on the planes z along x [Pa], positive where it resists shear()."""
		return -float(self.stress()[0, 2])

	def shear(self, rate):
		"""Simple shear from now on: velocity along x in proportion to z [1/s]. The cell is replaced by an equal, less tilted one at half of 45°."""
		self.shearRate = rate
		O.cell.flipFlippable = True
		gradient = np.array(O.cell.velGrad, float).reshape(3, 3)
		gradient[0, 2] = rate
		O.cell.velGrad = Matrix3(*gradient.ravel().tolist())

	def _controller(self):
		found = next((engine for engine in O.engines if isinstance(engine, PeriTriaxController)), None)
		if found is None:
			# no damping of its own (YADE's default is 0.25): it would take part in the balance of a cell that deforms
			found = PeriTriaxController(dynCell=True, growDamping=0, absStressTol=math.inf, relStressTol=math.inf, maxUnbalanced=-1)
			insertEngine(placeOfForces('PeriTriaxController measures and moves the cell'), found)
		return found
