# SPDX-License-Identifier: GPL-2.0-or-later
"""How fast an overlap throws bodies apart, for polytope.check()."""

import math

from yade import RockJointMat, _polytope

from ..scene.movers import moverOf
from ..scene.present import isPerArea, jointMakers
from ..scene.radii import inscribedRadius

__all__ = ['Thrown']

deep = 0.1
"""Overlap over the smaller inscribed diameter, some ten times what is usual, above which two bodies were placed into each other, whatever
their stiffness."""

standardGravity = 9.81
"""[m/s²], where a scene in metres and seconds has none: what throws a stone there is no resting contact either."""


class Thrown:
	"""Speeds at which contacts that do not exist yet would throw bodies of this scene.

	The elastic energy of the overlap, as the contact computes it, becomes motion, without any damping: the lighter of the two gets v = √(2
	E m₂ / (m₁ (m₁ + m₂))). It is told where it is more than √(2 g h), that of a fall over the body's own thickness h, its inscribed
	diameter: no load that a body on another one carries itself throws it higher than that. Contacts that exist may bear the loads of
	others, and are told by their depth alone.
	"""

	def __init__(self, scene):
		self.scene, self.makers = scene, jointMakers(scene.loops)
		self.gravity = scene.gravity() or (standardGravity if scene.inMetres() else 0.0)

	def speed(self, one, other, at, otherAt):
		"""Speed at which their contact throws two polytopes that stand where `at` and `otherAt` do [m/s]: infinite for a deep overlap, 0
		for none worth telling."""
		try:
			# the chord: there is one also for a body within another, on which a contact surface would not act
			chord = float(_polytope.contact(at, otherAt, contactModel='boon2012', contactPoint='chebyshevCentre').depth)
			if not chord > 0:
				return 0.0
			fast = 0.0
			if self._isNew(one, other) and (stiffness := self._stiffness(one, other)):
				perArea, value = stiffness
				contact = _polytope.contact(at, otherAt, contactModel='foundation' if perArea else 'spring')
				fast = self._ifFast(one, other, value * (float(contact.area) if perArea else 1) * float(contact.energyPerStiffness))
		except ValueError:  # a polygon and a polyhedron
			return 0.0
		return math.inf if chord > 2 * deep * min(inscribedRadius(body.shape) for body in (one, other)) else fast

	def speedOfDepth(self, body, sphere, depth):
		"""Speed of a polytope and a sphere that overlap by so much: per area over the sphere's section at this depth, as their contact has it."""
		if not depth > 0:
			return 0.0
		radius = float(sphere.shape.radius)
		if depth > 2 * deep * min(radius, inscribedRadius(body.shape)):
			return math.inf
		if not self._isNew(body, sphere) or not (stiffness := self._stiffness(body, sphere)):
			return 0.0
		perArea, value = stiffness
		# ∫ k π (2 R x − x²) x dx from 0 to the depth
		energy = math.pi * (2 * radius * depth**3 / 3 - depth**4 / 4) if perArea else depth**2 / 2
		return self._ifFast(body, sphere, value * energy)

	def _isNew(self, one, other):
		return not self.scene.O.interactions.has(one.id, other.id, True)

	def _stiffness(self, one, other):
		"""(whether per area, normal stiffness of a joint of both); None for other materials and given values."""
		materials = [body.material for body in (one, other)]
		if not all(isinstance(material, RockJointMat) for material in materials) or (self.makers and self.makers[0].kn):
			return None
		perArea = [isPerArea(material, self.makers) for material in materials]
		values = [material.normalStiffness for material in materials]
		if perArea[0] != perArea[1]:
			return False, float(values[perArea.index(False)])
		return perArea[0], float(_polytope.stiffnessInSeries(*values))

	def _ifFast(self, one, other, energy):
		"""The speed, if it is more than that of the fall."""
		bodies = [body for body in (one, other) if self.scene.moves(body)]
		masses = [float(self.scene.O.bodies[moverOf(body.id)].state.mass) for body in bodies]
		if not min(masses) > 0 or not self.gravity > 0:
			return 0.0
		light, heavy = min(masses), (max(masses) if len(masses) > 1 else math.inf)
		share = 1.0 if math.isinf(heavy) else heavy / (light + heavy)
		speed = math.sqrt(2 * energy * share / light)
		thickness = 2 * inscribedRadius(bodies[masses.index(light)].shape)
		return speed if speed > math.sqrt(2 * self.gravity * thickness) else 0.0
