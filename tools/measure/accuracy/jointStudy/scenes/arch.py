# SPDX-License-Identifier: GPL-2.0-or-later
"""A semicircular masonry arch of dry blocks between radial joints, under its own weight (Heyman 1966)."""

import dataclasses
import math

from yade import O, RockJointMat, Vector3
from yade.polytope import fromVertices, polygon

from .engines import jointEngines

__all__ = ['MasonryArch']


@dataclasses.dataclass
class MasonryArch:
	"""Blocks on two fixed springers. `MasonryArch(...).build()`. The arch stands in the xz plane, polygons in the xy plane."""

	thickness: float = 0.15
	"""Thickness over the mean radius."""
	blocks: int = 32
	radius: float = 1.0
	"""Radius of the middle of the arch [m]."""
	dimension: int = 2
	frictionAngle: float = math.radians(89)
	stiffness: float = 4e10
	"""Normal and shear: [Pa/m] where perArea, else [N/m]."""
	perArea: bool = False
	ig2: dict = dataclasses.field(default_factory=dict)
	density: float = 2000
	gravity: float = 9.81
	damping: float = 0.5
	contactDamping: float = 0.3
	rockingDamping: float = 0.0
	timeStepFraction: float = 0.15
	"""Time step over √(least mass/k)."""

	def build(self):
		O.reset()
		O.materials.append(
			RockJointMat(
				density=self.density, normalStiffness=self.stiffness, shearStiffness=self.stiffness, frictionAngle=self.frictionAngle
			)
		)
		t = self.thickness * self.radius
		inner, outer = self.radius - t / 2, self.radius + t / 2
		for side in (-1, 1):
			# wider than the arch, so that a block that slips outward lands on it
			O.bodies.append(
				self._body([(side * (r + way), z) for r, way in ((inner, -t / 2), (outer, t / 2)) for z in (0, -t)], fixed=True)
			)
		angles = [math.pi * k / self.blocks for k in range(self.blocks + 1)]
		self.ids = [
			O.bodies.append(self._body([(r * math.cos(q), r * math.sin(q)) for q in pair for r in (inner, outer)]))
			for pair in zip(angles, angles[1:], strict=False)
		]
		self.integrator = jointEngines(
			self.ig2,
			self.perArea,
			self.upward * -self.gravity,
			damping=self.damping,
			verlet=0.05 * t,
			normalDamping=self.contactDamping,
			shearDamping=self.contactDamping,
			rockingDamping=self.rockingDamping,
		)
		k = self.stiffness * (t * self.breadth if self.perArea else 1)
		O.dt = self.timeStepFraction * math.sqrt(min(O.bodies[i].state.mass for i in self.ids) / k)
		return self

	@property
	def breadth(self):
		"""Breadth out of the plane [m]."""
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
		"""Speed of the fastest block [m/s]."""
		return max(s.vel.norm() for s in self.states)

	def settle(self, duration=1.5, growing=0.3):
		"""The arch's weight comes on slowly, within *growing* seconds, and is left to act, well damped."""
		end = O.time + duration
		while O.time < end:
			part = min(O.time / growing, 1)
			self.integrator.gravity = self.upward * (-self.gravity * part * (2 - part))
			O.step()

	def stands(self, settling=0.6, most=2.0, fallen=0.01, calm=1e-5):
		"""Whether it stands: it comes to rest before *most* seconds have passed.

		It settles first. Then there is little damping, which would hold up an arch that falls slowly.

		:param float fallen: sag, over the radius, from which on it counts as fallen
		:param float calm: speed below which it counts as being at rest [m/s]
		"""
		self.settle(settling)
		self.integrator.damping = self.damping / 5
		while O.time < most and self.sag < fallen:
			for _ in range(200):
				O.step()
			if O.time > 1.5 * settling and self.speed < calm:
				return True
		return self.sag < fallen and self.speed < 10 * calm

	def creep(self, steps):
		"""Largest way of a block in so many steps, over the radius."""
		before = [Vector3(s.pos) for s in self.states]
		for _ in range(steps):
			O.step()
		return max((s.pos - p).norm() for s, p in zip(self.states, before, strict=True)) / self.radius
