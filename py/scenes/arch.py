# SPDX-License-Identifier: GPL-2.0-or-later
"""A semicircular masonry arch of dry blocks between radial joints, under its own weight (Heyman 1966)."""

import dataclasses
import math

from yade import O, RockJointMat, Vector3

from ..bodies import fromVertices, polygon
from .jointEngines import jointEngines, stepFactor

__all__ = ['MasonryArch']


@dataclasses.dataclass
class MasonryArch:
	"""Blocks on two fixed springers. `MasonryArch(...).build()`. The arch stands in the xz plane, polygons in the xy plane."""

	thickness: float = 0.15
	"""Over the mean radius."""
	blocks: int = 32
	radius: float = 1.0
	"""Of the middle of the arch [m]."""
	dimension: int = 2
	frictionAngle: float = math.radians(89)
	stiffness: float = 1e9
	"""Normal and shear: [Pa/m] where perArea, else [N/m]."""
	perArea: bool = False
	ig2: dict = dataclasses.field(default_factory=dict)
	density: float = 2000
	gravity: float = 9.81
	damping: float = 0.5
	contactDamping: float = 0.3
	timeStepFraction: float = 0.15
	"""Time step over √(least mass/k)."""

	def build(self):
		O.reset()
		O.materials.append(
			RockJointMat(density=self.density, normalStiffness=self.stiffness, shearStiffness=self.stiffness, frictionAngle=self.frictionAngle)
		)
		t = self.thickness * self.radius
		inner, outer = self.radius - t / 2, self.radius + t / 2
		for side in (-1, 1):
			# wider than the arch, so that a block that slips outward finds ground
			O.bodies.append(self._body([(side * (r + way), z) for r, way in ((inner, -t / 2), (outer, t / 2)) for z in (0, -t)], fixed=True))
		angles = [math.pi * k / self.blocks for k in range(self.blocks + 1)]
		self.ids = [
			O.bodies.append(self._body([(r * math.cos(q), r * math.sin(q)) for q in pair for r in (inner, outer)]))
			for pair in zip(angles, angles[1:], strict=False)
		]
		jointEngines(
			self.ig2,
			self.perArea,
			self.upward * -self.gravity,
			damping=self.damping,
			verlet=0.05 * t,
			normalDamping=self.contactDamping,
			shearDamping=self.contactDamping,
		)
		k = self.stiffness * (t * self.breadth if self.perArea else 1)
		O.dt = self.timeStepFraction * stepFactor(self.ig2) * math.sqrt(min(O.bodies[i].state.mass for i in self.ids) / k)
		return self

	@property
	def breadth(self):
		"""Out of the plane [m]."""
		return 1.0 if self.dimension == 2 else self.thickness * self.radius

	@property
	def upward(self):
		return Vector3(0, 1, 0) if self.dimension == 2 else Vector3(0, 0, 1)

	def _body(self, corners, **body):
		if self.dimension == 2:
			return polygon(corners, **body)
		half = self.breadth / 2
		return fromVertices([(x, y, z) for x, z in corners for y in (-half, half)], **body)

	@property
	def states(self):
		return [O.bodies[i].state for i in self.ids]

	@property
	def sag(self):
		"""How far the block that has sunk most has sunk, over the radius."""
		return max((s.refPos - s.pos).dot(self.upward) for s in self.states) / self.radius

	@property
	def speed(self):
		"""Of the fastest block [m/s]."""
		return max(s.vel.norm() for s in self.states)

	def stands(self, most=2.5, fallen=0.03, calm=1e-5):
		"""Whether it still stands when all is calm, or after *most* seconds.

		:param float fallen: sag, over the radius, from which on it counts as fallen
		:param float calm: speed below which it counts as being at rest [m/s]
		"""
		while O.time < most:
			for _ in range(500):
				O.step()
			if self.sag > fallen:
				return False
			if O.time > 0.5 and self.speed < calm:
				return True
		return self.speed < 10 * calm

	def creep(self, steps):
		"""Largest way of a block in so many steps, over the radius."""
		before = [Vector3(s.pos) for s in self.states]
		for _ in range(steps):
			O.step()
		return max((s.pos - p).norm() for s, p in zip(self.states, before, strict=True)) / self.radius
