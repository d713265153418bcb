# SPDX-License-Identifier: GPL-2.0-or-later
"""Data of a scene that several checks of polytope.check() need."""

import collections
import functools
import itertools

import numpy as np
import yade
from yade import InsertionSortCollider, InteractionLoop, NewtonIntegrator, Polytope, Wall

from ..bonding.bonds import intactBonds
from ..scene.movers import canMove
from ..scene.present import gravityOf
from .falling import belowAll

__all__ = ['Kind', 'SceneToCheck']

Kind = collections.namedtuple('Kind', 'shape variant material')
"""Bodies that the dispatchers treat alike: name of the shape's class, dimension of a polytope or axis of a wall, name of the
material's class."""

Member = collections.namedtuple('Member', 'mask moving clump')


densities = 50.0, 3e4
"""Densities of what can be a body [kg/m³], from foam to heavy metals. In t and mm, g and cm, t and m … the same bodies have 1e-12 to 1e-3 of it."""
gravities = 1.0, 30.0
"""Gravity on Moon and planets [m/s²]; in mm and s, cm and s, mm and ms … it is a hundredth or a hundred times that."""


class SceneToCheck:
	def __init__(self, O, engines=None):
		if not isinstance(O, type(yade.O)):
			raise ValueError(f'O: must be yade.O, got {O!r}')
		if O.running:
			raise ValueError('O: is running; O.pause() first')
		self.O, self.ownEngines = O, engines is None
		self.engines = [engine for engine in (O.engines if engines is None else engines) if not engine.dead]
		self.loops = self.those(InteractionLoop)
		self.colliders = self.those(InsertionSortCollider)
		self.integrators = self.those(NewtonIntegrator)
		self.bodies = [body for body in O.bodies if body is not None and body.shape is not None and not body.isClump]
		self.kinds, self.examples = self._kinds()

	def those(self, *classes):
		return [engine for engine in self.engines if isinstance(engine, classes)]

	def moves(self, body):
		return canMove(body)

	def gravity(self):
		"""Size of *totalGravity* [m/s²]."""
		return float(np.linalg.norm(self.totalGravity))

	@functools.cached_property
	def totalGravity(self):
		"""(3,) of all integrators together [m/s²]"""
		return np.array(gravityOf(self.engines), float)

	@functools.cached_property
	def down(self):
		"""Unit vector along it; None: there is none."""
		return self.totalGravity / np.linalg.norm(self.totalGravity) if self.totalGravity.any() else None

	@functools.cached_property
	def bonded(self):
		"""Ids of bodies with an intact bond, also of such as are gone."""
		return {k for bond in intactBonds() for k in (bond.id1, bond.id2)}

	@functools.cached_property
	def fallen(self):
		"""Ids of bodies that fall for ever."""
		return belowAll(self)

	def inMetres(self):
		"""Whether densities and gravity are those of metres, kilograms and seconds: in other units that agree with each other large numbers
		are no mistake."""
		least, most = densities
		gravity = self.gravity()
		dense = all(least <= float(body.material.density) <= most for body in self.bodies if body.material and self.moves(body))
		return dense and (gravity == 0 or gravities[0] <= gravity <= gravities[1])

	def _kinds(self):
		"""(kind → its different members with how many of each there are, kind → one body)."""
		kinds, examples = {}, {}
		for body in self.bodies:
			shape = body.shape
			variant = shape.dimension if isinstance(shape, Polytope) else shape.axis if isinstance(shape, Wall) else None
			kind = Kind(type(shape).__name__, variant, type(body.material).__name__)
			member = Member(body.mask, self.moves(body), body.clumpId if body.isClumpMember else None)
			kinds.setdefault(kind, collections.Counter())[member] += 1
			examples.setdefault(kind, body)
		return kinds, examples

	def meetings(self):
		"""Pairs of kinds that contain two bodies which can touch: not both held, not of one clump, with a bit of the masks in common."""
		return [pair for pair in itertools.combinations_with_replacement(self.kinds, 2) if self._canMeet(*pair)]

	def _canMeet(self, one, other):
		avoid = self.colliders[0].avoidSelfInteractionMask if self.colliders else 0
		for a, b in itertools.product(self.kinds[one], self.kinds[other]):
			alone = one == other and a == b and self.kinds[one][a] < 2
			sameClump = a.clump is not None and a.clump == b.clump
			if (a.moving or b.moving) and a.mask & b.mask and not a.mask & b.mask & avoid and not alone and not sameClump:
				return True
		return False
