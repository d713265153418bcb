# SPDX-License-Identifier: GPL-2.0-or-later
"""A sample between six walls, YADE's Wall: planes without edges, which may pass through each other as the box becomes smaller."""

import itertools

import numpy as np
from yade import Bo1_Wall_Aabb, Collider, Ig2_Polytope_Polytope_PolytopeGeom, Ig2_Wall_Polytope_PolytopeGeom, O, Vector3, utils

from ..measures.sizes import aabbExtrema
from ..scene.present import colliders, interactionLoops
from .sample import Sample
from .servo import Servo, actOn, eased

__all__ = ['WalledSample', 'boundaryMask', 'meetWalls', 'sixWalls', 'smooth', 'withoutEachOther']

boundaryMask = 2**31 - 1
"""Mask of walls and plates: they meet bodies of every mask, and not each other, see withoutEachOther()."""
selfMask = 2**30


class WalledSample(Sample):
	"""Bodies between walls; what polytope.pack() returns without a periodic cell.

	:ivar list walls: ids of the walls, [(lower, upper)] for each axis; None for the one that is missing above a heap under gravity
	"""

	def __init__(self, ids, walls):
		super().__init__(ids)
		self.walls = walls
		self.hold(k for pair in walls for k in pair if k is not None)
		self.servos = [Servo(self.mass) for _ in range(3)]
		self._states = [[None if k is None else O.bodies[k].state for k in pair] for pair in walls]

	@property
	def lower(self):
		"""Corner of the box [m]."""
		return np.array([float(pair[0].pos[axis]) for axis, pair in enumerate(self._states)])

	@property
	def upper(self):
		"""Opposite corner of the box [m]; for a heap without a wall above, with the height of its highest body."""
		top = None if all(pair[1] for pair in self._states) else aabbExtrema(self.ids)[1]
		return np.array([float(pair[1].pos[axis]) if pair[1] else top[axis] for axis, pair in enumerate(self._states)])

	@property
	def extents(self):
		return self.upper - self.lower

	def areas(self):
		"""Areas of the walls of each axis [m²]."""
		extents = self.extents
		return float(np.prod(extents)) / extents

	def forces(self):
		"""Forces by which the bodies push the walls of each axis apart [N]: the mean of both; below a heap without a wall above half of its
		weight."""
		pairs = [[0 if k is None else O.forces.f(k, sync=True)[axis] for k in pair] for axis, pair in enumerate(self.walls)]
		return np.array([float(above - below) / 2 for below, above in pairs])

	def boundaryStress(self):
		"""Normal stress on the walls of each axis [Pa], positive in compression."""
		return self.forces() / self.areas()

	def close(self):
		"""Puts a wall on the highest body of a heap under gravity, so that it can be loaded: with its weight, which the wall above does not feel."""
		if self.walls[2][1] is None:
			place = Vector3(*((self.lower + self.upper) / 2)[:2], self.upper[2])
			material = O.bodies[self.walls[0][0]].material
			above = O.bodies.append(utils.wall(place, 2, sense=-1, material=material, mask=boundaryMask))
			self.hold([above])
			self.walls[2], self._states[2][1] = (self.walls[2][0], above), O.bodies[above].state

	def apply(self):
		if any(None in pair for pair in self.walls):
			raise ValueError('sample: it has no wall above; sample.close() first')
		actOn(self)

	def move(self):
		"""Sets the walls' velocities for this step."""
		extents, forces = self.extents, self.forces()
		for axis, (states, servo) in enumerate(zip(self._states, self.servos, strict=True)):
			if self.stresses[axis] is None:
				speed = servo.speed = eased(servo.speed, -self.rates[axis] * extents[axis])
			else:
				servo.fastest = self.fastest[axis] * extents[axis]
				speed = servo.step(forces[axis] - self.stresses[axis] * extents[axis - 1] * extents[axis - 2])
			for state, sign in zip(states, (-0.5, 0.5), strict=True):  # each wall at half of the speed at which they part
				velocity = Vector3(0, 0, 0)
				velocity[axis] = sign * speed
				state.vel = velocity


def smooth(material, frictionAngle=0):
	"""A material like this one, of another friction angle, and without a shear law of its own."""
	attributes = {key: value for key, value in material.dict().items() if key not in ('id', 'label', 'strength', 'reduction')}
	return type(material)(**{**attributes, 'frictionAngle': frictionAngle})


def sixWalls(lower, upper, material, without=()):
	"""Ids of walls round a box, appended to the scene, [(lower, upper)] for each axis; None for those in *without*, [(axis, side 0 or 1)]."""
	middle, walls = (np.array(lower) + upper) / 2, []
	for axis, side in itertools.product(range(3), (0, 1)):
		place = middle.copy()
		place[axis] = (lower, upper)[side][axis]
		made = (
			None
			if (axis, side) in without
			else O.bodies.append(utils.wall(Vector3(*place), axis, sense=1 - 2 * side, material=material, mask=boundaryMask))
		)
		walls.append(made)
	return [(walls[2 * axis], walls[2 * axis + 1]) for axis in range(3)]


def withoutEachOther():
	"""Walls and plates of a boundary do not meet each other, by YADE's mask for this."""
	for collider in O.engines:
		if isinstance(collider, Collider):
			collider.avoidSelfInteractionMask |= selfMask


def meetWalls():
	"""Engines that were made before there were walls get the functors for them."""
	for collider in colliders():
		if not any(isinstance(functor, Bo1_Wall_Aabb) for functor in collider.boundDispatcher.functors):
			collider.boundDispatcher.functors = [*collider.boundDispatcher.functors, Bo1_Wall_Aabb()]
	for loop in interactionLoops():
		functors = list(loop.geomDispatcher.functors)
		kinds = [type(functor) for functor in functors]
		if Ig2_Polytope_Polytope_PolytopeGeom in kinds and Ig2_Wall_Polytope_PolytopeGeom not in kinds:
			loop.geomDispatcher.functors = [*functors, Ig2_Wall_Polytope_PolytopeGeom()]
